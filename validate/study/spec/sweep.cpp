#include "study/spec/sweep.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "common/error.h"
#include "study/record/sweep_record.h"
#include "study/spec/toml/toml_reader.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

void requireSweepable(const TomlReader& section, const std::string& key,
                      const StudyOptions& options) {
  if (key.starts_with("study.") || key.starts_with("sweep.")) {
    section.fail("key", fmt::format("\"{}\" found, a key of what is measured expected", key));
  }
  for (const std::string& change : options.overrides) {
    if (change.starts_with(key + "=")) {
      section.fail("key",
                   fmt::format("\"{}\" found, but --set {} gives it one value", key, change));
    }
  }
}

SweepSpec readSweep(const TomlReader& section, const StudyOptions& options) {
  SweepSpec sweep;
  readSection(section, keysOf(sweep));
  requireSweepable(section, sweep.key, options);
  if (sweep.values.size() < 2) section.fail("values", "one value found, at least two expected");
  std::set<double> seen;
  for (const double value : sweep.values) {
    if (!seen.insert(value).second) {
      section.fail("values", fmt::format("{} found twice, distinct values expected", value));
    }
  }
  if (sweep.axis.empty()) sweep.axis = sweep.key;
  return sweep;
}

/// What an error says beyond `opening` and a key, where the key is the sweep's or holds it.
std::optional<std::string> errorOfKey(std::string_view message, const std::string& opening,
                                      const std::string& key) {
  if (!message.starts_with(opening)) return std::nullopt;
  message.remove_prefix(opening.size());
  const std::string_view place = message.substr(0, message.find(": "));
  const bool its = place == key || key.starts_with(std::string(place) + ".");
  return its ? std::optional(std::string(message)) : std::nullopt;
}

/// The study at one value. What the value or its key is to blame for is an error of the section.
StudySpec readStep(const StudyText& text, StudyOptions options, const TomlReader& section,
                   const SweepSpec& sweep, double value) {
  const std::string change = fmt::format("{}={}", sweep.key, sweepValueText(value));
  options.overrides.push_back(change);
  try {
    return readStudy(text, options);
  } catch (const InputError& error) {
    // What an override sets has no line.
    const auto blamed = errorOfKey(error.what(), text.file.string() + ": ", sweep.key);
    if (!blamed) throw;
    section.fail("key", fmt::format("with {}: {}", change, *blamed));
  } catch (const UsageError& error) {
    const std::string message = error.what();
    const std::string opening = fmt::format("--set {}: ", change);
    if (!message.starts_with(opening)) throw;
    section.fail("key", fmt::format("with {}: {}", change, message.substr(opening.size())));
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
  const auto section = root.optionalTable("sweep");
  if (!section) return singlePlan(readStudy(text, options));
  StudyPlan plan;
  plan.sweep = readSweep(*section, options);
  for (std::size_t i = 0; i < plan.sweep->values.size(); ++i) {
    if (wants && !wants(i)) continue;
    const double value = plan.sweep->values[i];
    StudySpec step = readStep(text, options, *section, *plan.sweep, value);
    plan.name = step.name;
    plan.title = step.title;
    plan.source = step.source;
    step.name = fmt::format("{}/{}", plan.name, sweepValueText(value));
    step.title += fmt::format(", {} = {}", plan.sweep->key, sweepValueText(value));
    plan.steps.push_back(std::move(step));
  }
  return plan;
}

}  // namespace gnomon
