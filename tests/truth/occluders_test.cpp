#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "surface/texel_frame.h"
#include "truth/micro_surface.h"
#include "truth/shadow_tracer.h"
#include "truth/surface_paths.h"
#include "truth/truth_scenes.h"

namespace gnomon::truth {
namespace {

using test::flatRelief;
using test::lightToward;
using test::randomRelief;
using test::sampleAt;
using test::sampleLine;
using test::samplesOfAllFaces;
using test::stepRelief;
using test::wallPlane;
using test::wallRelief;

/// A surface with its relief, whose cast shadows are split.
struct DividedScene : test::MicroSurface {
  SurfacePaths paths;
  std::vector<int> parts = {};

  DividedScene(const surface::Cage& cage, relief::Relief heights, double stepTexels)
      : MicroSurface(cage, std::move(heights), stepTexels), paths(surface) {}

  [[nodiscard]] Truth trace(const surface::SampleGrid& samples, const Vec3& light,
                            double radiusTexels = 1000) const {
    const TraceSettings ray{{light}};
    const Truth undivided = traceShadows(surface, relief, mesh, scene, samples, ray);
    const CastShadowSettings settings{radiusTexels, parts};
    const auto divided = [&](const PlacedSamples* placed) {
      Truth truth = undivided;
      splitCastShadows(surface, relief, mesh, scene, paths, settings, samples, {&ray, 1},
                       {&truth, 1}, placed);
      return truth;
    };
    const Truth truth = divided(nullptr);
    const PlacedSamples placed = placeSamples(surface, relief.texelsPerUv(), mesh, samples);
    const Truth fromPlaces = divided(&placed);
    EXPECT_EQ(fromPlaces.regions, truth.regions);
    EXPECT_EQ(fromPlaces.casters, truth.casters);
    for (std::size_t i = 0; i < truth.regions.size(); ++i) {
      const bool wasCast = undivided.regions[i] == Region::cast;
      EXPECT_EQ(isCastShadow(truth.regions[i]), wasCast);
      if (!wasCast) {
        EXPECT_EQ(truth.regions[i], undivided.regions[i]);
      }
    }
    return truth;
  }
};

std::ptrdiff_t count(const Truth& truth, Region region) {
  return std::count(truth.regions.begin(), truth.regions.end(), region);
}

/// Adds a cage to another that it does not touch.
void add(surface::Cage& cage, const surface::Cage& other) {
  const auto points = static_cast<int>(cage.positions.size());
  const auto uvs = static_cast<int>(cage.uvs.size());
  cage.positions.insert(cage.positions.end(), other.positions.begin(), other.positions.end());
  cage.uvs.insert(cage.uvs.end(), other.uvs.begin(), other.uvs.end());
  for (const int vertex : other.faceVertices) cage.faceVertices.push_back(points + vertex);
  for (const int uv : other.faceUvs) cage.faceUvs.push_back(uvs + uv);
  cage.grid.reset();
}

/// Where a hit says that it is, the facet is too.
TEST(MicroMesh, KnowsTheParametersOfAHit) {
  const DividedScene scene(surface::makeSphere(20, 1.5, 1.5, 40, 40), randomRelief(48, 48, 0.3, 3),
                           0.4);
  const surface::SampleGrid samples = samplesOfAllFaces(scene.surface, 3);
  for (const surface::SurfaceSample& sample : samples.samples) {
    const Facet facet = scene.mesh.facet(sample);
    const Vec3 above = facet.rayOrigin(1e-3);
    const auto hit = scene.scene.nearest(above, -facet.normal);
    ASSERT_TRUE(hit);
    const surface::SurfaceSample found = scene.mesh.parametersAt(hit->face, hit->place);
    const Vec3 met = above - hit->distance * facet.normal;
    EXPECT_LT(glm::length(scene.mesh.facet(found).point - met), 2e-5);
  }
}

TEST(CastShadows, AreDistantBeyondTheTablesRadius) {
  const DividedScene scene(wallPlane(), wallRelief(), 0.25);
  const double slope = std::tan(radians(20));
  // A ray from the floor at x meets the wall's lee face, which falls from 6 at 31.5 to 0 at 32.5,
  // or passes over it where the shadow has ended.
  const auto reach = [slope](double x) { return x - (6 * 32.5 - x * slope) / (6 - slope); };
  const double end = 31.5 + 6 / slope;
  const surface::SampleGrid samples =
      sampleLine(scene.surface, scene.relief, {32.6, 16}, {62.6, 16}, 300);
  const Truth truth = scene.trace(samples, lightToward(180, 20), 10);
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const double x = 32.6 + 30 * (static_cast<double>(i) + 0.5) / 300;
    if (std::abs(x - end) < 0.01 || std::abs(reach(x) - 10) < 0.01) continue;
    const Region expected = x > end ? Region::lit : reach(x) > 10 ? Region::distant : Region::cast;
    EXPECT_EQ(truth.regions[i], expected) << x;
  }
}

TEST(CastShadows, AreNeverDistantWithinAnInfiniteRadius) {
  const DividedScene scene(wallPlane(), wallRelief(), 0.25);
  const surface::SampleGrid samples =
      sampleLine(scene.surface, scene.relief, {32.6, 16}, {62.6, 16}, 300);
  const Vec3 light = lightToward(180, 20);
  const Truth truth = scene.trace(samples, light, std::numeric_limits<double>::infinity());
  EXPECT_GT(count(truth, Region::cast), 100);
  EXPECT_EQ(count(truth, Region::distant), 0);
  EXPECT_EQ(truth.regions, scene.trace(samples, light, 1000).regions);
}

/// The path over a plane leads everywhere, also where two charts meet or the map is sheared.
TEST(GlobalOccluder, AWallOnAPlaneIsNone) {
  const DividedScene scene(wallPlane(), wallRelief(), 0.25);
  const surface::SampleGrid samples =
      sampleLine(scene.surface, scene.relief, {1, 16}, {95, 16}, 400);
  for (const double azimuth : {180.0, 150.0, 0.0}) {
    const Truth near = scene.trace(samples, lightToward(azimuth, 20));
    EXPECT_GT(count(near, Region::cast), 10) << azimuth;
    EXPECT_EQ(count(near, Region::global), 0) << azimuth;
  }
  // `distant` stays what a larger radius would find.
  const Truth distant = scene.trace(samples, lightToward(180, 20), 10);
  EXPECT_GT(count(distant, Region::distant), 10);
  EXPECT_EQ(count(distant, Region::global), 0);
}

TEST(GlobalOccluder, ARoughPlaneHasNone) {
  const DividedScene scene(surface::makePlane(64, 64, 8, 8), randomRelief(64, 64, 5, 7), 0.25);
  const Truth truth = scene.trace(samplesOfAllFaces(scene.surface, 8), lightToward(37, 15));
  EXPECT_GT(count(truth, Region::cast), 500);
  EXPECT_EQ(count(truth, Region::global), 0);
}

/// Two plates, the upper one 12 above the middle half of the lower one and turned up too: whatever
/// it shades is global. Under a light at 60° its shadow lies 12 / tan 60° farther on.
TEST(GlobalOccluder, AnotherPlateAboveIsOne) {
  surface::Cage plates = surface::makePlane(64, 64, 8, 8);
  surface::Cage upper = surface::makePlane(32, 32, 8, 8);
  for (Vec3& position : upper.positions) position.z = 12;
  add(plates, upper);
  const DividedScene scene(plates, flatRelief(64, 64), 0.5);
  surface::SampleGrid samples = samplesOfAllFaces(scene.surface, 8);
  const Truth truth = scene.trace(samples, lightToward(0, 60));
  const double shift = 12 / std::tan(radians(60));
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const Vec3 at = scene.surface.evaluate(samples.samples[i]).position;
    const double fromEdge =
        std::min(16 - std::abs(at.x + shift), 16 - std::abs(at.y));  // of the shadow
    if (std::abs(fromEdge) < 0.1) continue;
    const bool isShaded = at.z < 6 && fromEdge > 0;
    EXPECT_EQ(truth.regions[i], isShaded ? Region::global : Region::lit) << at.x << ' ' << at.y;
  }
  EXPECT_GT(count(truth, Region::global), 500);
  EXPECT_TRUE(truth.casters.empty());

  // Told apart: the upper plate is the caster wherever there is one.
  DividedScene told(plates, flatRelief(64, 64), 0.5);
  told.parts.assign(64, 7);
  told.parts.insert(told.parts.end(), 64, 3);
  const Truth same = told.trace(samples, lightToward(0, 60));
  EXPECT_EQ(same.regions, truth.regions);
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    EXPECT_EQ(same.casters[i], truth.regions[i] == Region::global ? 3 : noCaster);
  }
}

/// Not on a ball with columns: each shades what lies on the path behind it.
TEST(GlobalOccluder, ColumnsOnABallAreNone) {
  const DividedScene scene(
      surface::makeSphere(20, 2, 1.6, 40, 40),
      stepRelief(64, 64, 1.5, [](int i, int j) { return std::hypot(i % 16 - 8, j % 16 - 8) < 4; }),
      0.25);
  const Truth truth = scene.trace(samplesOfAllFaces(scene.surface, 6), Vec3(0.8, 0, 0.6));
  EXPECT_GT(count(truth, Region::cast), 500);
  EXPECT_EQ(count(truth, Region::global), 0);
}

/// Inside a ball of radius R the ray at the elevation θ over the tangent plane meets the wall at
/// the angle 2θ about the centre, which is where the path leads as long as it is no quarter turn:
/// 45°.
TEST(GlobalOccluder, TheFarSideOfABowlIsOneBeyondAQuarterTurn) {
  surface::Cage ball = surface::makeSphere(-20, 2 * pi, 2.8, 60, 40);
  const DividedScene scene(ball, flatRelief(64, 64), 0.5);
  const surface::SampleGrid samples = samplesOfAllFaces(scene.surface, 3);
  const Vec3 light = lightToward(0, 0);
  const Truth truth = scene.trace(samples, light);
  int near = 0;
  int far = 0;
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    if (!isCastShadow(truth.regions[i])) continue;
    const surface::LimitPoint point = scene.surface.evaluate(samples.samples[i]);
    const double elevation = std::asin(glm::dot(surface::outwardNormal(point), light));
    // A path that ends at one of the two holes leads no farther.
    if (std::abs(point.position.y) > 5) continue;
    // One triangle's side is 20 × 2π / 300.
    if (std::abs(elevation - pi / 4) < 0.04) continue;
    EXPECT_EQ(truth.regions[i] == Region::global, elevation > pi / 4) << elevation;
    (elevation > pi / 4 ? far : near) += 1;
  }
  EXPECT_GT(near, 300);
  EXPECT_GT(far, 300);
}

/// A torus under a light that comes nearly along its axis' plane: what its own hole's other side
/// shades is global, and nothing else is. With the light in the plane of the axis through λ = 0 and
/// 30° up, a sample of the tube's inner side at λ = 0 sees the tube at λ = π.
TEST(GlobalOccluder, TheOtherSideOfATorusIsOne) {
  const DividedScene scene(surface::makeTorus(30, 10, 66, 60), flatRelief(64, 64), 0.5);
  const double elevation = radians(5);
  const Vec3 light(0, std::sin(elevation), -std::cos(elevation));
  // In the plane x = 0: circles of radius 10 about z = 30 and z = -30; columns λ = 0 of the map.
  int global = 0;
  for (double angle = 100; angle < 260; angle += 5) {
    // ψ from the outside over the top; inside is ψ = 180°.
    const double psi = radians(angle);
    const surface::SampleGrid one{1,
                                  1,
                                  {sampleAt(scene.surface, scene.relief,
                                            Vec2(32, 64 * std::fmod(0.5 + psi / (2 * pi), 1.0)))}};
    const Vec3 at = scene.surface.evaluate(one.samples.front()).position;
    ASSERT_NEAR(at.x, 0, 1e-3);
    const Truth truth = scene.trace(one, light);
    if (truth.regions[0] == Region::beyondTerminator) continue;
    // The ray's distance from the other circle's centre.
    const Vec3 away = Vec3(0, 0, -30) - at;
    const double distance = glm::length(glm::cross(away, light));
    if (std::abs(distance - 10) < 0.2) continue;
    EXPECT_EQ(truth.regions[0], distance < 10 ? Region::global : Region::lit) << angle;
    global += distance < 10 ? 1 : 0;
  }
  EXPECT_GT(global, 5);
}

/// A surface with its relief, ready to be traced.
struct OccluderScene : test::MicroSurface {
  OccluderScene(const surface::Cage& cage, relief::Relief heights)
      : MicroSurface(cage, std::move(heights), 0.25) {}

  [[nodiscard]] std::optional<Occluder> first(const surface::SurfaceSample& sample,
                                              const Vec3& light) const {
    return firstOccluder(surface, relief, mesh, scene, {sample, light, standardRayOffset});
  }
};

/// The lee face of a wall 6 high falls from x = 31.5 to 32.5, on a plane of one unit a texel whose
/// middle is the origin: the ray from (60, 16) meets it where it is as high.
TEST(FirstOccluder, OfAWallIsTheFaceThatTheRayMeets) {
  const OccluderScene on(test::wallPlane(), test::wallRelief());
  const surface::SurfaceSample sample = sampleAt(on.surface, on.relief, {60, 16});
  const double slope = std::tan(radians(10));
  const auto occluder = on.first(sample, lightToward(180, 10));
  ASSERT_TRUE(occluder);
  EXPECT_FALSE(occluder->attached);
  // Height 6 (32.5 - x) on the face, slope (60 - x) on the ray.
  const double x = (6 * 32.5 - slope * 60) / (6 - slope);
  EXPECT_NEAR(occluder->point.x, x - 48, 1e-3);
  EXPECT_NEAR(occluder->point.y, 0, 1e-3);
  EXPECT_NEAR(occluder->point.z, slope * (60 - x), 1e-3);
  EXPECT_NEAR(occluder->distance, (60 - x) / std::cos(radians(10)), 1e-3);
  EXPECT_FALSE(on.first(sample, lightToward(180, 20)));
  EXPECT_FALSE(on.first(sample, lightToward(0, 5)));
  // The lee face itself is turned from the light.
  const auto lee = on.first(sampleAt(on.surface, on.relief, {32, 16}), lightToward(180, 30));
  ASSERT_TRUE(lee);
  EXPECT_TRUE(lee->attached);
  EXPECT_EQ(lee->distance, 0);
  EXPECT_NEAR(lee->point.z, 3, 1e-2);
}

TEST(FirstOccluder, IsThereExactlyWhereTheTruthIsDark) {
  const OccluderScene on(surface::makeSphere(60, 1, 1, 16, 16), randomRelief(64, 64, 4, 3));
  const surface::SampleGrid samples = samplesOfAllFaces(on.surface, 3);
  for (const double elevation : {60.0, 20.0}) {
    const Vec3 light = lightToward(35, elevation);
    const Truth truth =
        traceShadows(on.surface, on.relief, on.mesh, on.scene, samples, TraceSettings{{light}});
    std::size_t dark = 0;
    for (std::size_t i = 0; i < samples.samples.size(); ++i) {
      const auto occluder = on.first(samples.samples[i], light);
      ASSERT_EQ(occluder.has_value(), truth.mask.samples[i] == Shade::shadowed) << i;
      dark += occluder ? 1U : 0U;
      if (!occluder || occluder->attached) continue;
      EXPECT_GT(occluder->distance, 0);
      // On the displaced surface: within its shell.
      const double height = glm::length(occluder->point) - 60;
      EXPECT_GT(height, -0.1);
      EXPECT_LT(height, 4.1);
    }
    EXPECT_GT(dark, samples.samples.size() / 10);
    EXPECT_LT(dark, samples.samples.size());
  }
}

TEST(FirstOccluder, IsAbsentWithoutASample) {
  const OccluderScene on(surface::makePlane(32, 32, 4, 4), randomRelief(32, 32, 4, 3));
  EXPECT_FALSE(on.first({}, lightToward(35, 20)));
}

TEST(SamplePlace, OnARampIsThePlanesPointAndTheRampsFacet) {
  const surface::LimitSurface surface(surface::makePlane(16, 8, 4, 2));
  // Heights rise by 1/2 a texel from x = 4.5 to 11.5.
  std::vector<float> texels;
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 16; ++i) texels.push_back(0.5F * static_cast<float>(i));
  }
  const relief::Relief relief{relief::HeightField(16, 8, texels, relief::Wrap::clamp),
                              relief::HeightSpace::world, Vec2(1)};
  const MicroMesh mesh(surface, relief, {0.25, 0});
  const SamplePlace place = SamplePlacer(surface, relief.texelsPerUv(), mesh)
                                .place(sampleAt(surface, relief, {7.3, 2.2}));
  ASSERT_TRUE(place.defined);
  EXPECT_NEAR(glm::distance(place.frame.position, Vec3(7.3 - 8, 2.2 - 4, 0)), 0, 1e-6);
  EXPECT_NEAR(glm::distance(place.frame.normal, Vec3(0, 0, 1)), 0, 1e-12);
  EXPECT_NEAR(glm::distance(place.frame.texel, Vec2(7.3, 2.2)), 0, 1e-6);
  EXPECT_NEAR(
      glm::distance(place.facet.point + mesh.centre(), Vec3(7.3 - 8, 2.2 - 4, 0.5 * (7.3 - 0.5))),
      0, 1e-5);
  EXPECT_NEAR(glm::distance(place.facet.normal, glm::normalize(Vec3(-0.5, 0, 1))), 0, 1e-5);
}

TEST(SamplePlace, PointsConvergeToTheDisplacedSurface) {
  const surface::LimitSurface surface(surface::makeSphere(40, 1, 1, 12, 12));
  const relief::Relief relief = randomRelief(24, 24, 1, 5);
  const surface::SurfaceSample sample{77, 0.31F, 0.64F};
  const Vec3 exact = relief::displaced(
      relief, surface::texelFrame(surface.evaluate(sample), relief.texelsPerUv()));
  double before = 1;
  for (const double step : {0.25, 0.0625}) {
    const MicroMesh mesh(surface, relief, {step, 0});
    const SamplePlace place = SamplePlacer(surface, relief.texelsPerUv(), mesh).place(sample);
    const double off = glm::distance(place.facet.point + mesh.centre(), exact);
    EXPECT_LT(off, before / 4);
    before = off;
  }
}

/// On a plane whose texels are 2 long along x and 3 along y.
TEST(RayLength, IsThatOfItsTraceOverTheCosine) {
  const Vec3 up(0, 0, 1);
  const TexelAxes axes{Vec3(2, 0, 0), Vec3(0, 3, 0)};
  for (const double elevation : {5.0, 45.0, 80.0}) {
    const double cosine = std::cos(radians(elevation));
    EXPECT_NEAR(rayLength(up, axes, test::lightToward(0, elevation), 10), 20 / cosine, 1e-9);
    EXPECT_NEAR(rayLength(up, axes, test::lightToward(90, elevation), 10), 30 / cosine, 1e-9);
  }
  EXPECT_EQ(rayLength(up, axes, up, 10), std::numeric_limits<double>::infinity());
}

TEST(SamplePlace, IsUndefinedWithoutASample) {
  const surface::LimitSurface surface(surface::makePlane(16, 8, 4, 2));
  const relief::Relief relief = test::flatRelief(4, 4);
  const MicroMesh mesh(surface, relief, {0.5, 0});
  const SamplePlace place = SamplePlacer(surface, relief.texelsPerUv(), mesh).place({-1, 0, 0});
  EXPECT_FALSE(place.defined);
  EXPECT_EQ(place.facet.point + mesh.centre(), Vec3(0));
}

}  // namespace
}  // namespace gnomon::truth
