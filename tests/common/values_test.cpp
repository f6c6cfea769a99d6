#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <new>
#include <numeric>
#include <random>
#include <string>
#include <utility>

#include "common/camera.h"
#include "common/error.h"
#include "common/lists.h"
#include "common/mask.h"
#include "common/raw_vector.h"
#include "common/vec.h"

namespace gnomon {
namespace {

Camera skewCamera() {
  Camera camera;
  camera.eye = {3, -7, 5};
  camera.target = {-1, 2, 0.5};
  camera.up = {0.2, 0.1, 1};
  camera.verticalFov = radians(40);
  camera.width = 6;
  camera.height = 4;
  return camera;
}

double angle(const Vec3& a, const Vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

TEST(Camera, AxesAreARightHandedOrthonormalFrame) {
  const CameraAxes axis = axes(skewCamera());
  EXPECT_NEAR(glm::length(axis.right), 1, 1e-14);
  EXPECT_NEAR(glm::length(axis.up), 1, 1e-14);
  EXPECT_NEAR(glm::dot(axis.right, axis.up), 0, 1e-14);
  EXPECT_NEAR(glm::length(glm::cross(axis.right, axis.up) - axis.back), 0, 1e-14);
  EXPECT_GT(glm::dot(axis.up, skewCamera().up), 0);
}

TEST(Camera, RaysMeanToTheViewingDirection) {
  const Camera camera = skewCamera();
  const CameraAxes axis = axes(camera);
  // The picture's centre is the corner that the four middle pixels share.
  Vec3 sum(0);
  for (const int row : {1, 2}) {
    for (const int column : {2, 3}) sum += pixelDirection(camera, axis, column, row);
  }
  EXPECT_NEAR(angle(sum, camera.target - camera.eye), 0, 1e-14);
}

TEST(Camera, RowZeroIsTheTopAndColumnZeroTheLeft) {
  const Camera camera = skewCamera();
  const CameraAxes axis = axes(camera);
  const Vec3 first = pixelDirection(camera, axis, 0, 0);
  EXPECT_GT(glm::dot(first, axis.up), 0);
  EXPECT_LT(glm::dot(first, axis.right), 0);
}

TEST(Camera, FieldOfViewIsTheFullVerticalAngleAndPixelsAreSquare) {
  Camera camera = skewCamera();
  camera.width = 3000;
  camera.height = 2000;
  const CameraAxes axis = axes(camera);
  const Vec3 top = pixelDirection(camera, axis, 1500, 0);
  // Half a pixel inside the edge of the picture: tan(fov / 2) (1 - 1 / height).
  const double tangent = std::tan(radians(20));
  EXPECT_NEAR(glm::dot(top, axis.up) / -glm::dot(top, axis.back), tangent * (1 - 1 / 2000.0),
              1e-12);
  const Vec3 right = pixelDirection(camera, axis, 2999, 1000);
  EXPECT_NEAR(glm::dot(right, axis.right) / -glm::dot(right, axis.back),
              1.5 * tangent * (1 - 1 / 3000.0), 1e-12);
}

TEST(Degrees, AreKeptToTheBit) {
  for (const double degrees : {0.0, 24.0, 165.0, -90.0, 0.1, 12.345, 359.999, 1e-7, 47.0 / 3}) {
    EXPECT_EQ(radians(degreesOf(radians(degrees))), radians(degrees)) << degrees;
  }
  EXPECT_EQ(degreesOf(radians(24)), 24);
  EXPECT_EQ(degreesOf(radians(0.1)), 0.1);
  EXPECT_EQ(degreesOf(radians(12.345)), 12.345);
  std::mt19937 random(1);
  for (int k = 0; k < 10000; ++k) {
    const double angle = radians(static_cast<double>(random()) / 1e7);
    ASSERT_EQ(radians(degreesOf(angle)), angle);
  }
}

TEST(Error, EachKindHasTheStatusThatItsCallersTellItBy) {
  EXPECT_EQ(static_cast<int>(UsageError("").status()), 2);
  EXPECT_EQ(static_cast<int>(InputError("").status()), 3);
  EXPECT_EQ(static_cast<int>(InternalError("").status()), 4);
  EXPECT_EQ(static_cast<int>(MemoryError("").status()), 4);
  EXPECT_EQ(static_cast<int>(NoGlError("").status()), 77);
}

TEST(Error, IsCaughtAsOneBaseWithItsMessage) {
  try {
    throw InputError("scene.toml:3: relief.height: missing");
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "scene.toml:3: relief.height: missing");
    EXPECT_EQ(error.status(), ExitStatus::badInput);
    EXPECT_EQ(error.parameter(), "");
    EXPECT_EQ(error.reason(), error.what());
  }
}

TEST(Error, NamesTheParameterThatIsWrongBeforeTheReason) {
  const InputError error("0 texels found", "step");
  EXPECT_STREQ(error.what(), "step: 0 texels found");
  EXPECT_EQ(error.parameter(), "step");
  EXPECT_EQ(error.reason(), "0 texels found");
}

TEST(FirstOfSame, IsTheFirstThatHoldsTheSame) {
  const std::string letters = "abacbca";
  const auto firsts = firstOfSame(
      letters.size(), [&](std::size_t a, std::size_t b) { return letters[a] == letters[b]; });
  EXPECT_THAT(firsts, testing::ElementsAre(0, 1, 0, 3, 1, 3, 0));
  EXPECT_THAT(firstOfSame(0, [](std::size_t, std::size_t) { return true; }), testing::IsEmpty());
}

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

TEST(Quantile, IsAValueWhereTheShareMeetsOne) {
  const std::vector<double> sorted = {1, 2, 4, 8, 16};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    EXPECT_EQ(quantile(sorted, 0.25 * static_cast<double>(i)), sorted[i]);
  }
}

TEST(Quantile, IsLinearBetweenValues) {
  EXPECT_DOUBLE_EQ(quantile({1, 2}, 0.5), 1.5);
  EXPECT_DOUBLE_EQ(quantile({0, 10, 20, 40}, 0.9), 34);
  EXPECT_EQ(quantile({7}, 0.3), 7);
  EXPECT_EQ(quantile({0.1, 0.1}, 0.37), 0.1) << "exact between equal values";
}

std::uintptr_t addressOf(const void* data) {
  return reinterpret_cast<std::uintptr_t>(data);
}

TEST(RawVector, StartsAtACacheLineAndLargeOnesAtAHugePage) {
  for (const std::size_t count : {1U, 3U, 100U, 4097U}) {
    const RawVector<float> values(count, 1.F);
    EXPECT_EQ(addressOf(values.data()) % 64, 0U) << count;
  }
  const RawVector<float> large(std::size_t{1} << 20);
  EXPECT_EQ(addressOf(large.data()) % (std::size_t{1} << 21), 0U);
}

TEST(RawVector, KeepsItsValuesWhereItGrows) {
  RawVector<int> values(1000);
  std::iota(values.begin(), values.end(), 0);
  values.resize(3'000'000);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(values[static_cast<std::size_t>(i)], i);
}

TEST(RawVector, TakesTheValuesThatItIsGiven) {
  const RawVector<float> values(5, 2.5F);
  EXPECT_EQ(values, (RawVector<float>{2.5F, 2.5F, 2.5F, 2.5F, 2.5F}));
}

TEST(RawVector, MoreThanCanBeAddressedIsRefused) {
  RawAllocator<double> allocator;
  EXPECT_THROW(allocator.allocate(std::numeric_limits<std::size_t>::max() / 4), std::bad_alloc);
}

}  // namespace
}  // namespace gnomon
