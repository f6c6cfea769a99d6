#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "relief/relief.h"
#include "render/bakes/method_bake.h"
#include "render/gl_objects.h"
#include "render/gpu_scene.h"
#include "render/method.h"
#include "render/passes/drawing.h"
#include "render/shader_files.h"

namespace gnomon::render {

/// How tables are filtered.
enum class TableFilter {
  exact,     ///< by hand from single texels, in float: masks do not depend on the GPU's filter
  hardware,  ///< by the GPU's own trilinear filter, as products do
};

/// The tables of a bake on the GPU, and how far it searched. A method reads only what it declares.
struct GpuTables {
  const GpuTable* horizon = nullptr;
  const GpuTable* distance = nullptr;
  const GpuAngles* angles = nullptr;  ///< of the flat relief or of the surface, as declared
  const GpuTable* ellipse = nullptr;
  double searchRadius = 128;                    ///< of the bake, texels: marches end there too
  const std::vector<GpuBake>* bakes = nullptr;  ///< the method's own, as it declares them
};

/// Gives a program the tables that a method declares.
/// @throws InternalError where one of them is missing
void bindTables(GLuint program, const std::string& method, const MethodTables& declared,
                const GpuTables& tables);

/// Gives a program the method's own bakes.
/// @throws InternalError where they are missing
void bindBakes(GLuint program, const std::string& method, const std::vector<MethodBake>& declared,
               const GpuTables& tables);

/// The defines that a method is compiled with.
std::vector<std::string> methodDefines(const Method& method, relief::Wrap wrap, TableFilter filter);

/// The values of all of a method's parameters: the chosen ones, and the authors'.
/// @throws InputError as parameterValue, and for a value of an unknown parameter
std::map<std::string, double> parameterValues(const Method& method,
                                              const std::map<std::string, double>& chosen);

// The texture units of what a method declares, each by its place among its kind.
inline TextureUnit bakeUnit(std::size_t place) {
  return ownUnit(place);
}
inline TextureUnit textureUnit(std::size_t place) {
  return ownUnit(8 + place);
}
inline TextureUnit passUnit(std::size_t place) {
  return ownUnit(16 + place);
}

/// A texture of one texel that is no number: for what a function may not read.
/// @param target  GL_TEXTURE_2D or GL_TEXTURE_2D_ARRAY
gl::Texture makeNoNumber(GLenum target);

/// A method's own pictures on the GPU.
std::vector<GpuTexture> gpuTextures(const Method& method);
void bindOwnTextures(GLuint program, const std::vector<MethodTexture>& declared,
                     const std::vector<GpuTexture>& textures);

/// What stands before and after a method's own code in a program.
struct MethodStage {
  ShaderPiece vertex;
  std::vector<ShaderPiece> fragment;     ///< calls the method's functions
  std::vector<ShaderPiece> before = {};  ///< stands before all that the method uses
  bool endsLoops = false;                ///< whether loops turn while `nextTurn()` of `before`
};

/// The stage that draws the surface.
/// @param fragment  a file of `common/`
MethodStage surfaceStage(const std::filesystem::path& shaders, const char* fragment);

/// The stage that draws how many texels a pixel's answer reads.
MethodStage countingStage(const std::filesystem::path& shaders);

/// The passes of the method's own, and first the one that `passes = ["texture"]` asks for.
std::vector<OwnPass> ownPasses(const Method& method);

/// The stage of a pass of the method's own.
/// @param pass  of `passes`, those of the method
MethodStage ownPassStage(const std::filesystem::path& shaders, const Method& method,
                         const OwnPass& pass, const std::vector<OwnPass>& passes);

/// Compiles the method's own file between what it may use and the stage that calls it.
/// @throws InputError for what does not compile, naming the declaration that is missing, where the
///   compiler misses a name that one would provide
gl::Program makeMethodProgram(const std::filesystem::path& shaders, const Method& method,
                              const MethodStage& stage, const std::vector<std::string>& defines);

/// Sets the parameters of a program of a method.
/// @param values  of all of them
void setParameters(GLuint program, const Method& method,
                   const std::map<std::string, double>& values);

}  // namespace gnomon::render
