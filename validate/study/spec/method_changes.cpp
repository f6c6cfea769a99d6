#include "study/spec/method_changes.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "study/spec/sections/method_section.h"
#include "study/spec/sections/study_files.h"

namespace gnomon::study {

namespace fs = std::filesystem;
namespace {

struct Replacement {
  std::string label;
  std::string shader;
};

Replacement parsed(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    throw UsageError(fmt::format(
        "--replace {}: METHOD=NAME or METHOD=FILE.glsl expected, as onoue-2004=mine.glsl", text));
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

/// Makes a method's table name another shader under its old label.
void replaceShader(toml::table& method, const Replacement& replacement) {
  method.insert_or_assign("label", replacement.label);
  for (const char* key : {"name", "file", "masks", "parameters"}) method.erase(key);
  if (fs::path(replacement.shader).extension() == ".glsl") {
    method.insert("file", fileText(fs::absolute(replacement.shader)));
  } else {
    method.insert("name", replacement.shader);
  }
}

/// A ladder begins at the shader that the study gives the method.
void removeLadder(toml::table& study, const std::string& label) {
  toml::array* ladders = study["ladder"].as_array();
  if (ladders == nullptr) return;
  for (auto entry = ladders->begin(); entry != ladders->end();) {
    const toml::table* ladder = entry->as_table();
    const bool its = ladder != nullptr && (*ladder)["method"].value<std::string>() == label;
    entry = its ? ladders->erase(entry) : entry + 1;
  }
  if (!ladders->empty()) return;
  study.erase("ladder");
}

}  // namespace

std::string methodLabel(const toml::table& method) {
  if (const auto label = method["label"].value<std::string>()) return *label;
  if (const auto masks = method["masks"].value<std::string>()) return givenName(fileOf(*masks));
  const auto name = method["name"].value<std::string>();
  return (name ? *name : stemText(fileOf(method["file"].value_or(std::string())))) +
         (method["disc"].value_or(false) ? discLabel : "");
}

void replaceMethods(toml::table& study, const fs::path& file,
                    const std::vector<std::string>& replacements) {
  std::set<std::string> replaced;
  for (const std::string& text : replacements) {
    const Replacement replacement = parsed(text);
    if (!replaced.insert(replacement.label).second) {
      throw UsageError(fmt::format("--replace {}: {} is replaced twice", text, replacement.label));
    }
    std::vector<std::string> labels;
    bool found = false;
    if (toml::array* methods = study["method"].as_array()) {
      for (toml::node& entry : *methods) {
        toml::table* method = entry.as_table();
        if (method == nullptr) continue;
        labels.push_back(methodLabel(*method));
        if (labels.back() != replacement.label) continue;
        replaceShader(*method, replacement);
        found = true;
      }
    }
    if (!found) {
      throw UsageError(
          fmt::format("--replace {}: {} has {}", text, file.string(), fmt::join(labels, ", ")));
    }
    removeLadder(study, replacement.label);
  }
}

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
