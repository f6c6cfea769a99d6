#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/bakes/method_bake.h"
#include "render/passes/method_texture.h"
#include "render/passes/own_pass.h"
#include "render/shader_files.h"

namespace gnomon::render {

/// The families that a method's file can name, by what the method knows of the surface. Plots give
/// each a colour of its own.
constexpr std::array<std::string_view, 7> methodFamilies = {
    "control",    // no shadow method: what every method must beat
    "flat",       // tables of the height map as if the surface were flat
    "curvature",  // such tables, corrected by the surface's curvature
    "march",      // the height map, marched toward the light
    "displaced",  // shadows of the displaced mesh
    "engine",     // what engines ship: occlusion and other approximations of tables or marches
    "ours",       // this project's own
};

/// The symbols that it can name. Plots tell the methods of a family apart by them.
constexpr std::array<std::string_view, 9> methodSymbols = {
    "circle", "square", "triangle", "inverted-triangle", "diamond", "pentagon",
    "plus",   "cross",  "star"};

/// What a method's file says of how plots draw it; empty where it says nothing.
struct MethodMark {
  std::string family;  ///< one of methodFamilies
  std::string symbol;  ///< one of methodSymbols
  bool operator==(const MethodMark&) const = default;
};

/// What a parameter is in the method's GLSL.
enum class ParameterKind {
  real,   ///< `float`
  whole,  ///< `int`
  flag,   ///< `bool`: 0 or 1 here
};

/// A number that a method's quality depends on: a uniform of the same name in its GLSL.
struct MethodParameter {
  double defaultValue = 0;  ///< the authors' value
  double minimum = 0;
  double maximum = 0;
  std::string about = {};
  ParameterKind kind = ParameterKind::real;

  [[nodiscard]] bool allows(double value) const;
  /// What it allows, in words: "0 to 9".
  [[nodiscard]] std::string rangeText() const;
  /// A value as a file has it: "true", "3", "0.5".
  [[nodiscard]] std::string textOf(double value) const;
};

/// Which tables a method reads.
struct MethodTables {
  bool height = false;
  bool horizon = false;
  bool distance = false;
  bool angles = false;         ///< horizon angles of the flat relief
  bool surfaceAngles = false;  ///< horizon angles of the displaced surface, every texel unique
  bool ellipse = false;        ///< elliptical cones of light
};

/// Which passes a method needs before the one that answers.
struct MethodPasses {
  /// `resolveTexel` for every texel of the surface, in the texture's own plane; kept in the bits of
  /// the horizon angles that the method reads, as floats where it reads none.
  bool texture = false;
  /// The mesh's depth seen from the light, in a map of `depth_side` texels a side: a parameter that
  /// such a method must have. With `light_mesh` of a mesh of its own.
  bool lightDepth = false;
  /// Depth, then shadow volumes counted in the stencil. Only a camera has pixels to count at.
  bool shadowVolumes = false;
  bool cameraDepth = false;  ///< the depth that a camera sees
  /// The method's own, in the order of its declaration. One from the light leaves the depth, too.
  std::vector<OwnPass> own = {};

  /// Whether any of the method's own is drawn over a raster.
  [[nodiscard]] bool hasOwn(PassRaster raster) const;
  /// Whether any is drawn in the texture's own plane.
  [[nodiscard]] bool needTexturePlane() const { return texture || hasOwn(PassRaster::texture); }
  /// Whether they can answer in the pictures of a camera alone.
  [[nodiscard]] bool needCamera() const {
    return shadowVolumes || cameraDepth || hasOwn(PassRaster::camera);
  }
  /// How many there are in a frame, the one that answers included.
  [[nodiscard]] int count() const;
};

/// Which mesh a method draws.
enum class DrawnMesh {
  base,       ///< the bump-mapped base mesh
  displaced,  ///< the displaced mesh, as real geometry
};

/// A shadow method: one GLSL file whose first comment declares it. The comment opens with
/// `gnomon-method` and holds TOML:
///   title, citation
///   family, symbol  how plots draw it, see MethodMark
///   tables        list of "height", "horizon", "distance", "angles", "surface-angles", "ellipse"
///   passes        list of "texture", "light-depth", "shadow-volumes", "camera-depth": drawn before
///                 the answer
///   pass          tables [[pass]], passes of its own, see OwnPass
///   textures.NAME pictures that it brings, see MethodTexture
///   needs         "camera", where it answers in the pictures of cameras alone
///   mesh          "base" (default) or "displaced"
///   light_mesh    "displaced", where the pass "light-depth" draws that mesh and not the method's
///   normal        "own", where the method shades its picture by a normal of its own, not by N'
///   subdivisions  pieces of every face's side, where the authors state them
///   azimuths      of its tables, where the authors state them
///   bakes.NAME    tables that its own functions bake, see MethodBake
///   parameters.NAME with `default`, `minimum`, `maximum`, `type`, `about`
/// Files that it includes may declare some of these themselves, see Declaration.
/// The file defines one or more of
///   bool isShadowed(Pixel pixel, LocalLight light)     of a light that is a point
///   float visibility(Pixel pixel, LocalLight light)    V, the share of the light's disc, 0 to 1
///   float horizonSlope(Pixel pixel, LocalLight light)  tan of the horizon's elevation toward it
/// (answers.glsl derives the test from the others), and with a texture pass
/// `float resolveTexel(Pixel pixel)`, 0 to 1, with a normal of its own
/// `vec3 shadingNormal(Pixel pixel)`, of unit length.
struct Method {
  std::string name;  ///< the file's stem
  std::string title;
  std::string citation;
  MethodMark mark;
  MethodTables tables;
  std::vector<MethodBake> bakes;  ///< in the order of the declaration
  MethodPasses passes;
  DrawnMesh mesh = DrawnMesh::base;
  /// What the pass from the light draws; nothing where that is the method's own mesh. Its pieces of
  /// every face's side are the parameter `light_pieces`, which such a method must have.
  std::optional<DrawnMesh> lightMesh;
  /// Whether its picture is dark where its own `shadingNormal` is turned from the light; where not,
  /// that normal is N' of the bump-mapped mesh, or the facet's own of displaced geometry.
  bool hasOwnNormal = false;
  bool hasTest = true;         ///< defines `isShadowed`; else it follows from the other two
  bool answersShares = false;  ///< defines `visibility`; else a soft light is lit or not, 0 or 1
  bool hasHorizon = false;     ///< defines `horizonSlope`, which can be compared with a disc
  std::optional<int> subdivisions;  ///< the authors', over a study's own
  std::optional<int> azimuths;      ///< the authors', over a study's own
  std::map<std::string, MethodParameter> parameters;
  bool needsEye = false;  ///< declares that it needs a camera
  /// Set by who uses it on polygons as they are (see surface/polygon_surface.h): there its code is
  /// compiled with ON_POLYGONS.
  bool isOnPolygons = false;
  ShaderPiece source;                 ///< its file
  std::vector<ShaderPiece> code;      ///< the file with what it includes in its place
  std::vector<ShaderPiece> includes;  ///< the files that it includes, each once
  std::vector<MethodTexture> textures;

  /// Whether it can answer in the pictures of a camera alone.
  [[nodiscard]] bool needsCamera() const { return needsEye || passes.needCamera(); }
  /// The files that it is made of apart from its own.
  [[nodiscard]] std::vector<std::filesystem::path> otherFiles() const;
};

/// @throws InputError naming file and line for a declaration that is missing, malformed, or holds a
///   key that it should not
Method readMethod(const std::filesystem::path& file);

/// A parameter's value: the chosen one, or the authors'.
/// @param chosen  values by the parameters' names
/// @throws InputError for a value outside the parameter's range
double parameterValue(const Method& method, const std::string& name,
                      const std::map<std::string, double>& chosen);

/// The pieces of every face's side of the mesh that the pass from the light draws: `light_pieces`.
/// @throws InputError as `parameterValue`, and for a number that is not whole
int lightPieces(const Method& method, const std::map<std::string, double>& chosen);

/// The method's file: `methods/NAME.glsl` in the shader folder.
/// @throws InputError listing the methods there are, if that is none of them
std::filesystem::path methodFile(const std::filesystem::path& shaders, const std::string& name);

/// Names of all methods in the shader folder, sorted.
std::vector<std::string> methodNames(const std::filesystem::path& shaders);

/// What a method says of a soft light.
enum class SoftAnswer {
  own,   ///< its `visibility`; 0 or 1 where its file has none
  disc,  ///< its horizon compared with the disc by the closed form, `shareOver` of disc.glsl
};

/// The define of a method's soft answers; none where it has only 0 and 1 to say.
/// @throws InputError for a disc without a horizon
std::optional<std::string> softDefine(const Method& method, SoftAnswer soft);

}  // namespace gnomon::render
