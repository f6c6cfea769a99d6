#include "gnomon/truth.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include "api/failure_of.h"

namespace gnomon::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr int side = 64;  // texels and world units

/// A wall of height 4 over x from 20 to 24, along the whole map.
std::vector<float> wall() {
  std::vector<float> texels;
  for (int i = 0; i < side * side; ++i) {
    const int x = i % side;
    texels.push_back(x >= 20 && x < 24 ? 4.0F : 0.0F);
  }
  return texels;
}

/// The truth on a plane, one sample at every texel's centre.
ShadowTruth overWall(double slope, std::optional<double> radius = {}) {
  const std::vector<float> texels = wall();
  const Surface plane = makeShape("plane", {{"quads", {4, 4}}, {"size", {side, side}}});
  return traceTruth(plane, {{side, side, texels, false}}, atlasSamples(plane, side / 4),
                    {{-2, 0, 2 * slope}}, {.step = 0.25, .radius = radius})
      .front();
}

std::size_t at(int x, int y) {
  return static_cast<std::size_t>(y * side + x);
}

// The wall's top ends at x = 23.5 and falls to the ground at 24.5; the shadow of its top ends
// 4 / tan θ behind it.
TEST(ApiTruth, TheShadowOfAWallIsAsLongAsItsHeightOverTheLightsSlope) {
  constexpr double slope = 0.45;
  const ShadowTruth truth = overWall(slope);
  ASSERT_EQ(truth.mask.size(), static_cast<std::size_t>(side * side));
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (x >= 19 && x <= 24) continue;  // the wall itself
      const bool inShadow = x + 0.5 > 24 && x + 0.5 < 23.5 + 4 / slope;
      EXPECT_EQ(truth.mask[at(x, y)], inShadow ? 0 : 1) << x << ", " << y;
    }
  }
  EXPECT_LT(truth.uncertainty, 0.03) << "at most one column of 64, and a half";
}

TEST(ApiTruth, OccludersBeyondTheRadiusAreDistant) {
  const ShadowTruth truth = overWall(0.45, 4);
  EXPECT_EQ(truth.regions[at(25, 9)], static_cast<std::uint8_t>(ShadowRegion::cast));
  EXPECT_EQ(truth.regions[at(31, 9)], static_cast<std::uint8_t>(ShadowRegion::distant));
  EXPECT_EQ(truth.regions[at(40, 9)], static_cast<std::uint8_t>(ShadowRegion::lit));
}

TEST(ApiTruth, ABareSphereIsLitWhereItFacesTheLight) {
  const std::vector<float> flat(4, 0.0F);
  const Surface sphere =
      makeShape("sphere", {{"quads", {20, 20}}, {"curvature", {0.1}}, {"size", {20, 20}}});
  const SurfaceSamples samples = atlasSamples(sphere, 3);
  const auto truths = traceTruth(sphere, {{2, 2, flat}}, samples, {{1, 0, 0}, {0, 0, 5}});
  ASSERT_EQ(truths.size(), 2U);
  for (int y = 0; y < samples.height; ++y) {
    for (int x = 0; x < samples.width; ++x) {
      // Longitude from -1 to 1, of which light from +x sees the positive half.
      const std::uint8_t expected = x < samples.width / 2 ? 0 : 1;
      EXPECT_EQ(truths[0].mask[static_cast<std::size_t>(y * samples.width + x)], expected);
    }
  }
  EXPECT_THAT(truths[1].mask, Each(1));
}

// Seen from x on the ground, the wall's top edge at 23.5 is a straight horizon.
TEST(ApiTruth, ADiscOverAWallIsSeenByTheClosedForm) {
  constexpr double degrees = 3;
  const double disc = degrees * std::numbers::pi / 180;
  const double elevation = std::atan(0.45);
  const std::vector<float> texels = wall();
  const Surface plane = makeShape("plane", {{"quads", {4, 4}}, {"size", {side, side}}});
  const auto truths = traceTruth(plane, {{side, side, texels, false}},
                                 atlasSamples(plane, side / 4), {{-2, 0, 2 * 0.45}, {-1, 0, 0.45}},
                                 {.step = 0.25, .radius = {}, .lightRadii = {degrees, 0}});
  const ShadowTruth& soft = truths.front();
  EXPECT_THAT(truths.back().shares, ::testing::IsEmpty()) << "a point";
  ASSERT_EQ(soft.shares.size(), soft.mask.size());
  int penumbra = 0;
  for (int x = 26; x < side; ++x) {
    const double beta = std::atan(4 / (x + 0.5 - 23.5));
    const double height = std::clamp((elevation - beta) / disc, -1.0, 1.0);
    const double expected =
        1 - (std::acos(height) - height * std::sqrt(1 - height * height)) / std::numbers::pi;
    const float share = soft.shares[at(x, side / 2)];
    EXPECT_NEAR(share, expected, 0.01) << x;
    EXPECT_EQ(soft.mask[at(x, side / 2)], share < 0.5F ? 0 : 1) << x;
    penumbra += share > 0 && share < 1 ? 1 : 0;
  }
  EXPECT_GE(penumbra, 2);
  EXPECT_GT(soft.uncertainty, 0) << "fewer directions, a coarser mesh";
  EXPECT_LT(soft.uncertainty, 0.01);
}

TEST(ApiTruth, RefusesWhatItCannotTrace) {
  const std::vector<float> flat(4, 0.0F);
  const Surface plane = makeShape("plane", {{"quads", {2, 2}}, {"size", {1, 1}}});
  const SurfaceSamples samples = atlasSamples(plane, 2);
  const auto refusal = [&](const SurfaceSamples& asked, const std::array<double, 3>& light,
                           const Displacement& displacement, const TraceOptions& options = {}) {
    return failureOf([&] { (void)traceTruth(plane, displacement, asked, {light}, options); });
  };
  const Displacement bare{{2, 2, flat}};
  EXPECT_THAT(refusal(samples, {0, 0, 0}, bare), HasSubstr("light 0"));
  EXPECT_THAT(refusal({1, 1, {{4, 0, 0}}, {}}, {0, 0, 1}, bare), HasSubstr("face 4"));
  EXPECT_THAT(refusal({1, 1, {{0, 0, 2}}, {}}, {0, 0, 1}, bare), HasSubstr("t 2"));
  EXPECT_THAT(refusal({2, 1, {{0, 0, 0}}, {}}, {0, 0, 1}, bare), HasSubstr("2 × 1"));
  EXPECT_THAT(refusal(samples, {0, 0, 1}, {{2, 2, flat}, {0, 1}}), StartsWith("trace: repeats: 0"));
  for (const double radius : {0.0, 2e5, std::nan("")}) {
    EXPECT_THAT(refusal(samples, {0, 0, 1}, bare, {.step = 0.5, .radius = radius}),
                AllOf(StartsWith("trace: radius: "), HasSubstr("(texels")));
  }
  EXPECT_THAT(
      refusal(samples, {0, 0, 1}, bare, {.step = 0.5, .radius = {}, .lightRadii = {0.1, 0.1}}),
      StartsWith("light radii: 2 found"));
  for (const double radius : {-0.1, 10.1, std::nan("")}) {
    EXPECT_THAT(
        refusal(samples, {0, 0, 1}, bare, {.step = 0.5, .radius = {}, .lightRadii = {radius}}),
        AllOf(StartsWith("light 0: radius: "), HasSubstr("(degrees")));
  }
  for (const int directions : {30, 33, 65538}) {
    EXPECT_THAT(refusal(samples, {0, 0, 1}, bare,
                        {.step = 0.5, .radius = {}, .lightRadii = {5}, .directions = directions}),
                StartsWith("trace: directions: "));
  }
  EXPECT_THAT(refusal(samples, {0, 0, 1}, bare, {.step = -1, .radius = {}}),
              StartsWith("trace: step: -1 found"));
  EXPECT_THAT(
      failureOf(
          [&] {
            (void)traceTruth(plane, bare, samples, {{0, 0, 1}}, {.step = 1e-7, .radius = {}});
          },
          FailureKind::internal),
      StartsWith("step: 1e-07 texels make a micro-mesh of "));
  EXPECT_NE(failureOf([&] { (void)traceTruth(plane, bare, samples, {}); }), "");
}

// The limits of a study: where floats do not hold what rays compute with, there is no truth.
TEST(ApiTruth, RefusesWhatAStudyRefuses) {
  const std::vector<float> flat(4, 0.0F);
  const auto refusal = [](const Surface& surface, const std::vector<float>& heights) {
    return failureOf([&] {
      (void)traceTruth(surface, {{2, 2, heights}}, atlasSamples(surface, 2), {{0, 0, 1}},
                       {.step = 0.5, .radius = {}});
    });
  };
  const auto sphereOf = [](double radius) {
    return makeShape(
        "sphere",
        {{"quads", {20, 20}}, {"curvature", {1 / radius}}, {"size", {1.9 * radius, 1.9 * radius}}});
  };
  EXPECT_THAT(refusal(sphereOf(7e-11), flat), StartsWith("surface: a texel is "));
  EXPECT_THAT(refusal(sphereOf(1e10), flat), StartsWith("surface: a texel is "));
  for (const float height : {4e18F, -4e18F, 1.1e6F}) {
    EXPECT_THAT(refusal(sphereOf(1), {0, height, 0, 0}), StartsWith("heights from "));
    EXPECT_THAT(failureOf([&] {
                  (void)bakeHorizons({2, 2, std::vector<float>(4, height)}, 4, 2);
                }),
                StartsWith("heights from "));
  }
}

// Powers of two change no digit of a float: the same shadows, until they leave the range of floats.
TEST(ApiTruth, IsTheSameAtAnyScaleThatItTakes) {
  std::vector<float> bumps(64 * 64);
  for (std::size_t i = 0; i < bumps.size(); ++i) {
    bumps[i] = i % 16 < 5 && i / 64 % 16 < 5 ? 3.0F : 0.0F;
  }
  const auto truthAt = [&](double scale) {
    const Surface sphere = makeShape("sphere", {{"quads", {20, 20}},
                                                {"curvature", {1 / (32 * scale)}},
                                                {"size", {60 * scale, 60 * scale}}});
    const Displacement relief{.map = {64, 64, bumps}, .heightsInTexels = true};
    return traceTruth(sphere, relief, atlasSamples(sphere, 5), {{0.8, 0.3, 0.5}},
                      {.step = 0.5, .radius = {}})
        .front();
  };
  const ShadowTruth standard = truthAt(1);
  EXPECT_THAT(standard.mask, AllOf(Contains(0), Contains(1)));
  for (const int exponent : {-23, 23}) {  // texels of 1.1e-7 and 7.9e6
    const ShadowTruth scaled = truthAt(std::ldexp(1, exponent));
    EXPECT_EQ(scaled.mask, standard.mask) << exponent;
    EXPECT_EQ(scaled.regions, standard.regions) << exponent;
    EXPECT_EQ(scaled.uncertainty, standard.uncertainty) << exponent;
  }
}

#if !defined(__SANITIZE_THREAD__)  // where loops do not go by TBB

// Without a word from the trace itself: of 6,000 lights each takes a thousandth of a second.
TEST(ApiTruth, EndsWhenItIsStopped) {
  using Clock = std::chrono::steady_clock;
  const std::vector<float> texels = wall();
  const Surface plane = makeShape("plane", {{"quads", {4, 4}}, {"size", {side, side}}});
  const SurfaceSamples samples = atlasSamples(plane, 128);
  const std::vector<std::array<double, 3>> lights(6000, {-1, 0, 1});
  StopSwitch whole;
  Clock::time_point stopped;
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    stopped = Clock::now();
    whole.stop();
  });
  (void)failureOf(
      [&] {
        whole.run([&] {
          (void)traceTruth(plane, {{side, side, texels, false}}, samples, lights,
                           {.step = 0.25, .radius = {}});
        });
      },
      FailureKind::stopped);
  const auto late = Clock::now() - stopped;
  other.join();
  EXPECT_LT(std::chrono::duration<double>(late).count(), 1);
}

#endif

}  // namespace
}  // namespace gnomon::test
