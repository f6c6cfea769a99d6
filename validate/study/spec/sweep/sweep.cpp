#include "study/spec/sweep/sweep.h"

#include <fmt/core.h>

#include <string_view>

#include "common/error.h"
#include "study/spec/sweep/sweep_cases.h"
#include "study/spec/toml/toml_reader.h"

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

}  // namespace gnomon::study
