#include "render/passes/method_program.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/error.h"
#include "render/passes/drawing.h"
#include "render/program.h"
#include "render/shared_names.h"

namespace gnomon::render {
namespace fs = std::filesystem;
namespace {

std::string parameterUniforms(const Method& method) {
  std::string text;
  for (const auto& [name, parameter] : method.parameters) {
    text += fmt::format("uniform float {};\n", name);
  }
  return text;
}

/// What the declaration adds to the code: parameters, and access to its bakes.
std::string declaredText(const Method& method) {
  return parameterUniforms(method) + bakeAccess(method.bakes);
}

/// A name of the method's bakes must not be one that every method may use.
void requireOwnNames(const std::vector<SharedName>& shared, const Method& method) {
  for (const SharedName& name : shared) {
    for (const MethodBake& bake : method.bakes) {
      if (bakeOfName(name.name) != bake.name) continue;
      throw InputError(fmt::format("{}: bake `{}`: {} of {} has that name, another one expected",
                                   method.source.file, bake.name, name.name, name.file));
    }
  }
}

/// Every picture is shaded by the height map; a method that does not declare that table gets it
/// behind its back.
std::vector<ShaderPiece> methodPieces(const fs::path& shaders, const Method& method,
                                      const MethodStage& stage) {
  std::vector<ShaderPiece> pieces;
  const auto add = [&](const char* name) {
    pieces.push_back(readShader(shaders / "common" / name));
  };
  add("pixel.glsl");
  add("disc.glsl");
  add("wrap.glsl");
  if (method.tables.height) add("relief.glsl");
  for (const char* name : {"tables.glsl", "osculating.glsl", "path.glsl", "angles.glsl",
                           "passes.glsl", "bakes.glsl"}) {
    add(name);
  }
  pieces.push_back({method.source.file + " (declaration)", declaredText(method)});
  pieces.push_back(method.source);
  if (!method.tables.height) add("relief.glsl");
  add("shading.glsl");
  add("answers.glsl");
  pieces.insert(pieces.end(), stage.fragment.begin(), stage.fragment.end());
  return pieces;
}

}  // namespace

std::vector<std::string> methodDefines(const Method& method, relief::Wrap wrap,
                                       TableFilter filter) {
  std::vector<std::string> defines = surfaceDefines(wrap, method.mesh);
  if (method.tables.height) defines.emplace_back("TABLE_HEIGHT");
  if (method.tables.horizon) defines.emplace_back("TABLE_HORIZON");
  if (method.tables.distance) defines.emplace_back("TABLE_DISTANCE");
  if (method.tables.angles || method.tables.surfaceAngles) defines.emplace_back("TABLE_ANGLES");
  if (method.tables.surfaceAngles) defines.emplace_back("UNIQUE_ANGLES");
  if (method.tables.ellipse) defines.emplace_back("TABLE_ELLIPSE");
  if (method.passes.texture) defines.emplace_back("PASS_TEXTURE");
  if (method.passes.lightDepth) defines.emplace_back("PASS_LIGHT_DEPTH");
  if (method.passes.shadowVolumes) defines.emplace_back("PASS_SHADOW_VOLUMES");
  if (!method.bakes.empty()) defines.emplace_back("OWN_BAKES");
  if (method.hasOwnNormal) defines.emplace_back("OWN_NORMAL");
  if (method.hasTest) defines.emplace_back("OWN_TEST");
  if (method.hasHorizon) defines.emplace_back("OWN_HORIZON");
  if (filter == TableFilter::hardware) defines.emplace_back("FILTER_HARDWARE");
  return defines;
}

std::map<std::string, double> parameterValues(const Method& method,
                                              const std::map<std::string, double>& chosen) {
  for (const auto& [name, value] : chosen) {
    if (method.parameters.count(name) == 0) {
      throw InputError(fmt::format("method {}: it has no parameter `{}`", method.name, name));
    }
  }
  std::map<std::string, double> all;
  for (const auto& [name, parameter] : method.parameters) {
    all[name] = parameterValue(method, name, chosen);
  }
  return all;
}

MethodStage surfaceStage(const fs::path& shaders, const char* fragment) {
  return {readShader(shaders / "common/surface.vert"), {readShader(shaders / "common" / fragment)}};
}

gl::Program makeMethodProgram(const fs::path& shaders, const Method& method,
                              const MethodStage& stage, const std::vector<std::string>& defines) {
  if (!method.bakes.empty()) requireOwnNames(sharedNames(shaders), method);
  try {
    return makeProgram({{stage.vertex}, {}, methodPieces(shaders, method, stage)}, defines);
  } catch (const InputError& error) {
    const std::string message = error.what();
    throw InputError(message + missingDeclaration(sharedNames(shaders), message, method, defines));
  }
}

void setParameters(GLuint program, const std::map<std::string, double>& values) {
  for (const auto& [name, value] : values) setUniform(program, name.c_str(), value);
}

}  // namespace gnomon::render
