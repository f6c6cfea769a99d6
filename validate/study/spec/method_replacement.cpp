#include "study/spec/method_replacement.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <set>

#include "common/error.h"
#include "study/spec/sections/method_section.h"
#include "study/spec/sections/study_paths.h"

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
    method.insert("file", pathText(fs::absolute(replacement.shader)));
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
  if (const auto masks = method["masks"].value<std::string>()) return givenName(pathOf(*masks));
  const auto name = method["name"].value<std::string>();
  return (name ? *name : stemText(pathOf(method["file"].value_or(std::string())))) +
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

}  // namespace gnomon::study
