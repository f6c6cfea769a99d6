#include "render/shared_names.h"

#include <algorithm>
#include <array>
#include <regex>
#include <sstream>
#include <string_view>
#include <utility>

#include "render/declaration.h"

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

std::vector<std::string> allMatches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    found.push_back((*match)[1]);
  }
  return found;
}

/// "a" and "b" of "vec2 a, b;".
std::vector<std::string> membersIn(const std::string& line) {
  static const std::regex member(R"((\w+)(?=[,;]))");
  return allMatches(line.substr(0, line.find("//")), member);
}

}  // namespace

std::vector<SharedName> namesIn(const ShaderPiece& text, const std::vector<std::string>& always) {
  // `#if` is not nested around names.
  static const std::regex declared(R"(^(?:uniform |const |flat )?\w+ (\w+)(?:;| = |\(| \{))");
  static const std::regex input(R"(^layout\(.*\) (?:flat )?in \w+ (\w+);)");
  static const std::regex function(R"(^(\w+ \w+\([^)]*\)) \{)");
  static const std::regex defined(R"(\b([A-Z]+_[A-Z_]+)\b)");
  std::vector<SharedName> names;
  std::vector<std::string> defines = always;
  bool isInBody = false;
  bool isInStructure = false;
  std::istringstream lines(text.text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("}")) isInBody = isInStructure = false;
    if (!isInBody && line.starts_with("#if")) defines = allMatches(line, defined);
    if (!isInBody && line.starts_with("#endif")) defines = always;
    if (isInStructure) {
      for (std::string& member : membersIn(line)) names.back().members.push_back(std::move(member));
    }
    std::smatch name;
    if (std::regex_search(line, name, declared) || std::regex_search(line, name, input)) {
      names.push_back({name[1], fs::path(text.file).filename().string()});
      names.back().defines = defines;
      std::smatch signature;
      if (std::regex_search(line, signature, function)) names.back().signature = signature[1];
    }
    if (line.ends_with("{") && !line.starts_with(" ")) {
      isInBody = true;
      isInStructure = line.starts_with("struct ");
    }
  }
  return names;
}

std::vector<SharedName> sharedNames(const fs::path& shaders) {
  std::vector<SharedName> names;
  for (const fs::path& file : shadersIn(shaders / "common")) {
    // These follow the method's own file, so that no method sees them.
    const bool isAfter = file.filename() == "shading.glsl" || file.filename() == "answers.glsl";
    const bool isBefore = file.extension() == ".glsl" && !isAfter;
    if (!isBefore) continue;
    // Bump mapping itself reads the height map; methods see it only as a table.
    const bool isTable = file.filename() == "relief.glsl";
    for (SharedName& name :
         namesIn(readShader(file),
                 isTable ? std::vector<std::string>{"TABLE_HEIGHT"} : std::vector<std::string>{})) {
      names.push_back(std::move(name));
    }
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

}  // namespace gnomon::render
