#include "common/packed_shades.h"

#include <gtest/gtest.h>

#include <utility>

namespace gnomon {
namespace {

constexpr Shade lit = Shade::lit;
constexpr Shade dark = Shade::shadowed;
constexpr Shade none = Shade::none;

TEST(PackedShades, AreFourAByteFromTheLowestBits) {
  EXPECT_EQ(packedShades(std::vector<Shade>{dark, none, lit, dark, none}),
            (std::vector<std::uint8_t>{0b01'00'10'01, 0b10}));
  EXPECT_TRUE(packedShades({}).empty());
}

TEST(PackedShades, ComeBackInAnyNumber) {
  std::vector<Shade> samples;
  for (int i = 0; i < 41; ++i) {
    EXPECT_EQ(unpackedShades(packedShades(samples), samples.size()), samples) << i;
    samples.push_back(static_cast<Shade>((i * i + i / 3) % 3));
  }
}

TEST(PackedShades, OfFewerBytesAreFewer) {
  EXPECT_EQ(unpackedShades(std::vector<std::uint8_t>{0}, 1'000'000'000),
            (std::vector<Shade>(4, lit)));
}

TEST(Mask, IsTheSameWhereEverySampleIs) {
  const Mask mask{3, 2, {lit, dark, none, lit, lit, dark}};
  Mask other = mask;
  EXPECT_TRUE(isSame(mask, other));
  other.samples.back() = lit;
  EXPECT_FALSE(isSame(mask, other));
  other = mask;
  std::swap(other.width, other.height);
  EXPECT_FALSE(isSame(mask, other));
  EXPECT_TRUE(isSame(Mask{}, Mask{}));
}

}  // namespace
}  // namespace gnomon
