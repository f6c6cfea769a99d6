#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <span>
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
};

/// A smooth limit surface with texture coordinates. Copies share it, and threads may too.
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

/// The limit surface of an OBJ or PLY file.
/// @param triangles  as in ControlMesh
/// @throws Exception  badInput naming the file and what is wrong in it
GNOMON_API Surface readSurface(const std::filesystem::path& file, bool triangles = false);

/// A built-in shape of `columns` × `rows` faces, uv from 0 to 1 over the whole of it.
/// @param shape  with its sizes, in world units and radians:
///   "plane"     {width, height}, in z = 0
///   "cylinder"  {radius, longitude span, height}, about the y axis
///   "sphere"    {radius, longitude span, latitude span}: a patch whose middle faces +z; a negative
///               radius makes its inside
///   "torus"     {radius of the circle, radius of the tube}, about the y axis
/// @param columns, rows  1 to 4096; faces of arcs span less than 0.11 radians
/// @throws Exception  badInput for another name, number of sizes, or a value out of range
GNOMON_API Surface makeShape(std::string_view shape, const std::vector<double>& sizes, int columns,
                             int rows);

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

/// A regular grid of `side` × `side` points in every face, each weighted by its area. A face is a
/// square tile of the picture, t upward. Independent of any camera.
/// @throws Exception  badInput for a side below 1 or a picture of more than 2²⁷ samples
GNOMON_API SurfaceSamples atlasSamples(const Surface& surface, int side);

/// A pinhole camera.
struct PinholeCamera {
  std::array<double, 3> eye{0, 0, 1};     ///< world
  std::array<double, 3> target{0, 0, 0};  ///< world
  std::array<double, 3> up{0, 1, 0};
  double verticalFov = 0.5;       ///< full angle, radians, between 0 and π
  int width = 512, height = 512;  ///< pixels, 1 to 16384
};

/// The surface point that each pixel of a camera shows, rasterised by OpenGL with `subdivisions` ×
/// `subdivisions` quadrilaterals a face. Faces turned from the camera show nothing. The caller's
/// own OpenGL context is not touched.
/// @throws Exception  badInput for a camera out of range; noOpenGl
GNOMON_API SurfaceSamples cameraSamples(const Surface& surface, const PinholeCamera& camera,
                                        int subdivisions = 1);

}  // namespace api
}  // namespace gnomon
