#include "study/spec/sweep/sweep.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/error.h"
#include "study/spec/sweep/sweep_cases.h"

namespace gnomon::study {

namespace fs = std::filesystem;
namespace {

/// What an error says beyond `opening` and a key, where the key is the sweep's or holds it.
std::optional<std::string> errorOfKey(std::string_view message, const std::string& opening,
                                      const std::string& key) {
  if (!message.starts_with(opening)) return std::nullopt;
  message.remove_prefix(opening.size());
  const std::string_view place = message.substr(0, message.find(": "));
  const bool its = place == key || key.starts_with(std::string(place) + ".");
  return its ? std::optional(std::string(message)) : std::nullopt;
}

/// A file's sweep, and what its errors are told by.
struct SweptFile {
  const StudyText& text;
  const StudyOptions& options;
  std::vector<TomlReader> tables;  ///< one a key
  Sweep sweep;

  [[nodiscard]] std::string change(std::size_t key, const SweepCase& which) const {
    return fmt::format("{}={}", sweep.keys[key].key, which.values[key].written);
  }
  [[noreturn]] void blame(std::size_t key, const SweepCase& which, std::string_view what) const {
    tables[key].fail("key", fmt::format("with {}: {}", change(key, which), what));
  }
};

/// The study of one case. What a value or its key is to blame for is an error of its table.
StudySpec readStep(const SweptFile& file, const SweepCase& which, StudyParts& parts) {
  StudyOptions options = file.options;
  for (std::size_t k = 0; k < file.sweep.keys.size(); ++k) {
    options.overrides.push_back(file.change(k, which));
  }
  try {
    return readStudy(file.text, options, parts);
  } catch (const InputError& error) {
    for (std::size_t k = 0; k < file.sweep.keys.size(); ++k) {
      // What an override sets has no line.
      const auto blamed =
          errorOfKey(error.what(), file.text.file.string() + ": ", file.sweep.keys[k].key);
      if (blamed) file.blame(k, which, *blamed);
    }
    throw;
  } catch (const UsageError& error) {
    const std::string message = error.what();
    for (std::size_t k = 0; k < file.sweep.keys.size(); ++k) {
      const std::string opening = fmt::format("--set {}: ", file.change(k, which));
      if (message.starts_with(opening)) file.blame(k, which, message.substr(opening.size()));
    }
    throw;
  }
}

StudyPlan singlePlan(StudySpec study) {
  StudyPlan plan{study.name, study.title, study.source, std::nullopt, {}};
  plan.steps.push_back(std::move(study));
  return plan;
}

}  // namespace

StudyPlan readStudyPlan(const fs::path& file, const StudyOptions& options,
                        const StepFilter& wants) {
  const StudyText text = readStudyText(file);
  const toml::table table = parseTomlText(text.text, file.string(), options.overrides);
  const TomlReader root(table, file.string(), "");
  std::vector<TomlReader> tables = sweepTables(root);
  if (tables.empty()) return singlePlan(readStudy(text, options));
  Sweep sweep = readSweepTables(tables, options);
  const SweptFile swept{text, options, std::move(tables), std::move(sweep)};
  StudyPlan plan;
  StudyParts parts;
  for (std::size_t i = 0; i < swept.sweep.cases.size(); ++i) {
    if (wants && !wants(i)) continue;
    const SweepCase& which = swept.sweep.cases[i];
    StudySpec step = readStep(swept, which, parts);
    plan.name = step.name;
    plan.title = step.title;
    plan.source = step.source;
    step.name = fmt::format("{}/{}", plan.name, which.name);
    step.sweepCases = swept.sweep.cases.size();
    for (MethodSpec& method : step.methods) {
      if (method.isGiven()) method.maskCase = which.name;
    }
    step.title += ", " + caseText(swept.sweep.keys, which);
    plan.steps.push_back(std::move(step));
  }
  plan.sweep = swept.sweep;
  return plan;
}

namespace {

constexpr std::string_view rangesExpected =
    "\"FIRST:LAST:STEP\", \"log:FIRST:LAST:COUNT\" or a list expected";

std::vector<std::string_view> partsOf(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::optional<double> numberOf(std::string_view text) {
  double number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool isNumber =
      failure == std::errc() && end == text.data() + text.size() && std::isfinite(number);
  return isNumber ? std::optional(number) : std::nullopt;
}

/// All parts as numbers; none where one is no number.
std::optional<std::vector<double>> numbersOf(std::span<const std::string_view> parts) {
  std::vector<double> numbers;
  for (const std::string_view part : parts) {
    const auto number = numberOf(part);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

/// The nearest number of so many decimal digits.
double rounded(double value, int digits) {
  return *numberOf(fmt::format("{:.{}g}", value, digits));
}

/// One of the texts of `sweepValues`, and how to refuse it.
struct RangeText {
  const TomlReader& section;
  std::string_view key;
  std::string text;

  [[noreturn]] void refuse(std::string_view what) const {
    section.fail(key, fmt::format("\"{}\" found, {}", text, what));
  }
};

std::vector<double> arithmeticRange(const RangeText& range, const std::vector<double>& parts) {
  const double first = parts[0];
  const double last = parts[1];
  const double step = parts[2];
  const double steps = (last - first) / step;
  if (!(steps > 0) || !std::isfinite(steps)) {
    range.refuse("a step other than 0 that leads from the first to the last expected");
  }
  if (steps >= static_cast<double>(mostSweepValues)) {
    range.refuse(fmt::format("at most {} values expected", mostSweepValues));
  }
  const auto count = static_cast<std::size_t>(std::llround(steps));
  if (count == 0 || std::abs(steps - static_cast<double>(count)) > 1e-6) {
    const double reached = first + std::floor(steps) * step;
    range.refuse(
        fmt::format("a last value that the steps reach expected, as {}", rounded(reached, 12)));
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = first + static_cast<double>(i) * step;
    // What is left of two numbers that cancel is no value.
    values.push_back(std::abs(value) < 1e-9 * std::abs(step) ? 0 : rounded(value, 12));
  }
  values.push_back(last);
  return values;
}

std::vector<double> geometricRange(const RangeText& range, const std::vector<double>& parts) {
  const double first = parts[0];
  const double last = parts[1];
  if (!(first > 0) || !(last > 0)) range.refuse("a first and a last value above 0 expected");
  if (parts[2] != std::floor(parts[2]) || parts[2] < 2 ||
      parts[2] > static_cast<double>(mostSweepValues)) {
    range.refuse(fmt::format("a count from 2 to {} expected", mostSweepValues));
  }
  const auto count = static_cast<std::size_t>(parts[2]);
  std::vector<double> values = {first};
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    values.push_back(rounded(first * std::pow(last / first, share), 6));
  }
  values.push_back(last);
  return values;
}

std::vector<SweptValue> rangeValues(const RangeText& range) {
  const std::vector<std::string_view> parts = partsOf(range.text);
  const bool isGeometric = parts.size() == 4 && parts[0] == "log";
  const auto numbers = numbersOf(std::span(parts).subspan(isGeometric ? 1 : 0));
  if (!numbers || numbers->size() != 3) range.refuse(rangesExpected);
  std::vector<SweptValue> values;
  for (const double number :
       isGeometric ? geometricRange(range, *numbers) : arithmeticRange(range, *numbers)) {
    values.push_back(sweptNumber(number));
  }
  return values;
}

/// A value of a list: a number, a text, true or false, or a flat list; none for anything else.
std::optional<SweptValue> valueOf(const toml::node& node) {
  if (node.is_number()) {
    const auto number = node.value<double>();
    return number && std::isfinite(*number) ? std::optional(sweptNumber(*number)) : std::nullopt;
  }
  const std::string written = tomlValueText(node);
  if (const auto text = node.value_exact<std::string>()) {
    return text->empty() ? std::nullopt : std::optional(SweptValue{*text, {}, written});
  }
  const toml::array* list = node.as_array();
  const bool isFlat = list != nullptr && !list->empty() &&
                      std::all_of(list->begin(), list->end(), [](const auto& e) {
                        return e.is_number() || e.is_string() || e.is_boolean();
                      });
  if (!isFlat && !node.is_boolean()) return std::nullopt;
  return SweptValue{written, {}, written};
}

}  // namespace

std::vector<SweptValue> sweepValues(const TomlReader& section, std::string_view key) {
  const toml::node* node = section.find(key);
  if (node == nullptr) section.fail(key, fmt::format("missing, {}", rangesExpected));
  if (const auto text = node->value_exact<std::string>()) {
    return rangeValues({section, key, *text});
  }
  const toml::array* list = node->as_array();
  // A list of numbers, or one number, has the reader's own messages.
  const bool isOfNumbers = list == nullptr || list->empty() || list->front().is_number();
  std::vector<SweptValue> values;
  if (isOfNumbers) {
    for (const double number : section.numbers(key, anyNumber)) {
      values.push_back(sweptNumber(number));
    }
  } else {
    for (const toml::node& entry : *list) {
      auto value = valueOf(entry);
      if (!value || entry.type() != list->front().type()) {
        section.fail(key, fmt::format("{} is not as the first one: numbers, texts, true and false, "
                                      "or flat lists expected",
                                      value ? value->text : "one of them"));
      }
      values.push_back(std::move(*value));
    }
  }
  if (values.size() > mostSweepValues) {
    section.fail(
        key, fmt::format("{} values found, at most {} expected", values.size(), mostSweepValues));
  }
  return values;
}

}  // namespace gnomon::study
