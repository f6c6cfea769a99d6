#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::test {

/// Another renderer, which knows of a study what its export says and nothing more: it shares no
/// code with Gnomon.

using Point = std::array<double, 3>;

double dot(const Point& a, const Point& b);
Point minus(const Point& a, const Point& b);
Point cross(const Point& a, const Point& b);

struct Triangles {
  std::vector<Point> vertices;
  std::vector<std::array<std::uint32_t, 3>> faces;
};

/// @throws std::runtime_error for a file that is no binary PLY of triangles, or not whole
Triangles readPly(const std::filesystem::path& path);

/// The sides of the triangles that do not have exactly one other, in the opposite direction.
std::size_t openSides(const Triangles& mesh);

/// The channels of an EXR by name, row by row from the top.
struct Channels {
  int width = 0;
  int height = 0;
  std::map<std::string, std::vector<float>> of;

  [[nodiscard]] Point point(const std::string& layer, std::size_t pixel) const;
};
Channels readChannels(const std::filesystem::path& path);

/// Shadow rays of one direction: triangles are laid out on a plane across it, so that a ray is a
/// point there and meets the triangles around it.
class SunRays {
 public:
  /// @param direction  unit, toward the light
  SunRays(const Triangles& mesh, const Point& direction);
  /// Whether any triangle lies ahead of a point.
  [[nodiscard]] bool blocked(const Point& origin) const;

 private:
  [[nodiscard]] Point onPlane(const Point& p) const;
  [[nodiscard]] std::pair<std::ptrdiff_t, std::ptrdiff_t> cellOf(double x, double y) const;

  Point direction_, right_, up_;
  std::vector<std::array<Point, 3>> triangles_;  ///< across, across, toward the light
  double left_ = 0, bottom_ = 0, cell_ = 1;
  std::ptrdiff_t columns_ = 1, rows_ = 1;
  std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace gnomon::test
