#include "study/spec/sweep/sweep_cases.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <utility>

namespace gnomon::study {

namespace {

/// One table on its way to the cases.
struct Column {
  const TomlReader* section;
  SweepTable table;
  std::size_t dimension = 0;
  std::vector<SweptValue> values = {};  ///< one a step of its dimension
};

/// Whether one key is the other or holds it.
bool overlap(const std::string& a, const std::string& b) {
  return a == b || a.starts_with(b + ".") || b.starts_with(a + ".");
}

void requireSweepable(const Column& column, const std::vector<Column>& before,
                      const StudyOptions& options) {
  const TomlReader& section = *column.section;
  const std::string& key = column.table.key;
  if (key.starts_with("study.") || key.starts_with("sweep.")) {
    section.fail("key", fmt::format("\"{}\" found, a key of what is measured expected", key));
  }
  for (const std::string& change : options.overrides) {
    if (change.starts_with(key + "=")) {
      section.fail("key",
                   fmt::format("\"{}\" found, but --set {} gives it one value", key, change));
    }
  }
  for (const Column& other : before) {
    if (!overlap(key, other.table.key)) continue;
    section.fail(
        "key", fmt::format("\"{}\" found, but the table above sets \"{}\"", key, other.table.key));
  }
}

/// The table above that a table steps with.
const Column& leaderOf(const Column& column, const std::vector<Column>& columns) {
  const Column* leader = nullptr;
  for (const Column& other : columns) {
    if (&other == &column) break;
    if (other.table.key == column.table.with) leader = &other;
  }
  if (leader == nullptr) {
    column.section->fail("with", fmt::format("\"{}\" found, the key of a table above it expected",
                                             column.table.with));
  }
  return *leader;
}

void readValues(Column& column) {
  column.values = sweepValues(*column.section, "values");
  if (column.values.size() < 2) {
    column.section->fail("values", "one value found, at least two expected");
  }
}

/// Gives each table its dimension and its values.
void arrange(std::vector<Column>& columns) {
  std::size_t dimensions = 0;
  for (Column& column : columns) {
    readValues(column);
    if (column.table.with.empty()) {
      column.dimension = dimensions++;
      continue;
    }
    const Column& leader = leaderOf(column, columns);
    column.dimension = leader.dimension;
    if (leader.values.size() != column.values.size()) {
      column.section->fail(
          "values", fmt::format("{} values found, as many as of {} expected: {}",
                                column.values.size(), leader.table.key, leader.values.size()));
    }
  }
}

/// Numbers that are equal are the same value, however they are written.
std::pair<double, std::string> identity(const SweptValue& value) {
  return value.number ? std::pair(*value.number, std::string()) : std::pair(0.0, value.written);
}

/// That no step of a dimension repeats another.
void requireDistinct(const std::vector<Column>& columns, std::size_t dimension) {
  std::vector<const Column*> members;
  for (const Column& column : columns) {
    if (column.dimension == dimension) members.push_back(&column);
  }
  std::set<std::vector<std::pair<double, std::string>>> seen;
  for (std::size_t i = 0; i < members.front()->values.size(); ++i) {
    std::vector<std::pair<double, std::string>> step;
    std::string text;
    for (const Column* member : members) {
      step.push_back(identity(member->values[i]));
      text += (text.empty() ? "" : " with ") + member->values[i].text;
    }
    if (seen.insert(step).second) continue;
    members.back()->section->fail("values",
                                  fmt::format("{} found twice, distinct values expected", text));
  }
}

std::vector<std::size_t> dimensionSizes(const std::vector<Column>& columns) {
  std::vector<std::size_t> sizes;
  for (const Column& column : columns) {
    if (column.dimension == sizes.size()) sizes.push_back(column.values.size());
  }
  return sizes;
}

std::size_t caseCountOf(const std::vector<Column>& columns, const std::vector<std::size_t>& sizes,
                        std::size_t most) {
  double count = 1;
  for (const std::size_t size : sizes) count *= static_cast<double>(size);
  if (count > static_cast<double>(most)) {
    columns.back().section->fail(
        "key", fmt::format("{:.0f} cases found over all tables, at most {} expected", count, most));
  }
  return static_cast<std::size_t>(count);
}

}  // namespace

std::vector<TomlReader> sweepTables(const TomlReader& root) {
  const toml::node* node = root.find("sweep");
  if (node == nullptr) return {};
  if (node->is_table()) return {root.table("sweep")};
  return root.tables("sweep");
}

Sweep readSweepTables(const std::vector<TomlReader>& tables, const StudyOptions& options) {
  std::vector<Column> columns;
  for (const TomlReader& section : tables) {
    Column column{&section, {}};
    readSection(section, keysOf(column.table));
    requireSweepable(column, columns, options);
    if (column.table.axis.empty()) column.table.axis = column.table.key;
    columns.push_back(std::move(column));
  }
  arrange(columns);
  const std::vector<std::size_t> sizes = dimensionSizes(columns);
  const std::size_t count = caseCountOf(columns, sizes, options.mostCases);
  Sweep sweep;
  for (const Column& column : columns) {
    const SweepTable& table = column.table;
    sweep.keys.push_back({table.key, table.axis, column.dimension});
  }
  for (std::size_t d = 0; d < sizes.size(); ++d) requireDistinct(columns, d);
  for (std::size_t c = 0; c < count; ++c) {
    std::vector<std::size_t> place(sizes.size());
    std::size_t rest = c;
    for (std::size_t d = sizes.size(); d-- > 0; rest /= sizes[d]) place[d] = rest % sizes[d];
    SweepCase one;
    for (const Column& column : columns) {
      one.values.push_back(column.values[place[column.dimension]]);
    }
    sweep.cases.push_back(std::move(one));
  }
  nameCases(sweep.keys, sweep.cases);
  return sweep;
}

namespace {

constexpr std::size_t longestName = 64;

bool isLetterOrDigit(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Letters and digits, and one dash for whatever stands between them.
std::string plainText(const std::string& text) {
  std::string plain;
  for (const char c : text) {
    if (isLetterOrDigit(c)) {
      plain += c;
    } else if (!plain.empty() && plain.back() != '-') {
      plain += '-';
    }
  }
  if (!plain.empty() && plain.back() == '-') plain.pop_back();
  return plain;
}

std::string valueName(const SweptValue& value) {
  if (!value.number) return plainText(value.text);
  std::string name = value.text;
  std::erase(name, '+');
  return name;
}

std::string numbered(const char* name, std::size_t index, std::size_t count) {
  return fmt::format("{}-{:0{}}", name, index + 1, fmt::formatted_size("{}", count));
}

/// The parts of a case's name.
class CaseNamer {
 public:
  explicit CaseNamer(std::span<const SweptKey> keys) : keys_(keys), names_(shortNames(keys)) {}

  [[nodiscard]] std::string name(const SweepCase& which) const {
    std::string name;
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      name += fmt::format("{}{}-{}", name.empty() ? "" : "_", plainText(names_[k]),
                          valueName(which.values.at(k)));
    }
    return name;
  }

 private:
  std::span<const SweptKey> keys_;
  std::vector<std::string> names_;
};

bool areGood(std::span<const SweepCase> cases) {
  std::set<std::string> seen;
  return std::all_of(cases.begin(), cases.end(), [&](const SweepCase& which) {
    return which.name.size() <= longestName && seen.insert(lowered(which.name)).second;
  });
}

}  // namespace

void nameCases(std::span<const SweptKey> keys, std::vector<SweepCase>& cases) {
  const bool areNumbers = std::all_of(cases.begin(), cases.end(), [](const SweepCase& which) {
    return which.values.front().number.has_value();
  });
  if (keys.size() == 1 && areNumbers) {
    for (SweepCase& which : cases) which.name = which.values.front().text;
    return;
  }
  const CaseNamer names(keys);
  for (SweepCase& which : cases) which.name = names.name(which);
  if (areGood(cases)) return;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    cases[c].name = numbered("case", c, cases.size());
  }
}

}  // namespace gnomon::study
