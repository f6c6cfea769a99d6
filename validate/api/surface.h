#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gnomon/exception.h"

namespace gnomon {
inline namespace api {

/// A control mesh with texture coordinates. The spans stay the caller's.
struct ControlMesh {
  std::span<const double> positions;  ///< x, y, z of each vertex, world units
  std::span<const int> faces;    ///< vertices of each face, counter-clockwise seen from outside
  std::span<const double> uvs;   ///< u, v of each texture vertex
  std::span<const int> faceUvs;  ///< texture vertices of each face; empty where they are `faces`
  /// Faces have three corners (limit surface of Loop), not four (Catmull & Clark).
  bool triangles = false;
  /// The faces themselves are the surface, displaced and shaded by normals that are means of
  /// theirs.
  bool polygons = false;
};

/// A smooth limit surface, or polygons as they are, with texture coordinates. Copies share it, and
/// threads may too.
class GNOMON_API Surface {
 public:
  struct Data;
  explicit Surface(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  /// Faces of the limit surface. Each is a square of parameters (s, t), 0 to 1.
  [[nodiscard]] int faceCount() const;
  [[nodiscard]] const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

/// The limit surface of a control mesh.
/// @throws Exception  badInput naming a face or vertex that has no limit surface
GNOMON_API Surface makeSurface(const ControlMesh& mesh);

/// The surface of an OBJ or PLY file.
/// @param scheme  "catmull-clark" or "loop", the limit surface of the file as a control mesh, or
///   "none", its polygons as they are, with its normals
/// @throws Exception  badInput naming the file and what is wrong in it
GNOMON_API Surface readSurface(const std::filesystem::path& file, std::string_view scheme);

/// The keys of a built-in shape with their numbers, as `[surface]` of a study has them
/// (docs/study-keys.md): `{{"quads", {20, 20}}, {"curvature", {0.015}}, {"size", {128, 128}}}`.
/// Points stand one after the other, three numbers each.
using ShapeKeys = std::map<std::string, std::vector<double>>;

/// A built-in shape, uv from 0 to 1 over the whole of it. Its keys, lengths in world units:
///   "plane"     quads, size, in z = 0
///   "cylinder"  quads, curvature, size, about the y axis
///   "sphere"    quads, curvature, size: a patch whose middle faces +z; a negative curvature makes
///               its inside
///   "torus"     quads, major, minor, about the y axis
///   "bezier"    quads, points: 16 of them, row by row
///   "b-spline"  points, columns
/// `quads` are faces along u and along v, 1 to 4096, of arcs less than 0.11 radians each; `size`
/// the arc lengths along u and v; `curvature` 1 / world units.
/// @throws Exception  badInput for another name or key, or a value out of range
GNOMON_API Surface makeShape(std::string_view shape, const ShapeKeys& keys);

/// A point of the undisplaced limit surface.
struct SurfacePlace {
  int face = -1;       ///< 0 to faceCount() - 1; -1 where a pixel shows no surface
  float s = 0, t = 0;  ///< 0 to 1
};

/// The points at which masks answer whether the light is seen: row by row, row 0 at the top. Any
/// renderer that knows face and parameters of its pixels may fill it.
struct SurfaceSamples {
  int width = 0, height = 0;
  std::vector<SurfacePlace> places;  ///< width × height
  std::vector<double> weights;       ///< world area of each; empty where all count alike
};

/// A regular grid of `samples` × `samples` points in every face, each weighted by its area. A face
/// is a square tile of the picture, t upward. Independent of any camera.
/// @throws Exception  badInput for `samples` out of 1 to 4096, or over 2²⁷ of them in all
GNOMON_API SurfaceSamples atlasSamples(const Surface& surface, int samples);

/// A pinhole camera.
struct PinholeCamera {
  std::array<double, 3> eye{0, 0, 1};     ///< world
  std::array<double, 3> target{0, 0, 0};  ///< world
  std::array<double, 3> up{0, 1, 0};
  double fov = 30;                ///< full vertical angle, degrees, 0.1 to 170
  int width = 512, height = 512;  ///< pixels, 1 to 16384
};

/// The surface point that each pixel of a camera shows, rasterised by OpenGL with `subdivisions` ×
/// `subdivisions` quadrilaterals a face. Faces turned from the camera show nothing. The caller's
/// own OpenGL context is not touched.
/// @param subdivisions  1 to 1024
/// @throws Exception  badInput for a camera out of range; noOpenGl
GNOMON_API SurfaceSamples cameraSamples(const Surface& surface, const PinholeCamera& camera,
                                        int subdivisions = 1);

}  // namespace api
}  // namespace gnomon
