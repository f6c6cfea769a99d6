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

#include "render/declaration.h"
#include "render/glsl_text.h"

namespace gnomon::render {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 14> declarations = {
    {{"TABLE_HEIGHT", R"(tables = ["height"])"},
     {"TABLE_HORIZON", R"(tables = ["horizon"])"},
     {"TABLE_DISTANCE", R"(tables = ["distance"])"},
     {"TABLE_ELLIPSE", R"(tables = ["ellipse"])"},
     {"TABLE_ANGLES", R"(tables = ["angles"] or ["surface-angles"])"},
     {"PASS_TEXTURE", R"(passes = ["texture"])"},
     {"PASS_LIGHT_DEPTH", R"(passes = ["light-depth"])"},
     {"PASS_SHADOW_VOLUMES", R"(passes = ["shadow-volumes"])"},
     {"MESH_DISPLACED", R"(mesh = "displaced")"},
     {"OWN_BAKES", "[bakes.NAME]"},
     {"OWN_TEXTURES", "[textures.NAME]"},
     {"OWN_PASSES", "[[pass]]"},
     {"NEEDS_CAMERA", R"(needs = "camera")"},
     {"PASS_CAMERA_DEPTH", R"(passes = ["camera-depth"])"}}};

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

/// The declaration that a name of a method's code would belong to, which no file of ours defines.
std::string ownDeclaration(const Method& method, const std::string& word) {
  const std::string name = ownNameOf(word);
  if (name.empty()) return "";
  const auto isNamed = [&](const auto& declared) { return declared.name == name; };
  const bool isDeclared = std::any_of(method.bakes.begin(), method.bakes.end(), isNamed) ||
                          std::any_of(method.textures.begin(), method.textures.end(), isNamed) ||
                          std::any_of(method.passes.own.begin(), method.passes.own.end(), isNamed);
  if (isDeclared) return "";
  OwnPass pass;
  pass.name = name;
  if (word.ends_with("Pass") || placeOfWord(method.code, pass.function())) {
    return fmt::format("[[pass]] name = \"{}\"", name);
  }
  return fmt::format("[{}.{}]", word.ends_with("Texture") ? "textures" : "bakes", name);
}

/// What a line of one of the method's files says.
std::string lineOf(const Method& method, const std::string& file, long row) {
  std::vector<const ShaderPiece*> files = {&method.source};
  for (const ShaderPiece& include : method.includes) files.push_back(&include);
  std::string line;
  for (const ShaderPiece* piece : files) {
    if (piece->file != file) continue;
    std::istringstream text(piece->text);
    for (; row > 0; --row) std::getline(text, line);
  }
  return line;
}

/// The file of the method that a message begins with; empty for others.
std::string fileOf(const Method& method, const std::string& message) {
  const auto piece = std::find_if(method.code.begin(), method.code.end(), [&](const auto& part) {
    return message.starts_with(part.file + ":");
  });
  return piece == method.code.end() ? "" : piece->file;
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

std::string ownNameOf(const std::string& word) {
  for (const std::string_view ending : {"At", "Texel", "Bake", "Texture", "Pass", "Origin"}) {
    if (!word.ends_with(ending)) continue;
    std::string name = word.substr(0, word.size() - ending.size());
    if (isOwnName(name)) return name;
  }
  return "";
}

std::string declarationFor(const std::string& define) {
  const auto* found = std::find_if(declarations.begin(), declarations.end(),
                                   [&](const auto& entry) { return entry.first == define; });
  return found == declarations.end() ? "" : std::string(found->second);
}

std::string missingDeclaration(const std::vector<SharedName>& names, const std::string& message,
                               const Method& method, const std::vector<std::string>& defines) {
  const std::string file = fileOf(method, message);
  if (file.empty()) return "";
  const std::string refused = message.substr(file.size() + 1);
  std::vector<std::string> words = wordsOf(refused);
  if (refused.find("syntax error") != std::string::npos) {
    const std::string line = lineOf(method, file, std::atol(refused.c_str()));
    for (std::string& word : wordsOf(line)) words.push_back(std::move(word));
  }
  for (const std::string& word : words) {
    const bool isShared = std::any_of(names.begin(), names.end(),
                                      [&](const auto& shared) { return shared.name == word; });
    const std::string own = isShared ? "" : ownDeclaration(method, word);
    if (!own.empty()) return fmt::format("; to use {}, declare {}", word, own);
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
    return fmt::format("; to use {}, declare {}", word, fmt::join(needed, " or "));
  }
  return "";
}

}  // namespace gnomon::render
