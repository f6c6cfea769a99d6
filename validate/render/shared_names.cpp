#include "render/shared_names.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

namespace gnomon::render {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 10> declarations = {
    {{"TABLE_HEIGHT", R"(tables = ["height"])"},
     {"TABLE_HORIZON", R"(tables = ["horizon"])"},
     {"TABLE_DISTANCE", R"(tables = ["distance"])"},
     {"TABLE_ELLIPSE", R"(tables = ["ellipse"])"},
     {"TABLE_ANGLES", R"(tables = ["angles"] or ["surface-angles"])"},
     {"PASS_TEXTURE", R"(passes = ["texture"])"},
     {"PASS_LIGHT_DEPTH", R"(passes = ["light-depth"])"},
     {"PASS_SHADOW_VOLUMES", R"(passes = ["shadow-volumes"])"},
     {"MESH_DISPLACED", R"(mesh = "displaced")"},
     {"OWN_BAKES", "[bakes.NAME]"}}};

std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    found.push_back((*match)[1]);
  }
  return found;
}

std::vector<std::string> wordsOf(const std::string& text) {
  static const std::regex word(R"(\b([A-Za-z_]\w*)\b)");
  return matches(text, word);
}

/// The names of one file. `#if` is not nested around them there.
void addNames(const fs::path& file, std::vector<SharedName>& names) {
  static const std::regex declared(R"(^(?:uniform |const |flat )?\w+ (\w+)(?:;| = |\(| \{))");
  static const std::regex input(R"(^layout\(.*\) (?:flat )?in \w+ (\w+);)");
  static const std::regex defined(R"(\b([A-Z]+_[A-Z_]+)\b)");
  // Bump mapping itself reads the height map; methods see it only as a table.
  const bool isTable = file.filename() == "relief.glsl";
  const std::vector<std::string> always =
      isTable ? std::vector<std::string>{"TABLE_HEIGHT"} : std::vector<std::string>{};
  std::vector<std::string> defines = always;
  bool isInBody = false;
  std::istringstream text(readShader(file).text);
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("}")) isInBody = false;
    if (!isInBody && line.starts_with("#if")) defines = matches(line, defined);
    if (!isInBody && line.starts_with("#endif")) defines = always;
    std::smatch name;
    if (std::regex_search(line, name, declared) || std::regex_search(line, name, input)) {
      names.push_back({name[1], file.filename().string(), defines});
    }
    if (line.ends_with("{") && !line.starts_with(" ")) isInBody = true;
  }
}

bool hasBake(const Method& method, const std::string& name) {
  return std::any_of(method.bakes.begin(), method.bakes.end(),
                     [&](const MethodBake& bake) { return bake.name == name; });
}

}  // namespace

std::vector<SharedName> sharedNames(const fs::path& shaders) {
  std::vector<SharedName> names;
  for (const fs::path& file : shadersIn(shaders / "common")) {
    // These follow the method's own file, so that no method sees them.
    const bool isAfter = file.filename() == "shading.glsl" || file.filename() == "answers.glsl";
    const bool isBefore = file.extension() == ".glsl" && !isAfter;
    if (isBefore) addNames(file, names);
  }
  return names;
}

std::string declarationFor(const std::string& define) {
  const auto* found = std::find_if(declarations.begin(), declarations.end(),
                                   [&](const auto& entry) { return entry.first == define; });
  return found == declarations.end() ? "" : std::string(found->second);
}

std::string missingDeclaration(const std::vector<SharedName>& names, const std::string& message,
                               const Method& method, const std::vector<std::string>& defines) {
  const ShaderPiece& source = method.source;
  if (!message.starts_with(source.file + ":")) return "";
  const std::string refused = message.substr(source.file.size() + 1);
  std::vector<std::string> words = wordsOf(refused);
  if (refused.find("syntax error") != std::string::npos) {
    std::istringstream text(source.text);
    std::string line;
    for (long row = std::atol(refused.c_str()); row > 0; --row) std::getline(text, line);
    for (std::string& word : wordsOf(line)) words.push_back(std::move(word));
  }
  for (const std::string& word : words) {
    const bool isShared = std::any_of(names.begin(), names.end(),
                                      [&](const auto& shared) { return shared.name == word; });
    const std::string bake = isShared ? "" : bakeOfName(word);
    if (!bake.empty() && !hasBake(method, bake))
      return fmt::format("; {} needs [bakes.{}]", word, bake);
    std::vector<std::string> needed;
    bool isThere = false;
    for (const SharedName& shared : names) {
      if (shared.name != word) continue;
      isThere |= shared.defines.empty();
      for (const std::string& define : shared.defines) {
        isThere |= std::find(defines.begin(), defines.end(), define) != defines.end();
        needed.push_back(declarationFor(define));
      }
    }
    if (isThere || needed.empty()) continue;
    return fmt::format("; {} needs {}", word, fmt::join(needed, " or "));
  }
  return "";
}

}  // namespace gnomon::render
