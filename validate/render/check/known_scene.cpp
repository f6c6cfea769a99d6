#include "render/check/known_scene.h"

#include <limits>
#include <map>
#include <optional>
#include <random>
#include <tuple>

#include "horizon/angle_table.h"
#include "surface/face_grids.h"

namespace gnomon::render::check {
namespace {

/// corner + s along + t across, s and t from 0 to 1, at right angles; its outside is where
/// along × across points.
struct Rectangle {
  Vec3 corner, along, across;

  [[nodiscard]] Vec3 outside() const { return glm::normalize(glm::cross(along, across)); }
  [[nodiscard]] Vec2 place(const Vec3& point) const {
    const Vec3 from = point - corner;
    return {glm::dot(from, along) / glm::dot(along, along),
            glm::dot(from, across) / glm::dot(across, across)};
  }
};

/// The floor, and the box's six sides. Lengths are sums of halves to some power, so that cuts of
/// neighbouring rectangles coincide to the bit.
const std::array<Rectangle, 7>& rectangles() {
  static const auto made = [] {
    const Vec3 low(-3.375, -0.875, 2.25);
    const Vec3 high(0.75, 2.25, 5.125);
    const Vec3 x(high.x - low.x, 0, 0);
    const Vec3 y(0, high.y - low.y, 0);
    const Vec3 z(0, 0, high.z - low.z);
    return std::array{Rectangle{{-8, -8, 0}, {16, 0, 0}, {0, 16, 0}},
                      Rectangle{low, y, x},
                      Rectangle{low, x, z},
                      Rectangle{low, z, y},
                      Rectangle{high, -x, -y},
                      Rectangle{high, -z, -x},
                      Rectangle{high, -y, -z}};
  }();
  return made;
}

/// The distance along a ray to a rectangle, in lengths of `direction`; none where it misses.
std::optional<double> distanceTo(const Rectangle& r, const Vec3& origin, const Vec3& direction) {
  const double slope = glm::dot(r.outside(), direction);
  if (slope == 0) return std::nullopt;
  const double distance = glm::dot(r.outside(), r.corner - origin) / slope;
  const Vec2 st = r.place(origin + distance * direction);
  const bool isOn = distance > 0 && st.x >= 0 && st.x <= 1 && st.y >= 0 && st.y <= 1;
  return isOn ? std::optional(distance) : std::nullopt;
}

KnownPoint pointOn(int face, const Vec3& point) {
  const Rectangle& own = rectangles().at(static_cast<std::size_t>(face));
  KnownPoint known;
  known.face = face;
  known.st = own.place(point);
  known.facing = glm::dot(own.outside(), knownLight());
  known.isHidden = known.facesAway();
  for (const Rectangle& other : rectangles()) {
    if (&other != &own && distanceTo(other, point, knownLight())) known.isHidden = true;
  }
  return known;
}

KnownPoint seenFrom(const Vec3& eye, const Vec3& direction) {
  int face = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; const Rectangle& r : rectangles()) {
    const auto distance = distanceTo(r, eye, direction);
    if (glm::dot(r.outside(), direction) < 0 && distance && *distance < nearest) {
      nearest = *distance;
      face = k;
    }
    ++k;
  }
  return face < 0 ? KnownPoint() : pointOn(face, eye + nearest * direction);
}

displaced::DisplacedMesh knownMesh() {
  // How far samples lie beyond the centres of their texels: of the four texels that are mixed, the
  // own one has more than half of the weight.
  constexpr double beyond = 0.25;
  // The floor has four pieces a side, the box's sides have two.
  std::vector<surface::FaceLines> lines(rectangles().size(), surface::FaceLines{1, 1});
  lines.front() = {0, 0};
  const surface::FaceGrids grids({surface::evenLines(4), surface::evenLines(2)}, lines);
  displaced::DisplacedMesh result;
  // Vertices at one place are one vertex to the mesh's edges.
  std::map<std::tuple<double, double, double>, std::uint32_t> places;
  std::vector<std::uint32_t> shared;
  for (int face = 0; const Rectangle& r : rectangles()) {
    const surface::FaceGrid& grid = grids.faces()[static_cast<std::size_t>(face)];
    for (const double t : grids.tLines(grid)) {
      for (const double s : grids.sLines(grid)) {
        const Vec3 p = r.corner + s * r.along + t * r.across;
        const Vec2 texel = static_cast<double>(tileSide) * Vec2(s + face, t) + beyond;
        result.mesh.vertices.push_back(
            {{p, r.outside(), r.along / double(tileSide), r.across / double(tileSide), texel, true},
             {0, 0, glm::normalize(r.along), glm::normalize(r.across)},
             face,
             Vec2(s, t)});
        const auto next = static_cast<std::uint32_t>(shared.size());
        shared.push_back(places.emplace(std::tuple(p.x, p.y, p.z), next).first->second);
      }
    }
    ++face;
  }
  result.mesh.triangles = surface::gridTriangles(grids, surface::Diagonal::fromOrigin);
  result.adjacency = displaced::triangleAdjacency(result.mesh, shared);
  return result;
}

KnownView cameraViewFrom(const Vec3& eye, const Vec3& target, double fov) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.up = {0, 0, 1};
  camera.verticalFov = radians(fov);
  camera.width = 96;
  camera.height = 80;
  KnownView known{cameraView(camera, knownMesh().mesh), {}};
  const CameraAxes axis = axes(camera);
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      known.points.push_back(seenFrom(eye, pixelDirection(camera, axis, column, row)));
    }
  }
  const auto at = [&](int column, int row) -> KnownPoint& {
    return known.points[static_cast<std::size_t>(row * camera.width + column)];
  };
  for (int row = 1; row + 1 < camera.height; ++row) {
    for (int column = 1; column + 1 < camera.width; ++column) {
      KnownPoint& own = at(column, row);
      own.isClear = true;
      for (int k = 0; k < 9; ++k) {
        const KnownPoint& other = at(column + k % 3 - 1, row + k / 3 - 1);
        own.isClear = own.isClear && other.face == own.face && other.isHidden == own.isHidden;
      }
    }
  }
  return known;
}

KnownView makeAtlasView() {
  KnownView known;
  const auto tiles = static_cast<int>(rectangles().size());
  known.view.width = tiles * tileSide;
  known.view.height = tileSide;
  known.view.atlasTiles = {tiles, 1};
  const auto height = [](int x, int y) -> double {
    return bitOf(knownMaps().heights, 0, {x, y}) ? 1 : 0;
  };
  for (int y = tileSide - 1; y >= 0; --y) {
    for (int x = 0; x < known.view.width; ++x) {
      const Rectangle& r = rectangles().at(static_cast<std::size_t>(x / tileSide));
      const Vec2 st = Vec2(x % tileSide + 0.5, y + 0.5) / static_cast<double>(tileSide);
      KnownPoint point = pointOn(x / tileSide, r.corner + st.x * r.along + st.y * r.across);
      point.isClear = true;
      point.texel = {x, y};
      // The slopes of the height map a quarter of a texel beyond the texel's centre, per length.
      const auto between = [](double a, double b) { return 0.75 * a + 0.25 * b; };
      const double h00 = height(x, y);
      const double h10 = height(x + 1, y);
      const double h01 = height(x, y + 1);
      const double h11 = height(x + 1, y + 1);
      const double alongSlope = tileSide * between(h10 - h00, h11 - h01) / glm::length(r.along);
      const double acrossSlope = tileSide * between(h01 - h00, h11 - h10) / glm::length(r.across);
      const Vec3 normal = r.outside() - alongSlope * glm::normalize(r.along) -
                          acrossSlope * glm::normalize(r.across);
      point.bumped = glm::dot(glm::normalize(normal), knownLight());
      known.points.push_back(point);
    }
  }
  return known;
}

std::vector<float> randomBits(int layers, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> bits(static_cast<std::size_t>(layers * mapSize.x * mapSize.y));
  for (float& bit : bits) bit = static_cast<float>(random() >> 16 & 1U);
  return bits;
}

GpuTable tableOf(const std::vector<float>& values, int layers, horizon::TableBits bits) {
  return {horizon::storeTable(values, bits), {mapSize.x, mapSize.y, layers, relief::Wrap::repeat}};
}

horizon::AngleTable angleTable() {
  horizon::AngleTable table{{mapSize.x, mapSize.y, 2 * azimuths}, pi / 2, knownMaps().angles};
  for (float& angle : table.angles) angle *= static_cast<float>(table.limit);
  return table;
}

}  // namespace

const std::array<KnownView, 2>& cameraViews() {
  static const std::array views = {cameraViewFrom({-10, -9, 10}, {-2, 1, 1.5}, 42),
                                   cameraViewFrom({-2.7, 1.8, 1}, {4, -3, 0.6}, 90)};
  return views;
}

const KnownView& atlasView() {
  static const KnownView view = makeAtlasView();
  return view;
}

const Vec3& knownLight() {
  static const Vec3 light = glm::normalize(Vec3(0.45, -0.35, 0.82));
  return light;
}

const KnownMaps& knownMaps() {
  static const KnownMaps maps{randomBits(1, 1), randomBits(azimuths, 2), randomBits(azimuths, 3),
                              randomBits(horizon::EllipseTable::numbers, 4),
                              randomBits(2 * azimuths, 5)};
  return maps;
}

bool bitOf(const std::vector<float>& map, int layer, glm::ivec2 texel) {
  const glm::ivec2 at = texel % mapSize;
  return map.at(static_cast<std::size_t>((layer * mapSize.y + at.y) * mapSize.x + at.x)) > 0.5F;
}

KnownScene::KnownScene(horizon::TableBits bits)
    : mesh_(knownMesh()),
      gpu_(mesh_.mesh),
      volumes_(mesh_),
      texture_(textureView(mesh_.mesh)),
      heights_(
          relief::HeightField(mapSize.x, mapSize.y, knownMaps().heights, relief::Wrap::repeat)),
      horizon_(tableOf(knownMaps().horizon, azimuths, bits)),
      distance_(tableOf(knownMaps().distance, azimuths, bits)),
      ellipse_(tableOf(knownMaps().ellipse, horizon::EllipseTable::numbers, bits)),
      angles_(angleTable(), bits) {}

}  // namespace gnomon::render::check
