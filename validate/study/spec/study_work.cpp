#include "study/spec/study_work.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/error.h"

namespace gnomon::study {

namespace {

/// Takes thresholds out of a study, and records them as skipped.
template <typename Condition>
void leaveOut(StudySpec& study, const char* reason, const Condition& condition) {
  for (const Gate& gate : study.thresholds) {
    if (condition(gate)) study.leftOut.push_back({gate, GateVerdict::skipped, {}, reason});
  }
  std::erase_if(study.thresholds, condition);
}

/// Keeps some of the methods, and drops the gates, claims and ladders that speak of others.
template <typename Condition>
void keepMethods(StudySpec& study, const Condition& isWanted) {
  for (const MethodSpec& method : study.methods) {
    if (!isWanted(method)) study.leftOutMethods.push_back(method.label);
  }
  std::erase_if(study.methods, [&](const MethodSpec& method) { return !isWanted(method); });
  const auto isGone = [&](const std::string& label) {
    return !label.empty() &&
           std::none_of(study.methods.begin(), study.methods.end(),
                        [&](const MethodSpec& method) { return method.label == label; });
  };
  leaveOut(study, "its method is left out", [&](const Gate& gate) { return isGone(gate.method); });
  std::erase_if(study.claims, [&](const ClaimSpec& claim) {
    return isGone(claim.less) || isGone(claim.than) || isGone(claim.method);
  });
  std::erase_if(study.ladders, [&](const LadderSpec& ladder) { return isGone(ladder.method); });
}

/// Keeps the methods that the command line names, by label or by name.
void keepNamed(StudySpec& study, const std::vector<std::string>& wanted) {
  const auto isNamed = [](const MethodSpec& method, const std::string& name) {
    return method.label == name || method.file.stem() == name;
  };
  for (const std::string& name : wanted) {
    if (std::none_of(study.methods.begin(), study.methods.end(),
                     [&](const MethodSpec& method) { return isNamed(method, name); })) {
      std::vector<std::string> labels;
      for (const MethodSpec& method : study.methods) labels.push_back(method.label);
      throw UsageError(fmt::format("--method {}: {} has {}", name, study.file.string(),
                                   fmt::join(labels, ", ")));
    }
  }
  keepMethods(study, [&](const MethodSpec& method) {
    return std::any_of(wanted.begin(), wanted.end(),
                       [&](const std::string& name) { return isNamed(method, name); });
  });
}

/// Keeps the methods that gates name; all, where there is no gate or one leaves them free.
void keepGated(StudySpec& study) {
  const auto isFree = [](const Gate& gate) { return gate.method.empty(); };
  const std::vector<Gate> gates = study.thresholds;
  if (gates.empty() || std::any_of(gates.begin(), gates.end(), isFree)) return;
  keepMethods(study, [&](const MethodSpec& method) {
    return std::any_of(gates.begin(), gates.end(),
                       [&](const Gate& gate) { return gate.method == method.label; });
  });
}

}  // namespace

StudySpec withoutMethods(StudySpec study, std::span<const std::string> labels) {
  keepMethods(study, [&](const MethodSpec& method) {
    return std::find(labels.begin(), labels.end(), method.label) == labels.end();
  });
  return study;
}

void reduce(StudySpec& study, const StudyOptions& options) {
  if (!options.methods.empty()) keepNamed(study, options.methods);
  if (study.quick) {
    leaveOut(study, "it holds for the full form only",
             [](const Gate& gate) { return !std::get<Threshold>(gate.origin).quick; });
  }
  if (options.gatedOnly) keepGated(study);
}

}  // namespace gnomon::study
