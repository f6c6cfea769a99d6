#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "common/lists.h"
#include "study/spec/sections/study_key.h"
#include "surface/cage/cage.h"

namespace gnomon::study {

/// `[surface]`: a built-in shape, told by its `shape`, or a mesh file. A new shape is a type its
/// name and keys below, and a `cageOf`.

struct PlaneShape {
  glm::ivec2 quads{0};
  Vec2 size{0};
};
struct CylinderShape {
  glm::ivec2 quads{0};
  double curvature = 0;
  Vec2 size{0};
};
struct SphereShape {
  glm::ivec2 quads{0};
  double curvature = 0;
  Vec2 size{0};
};
struct TorusShape {
  glm::ivec2 quads{0};
  double major = 0, minor = 0;
};
struct BezierShape {
  glm::ivec2 quads{0};
  std::vector<Vec3> points;
};
struct BSplineShape {
  int columns = 0;
  std::vector<Vec3> points;
};
using Shape =
    std::variant<PlaneShape, CylinderShape, SphereShape, TorusShape, BezierShape, BSplineShape>;

struct SurfaceMesh {
  std::string path;  ///< as the file has it, see fileOf
  surface::SubdivisionScheme scheme = surface::SubdivisionScheme::catmullClark;
  bool isSchemeNamed = true;  ///< false where the study names none
};

using SurfaceSection = std::variant<Shape, SurfaceMesh>;

constexpr std::array<std::string_view, 6> shapeNames = {"plane", "cylinder", "sphere",
                                                        "torus", "bezier",   "b-spline"};

inline StudyKeys keysOf(Shape& shape) {
  constexpr int mostFacesASide = 4096;
  const auto quads = [](glm::ivec2& place) -> StudyKey {
    return studyKey("quads", &place, "faces of the base mesh, columns and rows; two triangles each",
                    {1, mostFacesASide}, required);
  };
  const auto size = [](Vec2& place) -> StudyKey {
    return studyKey("size", numbers(place),
                    "world units: arc lengths along the columns and the rows", positive, required);
  };
  const auto curvature = [](double& place, NumberRange range) -> StudyKey {
    return studyKey("curvature", numbers(place), "1 / world units; of a sphere below 0: its inside",
                    range, required);
  };
  using Keys = StudyKeys;
  return std::visit(
      Overloaded{
          [&](PlaneShape& s) -> Keys {
            return {quads(s.quads), size(s.size)};
          },
          [&](CylinderShape& s) -> Keys {
            return {quads(s.quads), curvature(s.curvature, positive), size(s.size)};
          },
          [&](SphereShape& s) -> Keys {
            return {quads(s.quads), curvature(s.curvature, anyNumber), size(s.size)};
          },
          [&](TorusShape& s) -> Keys {
            return {quads(s.quads),
                    studyKey("major", numbers(s.major), "world units: radius of the ring", positive,
                             required),
                    studyKey("minor", numbers(s.minor), "world units: radius of the tube", positive,
                             required)};
          },
          [&](BezierShape& s) -> Keys {
            return {quads(s.quads),
                    studyKey("points", &s.points, "16 control points, row by row", {}, required)};
          },
          [](BSplineShape& s) -> Keys {
            return {
                studyKey("points", &s.points, "control points, row by row", {}, required),
                studyKey("columns", &s.columns, "points a row", {4, mostFacesASide + 3}, required)};
          }},
      shape);
}

inline StudyKeys keysOf(SurfaceMesh& mesh) {
  const std::vector<std::pair<surface::SubdivisionScheme, std::string>> schemes = {
      {surface::SubdivisionScheme::catmullClark, "catmull-clark"},
      {surface::SubdivisionScheme::loop, "loop"},
      {surface::SubdivisionScheme::none, "none"}};
  return {studyKey("mesh", &mesh.path, "an OBJ or PLY file with texture coordinates", {}, required,
                   Enters::nothing),  // the file's content enters
          studyKey("scheme", chosenName(mesh.scheme, schemes),
                   "`mesh` is the control cage of a subdivision surface, `loop` one of triangles; "
                   "or, `none`, the surface itself: its polygons as they are",
                   {}, required)};
}

inline StudyKeys keysOf(SurfaceSection& surface) {
  return std::visit([](auto& kind) { return keysOf(kind); }, surface);
}

/// Reads `[surface]`. A mesh whose scheme is not named is for `cageOf` to refuse, which sees the
/// file.
/// @throws InputError as TomlReader
SurfaceSection readSurfaceSection(const TomlReader& section);

/// The section as a table of the file.
toml::table tableOf(SurfaceSection surface);

/// The cage that the section asks for.
/// @param section  for messages
/// @param folder   of the study: what paths are relative to
/// @param inSuite  of a study drawn from a suite, whose files are older than the key `scheme` and
///   must not change: without the key it is catmull-clark
/// @throws InputError for a shape that cannot be; for a mesh without a scheme; as readMeshFile
surface::Cage cageOf(const SurfaceSection& surface, const TomlReader& section,
                     const std::filesystem::path& folder, bool inSuite = false);

}  // namespace gnomon::study
