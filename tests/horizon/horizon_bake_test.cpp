#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "common/error.h"
#include "common/system/memory.h"
#include "horizon/horizon_bake.h"
#include "horizon/horizon_truth.h"
#include "horizon/kernel/horizon_tiles.h"
#include "horizon/kernel/tile_kernel.h"
#include "support/error_messages.h"

namespace gnomon::horizon {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// --- against brute force ------------------------------------------------------------------------

TEST(HorizonBake, IsTheSupremumOnNoise) {
  for (const relief::Wrap wrap : {relief::Wrap::repeat, relief::Wrap::clamp}) {
    const relief::HeightField field = noise(19, 14, wrap);
    expectExact(field, {7, 12.34});
    expectExact(field, {8, 6});
    expectExact(field, {12, 3.7});
  }
}

TEST(HorizonBake, IsTheSupremumWhereSlopesTie) {
  for (const relief::Wrap wrap : {relief::Wrap::repeat, relief::Wrap::clamp}) {
    expectExact(coarseNoise(13, 17, wrap, 4), {16, 9.5});
  }
}

TEST(HorizonBake, IsTheSupremumOnSmoothHills) {
  const relief::HeightField hills = sampled(24, 24, relief::Wrap::repeat, [](int x, int y) {
    return 6 * std::sin(2 * pi * x / 24) * std::cos(4 * pi * y / 24) + 100;
  });
  expectExact(hills, {10, 20});
}

TEST(HorizonBake, IsTheSupremumWithinAnyRadius) {
  const relief::HeightField field = noise(9, 7, relief::Wrap::repeat, 3);
  for (const double radius : {0.01, 0.4, 1.0, 1.2, std::sqrt(2.0), 2.0, 5.01, 40.0}) {
    expectExact(field, {8, radius});
  }
  expectExact(noise(9, 7, relief::Wrap::clamp, 3), {5, 33.3});
}

TEST(HorizonBake, IsTheSupremumOnMapsOfAnyShape) {
  expectExact(noise(1, 1, relief::Wrap::repeat), {8, 5});
  expectExact(noise(1, 9, relief::Wrap::clamp), {8, 5});
  expectExact(noise(67, 2, relief::Wrap::repeat), {8, 5});
  expectExact(noise(130, 1, relief::Wrap::clamp), {4, 5});
  expectExact(noise(6, 6, relief::Wrap::repeat), {1, 5});
}

TEST(HorizonBake, IsTheSupremumOnMapsOfSeveralTiles) {
  expectExact(noise(TexelTile::width + 3, TexelTile::height + 1, relief::Wrap::repeat), {5, 9});
  expectExact(noise(2, 2 * TexelTile::height + 7, relief::Wrap::clamp), {6, 70.5});
}

TEST(HorizonBake, AHighOffsetCostsNoPrecision) {
  // Heights around 1000 that floats hold to 6e-5: the map is what the floats say, and exact.
  expectExact(noise(12, 12, relief::Wrap::repeat, 8, 1000), {9, 10});
}

// --- borders ------------------------------------------------------------------------------------

TEST(HorizonBake, IsTheSupremumUpToABorder) {
  for (const relief::Wrap wrap : {relief::Wrap::repeat, relief::Wrap::clamp}) {
    for (const relief::Border border :
         {relief::Border{true, true}, relief::Border{true, false}, relief::Border{false, true}}) {
      expectExact(noise(19, 14, wrap).withBorder(border), {7, 12.34});
      expectExact(noise(9, 7, wrap, 3).withBorder(border), {12, 33.3});
      expectExact(coarseNoise(13, 17, wrap, 4).withBorder(border), {16, 9.5});
      expectExact(noise(1, 9, wrap).withBorder(border), {8, 5});
    }
  }
  expectExact(noise(TexelTile::width + 3, 5, relief::Wrap::repeat, 5).withBorder({true, true}),
              {6, 20});
  // As many azimuths as a study may have come nearest to a border without being parallel to it.
  expectExact(noise(3, 2, relief::Wrap::clamp, 6).withBorder({true, true}), {1023, 12});
}

TEST(HorizonBake, ARidgeEndsAtABorder) {
  // A ridge 4 high along column 12. Clamping draws it out past the upper border, where rays that
  // leave over that border would meet it.
  const relief::HeightField ridge =
      sampled(16, 16, relief::Wrap::clamp, [](int x, int) { return x == 12 ? 4.0 : 0.0; });
  const HorizonTables drawnOut = bakeHorizons(ridge, {8, 40});
  const HorizonTables ended = bakeHorizons(ridge.withBorder({true, true}), {8, 40});
  for (int y = 0; y < 16; ++y) {
    // At 45° from column 4 the ridge stands 8 rows up, or half of it on the border, 7½ rows up.
    const auto seen = static_cast<float>(4 / std::sqrt(128.0));
    EXPECT_FLOAT_EQ(horizonAt(drawnOut, 1, 4, y), seen);
    if (y + 8 < 16) {
      EXPECT_FLOAT_EQ(horizonAt(ended, 1, 4, y), seen);
    } else if (y + 8 == 16) {
      EXPECT_FLOAT_EQ(horizonAt(ended, 1, 4, y), static_cast<float>(2 / (7.5 * std::sqrt(2.0))));
    } else {
      EXPECT_EQ(horizonAt(ended, 1, 4, y), 0) << y;
      EXPECT_EQ(distanceAt(ended, 1, 4, y), 0) << y;
    }
  }
}

TEST(HorizonBake, ARampEndsAtABorder) {
  // It ends with the half texel that clamping keeps flat.
  const relief::HeightField ramp =
      sampled(16, 16, relief::Wrap::clamp, [](int x, int) { return 0.5 * x; });
  const HorizonTables up = bakeHorizons(ramp.withBorder({true, true}), {4, 40});
  for (int x = 0; x < 15; ++x) EXPECT_FLOAT_EQ(horizonAt(up, 0, x, 3), 0.5F);
  EXPECT_EQ(horizonAt(up, 0, 15, 3), 0) << "the half texel before the border is flat";
  // Down the ramp nothing lies beyond: the slope is the ramp's own or, at its foot, flat.
  for (int x = 1; x < 16; ++x) {
    EXPECT_FLOAT_EQ(horizonAt(up, 2, x, 3), static_cast<float>(-0.5 * x / (x + 0.5)));
    EXPECT_FLOAT_EQ(distanceAt(up, 2, x, 3), static_cast<float>(x + 0.5));
  }
}

TEST(HorizonBake, ARepeatedMapWithABorderDoesNotSeeItsNextTile) {
  // One peak 6 high at column 2 of 16: toward +x from column 10 it comes again after 8 texels.
  const relief::HeightField peak =
      sampled(16, 4, relief::Wrap::repeat, [](int x, int) { return x == 2 ? 6.0 : 0.0; });
  const HorizonTables tiled = bakeHorizons(peak, {4, 40});
  const HorizonTables ended = bakeHorizons(peak.withBorder({true, true}), {4, 40});
  EXPECT_FLOAT_EQ(horizonAt(tiled, 0, 10, 1), 6.F / 8);
  EXPECT_EQ(horizonAt(ended, 0, 10, 1), 0);
  EXPECT_FLOAT_EQ(horizonAt(ended, 2, 10, 1), 6.F / 8) << "within the map it is seen";
  EXPECT_FLOAT_EQ(distanceAt(ended, 2, 10, 1), 8);
  // Round a tube, closed along x, and open along y.
  EXPECT_EQ(bakeHorizons(peak.withBorder({false, true}), {1, 40}).horizon,
            bakeHorizons(peak, {1, 40}).horizon);
}

// --- closed forms -------------------------------------------------------------------------------

TEST(HorizonBake, FlatGroundHasNoHorizonAndNoDistance) {
  for (const float height : {0.F, 1000.3F, -1e-20F}) {
    const relief::HeightField flat(20, 10, std::vector<float>(200, height), relief::Wrap::repeat);
    const HorizonTables tables = bakeHorizons(flat, {16, 31.4});
    for (const float slope : tables.horizon) EXPECT_EQ(slope, 0);
    for (const float distance : tables.distance) EXPECT_EQ(distance, 0);
  }
}

TEST(HorizonBake, APlaneIsInTheShadowOfItsOwnSlope) {
  for (const Vec2 gradient : {Vec2(0.25, 0.125), Vec2(0.1, -0.7), Vec2(-1e-3, 3)}) {
    for (const double offset : {0.0, 12.3}) {
      const relief::HeightField plane = sampled(64, 64, relief::Wrap::clamp, [&](int x, int y) {
        return offset + gradient.x * x + gradient.y * y;
      });
      const HorizonTables tables = bakeHorizons(plane, {24, 20});
      for (int m = 0; m < 24; ++m) {
        const Vec2 e(std::cos(2 * pi * m / 24), std::sin(2 * pi * m / 24));
        for (int i = 22; i < 42; ++i) {
          EXPECT_NEAR(horizonAt(tables, m, i, 63 - i), glm::dot(gradient, e),
                      64 * 2e-6 * glm::length(gradient));
          EXPECT_EQ(distanceAt(tables, m, i, 63 - i), 0) << m << " " << gradient.x;
        }
      }
    }
  }
}

TEST(HorizonBake, AStepIsSeenFromItsEdge) {
  // Ground 0, from column 40 on 3: the top of the wall stands on the line x = 40 of centres.
  const relief::HeightField step =
      sampled(64, 8, relief::Wrap::clamp, [](int x, int) { return x < 40 ? 0.0 : 3.0; });
  constexpr int azimuths = 16;
  const HorizonTables tables = bakeHorizons(step, {azimuths, 60});
  for (const int m : {0, 1, 2, 3, azimuths - 1, azimuths - 3}) {
    const double c = std::cos(2 * pi * m / azimuths);
    // From the texel at its foot the wall is a ramp: all of it has one slope.
    EXPECT_NEAR(horizonAt(tables, m, 39, 4), 3 * c, 3e-6);
    EXPECT_EQ(distanceAt(tables, m, 39, 4), 0);
    for (int x = 20; x < 39; ++x) {
      const double distance = (40 - x) / c;
      if (distance > 60) continue;
      EXPECT_NEAR(horizonAt(tables, m, x, 4), 3 / distance, 3e-6);
      EXPECT_NEAR(distanceAt(tables, m, x, 4), distance, 1e-5 * distance);
    }
    EXPECT_EQ(horizonAt(tables, m, 50, 4), 0) << "on top it is flat";
    EXPECT_EQ(distanceAt(tables, m, 50, 4), 0);
  }
}

TEST(HorizonBake, AConeIsSeenFromItsApex) {
  // Apex 6 high at texel (32, 32), slope 1: foot at 6 texels.
  const relief::HeightField cone = sampled(64, 64, relief::Wrap::clamp, [](int x, int y) {
    return std::max(0.0, 6 - std::hypot(x - 32, y - 32));
  });
  const HorizonTables tables = bakeHorizons(cone, {8, 40});
  const std::vector<std::pair<int, int>> toward{{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                                {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  for (int m = 0; m < 8; ++m) {
    const auto [dx, dy] = toward[static_cast<std::size_t>(m)];
    const double unit = std::hypot(dx, dy);
    for (int k = 7; k < 20; ++k) {
      EXPECT_NEAR(horizonAt(tables, m, 32 - k * dx, 32 - k * dy), 6 / (k * unit), 6e-6);
      EXPECT_NEAR(distanceAt(tables, m, 32 - k * dx, 32 - k * dy), k * unit, 1e-5 * k);
    }
  }
  for (int k = 1; k < 6; ++k) {
    EXPECT_FLOAT_EQ(horizonAt(tables, 0, 32 - k, 32), 1);
    EXPECT_EQ(distanceAt(tables, 0, 32 - k, 32), 0) << "all of its slope ties: attached";
  }
}

// --- identities ---------------------------------------------------------------------------------

TEST(HorizonBake, AShiftedMapHasShiftedTablesToTheBit) {
  // Which texels share a vector, and what is skipped with it, must not show.
  const relief::HeightField field = noise(150, 90, relief::Wrap::repeat, 6);
  const relief::HeightField shifted = sampled(
      150, 90, relief::Wrap::repeat, [&](int x, int y) { return field.texel(x + 37, y + 11); });
  const HorizonTables a = bakeHorizons(field, {12, 100});
  const HorizonTables b = bakeHorizons(shifted, {12, 100});
  for (int m = 0; m < 12; ++m) {
    for (int y = 0; y < 90; ++y) {
      for (int x = 0; x < 150; ++x) {
        ASSERT_EQ(horizonAt(b, m, x, y), horizonAt(a, m, (x + 37) % 150, (y + 11) % 90));
        ASSERT_EQ(distanceAt(b, m, x, y), distanceAt(a, m, (x + 37) % 150, (y + 11) % 90));
      }
    }
  }
}

TEST(HorizonBake, ATurnedMapHasTurnedTables) {
  const relief::HeightField field = noise(40, 40, relief::Wrap::repeat, 7);
  // A quarter turn counter-clockwise: (x, y) goes to (39 - y, x).
  const relief::HeightField turned =
      sampled(40, 40, relief::Wrap::repeat, [&](int x, int y) { return field.texel(y, 39 - x); });
  const HorizonTables a = bakeHorizons(field, {12, 30});
  const HorizonTables b = bakeHorizons(turned, {12, 30});
  for (int m = 0; m < 12; ++m) {
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 40; ++x) {
        ASSERT_NEAR(horizonAt(b, (m + 3) % 12, 39 - y, x), horizonAt(a, m, x, y), 2e-6);
      }
    }
  }
}

TEST(HorizonBake, HeightsScaleSlopesAndLeaveDistances) {
  const relief::HeightField field = noise(40, 30, relief::Wrap::repeat, 2);
  const relief::HeightField higher =
      sampled(40, 30, relief::Wrap::repeat, [&](int x, int y) { return 8.0 * field.texel(x, y); });
  const HorizonTables a = bakeHorizons(field, {10, 25});
  const HorizonTables b = bakeHorizons(higher, {10, 25});
  for (std::size_t i = 0; i < a.horizon.size(); ++i) {
    ASSERT_EQ(b.horizon[i], 8 * a.horizon[i]);
    ASSERT_EQ(b.distance[i], a.distance[i]);
  }
}

TEST(HorizonBake, ALongerRadiusNeverLowersAHorizon) {
  const relief::HeightField field = noise(50, 50, relief::Wrap::clamp, 2);
  const HorizonTables near = bakeHorizons(field, {6, 10});
  const HorizonTables far = bakeHorizons(field, {6, 30});
  for (std::size_t i = 0; i < near.horizon.size(); ++i) {
    ASSERT_GE(far.horizon[i], near.horizon[i] - 1e-6);
  }
}

TEST(HorizonBake, DoesNotDependOnTheNumberOfThreads) {
  const relief::HeightField field = noise(200, 120, relief::Wrap::repeat, 12);
  const auto bakeOn = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return bakeHorizons(field, {9, 60.5});
  };
  const HorizonTables one = bakeOn(1);
  const HorizonTables two = bakeOn(2);
  EXPECT_EQ(one.horizon, two.horizon);
  EXPECT_EQ(one.distance, two.distance);
}

// --- the function as such -----------------------------------------------------------------------

TEST(HorizonBake, DescribesItsTables) {
  const HorizonTables tables = bakeHorizons(noise(5, 3, relief::Wrap::clamp), {6, 2.5});
  EXPECT_EQ(tables.width, 5);
  EXPECT_EQ(tables.height, 3);
  EXPECT_EQ(tables.layers, 6);
  EXPECT_EQ(tables.radiusTexels, 2.5);
  EXPECT_EQ(tables.wrap, relief::Wrap::clamp);
  EXPECT_EQ(tables.horizon.size(), 90U);
  EXPECT_EQ(tables.distance.size(), 90U);
}

TEST(HorizonBake, ReportsProgressOneCallAtATime) {
  std::atomic<int> inside = 0;
  double last = 0;
  int calls = 0;
  bakeHorizons(noise(128, 64, relief::Wrap::repeat), {16, 20}, [&](double share) {
    EXPECT_EQ(++inside, 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // so that another would meet it
    EXPECT_GT(share, last);
    last = share;
    ++calls;
    --inside;
  });
  EXPECT_EQ(last, 1);
  EXPECT_GT(calls, 10);
}

TEST(HorizonBake, RefusesSettingsOutOfRange) {
  const relief::HeightField field = noise(4, 4, relief::Wrap::repeat);
  for (const int azimuths : {0, -3}) {
    EXPECT_THAT(messageOf<InputError>([&] {
                  bakeHorizons(field, {azimuths, 5});
                }),
                StartsWith("azimuths: "));
  }
  for (const double radius : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(messageOf<InputError>([&] {
                  bakeHorizons(field, {8, radius});
                }),
                StartsWith("radius: "));
  }
}

TEST(HorizonBake, RefusesWhatCannotFit) {
  const relief::HeightField field = noise(64, 64, relief::Wrap::repeat);
  EXPECT_THAT(messageOf<MemoryError>([&] {
                bakeHorizons(field, {2000000000, 5});
              }),
              AllOf(StartsWith("azimuths: 2000000000"), HasSubstr("64 × 64")));
  EXPECT_THAT(messageOf<MemoryError>([&] {
                bakeHorizons(field, {8, 1e300});
              }),
              HasSubstr("a radius of 1e+300 texels"));
}

TEST(HorizonBake, MemoryCountsTheThreadsThatAreAllowed) {
  const relief::HeightField field = noise(4, 4, relief::Wrap::repeat);
  const auto refusal = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return messageOf<MemoryError>([&] { bakeHorizons(field, {1, 1e9}); });
  };
  // What each of them writes down is nearly all of it.
  const double one = tileScratchBytes(1e9);
  EXPECT_THAT(refusal(1), HasSubstr(formatBytes(one + azimuthPlanBytes(1e9)).substr(0, 3)));
  EXPECT_THAT(refusal(3), HasSubstr(formatBytes(3 * one + azimuthPlanBytes(1e9)).substr(0, 3)));
}

TEST(HorizonBake, ExtremeHeightsStayFinite) {
  constexpr float most = std::numeric_limits<float>::max();
  const relief::HeightField field = sampled(
      9, 9, relief::Wrap::repeat, [](int x, int y) { return (x + y) % 2 == 0 ? most : -most; });
  EXPECT_THAT(messageOf<InputError>([&] { bakeHorizons(field, {8, 5}); }), HasSubstr("1e+34"));
  const relief::HeightField fair =
      sampled(9, 9, relief::Wrap::repeat, [](int x, int) { return x * 1e30; });
  for (const float slope : bakeHorizons(fair, {8, 5}).horizon) EXPECT_TRUE(std::isfinite(slope));
}

/// While it lives, what is dispatched runs on one instruction set.
class OnTarget {
 public:
  explicit OnTarget(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
  ~OnTarget() { hwy::SetSupportedTargetsForTest(0); }
  OnTarget(const OnTarget&) = delete;
  OnTarget& operator=(const OnTarget&) = delete;
};

/// The instruction sets that this processor has and the baker is compiled for.
std::vector<std::int64_t> targets() {
  std::vector<std::int64_t> found;
  std::set<std::string> names;
  const std::int64_t supported = hwy::SupportedTargets();
  for (std::int64_t bit = 1; bit > 0 && bit <= HWY_EMU128; bit <<= 1) {
    if ((supported & bit) == 0) continue;
    const OnTarget on(bit);
    const std::string name = bakeInstructionSet();
    if (name == hwy::TargetName(bit) && names.insert(name).second) found.push_back(bit);
  }
  return found;
}

TEST(HorizonTargets, AreSeveralWhereTheProcessorHasWideVectors) {
#if defined(__x86_64__)
  if ((hwy::SupportedTargets() & HWY_AVX2) == 0) GTEST_SKIP() << "no AVX2";
  // SSE4 and AVX2; the third is AVX-512.
  const bool isWidest = (hwy::SupportedTargets() & HWY_AVX3) != 0;
  EXPECT_GE(targets().size(), isWidest ? 3U : 2U);
#endif
}

TEST(HorizonTargets, AreEachExact) {
  for (const std::int64_t target : targets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    const OnTarget on(target);
    for (const relief::Wrap wrap : {relief::Wrap::repeat, relief::Wrap::clamp}) {
      expectExact(noise(19, 14, wrap), {7, 12.34});
      expectExact(coarseNoise(13, 17, wrap, 4), {8, 9.5});
    }
    expectExact(noise(5, 6, relief::Wrap::repeat), {5, 80.2});
  }
}

TEST(HorizonTargets, AgreeToTheBit) {
  for (const relief::Wrap wrap : {relief::Wrap::repeat, relief::Wrap::clamp}) {
    const relief::HeightField field = noise(150, 90, wrap, 6);
    const HorizonTables widest = bakeHorizons(field, {12, 200.5});
    for (const std::int64_t target : targets()) {
      const OnTarget on(target);
      const HorizonTables tables = bakeHorizons(field, {12, 200.5});
      EXPECT_EQ(tables.horizon, widest.horizon) << hwy::TargetName(target);
      EXPECT_EQ(tables.distance, widest.distance) << hwy::TargetName(target);
    }
  }
}

}  // namespace
}  // namespace gnomon::horizon
