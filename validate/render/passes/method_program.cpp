#include "render/passes/method_program.h"

#include <fmt/core.h>

#include <limits>
#include <utility>

#include "common/error.h"
#include "render/program.h"
#include "render/shared_names.h"

namespace gnomon::render {

namespace {

template <typename Table>
const Table& tableOf(const Table* table, const std::string& method, const char* what) {
  if (table == nullptr) throw InternalError(fmt::format("method {} got no {}", method, what));
  return *table;
}

void bindTable(GLuint program, const GpuTable& table, TextureUnit unit, const char* sampler,
               const char* range) {
  bindTexture(program, unit, table.texture(), sampler);
  setUniform(program, range, table.range());
}

void bindAngles(GLuint program, const GpuAngles& angles) {
  bindTexture(program, TextureUnit::angles, angles.texture(), "angleMaps");
  bindTexture(program, TextureUnit::basis, angles.basis(), "basisMaps");
  bindTexture(program, TextureUnit::arccos, angles.arccos(), "arccosMap");
  setUniform(program, "angleAzimuths", angles.azimuths());
  setUniform(program, "angleLimit", angles.limit());
  setUniform(program, "angleSteps", angles.steps());
  setUniform(program, "angleOrigin", angles.origin());
}

}  // namespace

void bindTables(GLuint program, const std::string& method, const MethodTables& declared,
                const GpuTables& tables) {
  setUniform(program, "searchRadius", tables.searchRadius);
  if (declared.horizon) {
    bindTable(program, tableOf(tables.horizon, method, "horizons"), TextureUnit::horizon,
              "horizonTable", "horizonRange");
  }
  if (declared.distance) {
    bindTable(program, tableOf(tables.distance, method, "distances"), TextureUnit::distance,
              "distanceTable", "distanceRange");
  }
  if (declared.ellipse) {
    bindTable(program, tableOf(tables.ellipse, method, "ellipses"), TextureUnit::ellipse,
              "ellipseTable", "ellipseRange");
  }
  if (declared.angles || declared.surfaceAngles) {
    bindAngles(program, tableOf(tables.angles, method, "angles"));
  }
}

void bindBakes(GLuint program, const std::string& method, const std::vector<MethodBake>& declared,
               const GpuTables& tables) {
  if (declared.empty()) return;
  const std::vector<GpuBake>& bakes = tableOf(tables.bakes, method, "bakes");
  for (std::size_t i = 0; i < declared.size(); ++i) {
    bindTexture(program, bakeUnit(i), bakes.at(i).texture(), declared[i].sampler().c_str());
  }
}

namespace fs = std::filesystem;
namespace {

std::string parameterUniforms(const Method& method) {
  std::string text;
  for (const auto& [name, parameter] : method.parameters) {
    const char* type = parameter.kind == ParameterKind::real    ? "float"
                       : parameter.kind == ParameterKind::whole ? "int"
                                                                : "bool";
    text += fmt::format("uniform {} {};\n", type, name);
  }
  return text;
}

/// What the declaration adds to the code: parameters, and access to bakes, textures and passes.
std::string declaredText(const Method& method) {
  return parameterUniforms(method) + bakeAccess(method.bakes) + textureAccess(method.textures) +
         passAccess(method.passes.own);
}

bool hasOwnNames(const Method& method) {
  return !method.bakes.empty() || !method.textures.empty() || !method.passes.own.empty();
}

/// What a method declares must not have the name of what every method may use.
void requireOwnNames(const std::vector<SharedName>& shared, const Method& method) {
  const auto require = [&](const std::string& own) {
    for (const SharedName& name : shared) {
      if (ownNameOf(name.name) != own) continue;
      throw InputError(
          fmt::format("{}: the declaration's `{}`: {} of {} has that name, another one "
                      "expected",
                      method.source.file, own, name.name, name.file));
    }
  };
  for (const MethodBake& bake : method.bakes) require(bake.name);
  for (const MethodTexture& texture : method.textures) require(texture.name);
  for (const OwnPass& pass : method.passes.own) require(pass.name);
}

/// Every picture is shaded by the height map; a method that does not declare that table gets it
/// behind its back.
std::vector<ShaderPiece> methodPieces(const fs::path& shaders, const Method& method,
                                      const MethodStage& stage) {
  std::vector<ShaderPiece> pieces = stage.before;
  const auto add = [&](const char* name) {
    pieces.push_back(readShader(shaders / "common" / name));
  };
  add("pixel.glsl");
  add("disc.glsl");
  add("wrap.glsl");
  if (method.tables.height) add("relief.glsl");
  for (const char* name : {"tables.glsl", "osculating.glsl", "path.glsl", "angles.glsl",
                           "passes.glsl", "bakes.glsl", "textures.glsl"}) {
    add(name);
  }
  pieces.push_back({method.source.file + " (declaration)", declaredText(method), 1});
  pieces.insert(pieces.end(), method.code.begin(), method.code.end());
  if (!method.tables.height) add("relief.glsl");
  add("shading.glsl");
  add("answers.glsl");
  pieces.insert(pieces.end(), stage.fragment.begin(), stage.fragment.end());
  if (stage.endsLoops) {
    for (ShaderPiece& piece : pieces) piece.text = withEndingLoops(piece.text);
  }
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
  if (method.passes.lightDepth || method.passes.hasOwn(PassRaster::light)) {
    defines.emplace_back("PASS_LIGHT_DEPTH");
  }
  if (method.passes.cameraDepth) defines.emplace_back("PASS_CAMERA_DEPTH");
  if (method.needsCamera()) defines.emplace_back("NEEDS_CAMERA");
  if (!method.passes.own.empty()) defines.emplace_back("OWN_PASSES");
  if (!method.textures.empty()) defines.emplace_back("OWN_TEXTURES");
  if (method.passes.shadowVolumes) defines.emplace_back("PASS_SHADOW_VOLUMES");
  if (!method.bakes.empty()) defines.emplace_back("OWN_BAKES");
  if (method.hasOwnNormal) defines.emplace_back("OWN_NORMAL");
  if (method.hasTest) defines.emplace_back("OWN_TEST");
  if (method.hasHorizon) defines.emplace_back("OWN_HORIZON");
  if (method.isOnPolygons) defines.emplace_back("ON_POLYGONS");
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

gl::Texture makeNoNumber(GLenum target) {
  const glm::vec4 nothing(std::numeric_limits<float>::quiet_NaN());
  gl::Texture texture = gl::makeTexture(target, GL_RGBA32F, {1, 1}, GL_NEAREST);
  gl::fill(texture, {1, 1}, GL_RGBA, GL_FLOAT, &nothing);
  return texture;
}

std::vector<GpuTexture> gpuTextures(const Method& method) {
  std::vector<GpuTexture> textures;
  for (const MethodTexture& texture : method.textures) textures.emplace_back(texture);
  return textures;
}

void bindOwnTextures(GLuint program, const std::vector<MethodTexture>& declared,
                     const std::vector<GpuTexture>& textures) {
  for (std::size_t i = 0; i < declared.size(); ++i) {
    bindTexture(program, textureUnit(i), textures.at(i).texture(), declared[i].sampler().c_str());
  }
}

std::vector<OwnPass> ownPasses(const Method& method) {
  std::vector<OwnPass> passes = method.passes.own;
  if (!method.passes.texture) return passes;
  for (OwnPass& pass : passes) {
    if (pass.source) ++*pass.source;
  }
  passes.insert(passes.begin(), resolvePass());
  return passes;
}

MethodStage ownPassStage(const fs::path& shaders, const Method& method, const OwnPass& pass,
                         const std::vector<OwnPass>& passes) {
  const bool isFilter = pass.raster == PassRaster::filter;
  const fs::path vertex = shaders / (isFilter ? "common/plane.vert" : "common/surface.vert");
  const std::string file = fmt::format("{} (call of {})", method.source.file, pass.function());
  return {readShader(vertex),
          {readShader(shaders / "common/values.frag"), {file, passMain(pass, passes), 1}},
          {}};
}

MethodStage surfaceStage(const fs::path& shaders, const char* fragment) {
  return {
      readShader(shaders / "common/surface.vert"), {readShader(shaders / "common" / fragment)}, {}};
}

MethodStage countingStage(const fs::path& shaders) {
  MethodStage stage = surfaceStage(shaders, "texel_count.frag");
  stage.before = {readShader(shaders / "common/texel_macros.frag")};
  return stage;
}

gl::Program makeMethodProgram(const fs::path& shaders, const Method& method,
                              const MethodStage& stage, const std::vector<std::string>& defines) {
  if (hasOwnNames(method)) requireOwnNames(sharedNames(shaders), method);
  try {
    return makeProgram({{stage.vertex}, {}, methodPieces(shaders, method, stage)}, defines);
  } catch (const InputError& error) {
    std::vector<SharedName> names = sharedNames(shaders);
    for (SharedName& name : namesIn({"the declaration", declaredText(method), 1}, {})) {
      names.push_back(std::move(name));
    }
    throw InputError(explainedError(error.what(), method, std::move(names), defines));
  }
}

void setParameters(GLuint program, const Method& method,
                   const std::map<std::string, double>& values) {
  for (const auto& [name, value] : values) {
    if (method.parameters.at(name).kind == ParameterKind::real) {
      setUniform(program, name.c_str(), value);
    } else {
      setUniform(program, name.c_str(), static_cast<int>(value));
    }
  }
}

}  // namespace gnomon::render
