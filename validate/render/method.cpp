#include "render/method.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <system_error>
#include <utility>

#include "common/error.h"
#include "common/system/memory.h"
#include "render/declaration.h"
#include "render/glsl_text.h"

namespace gnomon::render {
namespace fs = std::filesystem;
namespace {

/// Sets the flag of every name that the list `key` holds.
void readFlags(const Declaration& declaration, std::string_view key, const char* what,
               const std::vector<std::pair<std::string_view, bool*>>& flags) {
  const toml::node_view<const toml::node> found = declaration.table()[key];
  if (!found) return;
  const toml::array* list = found.as_array();
  if (list == nullptr) declaration.fail(*found.node(), fmt::format("`{}`: a list expected", key));
  for (const toml::node& node : *list) {
    const auto name = node.value<std::string>().value_or("");
    const auto flag = std::find_if(flags.begin(), flags.end(),
                                   [&](const auto& entry) { return entry.first == name; });
    if (flag == flags.end()) {
      std::vector<std::string_view> names;
      names.reserve(flags.size());
      for (const auto& entry : flags) names.push_back(entry.first);
      declaration.fail(node,
                       fmt::format("{} `{}`, expected {}", what, name, fmt::join(names, ", ")));
    }
    *flag->second = true;
  }
}

MethodTables readTables(const Declaration& declaration) {
  MethodTables tables;
  readFlags(declaration, "tables", "table",
            {{"height", &tables.height},
             {"horizon", &tables.horizon},
             {"distance", &tables.distance},
             {"angles", &tables.angles},
             {"surface-angles", &tables.surfaceAngles},
             {"ellipse", &tables.ellipse}});
  if (tables.angles && tables.surfaceAngles) {
    declaration.fail(declaration.table(), "tables `angles` and `surface-angles`, one expected");
  }
  return tables;
}

MethodPasses readPasses(const Declaration& declaration) {
  MethodPasses passes;
  readFlags(declaration, "passes", "pass",
            {{"texture", &passes.texture},
             {"light-depth", &passes.lightDepth},
             {"shadow-volumes", &passes.shadowVolumes}});
  return passes;
}

DrawnMesh readMesh(const Declaration& declaration) {
  const toml::node_view<const toml::node> found = declaration.table()["mesh"];
  if (!found) return DrawnMesh::base;
  const auto name = found.value<std::string>().value_or("");
  if (name != "base" && name != "displaced") {
    declaration.fail(*found.node(), fmt::format("mesh `{}`, expected base or displaced", name));
  }
  return name == "base" ? DrawnMesh::base : DrawnMesh::displaced;
}

std::optional<DrawnMesh> readLightMesh(const Declaration& declaration) {
  const toml::node_view<const toml::node> found = declaration.table()["light_mesh"];
  if (!found) return std::nullopt;
  const auto name = found.value<std::string>().value_or("");
  if (name != "displaced") {
    declaration.fail(*found.node(), fmt::format("light_mesh `{}`, expected displaced", name));
  }
  return DrawnMesh::displaced;
}

bool readOwnNormal(const Declaration& declaration) {
  const toml::node_view<const toml::node> found = declaration.table()["normal"];
  if (!found) return false;
  const auto name = found.value<std::string>().value_or("");
  if (name != "own")
    declaration.fail(*found.node(), fmt::format("normal `{}`, expected own", name));
  return true;
}

std::map<std::string, MethodParameter> readParameters(const Declaration& declaration) {
  std::map<std::string, MethodParameter> parameters;
  const toml::node* found = declaration.table().get("parameters");
  if (found == nullptr) return parameters;
  const toml::table* tables = found->as_table();
  if (tables == nullptr) declaration.fail(*found, "`parameters`: a table expected");
  for (const auto& [name, node] : *tables) {
    const toml::table* table = node.as_table();
    if (table == nullptr) declaration.fail(node, "a table with default, minimum, maximum expected");
    declaration.allowOnly(*table, {"default", "minimum", "maximum", "about"});
    MethodParameter parameter;
    parameter.defaultValue = declaration.number(*table, "default");
    parameter.minimum = declaration.number(*table, "minimum");
    parameter.maximum = declaration.number(*table, "maximum");
    parameter.about = declaration.about(*table);
    if (!(parameter.minimum <= parameter.defaultValue &&
          parameter.defaultValue <= parameter.maximum)) {
      declaration.fail(node, "the default lies outside minimum … maximum");
    }
    parameters.emplace(name.str(), parameter);
  }
  return parameters;
}

/// Of the mesh that is drawn from the light alone.
void requireLightMesh(const Declaration& declaration, const Method& method) {
  if (!method.lightMesh) return;
  const toml::node& node = *declaration.table().get("light_mesh");
  if (!method.passes.lightDepth) {
    declaration.fail(node, "`light_mesh` needs passes = [\"light-depth\"]");
  }
  if (method.mesh == DrawnMesh::displaced) {
    declaration.fail(node, "`light_mesh` needs mesh = \"base\"");
  }
  const auto pieces = method.parameters.find("light_pieces");
  if (pieces == method.parameters.end()) {
    declaration.fail(node, "`light_mesh` needs the parameter light_pieces");
  }
  if (!(pieces->second.minimum >= 1 && pieces->second.maximum <= 1024)) {
    declaration.fail(node, "the parameter light_pieces: a range within 1 … 1024 expected");
  }
}

/// Finds which of the answers the file defines. One that defines neither a share nor a horizon is
/// taken at its word that it has a test: the compiler looks for it.
void readAnswers(Method& method) {
  const std::string& glsl = method.source.text;
  method.answersShares = definesFunction(glsl, "visibility", "Pixel");
  method.hasHorizon = definesFunction(glsl, "horizonSlope", "Pixel");
  method.hasTest =
      definesFunction(glsl, "isShadowed", "Pixel") || !(method.answersShares || method.hasHorizon);
  if (method.hasTest && glsl.find("isShadowed") == std::string::npos) {
    throw InputError(
        fmt::format("{}:1: no function `bool isShadowed(Pixel pixel, LocalLight light)`, every "
                    "method defines it, or `float visibility` or `float horizonSlope` of the same",
                    method.source.file));
  }
}

/// The function and its declaration come together: either alone shades nothing.
void requireNormal(const Declaration& declaration, const Method& method) {
  const std::string function = "`vec3 shadingNormal(Pixel pixel)`";
  const auto line = lineOfWord(method.source.text, "shadingNormal");
  if (!method.hasOwnNormal && line) {
    throw InputError(fmt::format("{}:{}: {} needs the declaration normal = \"own\"",
                                 method.source.file, *line, function));
  }
  if (!method.hasOwnNormal) return;
  const toml::node& node = *declaration.table().get("normal");
  if (!line) declaration.fail(node, "`normal` needs the function " + function);
  if (method.mesh == DrawnMesh::displaced) declaration.fail(node, "`normal` needs mesh = \"base\"");
}

void requirePasses(const Declaration& declaration, const Method& method) {
  requireLightMesh(declaration, method);
  if (method.passes.lightDepth && method.parameters.count("depth_side") == 0) {
    declaration.fail(declaration.table(), "pass `light-depth` needs the parameter depth_side");
  }
  if (method.passes.shadowVolumes && method.mesh != DrawnMesh::displaced) {
    declaration.fail(declaration.table(), "pass `shadow-volumes` needs mesh = \"displaced\"");
  }
  if (method.passes.texture && method.source.text.find("resolveTexel") == std::string::npos) {
    declaration.fail(declaration.table(),
                     "pass `texture` needs the function `float resolveTexel(Pixel pixel)`");
  }
}

/// No shader that a person wrote is as long; drivers crash on some that are.
void requireShort(const fs::path& path) {
  constexpr std::uintmax_t mostBytes = 1 << 18;
  std::error_code failure;
  const std::uintmax_t bytes = fs::file_size(path, failure);
  if (failure || bytes <= mostBytes) return;
  throw InputError(fmt::format("{}: {} found, a shader of at most {} expected", path.string(),
                               formatBytes(static_cast<double>(bytes)),
                               formatBytes(static_cast<double>(mostBytes))));
}

}  // namespace

Method readMethod(const fs::path& path) {
  requireShort(path);
  Method method;
  method.source = readShader(path);
  method.name = path.stem().string();
  const Declaration declaration(method.source.file, method.source.text);
  declaration.allowOnly(declaration.table(),
                        {"title", "citation", "tables", "passes", "mesh", "light_mesh", "normal",
                         "subdivisions", "azimuths", "parameters", "bakes"});
  method.title = declaration.text("title");
  method.citation = declaration.text("citation");
  method.tables = readTables(declaration);
  method.bakes = readBakes(declaration);
  method.passes = readPasses(declaration);
  method.mesh = readMesh(declaration);
  method.lightMesh = readLightMesh(declaration);
  method.hasOwnNormal = readOwnNormal(declaration);
  method.subdivisions = declaration.count(declaration.table(), "subdivisions", 1, 1024);
  method.azimuths = declaration.count(declaration.table(), "azimuths", 1, 1024);
  method.parameters = readParameters(declaration);
  requirePasses(declaration, method);
  requireNormal(declaration, method);
  requireBakeFunctions(declaration, method.bakes, method.source.text);
  readAnswers(method);
  if (const auto line = lineOfWord(method.source.text, "discard")) {
    throw InputError(fmt::format("{}:{}: `discard` found: method {} has to answer for every pixel",
                                 method.source.file, *line, method.name));
  }
  return method;
}

double parameterValue(const Method& method, const std::string& name,
                      const std::map<std::string, double>& chosen) {
  const MethodParameter& parameter = method.parameters.at(name);
  const auto value = chosen.find(name);
  if (value == chosen.end()) return parameter.defaultValue;
  if (!(value->second >= parameter.minimum && value->second <= parameter.maximum)) {
    throw InputError(fmt::format("method {}: parameter {} = {}, {} to {} expected", method.name,
                                 name, value->second, parameter.minimum, parameter.maximum));
  }
  return value->second;
}

int lightPieces(const Method& method, const std::map<std::string, double>& chosen) {
  const double pieces = parameterValue(method, "light_pieces", chosen);
  if (pieces != std::floor(pieces)) {
    throw InputError(fmt::format("method {}: parameter light_pieces = {}, a whole number expected",
                                 method.name, pieces));
  }
  return static_cast<int>(pieces);
}

fs::path methodFile(const fs::path& shaders, const std::string& name) {
  const std::vector<std::string> names = methodNames(shaders);
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw InputError(fmt::format("no method `{}`, there are {}", name, fmt::join(names, ", ")));
  }
  return shaders / "methods" / (name + ".glsl");
}

std::vector<std::string> methodNames(const fs::path& shaders) {
  std::vector<std::string> names;
  for (const fs::path& file : shadersIn(shaders / "methods")) {
    if (file.extension() == ".glsl") names.push_back(file.stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace gnomon::render
