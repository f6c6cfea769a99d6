#include "render/check/tile_scene.h"

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <random>

#include "horizon/horizon_ellipses.h"
#include "render/bakes/bake_pass.h"
#include "render/check/tally.h"
#include "surface/face_grids.h"

namespace gnomon::render::check {
namespace {

using tile::azimuths;
using tile::columns;
using tile::side;

/// Random zeros and ones, [layer][y][x].
std::vector<float> randomBits(int layers, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> bits(static_cast<std::size_t>(layers * columns * side));
  for (float& bit : bits) bit = static_cast<float>(random() >> 16 & 1U);
  return bits;
}

/// The maps on the GPU, in one number of bits.
class TileScene {
 public:
  TileScene(const TileValues& tiles, horizon::TableBits bits)
      : mesh_(tileMesh()),
        gpu_(mesh_),
        texture_(textureView(mesh_)),
        heights_(relief::HeightField(columns, side, tiles.heights, relief::Wrap::repeat)),
        horizon_(table(tiles.horizon, azimuths, bits)),
        distance_(table(tiles.distance, azimuths, bits)),
        ellipse_(table(tiles.ellipse, horizon::EllipseTable::numbers, bits)),
        angles_(angleTable(tiles.angles), bits) {}

  /// @param bakes  of the method, if it has any
  [[nodiscard]] MethodAnswers answers(const MethodPass& pass, const BakePass* bakes,
                                      const Method& method) const {
    GpuTables given = tables();
    std::vector<GpuBake> own;
    if (bakes != nullptr) {
      const BakeScene from{heights_, relief::Wrap::repeat, relief::HeightSpace::world, 1};
      own = gpuBakes(method, bakes->bake(from, given), from);
      given.bakes = &own;
    }
    return pass.render(tileView(), drawing(), given);
  }

  [[nodiscard]] VisibilityAnswers shares(const MethodPass& pass, double radius) const {
    Drawing soft = drawing();
    soft.lightRadius = radius;
    return pass.renderVisibility(tileView(), soft, tables());
  }

 private:
  [[nodiscard]] Drawing drawing() const {
    return {gpu_,    heights_, relief::Wrap::repeat, relief::HeightSpace::world, 1, tileLight(),
            nullptr, &texture_};
  }
  [[nodiscard]] GpuTables tables() const { return {&horizon_, &distance_, &angles_, &ellipse_}; }

  static GpuTable table(const std::vector<float>& values, int layers, horizon::TableBits bits) {
    return {horizon::storeTable(values, bits), {columns, side, layers, relief::Wrap::repeat}};
  }
  static horizon::AngleTable angleTable(const std::vector<float>& shares) {
    horizon::AngleTable table{{columns, side, 2 * azimuths}, pi / 2, shares};
    for (float& angle : table.angles) angle *= static_cast<float>(table.limit);
    return table;
  }

  surface::BaseMesh mesh_;
  GpuMesh gpu_;
  RenderView texture_;
  GpuHeights heights_;
  GpuTable horizon_, distance_, ellipse_;
  GpuAngles angles_;
};

void compareTiles(Tally& tally, const MethodAnswers& answers, const TileValues& tiles,
                  const std::function<bool(const TileValues&, int x, int y)>& isDark) {
  for (int row = 0; row < side; ++row) {
    for (int x = 0; x < columns; ++x) {
      const int y = side - 1 - row;
      const auto i = static_cast<std::size_t>(row * columns + x);
      const auto shade = [](bool dark) { return dark ? Shade::shadowed : Shade::lit; };
      const bool isHidden = isDark(tiles, x, y);
      const double cosine = glm::dot(tileLight(), tiles.normal(x, y));
      const bool isSure = std::abs(cosine) > 1e-3;
      tally.add(answers.test.samples.at(i) == shade(isHidden) &&
                (!isSure || answers.drawn.samples.at(i) == shade(isHidden || cosine <= 0)));
    }
  }
}

}  // namespace

TileValues::TileValues()
    : heights(randomBits(1, 1)),
      horizon(randomBits(azimuths, 2)),
      distance(randomBits(azimuths, 3)),
      ellipse(randomBits(horizon::EllipseTable::numbers, 4)),
      angles(randomBits(2 * azimuths, 5)) {}

Vec3 TileValues::normal(int x, int y) const {
  const auto between = [](double a, double b) { return 0.75 * a + 0.25 * b; };
  const double h00 = height(x, y);
  const double h10 = height(x + 1, y);
  const double h01 = height(x, y + 1);
  const double h11 = height(x + 1, y + 1);
  return {-between(h10 - h00, h11 - h01), -between(h01 - h00, h11 - h10), 1};
}

surface::BaseMesh tileMesh() {
  constexpr double beyond = 0.25;
  const surface::FaceGrids grids = surface::FaceGrids::even(2, 1);
  const Vec3 x(1, 0, 0);
  const Vec3 y(0, 1, 0);
  surface::BaseMesh mesh;
  for (int face = 0; face < 2; ++face) {
    for (const Vec2& st : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(1, 1)}) {
      const Vec2 place = static_cast<double>(side) * (st + Vec2(face, 0));
      mesh.vertices.push_back(
          {{Vec3(place, 0), Vec3(0, 0, 1), x, y, place + beyond, true}, {0, 0, x, y}, face, st});
    }
  }
  mesh.triangles = surface::gridTriangles(grids, surface::Diagonal::fromOrigin);
  return mesh;
}

RenderView tileView() {
  RenderView view;
  view.width = columns;
  view.height = side;
  view.atlasTiles = {2, 1};
  return view;
}

Vec3 tileLight() {
  return glm::normalize(Vec3(0.6, 0.25, 0.2));
}

VisibilityAnswers tileShares(const std::filesystem::path& shaders, const Method& method,
                             const TileValues& tiles, double radius) {
  const MethodPass pass(shaders, method, relief::Wrap::repeat, TableFilter::exact, {});
  return TileScene(tiles, horizon::TableBits::thirtyTwo).shares(pass, radius);
}

std::string tileFault(const std::filesystem::path& shaders, const Method& method,
                      TableFilter filter,
                      const std::function<bool(const TileValues&, int x, int y)>& isDark) {
  const MethodPass pass(shaders, method, relief::Wrap::repeat, filter, {});
  std::optional<BakePass> bakes;
  if (!method.bakes.empty()) {
    bakes.emplace(shaders, method, relief::Wrap::repeat, filter, std::map<std::string, double>());
  }
  const TileValues tiles;
  Tally tally;
  for (const horizon::TableBits bits :
       {horizon::TableBits::eight, horizon::TableBits::sixteen, horizon::TableBits::thirtyTwo}) {
    compareTiles(tally, TileScene(tiles, bits).answers(pass, bakes ? &*bakes : nullptr, method),
                 tiles, isDark);
  }
  return tally.fault();
}

}  // namespace gnomon::render::check
