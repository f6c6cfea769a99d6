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
      {surface::SubdivisionScheme::loop, "loop"}};
  return {studyKey("mesh", &mesh.path,
                   "an OBJ or PLY file: a control cage with texture coordinates", {}, required,
                   Enters::nothing),  // the file's content enters
          studyKey("scheme", chosenName(mesh.scheme, schemes),
                   "of subdivision; `loop` is for triangles")};
}

inline StudyKeys keysOf(SurfaceSection& surface) {
  return std::visit([](auto& kind) { return keysOf(kind); }, surface);
}

/// Reads `[surface]`.
/// @throws InputError as TomlReader
SurfaceSection readSurfaceSection(const TomlReader& section);

/// The section as a table of the file.
toml::table tableOf(SurfaceSection surface);

/// The cage that the section asks for.
/// @param section  for messages
/// @param folder   of the study: what paths are relative to
/// @throws InputError for a shape that cannot be; as readMeshFile
surface::Cage cageOf(const SurfaceSection& surface, const TomlReader& section,
                     const std::filesystem::path& folder);

}  // namespace gnomon::study
