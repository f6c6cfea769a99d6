#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "horizon/horizon_bake.h"
#include "horizon/horizon_truth.h"
#include "horizon/kernel/tile_kernel.h"

namespace gnomon::horizon {
namespace {

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
  EXPECT_GE(targets().size(), 3U);
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
