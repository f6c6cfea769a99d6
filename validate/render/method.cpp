#include "render/method.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <system_error>
#include <utility>

#include "common/error.h"
#include "common/system/memory.h"
#include "render/declaration.h"

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
             {"shadow-volumes", &passes.shadowVolumes},
             {"camera-depth", &passes.cameraDepth}});
  passes.own = readOwnPasses(declaration);
  return passes;
}

/// One of several names; empty where the key is not there.
template <std::size_t count>
std::string readName(const Declaration& declaration, std::string_view key,
                     const std::array<std::string_view, count>& names) {
  const toml::node_view<const toml::node> found = declaration.table()[key];
  if (!found) return {};
  auto name = found.value<std::string>().value_or("");
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    declaration.fail(*found.node(),
                     fmt::format("{} `{}`, expected one of {}", key, name, fmt::join(names, ", ")));
  }
  return name;
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

bool readNeeds(const Declaration& declaration) {
  const toml::node_view<const toml::node> found = declaration.table()["needs"];
  if (!found) return false;
  const auto name = found.value<std::string>().value_or("");
  if (name != "camera") {
    declaration.fail(*found.node(), fmt::format("needs `{}`, expected camera", name));
  }
  return true;
}

bool readOwnNormal(const Declaration& declaration) {
  const toml::node_view<const toml::node> found = declaration.table()["normal"];
  if (!found) return false;
  const auto name = found.value<std::string>().value_or("");
  if (name != "own")
    declaration.fail(*found.node(), fmt::format("normal `{}`, expected own", name));
  return true;
}

ParameterKind readKind(const Declaration& declaration, const toml::table& table) {
  const bool isFlag = table.contains("default") && table.get("default")->is_boolean();
  const toml::node* found = table.get("type");
  if (found == nullptr) return isFlag ? ParameterKind::flag : ParameterKind::real;
  const std::string name = declaration.textOf(*found, "type");
  if (name == "bool" && isFlag) return ParameterKind::flag;
  if (name == "float" && !isFlag) return ParameterKind::real;
  if (name == "int" && !isFlag) return ParameterKind::whole;
  declaration.fail(*found, fmt::format("`type`: \"{}\" found, \"float\" or \"int\" of a number, "
                                       "\"bool\" of true and false expected",
                                       name));
}

MethodParameter readParameter(const Declaration& declaration, const toml::table& table) {
  MethodParameter parameter;
  parameter.kind = readKind(declaration, table);
  parameter.about = declaration.about(table);
  if (parameter.kind == ParameterKind::flag) {
    declaration.allowOnly(table, {"default", "type", "about"});
    parameter.defaultValue = table.get("default")->value_or(false) ? 1 : 0;
    parameter.maximum = 1;
    return parameter;
  }
  declaration.allowOnly(table, {"default", "minimum", "maximum", "type", "about"});
  parameter.defaultValue = declaration.number(table, "default");
  parameter.minimum = declaration.number(table, "minimum");
  parameter.maximum = declaration.number(table, "maximum");
  constexpr double largest = 1 << 30;  // of an int of GLSL
  for (const double value : {parameter.defaultValue, parameter.minimum, parameter.maximum}) {
    const bool isWhole = value == std::floor(value) && std::abs(value) <= largest;
    if (parameter.kind == ParameterKind::whole && !isWhole) {
      declaration.fail(table, "type = \"int\": whole numbers up to 2³⁰ expected");
    }
  }
  if (!(parameter.minimum <= parameter.defaultValue &&
        parameter.defaultValue <= parameter.maximum)) {
    declaration.fail(table, "the default lies outside minimum … maximum");
  }
  return parameter;
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
    parameters.emplace(name.str(), readParameter(declaration, *table));
  }
  return parameters;
}

/// Of the mesh that is drawn from the light alone.
void requireLightMesh(const Declaration& declaration, const Method& method) {
  if (!method.lightMesh) return;
  const toml::node& node = *declaration.table().get("light_mesh");
  if (!method.passes.lightDepth && !method.passes.hasOwn(PassRaster::light)) {
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
  const std::vector<ShaderPiece>& glsl = method.code;
  method.answersShares = definesFunction(glsl, "visibility", "Pixel");
  method.hasHorizon = definesFunction(glsl, "horizonSlope", "Pixel");
  method.hasTest =
      definesFunction(glsl, "isShadowed", "Pixel") || !(method.answersShares || method.hasHorizon);
  const bool isNamed = std::any_of(glsl.begin(), glsl.end(), [](const ShaderPiece& piece) {
    return piece.text.find("isShadowed") != std::string::npos;
  });
  if (method.hasTest && !isNamed) {
    throw InputError(
        fmt::format("{}:1: no function `bool isShadowed(Pixel pixel, LocalLight light)`, every "
                    "method defines it, or `float visibility` or `float horizonSlope` of the same",
                    method.source.file));
  }
}

/// The function and its declaration come together: either alone shades nothing.
void requireNormal(const Declaration& declaration, const Method& method) {
  const std::string function = "`vec3 shadingNormal(Pixel pixel)`";
  const auto place = placeOfWord(method.code, "shadingNormal");
  if (!method.hasOwnNormal && place) {
    throw InputError(
        fmt::format("{}: {} needs the declaration normal = \"own\"", *place, function));
  }
  if (!method.hasOwnNormal) return;
  const toml::node& node = *declaration.table().get("normal");
  if (!place) declaration.fail(node, "`normal` needs the function " + function);
  if (method.mesh == DrawnMesh::displaced) declaration.fail(node, "`normal` needs mesh = \"base\"");
}

void requirePasses(const Declaration& declaration, const Method& method) {
  requireLightMesh(declaration, method);
  const bool seesLight = method.passes.lightDepth || method.passes.hasOwn(PassRaster::light);
  if (seesLight && method.parameters.count("depth_side") == 0) {
    declaration.fail(declaration.table(),
                     method.passes.lightDepth
                         ? "pass `light-depth` needs the parameter depth_side"
                         : "a pass from the light needs the parameter depth_side");
  }
  if (method.passes.shadowVolumes && method.mesh != DrawnMesh::displaced) {
    declaration.fail(declaration.table(), "pass `shadow-volumes` needs mesh = \"displaced\"");
  }
  if (method.passes.texture && !placeOfWord(method.code, "resolveTexel")) {
    declaration.fail(declaration.table(),
                     "pass `texture` needs the function `float resolveTexel(Pixel pixel)`");
  }
}

/// Bakes, textures and passes give names to functions: no two may share one.
void requireNamesApart(const Declaration& declaration, const Method& method) {
  std::vector<std::string> names;
  for (const MethodBake& bake : method.bakes) names.push_back(bake.name);
  for (const MethodTexture& texture : method.textures) names.push_back(texture.name);
  for (const OwnPass& pass : method.passes.own) names.push_back(pass.name);
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice == names.end()) return;
  declaration.fail(declaration.table(), fmt::format("two of its bakes, textures and passes are "
                                                    "`{}`, one expected",
                                                    *twice));
}

void requireShort(const fs::path& path) {
  std::error_code failure;
  const std::uintmax_t bytes = fs::file_size(path, failure);
  if (failure || bytes <= mostShaderBytes) return;
  throw InputError(fmt::format("{}: {} found, a shader of at most {} expected", path.string(),
                               formatBytes(static_cast<double>(bytes)),
                               formatBytes(static_cast<double>(mostShaderBytes))));
}

}  // namespace

bool MethodPasses::hasOwn(PassRaster raster) const {
  return std::any_of(own.begin(), own.end(),
                     [raster](const OwnPass& pass) { return pass.raster == raster; });
}

int MethodPasses::count() const {
  const bool drawsDepth = lightDepth && !hasOwn(PassRaster::light);
  return 1 + (texture ? 1 : 0) + (drawsDepth ? 1 : 0) + (shadowVolumes ? 2 : 0) +
         (cameraDepth ? 1 : 0) + static_cast<int>(own.size());
}

std::vector<fs::path> Method::otherFiles() const {
  std::vector<fs::path> files;
  for (const ShaderPiece& include : includes) files.emplace_back(include.file);
  for (const MethodTexture& texture : textures) files.push_back(texture.file);
  return files;
}

Method readMethod(const fs::path& path) {
  requireShort(path);
  Method method;
  method.source = readShader(path);
  method.name = path.stem().string();
  IncludedCode included = expandIncludes(path, method.source);
  method.code = std::move(included.pieces);
  method.includes = std::move(included.includes);
  const Declaration declaration(method.source, method.includes);
  declaration.allowOnly(
      declaration.table(),
      {"title", "citation", "family", "symbol", "tables", "passes", "mesh", "light_mesh", "normal",
       "subdivisions", "azimuths", "parameters", "bakes", "textures", "pass", "needs"});
  method.title = declaration.text("title");
  method.citation = declaration.text("citation");
  method.mark = {readName(declaration, "family", methodFamilies),
                 readName(declaration, "symbol", methodSymbols)};
  method.tables = readTables(declaration);
  method.bakes = readBakes(declaration);
  method.textures = readTextures(declaration, path.parent_path());
  method.passes = readPasses(declaration);
  method.mesh = readMesh(declaration);
  method.lightMesh = readLightMesh(declaration);
  method.hasOwnNormal = readOwnNormal(declaration);
  method.needsEye = readNeeds(declaration);
  method.subdivisions = declaration.count(declaration.table(), "subdivisions", 1, 1024);
  method.azimuths = declaration.count(declaration.table(), "azimuths", 1, 1024);
  method.parameters = readParameters(declaration);
  requirePasses(declaration, method);
  requireNormal(declaration, method);
  requireBakeFunctions(declaration, method.bakes, method.code);
  requirePassFunctions(declaration, method.passes.own, method.code);
  requireNamesApart(declaration, method);
  readAnswers(method);
  if (const auto place = placeOfWord(method.code, "discard")) {
    throw InputError(fmt::format("{}: `discard` found: method {} has to answer for every pixel",
                                 *place, method.name));
  }
  return method;
}

bool MethodParameter::allows(double value) const {
  const bool isRight = kind == ParameterKind::real || value == std::floor(value);
  return isRight && value >= minimum && value <= maximum;
}

std::string MethodParameter::rangeText() const {
  if (kind == ParameterKind::flag) return "true or false";
  return fmt::format("{}{} to {}", kind == ParameterKind::whole ? "a whole number from " : "",
                     minimum, maximum);
}

std::string MethodParameter::textOf(double value) const {
  if (kind == ParameterKind::flag) return value != 0 ? "true" : "false";
  return fmt::format("{}", value);
}

double parameterValue(const Method& method, const std::string& name,
                      const std::map<std::string, double>& chosen) {
  const MethodParameter& parameter = method.parameters.at(name);
  const auto value = chosen.find(name);
  if (value == chosen.end()) return parameter.defaultValue;
  if (!parameter.allows(value->second)) {
    throw InputError(fmt::format("method {}: parameter {} = {}, {} expected", method.name, name,
                                 value->second, parameter.rangeText()));
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
  const fs::directory_entry file(shaders / "methods" / (name + ".glsl"));
  const bool isPlainName = fs::path(name).filename() == name;
  if (isPlainName && isShader(file)) return file.path();
  throw InputError(
      fmt::format("no method `{}`, there are {}", name, fmt::join(methodNames(shaders), ", ")));
}

std::vector<std::string> methodNames(const fs::path& shaders) {
  std::vector<std::string> names;
  for (const fs::path& file : shadersIn(shaders / "methods")) {
    if (file.extension() == ".glsl") names.push_back(file.stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::optional<std::string> softDefine(const Method& method, SoftAnswer soft) {
  const bool isDisc = soft == SoftAnswer::disc;
  if (isDisc && !method.hasHorizon) {
    throw InputError(fmt::format(
        "method {}: no function `float horizonSlope(Pixel pixel, LocalLight light)` in {}, which "
        "the light's disc could be held against",
        method.name, method.source.file));
  }
  if (!isDisc && !method.answersShares) return std::nullopt;
  return isDisc ? "ANSWER_DISC" : "ANSWER_SHARE";
}

}  // namespace gnomon::render
