#include <fmt/core.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "truth/disc_scenes.h"
#include "truth/micro_surface.h"
#include "truth/shadow_tracer.h"
#include "truth/truth_scenes.h"
#include "truth/visibility_tracer.h"

namespace gnomon::truth {
namespace {

using test::capShare;
using test::flatShare;
using test::lightToward;

/// Of some points, the share whose place along an angle is below a line.
double shareBelow(std::span<const Vec2> points, double angle, double line) {
  const Vec2 along(std::cos(angle), std::sin(angle));
  const auto below = std::count_if(points.begin(), points.end(), [&](const Vec2& point) {
    return glm::dot(point, along) < line;
  });
  return static_cast<double>(below) / static_cast<double>(points.size());
}

/// Root mean square and largest error of the share, over edges of an angle, in points.
struct EdgeErrors {
  double rms = 0;
  double largest = 0;
};
EdgeErrors edgeErrors(std::span<const Vec2> points, double angle) {
  constexpr int lines = 401;
  EdgeErrors errors;
  for (int k = 0; k < lines; ++k) {
    const double line = 2.0 * k / (lines - 1) - 1;
    const double error = shareBelow(points, angle, line) - flatShare(line, 0, 1);
    errors.rms += error * error / lines;
    errors.largest = std::max(errors.largest, std::abs(error));
  }
  const auto count = static_cast<double>(points.size());
  return {count * std::sqrt(errors.rms), count * errors.largest};
}

TEST(DiscPoints, StandForEqualAreasAlongEveryEdge) {
  for (const int count : {64, 128, 256}) {
    const std::vector<Vec2> points = discPoints(count);
    double squares = 0;
    double largest = 0;
    constexpr int angles = 90;
    for (int k = 0; k < angles; ++k) {
      const EdgeErrors errors = edgeErrors(points, pi * (k + 0.3) / angles);
      squares += errors.rms * errors.rms / angles;
      largest = std::max(largest, errors.largest);
    }
    EXPECT_LT(std::sqrt(squares), 1.15) << count;
    EXPECT_LT(largest, 5.5) << count;
  }
}

TEST(DiscPoints, HalveNoMoreThanOneAlongEitherAxis) {
  for (const int count : {2, 16, 128, 256, 1024}) {
    const std::vector<Vec2> points = discPoints(count);
    for (const double angle : {0.0, pi / 2, pi}) {
      EXPECT_LT(edgeErrors(points, angle).largest, 0.75) << count << " at " << angle;
    }
  }
}

TEST(DiscRim, NoLargeHalfPlaneMissesIt) {
  const std::vector<Vec2> rim = discRim(16);
  const double angle = pi / 16;
  const double largest = (angle - std::sin(angle) * std::cos(angle)) / pi;
  EXPECT_NEAR(largest, 0.0016, 5e-5);
  // Half-way between two of them, the edge that both lie on.
  EXPECT_NEAR(1 - flatShare(std::cos(angle), 0, 1), largest, 1e-12);
  EXPECT_NEAR(shareBelow(rim, angle, std::cos(angle) - 1e-9), 14.0 / 16, 1e-12);
}

TEST(DiscDirections, FillTheCapEvenly) {
  const double radius = radians(10);
  const Vec3 centre = lightToward(40, 35);
  const std::vector<Vec3> directions = discDirections(centre, radius, discPoints(1024));
  Vec3 mean(0);
  for (const Vec3& direction : directions) {
    EXPECT_NEAR(glm::length(direction), 1, 1e-14);
    EXPECT_LE(std::acos(glm::dot(direction, centre)), radius + 1e-9);
    mean += direction / 1024.0;
  }
  // The mean direction of a cap is its centre times (1 + cos ρ) / 2.
  EXPECT_NEAR(glm::length(mean - centre * (1 + std::cos(radius)) / 2.0), 0, 2e-5);
  // Equal solid angle: half of them within the cap of half the solid angle.
  const double half = (1 + std::cos(radius)) / 2;
  const auto inner =
      std::count_if(directions.begin(), directions.end(),
                    [&](const Vec3& direction) { return glm::dot(direction, centre) > half; });
  EXPECT_NEAR(static_cast<double>(inner) / 1024, 0.5, 0.01);
}

TEST(DiscDirections, APointLightHasOneAndAZenithAny) {
  for (const Vec3& direction : discDirections(lightToward(10, 20), 0, discPoints(8))) {
    EXPECT_NEAR(glm::length(direction - lightToward(10, 20)), 0, 1e-15);
  }
  for (const Vec3& direction : discDirections(Vec3(0, 0, 1), 0.1, discPoints(8))) {
    EXPECT_GE(direction.z, std::cos(0.1) - 1e-12);
  }
}

TEST(DiscDirections, TheLowestIsTheCentreARadiusLower) {
  const Vec3 centre = lightToward(200, 20);
  EXPECT_NEAR(glm::length(lowestOfDisc({centre, radians(3)}) - lightToward(200, 17)), 0, 1e-15);
  EXPECT_EQ(lowestOfDisc({centre}), centre);
  EXPECT_NEAR(lowestOfDisc({Vec3(0, 0, 1), 0.1}).z, std::cos(0.1), 1e-15);
}

/// A surface with its relief, ready to be traced.
struct DiscScene : test::MicroSurface {
  using MicroSurface::MicroSurface;

  [[nodiscard]] Mask hard(const surface::SampleGrid& samples, const Vec3& light) const {
    return traceShadows(surface, relief, mesh, scene, samples, TraceSettings{{light}}).mask;
  }
  [[nodiscard]] Visibility trace(const surface::SampleGrid& samples,
                                 const DiscSettings& settings) const {
    return traceVisibility(mesh, scene, samples, hard(samples, settings.light.direction), settings);
  }
};

DiscScene longWall() {
  return {test::wallPlane(), test::wallRelief(), 0.25};
}

constexpr double lineBegin = 32.6;
constexpr double lineEnd = 62.6;
surface::SampleGrid lineBehindWall(const DiscScene& scene, int count) {
  return test::sampleLine(scene.surface, scene.relief, {lineBegin, 16}, {lineEnd, 16}, count);
}
double placeOn(std::size_t i, std::size_t count) {
  return lineBegin +
         (lineEnd - lineBegin) * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
}

/// Error of V against a closed form.
struct Errors {
  double largest = 0;
  double squares = 0;
  std::size_t count = 0;
  void add(double error) {
    largest = std::max(largest, std::abs(error));
    squares += error * error;
    ++count;
  }
  [[nodiscard]] double rms() const { return std::sqrt(squares / static_cast<double>(count)); }
};

TEST(CapShare, IsTheFlatDiscsForSmallRadii) {
  for (const double degrees : {0.266, 1.0, 5.0}) {
    const double rho = radians(degrees);
    double largest = 0;
    for (double x = -1; x <= 1; x += 0.01) {
      largest = std::max(largest, std::abs(capShare(x * rho, rho) - flatShare(x, 0, 1)));
    }
    EXPECT_LT(largest, degrees < 2 ? 2e-4 : 2e-3) << degrees;
  }
}

/// A level edge: the wall stands across the light. A ray passes the top of the wall or meets its
/// lee side, which falls to the ground at 32.5: no horizon below the edge is lower.
TEST(VisibilityTracer, BehindAWallIsTheHalfPlanesClosedForm) {
  const DiscScene scene = longWall();
  const surface::SampleGrid samples = lineBehindWall(scene, 2000);
  for (const double degrees : {0.266, 1.0, 5.0}) {
    const double rho = radians(degrees);
    const double theta = radians(20);
    const Visibility found = scene.trace(samples, {lightToward(180, 20), rho});
    Errors exact;
    Errors flat;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double beta = std::atan(6 / (placeOn(i, found.size()) - 31.5));
      const auto share = static_cast<double>(found.shares[i]);
      exact.add(share - capShare(theta - beta, rho));
      flat.add(share - flatShare(theta, beta, rho));
    }
    EXPECT_LT(exact.largest, 1.0 / 256) << degrees;
    EXPECT_LT(flat.largest, 1.0 / 256 + 0.002) << degrees;
    EXPECT_GT(exact.largest, 0) << degrees;
  }
}

/// An edge that is slanted in the world: the wall turned from the light, so that the edge's plane
/// leans. Its great circle is at the angle asin(n · L) from the disc's centre, n the plane's
/// normal.
TEST(VisibilityTracer, ASlantedEdgeIsRightToTheDirectionsOwnError) {
  const DiscScene scene = longWall();
  const surface::SampleGrid samples = lineBehindWall(scene, 2000);
  for (const int count : {256, 1024}) {
    const double rho = radians(3);
    const Vec3 light = lightToward(180 + 35, 25);
    DiscSettings settings{{light, rho}};
    settings.directions = count;
    const Visibility found = scene.trace(samples, settings);
    Errors errors;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Vec3 toEdge(31.5 - placeOn(i, found.size()), 0, 6);
      const Vec3 normal = glm::normalize(glm::cross(Vec3(0, 1, 0), toEdge));
      const double side = normal.z > 0 ? 1 : -1;
      const double delta = std::asin(side * glm::dot(normal, light));
      if (std::abs(delta) < rho) {
        errors.add(static_cast<double>(found.shares[i]) - capShare(delta, rho));
      } else {
        EXPECT_EQ(found.shares[i], delta > 0 ? 1.0F : 0.0F);
      }
    }
    ASSERT_GT(errors.count, 50);
    EXPECT_LT(errors.rms(), 1.7 / count);
    EXPECT_LT(errors.largest, 6.0 / count);
  }
}

TEST(VisibilityTracer, ABareSpheresTerminatorIsTheClosedForm) {
  constexpr double radius = 40;
  const DiscScene scene(surface::makeSphere(radius, 0.3, 0.1, 12, 4), test::flatRelief(30, 10),
                        0.02);
  const double rho = radians(5);
  surface::SampleGrid samples{300, 3, {}};
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 300; ++i) {
      samples.samples.push_back(
          test::sampleAt(scene.surface, scene.relief, {1 + 28 * (i + 0.5) / 300, 2.0 + 3 * j}));
    }
  }
  const Vec3 light = lightToward(0, 0);
  const Visibility found = scene.trace(samples, {light, rho});
  Errors level;  // of the middle row, whose terminator is level in the world
  Errors flat;   // likewise
  Errors all;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vec3 normal = scene.surface.evaluate(samples.samples[i]).position / radius;
    const double theta = std::asin(glm::dot(normal, light));
    const auto share = static_cast<double>(found.shares[i]);
    all.add(share - capShare(theta, rho));
    if (i / 300 != 1) continue;
    level.add(share - capShare(theta, rho));
    flat.add(share - flatShare(theta, 0, rho));
  }
  // A facet is tilted by up to half its angle from its samples: 1e-4 of 0.087 rad.
  EXPECT_LT(level.largest, 1.0 / 256 + 0.001);
  EXPECT_LT(flat.largest, 1.0 / 256 + 0.002);
  EXPECT_LT(all.rms(), 1.0 / 256);
  EXPECT_LT(all.largest, 5.0 / 256);
}

TEST(VisibilityTracer, TheLightBehindAWallAddsUp) {
  const DiscScene scene = longWall();
  for (const double degrees : {0.266, 2.0, 5.0}) {
    const double rho = radians(degrees);
    const surface::SampleGrid samples = lineBehindWall(scene, 6000);
    const Visibility found = scene.trace(samples, {lightToward(180, 20), rho});
    double sum = 0;
    for (const float share : found.shares) sum += static_cast<double>(share) / 6000;
    double integral = 0;
    constexpr std::size_t parts = 30000;
    for (std::size_t k = 0; k < parts; ++k) {
      const double beta = std::atan(6 / (placeOn(k, parts) - 31.5));
      integral += flatShare(radians(20), beta, rho) / parts;
    }
    EXPECT_NEAR(sum, integral, 5e-4) << degrees;
  }
}

/// A picture of a plane with the roughest relief there is.
struct BumpyPlane {
  static constexpr int side = 160;
  DiscScene scene{surface::makePlane(64, 64, 8, 8), test::randomRelief(64, 64, 4, 5), 0.125};
  surface::SampleGrid samples{side, side, {}};

  /// @param spacing  of the samples, texels
  explicit BumpyPlane(double spacing = 0.15) {
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        samples.samples.push_back(test::sampleAt(
            scene.surface, scene.relief, {2 + spacing * (i + 0.5), 2 + spacing * (j + 0.5)}));
      }
    }
  }
};

TEST(VisibilityTracer, AVanishingDiscIsTheHardLight) {
  const BumpyPlane plane;
  const Vec3 light = lightToward(30, 20);
  const Mask hard = plane.scene.hard(plane.samples, light);
  const Visibility found = plane.scene.trace(plane.samples, {light, 1e-12});
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found.shares[i], hard.samples[i] == Shade::lit ? 1.0F : 0.0F);
  }
}

TEST(VisibilityTracer, ADiscBelowTheHorizonGivesNoLight) {
  const DiscScene scene = longWall();
  const surface::SampleGrid samples = lineBehindWall(scene, 500);
  const Visibility below = scene.trace(samples, {lightToward(180, -3), radians(2)});
  for (const float share : below.shares) EXPECT_EQ(share, 0);
  const Visibility above = scene.trace(samples, {lightToward(0, 60), radians(2)});
  for (const float share : above.shares) EXPECT_EQ(share, 1);
}

TEST(VisibilityTracer, SettledSamplesMissLittle) {
  // Far apart, neighbours find little of what a sample's own first directions miss.
  for (const double spacing : {0.1, 0.37}) {
    const BumpyPlane plane(spacing);
    for (const double degrees : {0.266, 1.0, 5.0}) {
      for (const double elevation : {8.0, 30.0}) {
        DiscSettings settings{{lightToward(30, elevation), radians(degrees)}};
        const Visibility adaptive = plane.scene.trace(plane.samples, settings);
        settings.isAdaptive = false;
        const Visibility all = plane.scene.trace(plane.samples, settings);
        const ShareChange change = shareChange(adaptive, all);
        float largest = 0;
        std::size_t changed = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
          const float off = std::abs(all.shares[i] - adaptive.shares[i]);
          largest = std::max(largest, off);
          changed += off > 0 ? 1 : 0;
        }
        const std::string of = fmt::format("{} at {}, {}", degrees, elevation, spacing);
        RecordProperty("missed " + of, fmt::format("mean {:.2e}, largest {:.4f}, samples {}",
                                                   change.mean, largest, changed));
        EXPECT_LT(change.mean, 1e-5) << of;
        EXPECT_EQ(change.percentile99, 0) << of;
        EXPECT_LT(largest, 1.0F / 8) << of;
      }
    }
  }
}

TEST(VisibilityTracer, DoesNotDependOnTheNumberOfThreads) {
  const BumpyPlane plane;
  const DiscSettings settings{{lightToward(30, 20), radians(1)}};
  const Visibility many = plane.scene.trace(plane.samples, settings);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(plane.scene.trace(plane.samples, settings).shares, many.shares);
}

TEST(VisibilityTracer, HasNoAnswerWhereTheHardLightHasNone) {
  const DiscScene scene = longWall();
  surface::SampleGrid samples = lineBehindWall(scene, 50);
  samples.samples[7] = {};
  const Visibility found = scene.trace(samples, {lightToward(180, 20), radians(1)});
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(std::isnan(found.shares[i]), i == 7);
}

TEST(VisibilityTracer, RefusesWhatDoesNotFit) {
  const DiscScene scene = longWall();
  const surface::SampleGrid samples = lineBehindWall(scene, 50);
  const Mask other{1, 1, {Shade::lit}};
  EXPECT_THROW((void)traceVisibility(scene.mesh, scene.scene, samples, other, {}), InternalError);
}

TEST(ShareChange, IsMeanAndPercentileOfWhatBothHold) {
  Visibility a{200, 1, std::vector<float>(200, 0.5F)};
  Visibility b = a;
  b.shares[3] = 0.75F;
  b.shares[5] = noSample;
  EXPECT_DOUBLE_EQ(shareChange(a, b).mean, 0.25 / 199);
  EXPECT_DOUBLE_EQ(shareChange(a, b).percentile99, 0);
  b.shares[4] = 0.0F;
  EXPECT_DOUBLE_EQ(shareChange(a, b).mean, 0.75 / 199);
  EXPECT_DOUBLE_EQ(shareChange(a, b).percentile99, 0.25);
  EXPECT_DOUBLE_EQ(shareChange(a, a).mean, 0);
  EXPECT_DOUBLE_EQ(shareChange(a, b).percentile999, 0.5) << "199 samples: the largest";
  Visibility c{2000, 1, std::vector<float>(2000, 0.5F)};
  Visibility d = c;
  d.shares[1] = 1;
  d.shares[2] = 0.75F;
  EXPECT_DOUBLE_EQ(shareChange(c, d).percentile999, 0) << "2 of 2000 may exceed it";
  d.shares[3] = 0.625F;
  EXPECT_DOUBLE_EQ(shareChange(c, d).percentile999, 0.125);
  EXPECT_DOUBLE_EQ(shareChange(c, d).percentile99, 0);
}

TEST(Brightening, IsTheMeanChangeOfLight) {
  Truth fine;
  fine.mask = {2, 2, {Shade::lit, Shade::lit, Shade::shadowed, Shade::none}};
  Truth coarse = fine;
  EXPECT_EQ(brightening(fine, coarse), 0);
  coarse.mask.samples[0] = Shade::shadowed;
  EXPECT_DOUBLE_EQ(brightening(fine, coarse), -1.0 / 3) << "coarse facets darken";
  coarse.mask.samples[2] = Shade::lit;
  EXPECT_EQ(brightening(fine, coarse), 0) << "as many turn lit";
  fine.visibility = {2, 2, {1, 0.5F, 0, noSample}};
  coarse.visibility = {2, 2, {1, 0.75F, 0.25F, noSample}};
  EXPECT_DOUBLE_EQ(brightening(fine, coarse), 0.5 / 3);
  coarse.mask.samples.pop_back();
  EXPECT_THROW((void)brightening(fine, coarse), InternalError);
}

}  // namespace
}  // namespace gnomon::truth
