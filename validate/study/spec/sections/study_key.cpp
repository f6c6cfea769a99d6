#include "study/spec/sections/study_key.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/lists.h"

namespace gnomon::study {
namespace {

/// The least whole number that TOML and `int` both hold, where a range leaves it open.
int wholeOf(double bound) {
  constexpr double most = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp(bound, -most, most));
}

std::string readText(const TomlReader& section, const StudyKey& key) {
  std::string text = section.text(key.name);
  const auto& known = key.oneOf;
  if (!known.empty() && std::find(known.begin(), known.end(), text) == known.end()) {
    section.fail(key.name,
                 fmt::format("\"{}\" found, one of {} expected", text, fmt::join(known, ", ")));
  }
  return text;
}

glm::ivec2 readWholePair(const TomlReader& section, const StudyKey& key) {
  const auto pair = section.list(key.name, key.range, 2);
  const glm::ivec2 whole(static_cast<int>(pair[0]), static_cast<int>(pair[1]));
  if (whole.x != pair[0] || whole.y != pair[1]) {
    section.fail(key.name,
                 fmt::format("[{}, {}] found, two whole numbers expected", pair[0], pair[1]));
  }
  return whole;
}

void readUnusual(const TomlReader& section, const StudyKey& key, const Unusual& value) {
  std::visit(Overloaded{[&](bool* flag) { *flag = section.flag(key.name); },
                        [&](int* whole) {
                          *whole = section.integer(key.name, wholeOf(key.range.least),
                                                   wholeOf(key.range.most));
                        },
                        [&](double* number) { *number = section.number(key.name, key.range); }},
             value.place);
}

/// Whether it has its usual value.
bool isUsual(const Unusual& value) {
  return std::visit([&](const auto* place) { return static_cast<double>(*place) == value.usual; },
                    value.place);
}

void readKey(const TomlReader& section, const StudyKey& key) {
  const std::string_view name = key.name;
  std::visit(
      Overloaded{
          [&](std::string* text) { *text = readText(section, key); },
          [&](bool* flag) { *flag = section.flag(name); },
          [&](int* whole) {
            *whole = section.integer(name, wholeOf(key.range.least), wholeOf(key.range.most));
          },
          [&](glm::ivec2* pair) { *pair = readWholePair(section, key); },
          [&](const Numbers& place) {
            const auto values = place.count == 1
                                    ? std::vector<double>{section.number(name, key.range)}
                                    : section.list(name, key.range, place.count);
            std::transform(values.begin(), values.end(), place.first, [&](double value) {
              return place.areAngles ? radians(value) : value * place.scale;
            });
          },
          [&](const OptionalNumber& place) {
            *place.number = section.number(name, key.range) * place.scale;
          },
          [&](const NumberOrList& list) { *list.numbers = section.numbers(name, key.range); },
          [&](const Unusual& value) { readUnusual(section, key, value); },
          [&](std::vector<Vec3>* points) { *points = section.points(name); },
          [&](const ChosenName& chosen) {
            chosen.set(section.choice(name, chosen.names, chosen.areNumbers));
          },
          [](const OwnCode&) {}},
      key.place);
}

/// Adds a key's value to a table of the file.
void write(toml::table& table, const StudyKey& key) {
  const auto insert = [&](auto&& value) {
    table.insert_or_assign(key.name, std::forward<decltype(value)>(value));
  };
  const auto insertNumbers = [&](const std::vector<double>& values) {
    if (values.size() == 1) return insert(values.front());
    toml::array array;
    for (const double value : values) array.push_back(value);
    insert(std::move(array));
  };
  std::visit(Overloaded{[&](const std::string* text) { insert(*text); },
                        [&](const bool* flag) { insert(*flag); },
                        [&](const int* whole) { insert(*whole); },
                        [&](const glm::ivec2* pair) {
                          insert(toml::array{pair->x, pair->y});
                        },
                        [&](const Numbers& place) {
                          std::vector<double> values(place.first, place.first + place.count);
                          for (double& value : values) {
                            value = place.areAngles ? degreesOf(value) : value / place.scale;
                          }
                          insertNumbers(values);
                        },
                        [&](const OptionalNumber& place) {
                          if (*place.number) insert(**place.number / place.scale);
                        },
                        [&](const NumberOrList& list) { insertNumbers(*list.numbers); },
                        [&](const Unusual& value) {
                          if (isUsual(value)) return;
                          std::visit([&](const auto* place) { insert(*place); }, value.place);
                        },
                        [&](const std::vector<Vec3>* points) {
                          toml::array list;
                          for (const Vec3& point : *points) {
                            list.push_back(toml::array{point.x, point.y, point.z});
                          }
                          insert(std::move(list));
                        },
                        [&](const ChosenName& chosen) {
                          const std::string& name = chosen.names.at(chosen.get());
                          if (chosen.areNumbers) return insert(std::stoi(name));
                          insert(name);
                        },
                        [](const OwnCode&) {}},
             key.place);
}

std::string quotedNames(const std::vector<std::string>& names, std::string_view mark) {
  std::vector<std::string> quoted;
  for (const std::string& name : names) quoted.push_back(fmt::format("{0}{1}{0}", mark, name));
  return fmt::format("{}", fmt::join(quoted, ", "));
}

}  // namespace

KeyNames namesOf(const StudyKeys& keys) {
  KeyNames names;
  for (const StudyKey& key : keys) names.emplace(key.name);
  return names;
}

void readKeys(const TomlReader& section, const StudyKeys& keys) {
  for (const StudyKey& key : keys) {
    if (std::holds_alternative<OwnCode>(key.place)) continue;
    if (section.find(key.name) != nullptr || key.otherwise == required) readKey(section, key);
  }
}

void readSection(const TomlReader& section, const StudyKeys& keys) {
  section.allow(namesOf(keys));
  readKeys(section, keys);
}

void readValues(const toml::table& values, const std::string& name, const StudyKeys& keys) {
  const TomlReader section(values, name, "");
  section.allow(namesOf(keys));
  for (const StudyKey& key : keys) {
    try {
      readKeys(section, {key});
    } catch (const InputError& error) {
      throw InputError(fmt::format("{} ({})", error.what(), key.meaning));
    }
  }
}

toml::table tableOf(const StudyKeys& keys) {
  toml::table table;
  for (const StudyKey& key : keys) write(table, key);
  return table;
}

void addKeys(cache::KeyBuilder& builder, const StudyKeys& keys, Enters result) {
  for (const StudyKey& key : keys) {
    if ((static_cast<unsigned>(key.enters) & static_cast<unsigned>(result)) == 0) continue;
    const auto* unusual = std::get_if<Unusual>(&key.place);
    if (unusual != nullptr && isUsual(*unusual)) continue;
    toml::table value;
    write(value, key);
    builder.add(key.name, tomlValueText(value));
  }
}

std::string typeText(const StudyKey& key) {
  const std::string number = expectedNumber(key.range);
  const std::string whole = fmt::format("{} to {}", key.range.least, key.range.most);
  return std::visit(
      Overloaded{[&](const std::string*) {
                   return key.oneOf.empty() ? "text" : quotedNames(key.oneOf, "`");
                 },
                 [](const bool*) { return std::string("true or false"); },
                 [&](const int*) { return "a whole number from " + whole; },
                 [&](const glm::ivec2*) { return "two whole numbers from " + whole; },
                 [&](const Numbers& place) {
                   return place.count == 1
                              ? number
                              : fmt::format("a list of {}, each {}", place.count, number);
                 },
                 [&](const OptionalNumber&) { return number; },
                 [&](const NumberOrList&) { return number + ", or a list of them"; },
                 [&](const Unusual& value) {
                   if (std::holds_alternative<bool*>(value.place)) {
                     return std::string("true or false");
                   }
                   return std::holds_alternative<int*>(value.place) ? "a whole number from " + whole
                                                                    : number;
                 },
                 [](const std::vector<Vec3>*) { return std::string("a list of points [x, y, z]"); },
                 [](const ChosenName& chosen) {
                   return quotedNames(chosen.names, chosen.areNumbers ? "" : "`");
                 },
                 [](const OwnCode& own) { return own.type; }},
      key.place);
}

std::string defaultText(const StudyKey& key) {
  if (!key.otherwise.empty()) return std::string(key.otherwise);
  if (const auto* unusual = std::get_if<Unusual>(&key.place)) {
    const bool isFlag = std::holds_alternative<bool*>(unusual->place);
    return isFlag ? fmt::format("`{}`", unusual->usual != 0) : fmt::format("`{}`", unusual->usual);
  }
  toml::table value;
  write(value, key);
  return value.empty() ? "" : fmt::format("`{}`", tomlValueText(*value.get(key.name)));
}

}  // namespace gnomon::study
