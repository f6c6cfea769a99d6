// Methods of real geometry, shadow volumes and a shadow map, against rays through the very
// triangles that they draw, one triangle after another.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/parallel.h"
#include "relief/patterns.h"
#include "render/render_scene.h"
#include "render/traced_scene.h"

namespace gnomon {
namespace {

using test::difference;
using test::DisplacedScene;
using test::flatRelief;
using test::lightToward;
using test::randomRelief;
using test::shareShadowed;
using test::stepRelief;
using test::TracedScene;

/// What rays through the triangles of a displaced mesh say of a view's pixels.
class Rays {
 public:
  explicit Rays(const DisplacedScene& scene, int subdivisions)
      : mesh_(scene.displaced.mesh), cuts_(subdivisions) {
    for (std::size_t i = 0; i < mesh_.triangleCount(); ++i) {
      const Vec3 a = corner(i, 0);
      triangles_.push_back({a, corner(i, 1) - a, corner(i, 2) - a});
      for (const int k : {0, 1, 2}) extent_ = std::max(extent_, glm::length(corner(i, k)));
    }
  }

  /// lit, shadowed, or none where a pixel lies so near to an edge of anything that rounding
  /// decides.
  /// @param grazing  facets whose cosine to the light is smaller are left out
  [[nodiscard]] Mask mask(const SampleGrid& samples, const Vec3& light,
                          double grazing = 1e-4) const {
    Mask result{samples.width, samples.height,
                std::vector<Shade>(samples.samples.size(), Shade::none)};
    const std::vector<Obstacle> obstacles = obstaclesOf(light);
    parallelFor(0, samples.samples.size(), [&](std::size_t i) {
      if (samples.samples[i].face >= 0) {
        result.samples[i] = shadeOf(samples.samples[i], light, obstacles, grazing);
      }
    });
    return result;
  }

 private:
  struct Triangle {
    Vec3 corner, along, across;
  };

  /// A triangle with what all rays of one direction have in common.
  struct Obstacle {
    Triangle triangle;
    Vec3 p;
    double volume;
  };

  /// All triangles but those that the direction lies in.
  [[nodiscard]] std::vector<Obstacle> obstaclesOf(const Vec3& direction) const {
    std::vector<Obstacle> obstacles;
    for (const Triangle& t : triangles_) {
      const Vec3 p = glm::cross(direction, t.across);
      const double volume = glm::dot(t.along, p);
      if (std::abs(volume) >= 1e-12) obstacles.push_back({t, p, volume});
    }
    return obstacles;
  }

  [[nodiscard]] Vec3 corner(std::size_t triangle, int k) const {
    return mesh_.vertices[mesh_.triangles[3 * triangle + static_cast<std::size_t>(k)]].position;
  }

  [[nodiscard]] Shade shadeOf(const SurfaceSample& sample, const Vec3& light,
                              const std::vector<Obstacle>& obstacles, double grazing) const {
    const Vec2 place = Vec2(sample.s, sample.t) * static_cast<double>(cuts_);
    const Vec2 cell = glm::clamp(glm::floor(place), Vec2(0), Vec2(cuts_ - 1));
    const Vec2 in = place - cell;
    // GL snaps corners to 1/256 of a pixel, and triangles here are a few pixels wide.
    constexpr double border = 0.02;
    if (std::min(in.x, in.y) < border || std::max(in.x, in.y) > 1 - border ||
        std::abs(in.x - in.y) < border) {
      return Shade::none;
    }
    const bool upper = in.y > in.x;
    const auto quad = static_cast<std::size_t>(
        (sample.face * cuts_ + static_cast<int>(cell.y)) * cuts_ + static_cast<int>(cell.x));
    const Triangle& own = triangles_[2 * quad + (upper ? 1 : 0)];
    const Vec3 normal = glm::normalize(glm::cross(own.along, own.across));
    const double cosine = glm::dot(normal, light);
    if (std::abs(cosine) < grazing) return Shade::none;
    if (cosine < 0) return Shade::shadowed;
    // (0,0) (1,0) (1,1) below the diagonal, (0,0) (1,1) (0,1) above it.
    const Vec2 share = upper ? Vec2(in.x, in.y - in.x) : Vec2(in.x - in.y, in.y);
    const Vec3 point = own.corner + share.x * own.along + share.y * own.across;
    const double shift = 1e-4 * extent_;
    const Vec3 sideways = shift * glm::normalize(own.along);
    const Vec3 upward = shift * glm::normalize(glm::cross(normal, own.along));
    const bool dark = meets(obstacles, point + 1e-9 * extent_ * normal, light);
    for (const Vec3& move : {sideways, -sideways, upward, -upward}) {
      if (meets(obstacles, point + move + 1e-9 * extent_ * normal, light) != dark)
        return Shade::none;
    }
    return dark ? Shade::shadowed : Shade::lit;
  }

  /// Möller & Trumbore 1997, every triangle of the mesh.
  [[nodiscard]] static bool meets(const std::vector<Obstacle>& obstacles, const Vec3& origin,
                                  const Vec3& direction) {
    for (const auto& [t, p, volume] : obstacles) {
      const Vec3 from = origin - t.corner;
      const double u = glm::dot(from, p) / volume;
      if (u < 0 || u > 1) continue;
      const Vec3 q = glm::cross(from, t.along);
      const double v = glm::dot(direction, q) / volume;
      if (v < 0 || u + v > 1) continue;
      if (glm::dot(t.across, q) / volume > 0) return true;
    }
    return false;
  }

  const BaseMesh& mesh_;
  int cuts_;
  double extent_ = 0;
  std::vector<Triangle> triangles_;
};

Camera cameraAt(const Vec3& eye, const Vec3& target, double fov, int side) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.verticalFov = radians(fov);
  camera.width = side;
  camera.height = side;
  camera.up = std::abs(glm::normalize(eye - target).z) > 0.99 ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  return camera;
}

/// How a mask compares with what the rays are sure of.
struct Verdict {
  std::size_t wrong = 0;
  std::size_t lit = 0;
  std::size_t dark = 0;
  std::size_t unsure = 0;
};

Verdict judge(const Mask& mask, const Mask& rays, const SampleGrid& samples) {
  Verdict verdict;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    EXPECT_EQ(mask.samples[i] == Shade::none, samples.samples[i].face < 0);
    if (samples.samples[i].face < 0) continue;
    if (rays.samples[i] == Shade::none) {
      ++verdict.unsure;
      continue;
    }
    verdict.wrong += mask.samples[i] != rays.samples[i] ? 1 : 0;
    verdict.lit += rays.samples[i] == Shade::lit ? 1 : 0;
    verdict.dark += rays.samples[i] == Shade::shadowed ? 1 : 0;
  }
  return verdict;
}

/// Shadow volumes are exact: not one pixel may differ where rounding does not decide.
void expectRaysAnswer(const DisplacedScene& scene, int subdivisions, const Camera& camera,
                      const Vec3& light, const char* what, bool both = true) {
  SCOPED_TRACE(what);
  const RenderView view = cameraView(camera, scene.displaced.mesh);
  const SampleGrid samples = scene.samples(view);
  const Mask rays = Rays(scene, subdivisions).mask(samples, light);
  const Mask mask = scene.answer("shadow-volume", view, light);
  const Verdict verdict = judge(mask, rays, samples);
  EXPECT_EQ(verdict.wrong, 0U);
  const std::size_t all = verdict.lit + verdict.dark + verdict.unsure;
  EXPECT_GT(all, mask.size() / 10);
  EXPECT_LT(verdict.unsure, all / 3);
  if (both) {
    EXPECT_GT(verdict.lit, all / 50);
    EXPECT_GT(verdict.dark, all / 50);
  }
}

/// An arched patch that ends at its rim.
Cage arch(int columns, int rows) {
  std::array<Vec3, 16> points{};
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const double rise = (i == 1 || i == 2 ? 12 : 0) + (j == 1 || j == 2 ? 6 : 0);
      points[static_cast<std::size_t>(4 * j + i)] = Vec3(-24 + 16 * i, -24 + 16 * j, rise);
    }
  }
  return makeBezier(points, columns, rows);
}

Relief box(double height) {
  return stepRelief(48, 48, height,
                    [](int i, int j) { return i >= 20 && i < 28 && j >= 20 && j < 28; });
}

const Camera above = cameraAt({0, 0, 100}, {0, 0, 0}, 30, 96);

// ---- nothing to shade

TEST(RealGeometry, UndisplacedPlaneIsLitWhole) {
  const GlContext gl;
  const DisplacedScene scene(makePlane(48, 48, 6, 6), flatRelief(48, 48), 9);
  for (const Camera& camera : {above, cameraAt({10, -70, 30}, {0, 0, 0}, 40, 96)}) {
    const RenderView view = cameraView(camera, scene.displaced.mesh);
    for (const auto& [azimuth, elevation] : {std::pair{20.0, 80.0},
                                             {20.0, 30.0},
                                             {45.0, 10.0},
                                             {90.0, 5.0},
                                             {200.0, 2.0},
                                             {0.0, 90.0}}) {
      const Vec3 light = lightToward(azimuth, elevation);
      EXPECT_EQ(shareShadowed(scene.answer("shadow-volume", view, light)), 0) << elevation;
      EXPECT_EQ(shareShadowed(scene.answer("shadow-map", view, light)), 0) << elevation;
    }
  }
  const RenderView atlas = atlasView(scene.surface, 24);
  for (const double elevation : {80.0, 30.0, 10.0, 2.0}) {
    EXPECT_EQ(shareShadowed(scene.answer("shadow-map", atlas, lightToward(20, elevation))), 0);
  }
}

TEST(RealGeometry, ConvexPatchThatFacesTheLightIsLitWhole) {
  const GlContext gl;
  const DisplacedScene scene(arch(12, 12), flatRelief(48, 48), 5);
  const RenderView view =
      cameraView(cameraAt({20, -60, 60}, {0, 0, 4}, 40, 96), scene.displaced.mesh);
  const RenderView atlas = atlasView(scene.surface, 16);
  for (const double azimuth : {0.0, 77.0, 200.0}) {
    const Vec3 light = lightToward(azimuth, 70);
    EXPECT_EQ(shareShadowed(scene.answer("shadow-volume", view, light)), 0) << azimuth;
    EXPECT_EQ(shareShadowed(scene.answer("shadow-map", view, light)), 0) << azimuth;
    EXPECT_EQ(shareShadowed(scene.answer("shadow-map", atlas, light)), 0) << azimuth;
  }
}

TEST(RealGeometry, PlaneLitFromBelowIsDarkWhole) {
  const GlContext gl;
  const DisplacedScene scene(makePlane(48, 48, 6, 6), flatRelief(48, 48), 3);
  const RenderView view = cameraView(above, scene.displaced.mesh);
  for (const double elevation : {-5.0, -60.0, -90.0}) {
    const Vec3 light = lightToward(20, elevation);
    EXPECT_EQ(shareShadowed(scene.answer("shadow-volume", view, light)), 1);
    EXPECT_EQ(shareShadowed(scene.answer("shadow-map", view, light)), 1);
  }
}

TEST(RealGeometry, ShadowMapWithoutBiasHasAcne) {
  const GlContext gl;
  const DisplacedScene scene(makePlane(48, 48, 6, 6), flatRelief(48, 48), 9);
  const RenderView view = cameraView(above, scene.displaced.mesh);
  const Mask mask = scene.answer("shadow-map", view, lightToward(20, 30), {{"bias", 0}});
  EXPECT_GT(shareShadowed(mask), 0.05);
}

// ---- a box's shadow

/// The last shadowed column of the middle row, as a place x in the world; the camera looks straight
/// down at z = 0.
double shadowEnd(const Mask& mask, const SampleGrid& samples, const LimitSurface& surface) {
  double end = -1000;
  for (int column = 0; column < mask.width; ++column) {
    const auto i = static_cast<std::size_t>(mask.height / 2 * mask.width + column);
    if (mask.samples[i] != Shade::shadowed) continue;
    const SurfaceSample& s = samples.samples[i];
    end = std::max(end, surface.evaluate(s.face, s.s, s.t).position.x);
  }
  return end;
}

TEST(RealGeometry, BoxCastsAShadowAsLongAsTheTangentOfTheLightSays) {
  const GlContext gl;
  constexpr double height = 5;
  // Vertices at every half texel, texel centres among them: the mesh is the relief itself.
  const DisplacedScene scene(makePlane(48, 48, 6, 6), box(height), 16);
  const RenderView view =
      cameraView(cameraAt({0, 0, 100}, {0, 0, 0}, 27, 384), scene.displaced.mesh);
  const SampleGrid samples = scene.samples(view);
  const double pixel = 2 * 100 * std::tan(radians(13.5)) / 384;
  const double edge = 27.5 - 24;  // the end of its top
  for (const double elevation : {55.0, 40.0, 25.0, 17.0}) {
    const Vec3 light = lightToward(180, elevation);
    const double expected = edge + height / std::tan(radians(elevation));
    const Mask volumes = scene.answer("shadow-volume", view, light);
    EXPECT_NEAR(shadowEnd(volumes, samples, scene.surface), expected, 1.01 * pixel) << elevation;
    // The map's texel is 0.035 wide; its bias lets light in for about one, its filter for 1.5.
    const Mask map = scene.answer("shadow-map", view, light);
    EXPECT_NEAR(shadowEnd(map, samples, scene.surface), expected, pixel + 0.4) << elevation;
    // Across the light the shadow is as wide as the box's top and its sloped sides can cast.
    EXPECT_LT(shadowEnd(scene.answer("shadow-volume", view, lightToward(0, elevation)), samples,
                        scene.surface),
              28.5 - 24);
  }
}

TEST(RealGeometry, ShadowVolumesOfABoxAreTheTracers) {
  const GlContext gl;
  // At the box's four corners the relief is not flat inside a texel: quarter texels, and halves of
  // them for the tracer.
  const DisplacedScene scene(makePlane(48, 48, 6, 6), box(5), 32);
  const TracedScene traced(scene.surface, scene.relief, 0.125);
  for (const Camera& camera : {above, cameraAt({30, -60, 40}, {0, 0, 2}, 40, 128)}) {
    const RenderView view = cameraView(camera, scene.displaced.mesh);
    const SampleGrid samples = scene.samples(view);
    for (const auto& [azimuth, elevation] :
         {std::pair{20.0, 35.0}, {-140.0, 20.0}, {90.0, 50.0}, {180.0, 10.0}}) {
      const Vec3 light = lightToward(azimuth, elevation);
      const Mask truth = traced.mask(scene.surface, scene.relief, samples, light);
      const Mask mask = scene.answer("shadow-volume", view, light);
      EXPECT_GT(shareShadowed(truth), 0.01);
      // Single pixels on the very edges of shadows.
      EXPECT_LT(difference(mask, truth), 1e-3) << azimuth << " " << elevation;
    }
  }
}

// ---- shadow volumes against rays through the same triangles

TEST(ShadowVolumes, AreExactOnARoughPlane) {
  const GlContext gl;
  const DisplacedScene scene(makePlane(48, 48, 6, 6), randomRelief(24, 24, 5, 3), 4);
  for (const double azimuth : {20.0, 111.0, 250.0}) {
    expectRaysAnswer(scene, 4, above, lightToward(azimuth, 30), "from above");
    expectRaysAnswer(scene, 4, cameraAt({60, -50, 35}, {0, 0, 0}, 45, 96), lightToward(azimuth, 20),
                     "from aside");
  }
}

TEST(ShadowVolumes, AreExactOnClosedSurfaces) {
  const GlContext gl;
  const DisplacedScene torus(makeTorus(30, 10, 58, 58), randomRelief(48, 32, 3, 3), 1);
  expectRaysAnswer(torus, 1, cameraAt({20, 90, 90}, {0, 0, 0}, 45, 64), lightToward(20, 40),
                   "torus");
  expectRaysAnswer(torus, 1, cameraAt({100, 20, 30}, {0, 0, 0}, 45, 64), lightToward(120, -30),
                   "torus, half behind");
  const DisplacedScene cube(test::cubeCage(), randomRelief(8, 8, 1, 3), 8);
  expectRaysAnswer(cube, 8, cameraAt({20, -25, 22}, {0, 0, 0}, 32, 96), lightToward(-10, 30),
                   "cube with seams");
}

TEST(ShadowVolumes, AreExactOnAnOpenPatchWhateverSideTheLightIsOn) {
  const GlContext gl;
  const DisplacedScene scene(arch(8, 8), randomRelief(32, 32, 4, 3), 4);
  const Camera camera = cameraAt({10, -70, 60}, {0, 0, 5}, 45, 96);
  expectRaysAnswer(scene, 4, camera, lightToward(20, 25), "from above");
  expectRaysAnswer(scene, 4, camera, lightToward(200, 4), "grazing");
  // From below light comes in past the rim only where a bump overhangs it.
  expectRaysAnswer(scene, 4, camera, lightToward(20, -35), "from below", false);
  // The far side of a thin sheet, seen from the light's own side: nothing of it faces the camera.
  const DisplacedScene bowl(arch(8, 8), stepRelief(32, 32, -6, [](int i, int) { return i > 15; }),
                            4);
  expectRaysAnswer(bowl, 4, camera, lightToward(160, 20), "one half pressed in");
}

TEST(ShadowVolumes, AreExactForACameraInsideAShadow) {
  const GlContext gl;
  // A tower 30 high whose shadow, at 20°, is 82 long and holds the camera.
  const DisplacedScene scene(
      makePlane(96, 48, 12, 6),
      stepRelief(48, 24, 30, [](int i, int j) { return i >= 10 && i < 16 && j >= 8 && j < 16; }),
      4);
  const Vec3 light = lightToward(180, 20);
  const Vec3 inside(0, 0, 4);
  ASSERT_LT(inside.x + 16, 30 / std::tan(radians(20)));
  expectRaysAnswer(scene, 4, cameraAt(inside, {40, 6, 0}, 100, 96), light, "away from the light");
  expectRaysAnswer(scene, 4, cameraAt(inside, {-4, 24, 0}, 100, 96), light, "across");
  expectRaysAnswer(scene, 4, cameraAt(inside, {-15, 10, 6}, 100, 96), light, "toward the tower",
                   true);
  // Looking along the light and against it: the point at infinity is in the picture's middle.
  expectRaysAnswer(scene, 4, cameraAt({-20, 0, 45}, Vec3(-20, 0, 45) - 10.0 * light, 100, 96),
                   light, "along the light");
}

TEST(ShadowVolumes, LeaveNoStreaksWhereFacetsStandEdgeOnToTheLight) {
  const GlContext gl;
  // The lee side of the box falls from 6 to 0 over one texel: light along it, to the bit of a float
  // and beside it.
  const Relief relief =
      stepRelief(24, 24, 6, [](int i, int j) { return i >= 10 && i < 14 && j >= 10 && j < 14; });
  const DisplacedScene scene(makePlane(24, 24, 3, 3), relief, 16);
  const Camera camera = cameraAt({3, -2, 60}, {0, 0, 0}, 24, 128);
  for (const Vec3& light :
       {glm::normalize(Vec3(-1, 0, 6)), glm::normalize(Vec3(1, 0, 6)),
        glm::normalize(Vec3(0, -1, 6)), glm::normalize(Vec3(-1, -1, 6)),
        glm::normalize(Vec3(-1, 1e-7, 6)), Vec3(0, 0, 1), glm::normalize(Vec3(-1, -1, 3))}) {
    expectRaysAnswer(scene, 16, camera, light, "edge-on", false);
  }
  // A roof with a ridge along y, its far slope exactly along the light.
  const DisplacedScene ridge(makePlane(24, 24, 3, 3),
                             stepRelief(24, 24, 4, [](int i, int) { return i == 11; }), 16);
  for (const double along : {0.0, 1.0, -2.0}) {
    expectRaysAnswer(ridge, 16, camera, glm::normalize(Vec3(-1, along, 4)), "ridge", false);
  }
}

TEST(ShadowVolumes, StayClosedWhereRoundingDecidesHowAFacetFaces) {
  const GlContext gl;
  const DisplacedScene scene(arch(4, 4), randomRelief(16, 16, 3, 3), 2);
  const RenderView view =
      cameraView(cameraAt({10, -50, 60}, {0, 0, 5}, 50, 64), scene.displaced.mesh);
  const SampleGrid samples = scene.samples(view);
  const Rays rays(scene, 2);
  const BaseMesh& mesh = scene.displaced.mesh;
  std::size_t judged = 0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    // A light in the very plane of a facet. Its two neighbours and itself must agree on whether it
    // faces the light, or a volume without a wall would run through the picture.
    const auto corner = [&](std::size_t k) {
      return mesh.vertices[mesh.triangles[3 * t + k]].position;
    };
    Vec3 light = corner(1) - corner(0) + 0.3 * (corner(2) - corner(0));
    light = glm::normalize(light.z < 0 ? -light : light);
    const Verdict verdict =
        judge(scene.answer("shadow-volume", view, light), rays.mask(samples, light), samples);
    EXPECT_EQ(verdict.wrong, 0U) << t;
    judged += verdict.lit;
  }
  EXPECT_GT(judged, 10000U);
}

TEST(ShadowVolumes, AreCountedForOneCameraOnly) {
  const GlContext gl;
  const DisplacedScene scene(makePlane(24, 24, 3, 3), flatRelief(24, 24), 2);
  EXPECT_THROW((void)scene.answer("shadow-volume", atlasView(scene.surface, 8), {0, 0, 1}),
               InternalError);
}

// ---- the shadow map tends to the rays

TEST(ShadowMap, TendsToTheRaysAsItsTexelsShrink) {
  const GlContext gl;
  const DisplacedScene scene(makePlane(48, 48, 6, 6), randomRelief(24, 24, 5, 3), 4);
  const Rays rays(scene, 4);
  const Vec3 light = lightToward(20, 30);
  for (const RenderView& view :
       {cameraView(cameraAt({0, 0, 100}, {0, 0, 0}, 30, 256), scene.displaced.mesh),
        atlasView(scene.surface, 40)}) {
    const SampleGrid samples = scene.samples(view);
    // The bias grows with a facet's slope to the light up to 16 and no more: steeper ones,
    // within 3.6° of edge-on, shade themselves in specks however fine the map.
    const Mask truth = rays.mask(samples, light, 1 / std::hypot(1.0, 16.0));
    double before = 1;
    for (const double side : {256.0, 1024.0, 4096.0}) {
      const Verdict verdict =
          judge(scene.answer("shadow-map", view, light, {{"depth_side", side}}), truth, samples);
      const double error =
          static_cast<double>(verdict.wrong) / static_cast<double>(verdict.lit + verdict.dark);
      // Its error is some texels' width along the shadows' edges, four times less each; less falls
      // while texels are as wide as the shadows.
      EXPECT_LT(error, before / 2) << side;
      before = error;
    }
    EXPECT_LT(before, 0.002);
  }
}

TEST(ShadowMap, SeesClosedSurfacesAsRaysDo) {
  const GlContext gl;
  const DisplacedScene torus(makeTorus(30, 10, 58, 58), randomRelief(48, 32, 3, 3), 1);
  const RenderView view =
      cameraView(cameraAt({20, 90, 90}, {0, 0, 0}, 45, 64), torus.displaced.mesh);
  const SampleGrid samples = torus.samples(view);
  for (const Vec3& light : {lightToward(20, 40), lightToward(120, -30)}) {
    const Verdict verdict = judge(torus.answer("shadow-map", view, light),
                                  Rays(torus, 1).mask(samples, light), samples);
    EXPECT_GT(verdict.lit, 200U);
    EXPECT_GT(verdict.dark, 200U);
    EXPECT_LT(verdict.wrong, (verdict.lit + verdict.dark) / 50);
  }
}

// ---- more polygons, less error: the mesh is all that shadow volumes err by

TEST(RealGeometry, ShadowVolumesTendToTheTruthOfFigure8AsTheMeshIsRefined) {
  const GlContext gl;
  std::array<Vec3, 16> points{};
  const std::array<double, 4> across = {-66, -50, 50, 66};
  const std::array<double, 4> along = {-80, -28, 28, 80};
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      const bool rim = i == 0 || i == 3;
      const bool end = j == 0 || j == 3;
      points.at(4 * j + i) = Vec3(across.at(i), along.at(j), (rim ? -48 : 34) + (end ? 0 : 24));
    }
  }
  const Relief relief{makeColumns(192, 160, {32, 7, 3}, 8, Wrap::clamp), HeightSpace::texture,
                      Vec2(1)};
  const Cage cage = makeBezier(points, 24, 20);
  Camera camera = cameraAt({0, -205, 275}, {0, -4, -2}, 32, 384);
  const Vec3 light = lightToward(165, 24);
  std::optional<TracedScene> traced;
  std::vector<double> errors;
  for (const int subdivisions : {9, 18, 36}) {
    const DisplacedScene scene(cage, relief, subdivisions);
    if (!traced) traced.emplace(scene.surface, relief, 0.125);
    const RenderView view = cameraView(camera, scene.displaced.mesh);
    const Mask truth = traced->mask(scene.surface, relief, scene.samples(view), light);
    EXPECT_GT(shareShadowed(truth), 0.2);
    errors.push_back(difference(scene.answer("shadow-volume", view, light), truth));
    RecordProperty("error_at_" + std::to_string(subdivisions), std::to_string(errors.back()));
  }
  // A facet's chord leaves the relief by less than its width: first order.
  EXPECT_LT(errors[0], 0.025);
  EXPECT_GT(errors[0], 0.008);
  EXPECT_LT(errors[1], errors[0] / 1.5);
  EXPECT_LT(errors[2], errors[1] / 1.5);
}

}  // namespace
}  // namespace gnomon
