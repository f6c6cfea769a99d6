#include "study/run/scene/view_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/counts.h"
#include "surface/base_mesh.h"
#include "truth/truth_scenes.h"

namespace gnomon::study {
namespace {

using test::lightToward;
using test::stepRelief;

/// A relief of one height everywhere.
relief::Relief plateau(double height, relief::HeightSpace space = relief::HeightSpace::world) {
  relief::Relief relief = stepRelief(
      64, 48, height, [](int, int) { return true; }, relief::Wrap::repeat);
  relief.space = space;
  return relief;
}

template <typename Check>
void forPoints(const surface::LimitSurface& surface, const relief::Relief& relief,
               const Vec3& light, const Check& check) {
  for (int face = 0; face < surface.faceCount(); face += 7) {
    const surface::LimitPoint point = surface.evaluate(face, 0.3, 0.7);
    const surface::TexelFrame frame = surface::texelFrame(point, relief.texelsPerUv());
    ASSERT_TRUE(frame.defined);
    check(point, axisSample(point, frame, relief, light));
  }
}

/// On a sphere κ is 1 / R whatever the direction, and the terminator is a great circle: R times the
/// angle away, exactly.
TEST(SampleAxes, OnASphereAreClosedForms) {
  const double radius = 60;
  const surface::LimitSurface surface(surface::makeSphere(radius, 3.0, 2.4, 60, 48));
  const relief::Relief relief = plateau(3);
  const Vec3 light = lightToward(70, 20);
  int beyond = 0;
  forPoints(surface, relief, light,
            [&](const surface::LimitPoint& point, const AxisSample& sample) {
              const double elevation = std::asin(glm::dot(glm::normalize(point.position), light));
              EXPECT_NEAR(curvatureHeight(sample), 3 / radius, 3e-4 * 3 / radius);
              EXPECT_NEAR(lightElevation(sample), elevation * 180 / pi, 1e-3);
              const surface::TexelFrame frame = surface::texelFrame(point, relief.texelsPerUv());
              const double texel = std::sqrt(glm::length(glm::cross(frame.px, frame.py)));
              EXPECT_NEAR(terminatorDistance(sample), radius * elevation / texel,
                          1e-3 * std::abs(radius * elevation / texel) + 1e-3);
              beyond += elevation < 0 ? 1 : 0;
            });
  EXPECT_GT(beyond, 20);
}

/// Heights in texels are worth a texel's size each.
TEST(SampleAxes, TakeHeightsInTheReliefsOwnUnits) {
  const surface::LimitSurface surface(surface::makeSphere(60, 1.6, 1.2, 32, 24));
  const Vec3 light = lightToward(70, 40);
  forPoints(surface, plateau(3, relief::HeightSpace::texture), light,
            [&](const surface::LimitPoint&, const AxisSample& sample) {
              EXPECT_NEAR(curvatureHeight(sample), 3 * sample.texel / 60, 1e-4);
            });
}

/// A plane has no terminator, and one light elevation.
TEST(SampleAxes, OnAPlaneAreFlat) {
  const surface::LimitSurface surface(surface::makePlane(64, 48, 8, 6));
  const relief::Relief relief = plateau(5);
  forPoints(surface, relief, lightToward(10, 35),
            [](const surface::LimitPoint&, const AxisSample& sample) {
              EXPECT_NEAR(curvatureHeight(sample), 0, 1e-12);
              EXPECT_NEAR(lightElevation(sample), 35, 1e-9);
              EXPECT_GT(terminatorDistance(sample), 1e6);
            });
  const surface::LimitPoint point = surface.evaluate(0, 0.5, 0.5);
  const surface::TexelFrame frame = surface::texelFrame(point, relief.texelsPerUv());
  const AxisSample grazing{0, 0, 0, 5, 1};
  EXPECT_EQ(terminatorDistance(grazing), 0);
  EXPECT_EQ(lightElevation(axisSample(point, frame, relief, Vec3(0, 0, 1))), 90);
  EXPECT_EQ(curvatureHeight(axisSample(point, frame, relief, Vec3(0, 0, 1))), 0);
}

/// A cylinder bends across its axis alone: Euler's formula, and the exact distance for a light
/// across the axis.
TEST(SampleAxes, OnACylinderFollowTheLight) {
  const double curvature = 0.02;
  const surface::LimitSurface surface(
      surface::makeCylinder(1 / curvature, 100 * curvature, 60, 40, 24));
  const relief::Relief relief = plateau(4);
  forPoints(surface, relief, lightToward(0, 30),
            [&](const surface::LimitPoint& point, const AxisSample& sample) {
              const Vec3 n = surface::outwardNormal(point);
              EXPECT_NEAR(sample.normalChange, curvature, 1e-5);
              EXPECT_NEAR(curvatureHeight(sample), 4 * curvature, 1e-4);
              const double elevation = std::asin(glm::dot(n, lightToward(0, 30)));
              EXPECT_NEAR(terminatorDistance(sample) * sample.texel, elevation / curvature, 0.05);
            });
  forPoints(surface, relief, lightToward(50, 40),
            [&](const surface::LimitPoint& point, const AxisSample& sample) {
              const Vec3 n = surface::outwardNormal(point);
              const Vec3 light = lightToward(50, 40);
              const Vec3 t = glm::normalize(light - glm::dot(light, n) * n);
              const Vec3 across = glm::normalize(glm::cross(Vec3(0, 1, 0), n));
              EXPECT_NEAR(sample.curvature, curvature * std::pow(glm::dot(t, across), 2), 1e-5);
              EXPECT_NEAR(sample.normalChange, curvature * std::abs(glm::dot(t, across)), 1e-5);
            });
}

/// Near the terminator of a torus, the first-order distance is that to the nearest point where n·L
/// changes sign, found by brute force.
TEST(SampleAxes, TheTerminatorIsAsFarAsBruteForceFindsIt) {
  const surface::LimitSurface surface(surface::makeTorus(60, 25, 60, 60));
  const relief::Relief relief = plateau(1);
  const Vec3 light = lightToward(30, 25);
  const auto sineAt = [&](const surface::LimitPoint& point) {
    return glm::dot(surface::outwardNormal(point), light);
  };
  std::vector<Vec3> terminator;
  for (int face = 0; face < surface.faceCount(); ++face) {
    if (std::abs(sineAt(surface.evaluate(face, 0.5, 0.5))) > 0.2) continue;
    double before = 0;
    for (int i = 0; i <= 60; ++i) {
      for (int j = 0; j <= 20; ++j) {
        const surface::LimitPoint point = surface.evaluate(face, i / 60.0, j / 20.0);
        const double sine = sineAt(point);
        if (j > 0 && before * sine <= 0) terminator.push_back(point.position);
        before = sine;
      }
    }
  }
  ASSERT_GT(terminator.size(), 1000U);
  int compared = 0;
  forPoints(surface, relief, light,
            [&](const surface::LimitPoint& point, const AxisSample& sample) {
              const double distance = terminatorDistance(sample) * sample.texel;
              if (std::abs(distance) > 3) return;
              double nearest = std::numeric_limits<double>::infinity();
              for (const Vec3& place : terminator) {
                nearest = std::min(nearest, glm::distance(place, point.position));
              }
              EXPECT_NEAR(std::abs(distance), nearest, 0.1 * nearest + 0.15);
              ++compared;
            });
  EXPECT_GE(compared, 5);
}

/// The longest over the shortest image of a unit vector of the texture plane, by brute force.
TEST(SampleAxes, StretchIsTheRatioOfTheLongestTexelToTheShortest) {
  for (const test::ShearedPlane& plane : test::shearedPlanes()) {
    const surface::LimitSurface surface(plane.cage());
    const relief::Relief relief =
        stepRelief(plane.width, plane.height, 1, [](int, int) { return true; });
    double longest = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 20000; ++k) {
      const double length = plane.worldPerTexel(k * pi / 20000);
      longest = std::max(longest, length);
      shortest = std::min(shortest, length);
    }
    ASSERT_GT(longest / shortest, 1.4);
    forPoints(surface, relief, lightToward(10, 35),
              [&](const surface::LimitPoint&, const AxisSample& sample) {
                EXPECT_NEAR(sample.stretch, longest / shortest, 1e-5);
              });
  }
  // Of square texels none, whatever their size.
  for (const double size : {0.25, 4.0}) {
    const surface::LimitSurface surface(surface::makePlane(64 * size, 48 * size, 8, 6));
    forPoints(surface, plateau(1), lightToward(10, 35),
              [](const surface::LimitPoint&, const AxisSample& sample) {
                EXPECT_NEAR(sample.stretch, 1, 1e-7);
              });
  }
}

/// Beside a column of height 6 on a plane of texels of one size: the length of its shadow on the
/// ground, less what the ground itself is high.
TEST(SampleAxes, TheReachOfAShadowIsTheLongestThatCanFallThere) {
  const double texel = 0.5;
  const surface::LimitSurface surface(surface::makePlane(64 * texel, 48 * texel, 8, 6));
  for (const double ground : {0.0, 2.0}) {
    relief::Relief relief = stepRelief(
        64, 48, 6, [](int i, int) { return i >= 60; }, relief::Wrap::repeat);
    std::vector<float> texels = relief.field.texels();
    for (float& height : texels) height = std::max(height, static_cast<float>(ground));
    relief.field = relief::HeightField(64, 48, texels, relief::Wrap::repeat);
    const surface::LimitPoint point = surface.evaluate(0, 0.5, 0.5);
    const surface::TexelFrame frame = surface::texelFrame(point, relief.texelsPerUv());
    for (const double elevation : {15.0, 45.0, 80.0}) {
      const AxisSample sample = axisSample(point, frame, relief, lightToward(10, elevation));
      EXPECT_NEAR(shadowReach(sample), (6 - ground) / std::tan(elevation * pi / 180) / texel, 1e-6);
    }
    EXPECT_TRUE(std::isnan(shadowReach(axisSample(point, frame, relief, Vec3(1, 0, 0)))));
    EXPECT_TRUE(std::isnan(shadowReach(axisSample(point, frame, relief, lightToward(10, -5)))));
    EXPECT_NEAR(shadowReach(axisSample(point, frame, relief, Vec3(0, 0, 1))), 0, 1e-12);
  }
}

TEST(SampleAxes, HaveEdgesThatRiseAndNamesOfTheirOwn) {
  std::vector<std::string_view> names;
  for (const SampleAxis& axis : sampleAxes()) {
    EXPECT_NO_THROW(compare::requireEdges(axis.edges)) << axis.name;
    EXPECT_FALSE(axis.title.empty());
    EXPECT_EQ(std::find(names.begin(), names.end(), axis.name), names.end());
    names.push_back(axis.name);
  }
  EXPECT_EQ(names, (std::vector<std::string_view>{"curvature_height", "elevation", "terminator",
                                                  "uv_stretch", "shadow_reach"}));
}

/// A light at the very edge of two bins over a plane: rounding must not part its samples.
TEST(BinSamples, PutsEverySampleIntoTheBinOfItsValue) {
  const surface::LimitSurface surface(surface::makePlane(64, 48, 8, 6));
  const relief::Relief relief = plateau(5);
  surface::SampleGrid samples{200, 1, {}};
  for (int i = 0; i < 200; ++i) {
    const auto share = [i](int k) { return static_cast<float>((i * k + 3) % 17 + 1) / 19; };
    samples.samples.push_back({i % 48, share(5), share(7)});
  }
  samples.samples[7].face = -1;
  for (const double azimuth : {0.0, 10.0, 77.0}) {
    const SampleBins bins = binSamples(surface, relief, samples, lightToward(azimuth, 30));
    ASSERT_EQ(bins.size(), 5U);
    for (std::size_t i = 0; i < 200; ++i) {
      const bool none = i == 7;
      EXPECT_EQ(bins[0][i], none ? compare::noBin : 5) << i;  // -0.005 to 0.005
      EXPECT_EQ(bins[1][i], none ? compare::noBin : 7) << i;  // 30° to 40°
      EXPECT_EQ(bins[2][i], none ? compare::noBin : 9) << i;  // 256 texels or more
      EXPECT_EQ(bins[3][i], none ? compare::noBin : 0) << i;  // square texels
      EXPECT_EQ(bins[4][i], none ? compare::noBin : 0) << i;  // nothing is higher
    }
  }
}

TEST(BinSamples, LeavesOutSamplesWithoutFrame) {
  surface::Cage cage = surface::makePlane(64, 48, 8, 6);
  for (Vec2& uv : cage.uvs) uv.y = 0;  // a texture without area
  const surface::SampleGrid samples{1, 1, {{3, 0.5F, 0.5F}}};
  for (const auto& axis :
       binSamples(surface::LimitSurface(cage), plateau(1), samples, Vec3(0, 0, 1))) {
    EXPECT_EQ(axis[0], compare::noBin);
  }
}

TEST(BinSamples, FromPlacesAreTheSame) {
  const surface::LimitSurface surface(surface::makeTorus(30, 10, 60, 60));
  const relief::Relief relief = plateau(5);
  surface::SampleGrid samples{300, 1, {}};
  for (int i = 0; i < 300; ++i) {
    const auto share = [i](int k) { return static_cast<float>((i * k + 3) % 17 + 1) / 19; };
    samples.samples.push_back({i % 7 == 0 ? -1 : i % surface.faceCount(), share(5), share(7)});
  }
  const AxisPlaces places = axisPlaces(surface, relief, samples);
  for (const double azimuth : {0.0, 77.0}) {
    const Vec3 light = lightToward(azimuth, 30);
    EXPECT_EQ(binSamples(samples, places, light), binSamples(surface, relief, samples, light));
  }
}

}  // namespace
}  // namespace gnomon::study
