#include "render/check/pass_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "common/error.h"
#include "render/check/rectangles.h"
#include "render/passes.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

/// Counts what is as it must be.
class Tally {
 public:
  void add(bool isRight) {
    ++all_;
    wrong_ += isRight ? 0 : 1;
  }
  [[nodiscard]] std::string fault() const {
    if (all_ == 0) throw InternalError("the check of a pass has looked at nothing");
    return wrong_ == 0 ? "" : fmt::format("{} of {} pixels are wrong", wrong_, all_);
  }

 private:
  std::size_t all_ = 0;
  std::size_t wrong_ = 0;
};

Method probe(DrawnMesh mesh, const std::string& text) {
  Method method;
  method.name = "check";
  method.mesh = mesh;
  method.source = {"the check of a pass", text};
  return method;
}

// ---- a box over a floor

const Vec3 boxLight = glm::normalize(Vec3(0.45, -0.35, 0.82));

Camera boxCamera(const Vec3& eye, const Vec3& target, double fov) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.up = {0, 0, 1};
  camera.verticalFov = radians(fov);
  camera.width = 96;
  camera.height = 80;
  return camera;
}

const Camera& boxFromOutside() {
  static const Camera camera = boxCamera({-10, -9, 10}, {-2, 1, 1.5}, 42);
  return camera;
}

/// Below the box.
const Camera& boxFromItsShadow() {
  static const Camera camera = boxCamera({-2.7, 1.8, 1}, {4, -3, 0.6}, 90);
  return camera;
}

/// The scene on the GPU.
class Box {
 public:
  Box()
      : mesh_(boxOverFloorMesh()),
        gpu_(mesh_.mesh),
        volumes_(mesh_),
        heights_(HeightField(2, 2, {0, 0, 0, 0}, Wrap::repeat)) {}

  [[nodiscard]] RenderView view(const Camera& camera) const {
    return cameraView(camera, mesh_.mesh);
  }
  [[nodiscard]] const GpuMesh& gpu() const { return gpu_; }
  [[nodiscard]] Drawing drawing() const {
    return {gpu_, heights_, Wrap::repeat, HeightSpace::world, 1, boxLight, &volumes_};
  }

 private:
  DisplacedMesh mesh_;
  GpuMesh gpu_;
  GpuVolumes volumes_;
  GpuHeights heights_;
};

/// Compares both answers of a method: `test` says hidden, unless it is not asked; `drawn` dark.
enum class Asked { both, drawnAlone };

void compareBox(Tally& tally, const fs::path& shaders, const Method& method, const Box& box,
                const Camera& camera, Asked asked) {
  const MethodPass pass(shaders, method, Wrap::repeat, TableFilter::exact, {});
  const MethodAnswers answers = pass.render(box.view(camera), box.drawing(), {});
  const std::vector<SeenPoint> points = seenPoints(camera, boxLight);
  const bool castsShadows = method.passes.lightDepth || method.passes.shadowVolumes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SeenPoint& seen = points[i];
    if (!seen.isClear) continue;
    const auto shade = [&](bool isDark) {
      return seen.face < 0 ? Shade::none : isDark ? Shade::shadowed : Shade::lit;
    };
    const bool isRight =
        answers.drawn.samples.at(i) == shade(castsShadows ? seen.isHidden : seen.isTurned) &&
        (asked == Asked::drawnAlone ||
         answers.test.samples.at(i) == shade(castsShadows && seen.isHidden));
    tally.add(isRight);
  }
}

std::string cameraFault(const fs::path& shaders) {
  const Box box;
  const SamplesPass pass(shaders);
  constexpr double nearEnough = 1e-3;
  Tally tally;
  for (const Camera* camera : {&boxFromOutside(), &boxFromItsShadow()}) {
    const SampleGrid grid = pass.render(box.view(*camera), box.gpu());
    const std::vector<SeenPoint> points = seenPoints(*camera, boxLight);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!points[i].isClear) continue;
      const SurfaceSample& found = grid.samples.at(i);
      const Vec2 off = Vec2(found.s, found.t) - points[i].st;
      tally.add(found.face == points[i].face &&
                (found.face < 0 || std::max(std::abs(off.x), std::abs(off.y)) < nearEnough));
    }
  }
  return tally.fault();
}

std::string facetFault(const fs::path& shaders) {
  const Method method = probe(DrawnMesh::displaced,
                              "bool isShadowed(Pixel pixel, LocalLight light) { return false; }\n");
  const Box box;
  Tally tally;
  compareBox(tally, shaders, method, box, boxFromOutside(), Asked::both);
  compareBox(tally, shaders, method, box, boxFromItsShadow(), Asked::both);
  return tally.fault();
}

std::string lightDepthFault(const fs::path& shaders) {
  // Nearer to the light by more than 0.3, where the box is above the floor by 2 and more.
  Method method = probe(DrawnMesh::displaced,
                        "bool isShadowed(Pixel pixel, LocalLight light) {\n"
                        "  vec3 place = lightMapPlace(pixel.position);\n"
                        "  float before = place.z - lightDepthOf(ivec2(floor(place.xy)));\n"
                        "  return before * lightMapLengths.y > 0.3;\n"
                        "}\n");
  method.passes.lightDepth = true;
  method.parameters["depth_side"] = {512, 512, 512, ""};
  Tally tally;
  // Where a side is turned from the light, how deep it lies in the box decides: not asked.
  compareBox(tally, shaders, method, Box(), boxFromOutside(), Asked::drawnAlone);
  return tally.fault();
}

std::string volumeFault(const fs::path& shaders) {
  Method method =
      probe(DrawnMesh::displaced,
            "bool isShadowed(Pixel pixel, LocalLight light) { return shadowCount() != 0u; }\n");
  method.passes.shadowVolumes = true;
  const Box box;
  Tally tally;
  compareBox(tally, shaders, method, box, boxFromOutside(), Asked::both);
  compareBox(tally, shaders, method, box, boxFromItsShadow(), Asked::both);
  return tally.fault();
}

std::string pictureFault(const fs::path& shaders) {
  const Box box;
  const Camera& camera = boxFromOutside();
  const RenderView view = box.view(camera);
  Mask mask{view.width, view.height, {}};
  for (int i = 0; i < view.width * view.height; ++i) {
    const bool isDark = (i % view.width / 4 + i / view.width / 4) % 2 == 0;
    mask.samples.push_back(isDark ? Shade::shadowed : Shade::lit);
  }
  const auto picture =
      ShadePass(shaders, Wrap::repeat, DrawnMesh::displaced).render(view, box.drawing(), mask);
  const std::vector<SeenPoint> points = seenPoints(camera, boxLight);
  constexpr int white = 255;
  // As shade.frag has it: ambient light alone, and with it a cosine of at least 0.02.
  const auto red = [](double cosine) {
    const double light = 0.86 * (0.16 + 0.84 * cosine);
    return 255 * std::pow(light, 1 / 2.2);
  };
  Tally tally;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].isClear) continue;
    double expected = white;
    if (points[i].face >= 0) {
      const Rectangle& own = boxOverFloor().at(static_cast<std::size_t>(points[i].face));
      const Vec3 normal = glm::normalize(glm::cross(own.along, own.across));
      const bool isLit = mask.samples[i] == Shade::lit;
      expected = red(isLit ? std::max(glm::dot(normal, boxLight), 0.02) : 0);
    }
    tally.add(std::abs(picture.at(3 * i) - expected) < 1.5);
  }
  return tally.fault();
}

// ---- two faces side by side

constexpr int faceSide = 8;  ///< samples, and texels, of a face's side
constexpr int columns = 2 * faceSide;
constexpr int tileAzimuths = 4;
const Vec3 tileLight = glm::normalize(Vec3(0.6, 0.25, 0.2));

/// Samples lie a quarter of a texel beyond texel centres: of the four texels that are mixed, that
/// one has more than half of the weight.
BaseMesh tileMesh() {
  constexpr double beyond = 0.25;
  BaseMesh mesh;
  for (int face = 0; face < 2; ++face) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec2& st : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
      BaseVertex vertex{};
      vertex.position = Vec3(static_cast<double>(faceSide) * (st + Vec2(face, 0)), 0);
      vertex.normal = {0, 0, 1};
      vertex.px = vertex.v1 = {1, 0, 0};
      vertex.py = vertex.v2 = {0, 1, 0};
      vertex.texel = Vec2(vertex.position) + beyond;
      vertex.face = face;
      vertex.st = st;
      mesh.vertices.push_back(vertex);
    }
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
      mesh.triangles.push_back(first + corner);
    }
  }
  return mesh;
}

/// One sample a texel.
RenderView tileView() {
  RenderView view;
  view.width = columns;
  view.height = faceSide;
  view.atlasTiles = {2, 1};
  return view;
}

/// Random zeros and ones, [layer][y][x].
std::vector<float> randomBits(int layers, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> bits(static_cast<std::size_t>(layers * columns * faceSide));
  for (float& bit : bits) bit = static_cast<float>(random() >> 16 & 1U);
  return bits;
}

/// What is known at texel (x, y) of the maps.
struct Tiles {
  std::vector<float> heights = randomBits(1, 1);
  std::vector<float> horizon = randomBits(tileAzimuths, 2);
  std::vector<float> distance = randomBits(tileAzimuths, 3);
  std::vector<float> ellipse = randomBits(5, 4);
  std::vector<float> angles = randomBits(2 * tileAzimuths, 5);

  [[nodiscard]] static bool bit(const std::vector<float>& bits, int layer, int x, int y) {
    return bits.at(static_cast<std::size_t>((layer * faceSide + y) * columns + x)) > 0.5F;
  }
  [[nodiscard]] double height(int x, int y) const {
    return bit(heights, 0, x % columns, y % faceSide) ? 1 : 0;
  }
  /// N' · L, without its length, a quarter of a texel beyond the texel's centre.
  [[nodiscard]] double cosine(int x, int y) const {
    const auto between = [](double a, double b) { return 0.75 * a + 0.25 * b; };
    const double h00 = height(x, y);
    const double h10 = height(x + 1, y);
    const double h01 = height(x, y + 1);
    const double h11 = height(x + 1, y + 1);
    return glm::dot(tileLight,
                    Vec3(-between(h10 - h00, h11 - h01), -between(h01 - h00, h11 - h10), 1));
  }
};

/// Both sides mix bits by the same rule, of which each and their order count.
std::uint32_t mixed(std::uint32_t hash, bool bit) {
  hash = (hash + (bit ? 1U : 2U)) * 2654435761U;
  return hash ^ hash >> 15;
}

/// What a method's shader adds up of what it reads, and the same of what is known.
struct Probe {
  const char* hash;  ///< GLSL: mixes into `hash`, at `at`, layers chosen by `k`
  std::uint32_t (*expected)(const Tiles& tiles, int x, int y, int k);
};

const Probe tableProbe = {
    "  hash = mixed(hash, heightAt(at) > 0.5);\n"
    "  hash = mixed(hash, horizonAt(at, 0.5 * pi * float(k)) > 0.5);\n"
    "  hash = mixed(hash, distanceAt(at, 0.5 * pi * float(k)) > 0.5);\n",
    [](const Tiles& tiles, int x, int y, int k) {
      const auto bit = [&](const auto& bits, int layer) { return Tiles::bit(bits, layer, x, y); };
      return mixed(mixed(mixed(0, bit(tiles.heights, 0)), bit(tiles.horizon, k)),
                   bit(tiles.distance, k));
    }};

const Probe ellipseProbe = {
    "  Ellipse ellipse = ellipseAt(at);\n"
    "  hash = mixed(hash, ellipse.centre.x > 0.5);\n"
    "  hash = mixed(hash, ellipse.centre.y > 0.5);\n"
    "  hash = mixed(hash, ellipse.spread[0][0] > 0.5);\n"
    "  hash = mixed(hash, ellipse.spread[0][1] > 0.5);\n"
    "  hash = mixed(hash, ellipse.spread[1][1] > 0.5);\n",
    [](const Tiles& tiles, int x, int y, int) {
      std::uint32_t hash = 0;
      for (int layer = 0; layer < 5; ++layer) {
        hash = mixed(hash, Tiles::bit(tiles.ellipse, layer, x, y));
      }
      return hash;
    }};

/// The two lookup maps of angles are smooth: some of their values are known.
const Probe angleProbe = {
    "  int map = k / 2;\n"
    "  vec4 four = anglesOfTexel(ivec2(floor(at)), map);\n"
    "  for (int i = 0; i < 4; ++i) hash = mixed(hash, four[i] > 0.5);\n"
    "  hash = mixed(hash, basisOf(vec2(0.0, 1.0 - 2.0 * float(map)), map).z > 0.9);\n"
    "  hash = mixed(hash, abs(angleOfCosine(0.5) * angleLimit - pi / 3.0) < 0.02);\n",
    [](const Tiles& tiles, int x, int y, int k) {
      std::uint32_t hash = 0;
      for (int i = 0; i < 4; ++i)
        hash = mixed(hash, Tiles::bit(tiles.angles, 4 * (k / 2) + i, x, y));
      return mixed(mixed(hash, true), true);
    }};

/// Reads one map further, where the tables repeat.
std::string probeText(const Probe& probe) {
  return fmt::format(
      "uint mixed(uint hash, bool bit) {{\n"
      "  hash = (hash + (bit ? 1u : 2u)) * 2654435761u;\n"
      "  return hash ^ hash >> 15;\n"
      "}}\n"
      "bool isShadowed(Pixel pixel, LocalLight light) {{\n"
      "  vec2 at = pixel.texel + vec2({}.0, -{}.0);\n"
      "  int k = (int(pixel.texel.x) + int(pixel.texel.y)) % {};\n"
      "  uint hash = 0u;\n"
      "{}"
      "  return (hash & 1u) != 0u;\n"
      "}}\n",
      columns, faceSide, tileAzimuths, probe.hash);
}

/// The maps on the GPU, in one number of bits.
class GpuTiles {
 public:
  GpuTiles(const Tiles& tiles, TableBits bits)
      : mesh_(tileMesh()),
        gpu_(mesh_),
        texture_(textureView(mesh_)),
        heights_(HeightField(columns, faceSide, tiles.heights, Wrap::repeat)),
        horizon_(table(tiles.horizon, tileAzimuths, bits)),
        distance_(table(tiles.distance, tileAzimuths, bits)),
        ellipse_(table(tiles.ellipse, 5, bits)),
        angles_(angleTable(tiles.angles), bits) {}

  [[nodiscard]] const GpuMesh& gpu() const { return gpu_; }
  [[nodiscard]] MethodAnswers answers(const MethodPass& pass) const {
    const Drawing drawing{gpu_, heights_,  Wrap::repeat, HeightSpace::world,
                          1,    tileLight, nullptr,      &texture_};
    return pass.render(tileView(), drawing, {&horizon_, &distance_, &angles_, &ellipse_});
  }

 private:
  static GpuTable table(const std::vector<float>& values, int layers, TableBits bits) {
    return {storeTable(values, bits), columns, faceSide, layers, Wrap::repeat};
  }
  static AngleTable angleTable(const std::vector<float>& shares) {
    AngleTable table{columns, faceSide, 2 * tileAzimuths, pi / 2, shares};
    for (float& angle : table.angles) angle *= static_cast<float>(table.limit);
    return table;
  }

  BaseMesh mesh_;
  GpuMesh gpu_;
  RenderView texture_;
  GpuHeights heights_;
  GpuTable horizon_, distance_, ellipse_;
  GpuAngles angles_;
};

/// @param dark  what the method's test must say at texel (x, y)
template <typename Dark>
void compareTiles(Tally& tally, const MethodAnswers& answers, const Tiles& tiles,
                  const Dark& dark) {
  for (int row = 0; row < faceSide; ++row) {
    for (int x = 0; x < columns; ++x) {
      const int y = faceSide - 1 - row;
      const auto i = static_cast<std::size_t>(row * columns + x);
      const auto shade = [](bool isDark) { return isDark ? Shade::shadowed : Shade::lit; };
      const double cosine = tiles.cosine(x, y);
      const bool isSure = std::abs(cosine) > 1e-3;
      tally.add(answers.test.samples.at(i) == shade(dark(x, y)) &&
                (!isSure || answers.drawn.samples.at(i) == shade(dark(x, y) || cosine <= 0)));
    }
  }
}

std::string atlasFault(const fs::path& shaders) {
  const BaseMesh mesh = tileMesh();
  const SampleGrid grid = SamplesPass(shaders).render(tileView(), GpuMesh(mesh));
  constexpr double nearEnough = 1e-6;
  Tally tally;
  for (int row = 0; row < faceSide; ++row) {
    for (int x = 0; x < columns; ++x) {
      const SurfaceSample& found = grid.samples.at(static_cast<std::size_t>(row * columns + x));
      tally.add(found.face == x / faceSide &&
                std::abs(found.s - (x % faceSide + 0.5) / faceSide) < nearEnough &&
                std::abs(found.t - (faceSide - 1 - row + 0.5) / faceSide) < nearEnough);
    }
  }
  return tally.fault();
}

constexpr std::array allBits = {TableBits::eight, TableBits::sixteen, TableBits::thirtyTwo};

std::string tileFault(const fs::path& shaders, const Probe& probed, const MethodTables& tables,
                      TableFilter filter) {
  Method method = probe(DrawnMesh::base, probeText(probed));
  method.tables = tables;
  const MethodPass pass(shaders, method, Wrap::repeat, filter, {});
  const Tiles tiles;
  Tally tally;
  for (const TableBits bits : allBits) {
    compareTiles(tally, GpuTiles(tiles, bits).answers(pass), tiles, [&](int x, int y) {
      return (probed.expected(tiles, x, y, (x + y) % tileAzimuths) & 1U) != 0;
    });
  }
  return tally.fault();
}

std::string tableFault(const fs::path& shaders, TableFilter filter) {
  MethodTables tables;
  tables.height = tables.horizon = tables.distance = true;
  return tileFault(shaders, tableProbe, tables, filter);
}

std::string ellipseFault(const fs::path& shaders) {
  MethodTables tables;
  tables.ellipse = true;
  return tileFault(shaders, ellipseProbe, tables, TableFilter::exact);
}

std::string angleFault(const fs::path& shaders) {
  MethodTables tables;
  tables.angles = true;
  return tileFault(shaders, angleProbe, tables, TableFilter::exact);
}

std::string textureFault(const fs::path& shaders) {
  Method method = probe(DrawnMesh::base,
                        "float resolveTexel(Pixel pixel) { return heightAt(pixel.texel); }\n"
                        "bool isShadowed(Pixel pixel, LocalLight light) {\n"
                        "  return resolvedAt(pixel.texel) > 0.5;\n"
                        "}\n");
  method.tables.height = method.tables.angles = true;
  method.passes.texture = true;
  const MethodPass pass(shaders, method, Wrap::repeat, TableFilter::exact, {});
  const Tiles tiles;
  Tally tally;
  for (const TableBits bits : allBits) {
    compareTiles(tally, GpuTiles(tiles, bits).answers(pass), tiles,
                 [&](int x, int y) { return Tiles::bit(tiles.heights, 0, x, y); });
  }
  return tally.fault();
}

}  // namespace

std::string_view passName(PassKind kind) {
  switch (kind) {
    case PassKind::cameraSamples:
      return "the samples of a camera";
    case PassKind::atlasSamples:
      return "the samples of an atlas";
    case PassKind::tables:
      return "answers from tables";
    case PassKind::filteredTables:
      return "answers from tables by the GPU's filter";
    case PassKind::angles:
      return "answers from horizon angles";
    case PassKind::ellipses:
      return "answers from ellipses";
    case PassKind::facets:
      return "facets of displaced geometry";
    case PassKind::texture:
      return "a pass in the texture's plane";
    case PassKind::lightDepth:
      return "the depth that the light sees";
    case PassKind::shadowVolumes:
      return "shadow volumes";
    case PassKind::pictures:
      return "the pictures of masks";
  }
  throw InternalError("pass: not one of its kinds");
}

std::vector<PassKind> passesOf(const Method& method, TableFilter filter) {
  const MethodTables& tables = method.tables;
  std::vector<PassKind> kinds;
  if (method.mesh == DrawnMesh::displaced) kinds.push_back(PassKind::facets);
  // Base meshes are shaded by the height map whatever the method reads.
  if (method.mesh == DrawnMesh::base || tables.height || tables.horizon || tables.distance) {
    kinds.push_back(filter == TableFilter::hardware ? PassKind::filteredTables : PassKind::tables);
  }
  if (tables.angles || tables.surfaceAngles) kinds.push_back(PassKind::angles);
  if (tables.ellipse) kinds.push_back(PassKind::ellipses);
  if (method.passes.texture) kinds.push_back(PassKind::texture);
  if (method.passes.lightDepth) kinds.push_back(PassKind::lightDepth);
  if (method.passes.shadowVolumes) kinds.push_back(PassKind::shadowVolumes);
  return kinds;
}

std::string passFault(PassKind kind, const fs::path& shaders) {
  switch (kind) {
    case PassKind::cameraSamples:
      return cameraFault(shaders);
    case PassKind::atlasSamples:
      return atlasFault(shaders);
    case PassKind::tables:
      return tableFault(shaders, TableFilter::exact);
    case PassKind::filteredTables:
      return tableFault(shaders, TableFilter::hardware);
    case PassKind::angles:
      return angleFault(shaders);
    case PassKind::ellipses:
      return ellipseFault(shaders);
    case PassKind::facets:
      return facetFault(shaders);
    case PassKind::texture:
      return textureFault(shaders);
    case PassKind::lightDepth:
      return lightDepthFault(shaders);
    case PassKind::shadowVolumes:
      return volumeFault(shaders);
    case PassKind::pictures:
      return pictureFault(shaders);
  }
  throw InternalError("pass: not one of its kinds");
}

}  // namespace gnomon
