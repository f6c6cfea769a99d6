#include "end_to_end/support/other_renderer.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace gnomon::test {
namespace {

constexpr std::ptrdiff_t cellsASide = 400;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
  throw std::runtime_error(path.string() + ": " + why);
}

Point unit(const Point& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

template <typename Value>
Value next(std::ifstream& file) {
  Value value{};
  file.read(reinterpret_cast<char*>(&value), sizeof value);
  return value;
}

/// Twice the signed area of a triangle's shadow on the plane.
double area(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

}  // namespace

double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Triangles readPly(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<std::string> header;
  for (std::string line; std::getline(file, line) && line != "end_header";) {
    if (line.rfind("comment", 0) != 0) header.push_back(line);
  }
  const std::string order = std::endian::native == std::endian::little ? "little" : "big";
  if (header.size() != 8 || header[0] != "ply" ||
      header[1] != "format binary_" + order + "_endian 1.0" ||
      header[2].rfind("element vertex ", 0) != 0 || header[3] != "property float x" ||
      header[4] != "property float y" || header[5] != "property float z" ||
      header[6].rfind("element face ", 0) != 0 ||
      header[7] != "property list uchar int vertex_indices") {
    fail(path, "another header than was expected");
  }
  Triangles mesh;
  mesh.vertices.resize(std::stoul(header[2].substr(15)));
  mesh.faces.resize(std::stoul(header[6].substr(13)));
  for (Point& vertex : mesh.vertices) {
    for (double& coordinate : vertex) coordinate = next<float>(file);
  }
  for (auto& face : mesh.faces) {
    if (next<std::uint8_t>(file) != 3) fail(path, "a face that is no triangle");
    for (std::uint32_t& vertex : face) {
      vertex = static_cast<std::uint32_t>(next<std::int32_t>(file));
      if (vertex >= mesh.vertices.size()) fail(path, "a vertex that is none");
    }
  }
  if (!file || file.peek() != std::ifstream::traits_type::eof()) fail(path, "not whole");
  return mesh;
}

std::size_t openSides(const Triangles& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  std::size_t twice = 0;
  for (const auto& face : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = face.at(k);
      const std::uint32_t b = face.at((k + 1) % 3);
      int& way = balance[std::minmax(a, b)];
      const int bit = a < b ? 1 : 2;
      twice += (way & bit) != 0 ? 1 : 0;
      way |= bit;
    }
  }
  return twice +
         static_cast<std::size_t>(std::count_if(balance.begin(), balance.end(),
                                                [](const auto& side) { return side.second != 3; }));
}

Point Channels::point(const std::string& layer, std::size_t pixel) const {
  return {of.at(layer + ".X")[pixel], of.at(layer + ".Y")[pixel], of.at(layer + ".Z")[pixel]};
}

Channels readChannels(const std::filesystem::path& path) {
  const auto image = OIIO::ImageInput::open(path.string());
  if (!image) fail(path, OIIO::geterror());
  const OIIO::ImageSpec spec = image->spec();
  Channels channels{spec.width, spec.height, {}};
  for (int c = 0; c < spec.nchannels; ++c) {
    std::vector<float>& values = channels.of[spec.channelnames[static_cast<std::size_t>(c)]];
    values.resize(spec.image_pixels());
    if (!image->read_image(0, 0, c, c + 1, OIIO::TypeDesc::FLOAT, values.data())) {
      fail(path, image->geterror());
    }
  }
  return channels;
}

SunRays::SunRays(const Triangles& mesh, const Point& direction)
    : direction_(direction),
      right_(
          unit(cross(direction, std::abs(direction[0]) < 0.5 ? Point{1, 0, 0} : Point{0, 1, 0}))),
      up_(cross(direction, right_)) {
  double right = -1e300, top = -1e300;
  left_ = bottom_ = 1e300;
  for (const Point& vertex : mesh.vertices) {
    const Point p = onPlane(vertex);
    left_ = std::min(left_, p[0]);
    right = std::max(right, p[0]);
    bottom_ = std::min(bottom_, p[1]);
    top = std::max(top, p[1]);
  }
  cell_ = std::max(right - left_, top - bottom_) / static_cast<double>(cellsASide);
  columns_ = rows_ = cellsASide + 1;
  cells_.resize(static_cast<std::size_t>(columns_ * rows_));
  for (const auto& face : mesh.faces) {
    std::array<Point, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners.at(k) = onPlane(mesh.vertices[face.at(k)]);
    const auto [x0, x1] = std::minmax({corners[0][0], corners[1][0], corners[2][0]});
    const auto [y0, y1] = std::minmax({corners[0][1], corners[1][1], corners[2][1]});
    const auto low = cellOf(x0, y0);
    const auto high = cellOf(x1, y1);
    for (std::ptrdiff_t row = low.second; row <= high.second; ++row) {
      for (std::ptrdiff_t column = low.first; column <= high.first; ++column) {
        cells_[static_cast<std::size_t>(row * columns_ + column)].push_back(
            static_cast<std::uint32_t>(triangles_.size()));
      }
    }
    triangles_.push_back(corners);
  }
}

Point SunRays::onPlane(const Point& p) const {
  return {dot(p, right_), dot(p, up_), dot(p, direction_)};
}

std::pair<std::ptrdiff_t, std::ptrdiff_t> SunRays::cellOf(double x, double y) const {
  const auto index = [&](double offset, std::ptrdiff_t count) {
    return std::clamp(static_cast<std::ptrdiff_t>(std::floor(offset / cell_)), std::ptrdiff_t{0},
                      count - 1);
  };
  return {index(x - left_, columns_), index(y - bottom_, rows_)};
}

bool SunRays::blocked(const Point& origin) const {
  const Point p = onPlane(origin);
  const auto [column, row] = cellOf(p[0], p[1]);
  for (const std::uint32_t index : cells_[static_cast<std::size_t>(row * columns_ + column)]) {
    const auto& [a, b, c] = triangles_[index];
    const double whole = area(a, b, c);
    if (whole == 0) continue;
    const double u = area(p, b, c) / whole;
    const double v = area(a, p, c) / whole;
    const double w = 1 - u - v;
    if (u < 0 || v < 0 || w < 0) continue;
    if (u * a[2] + v * b[2] + w * c[2] > p[2]) return true;
  }
  return false;
}

}  // namespace gnomon::test
