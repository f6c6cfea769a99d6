#include "relief/triplanar.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/error.h"
#include "relief/patterns.h"
#include "support/error_messages.h"
#include "surface/cage/shapes.h"

namespace gnomon::relief {
namespace {
using ::testing::StartsWith;

/// Six texels by three, no two alike.
HeightField someImage() {
  std::vector<float> texels;
  for (int k = 0; k < 18; ++k) texels.push_back(static_cast<float>(0.05 * k + 0.01 * (k * k % 7)));
  return {6, 3, texels, Wrap::repeat};
}

/// A plane through the origin that faces an axis, its two sides along the next axes.
surface::LimitSurface planeFacing(int axis) {
  surface::Cage cage = surface::makePlane(6, 3, 4, 5);
  for (Vec3& p : cage.positions) {
    Vec3 turned(0);
    turned[(axis + 1) % 3] = p.x;
    turned[(axis + 2) % 3] = p.y;
    turned[axis] = p.z;
    p = turned;
  }
  return surface::LimitSurface(cage);
}

/// Texel i of a row that goes on, to both sides of 0, in mirror images.
int mirroredTexel(int i, int side) {
  const int within = ((i % (2 * side)) + 2 * side) % (2 * side);
  return within < side ? within : 2 * side - 1 - within;
}

TEST(Triplanar, OnAPlaneThatFacesAnAxisIsTheImage) {
  const HeightField image = someImage();
  for (int axis = 0; axis < 3; ++axis) {
    // Two images side by side and one above the other: the map's middle is the origin.
    const HeightField field =
        makeSolidMap(planeFacing(axis), 12, 6, triplanar(image, 3), 2, Wrap::clamp);
    for (int j = 0; j < 6; ++j) {
      for (int i = 0; i < 12; ++i) {
        const double expected = 2.0 * static_cast<double>(image.texel(mirroredTexel(i - 6, 6),
                                                                      mirroredTexel(j - 3, 3)));
        EXPECT_NEAR(field.texel(i, j), expected, 1e-6) << axis << " " << i << " " << j;
      }
    }
  }
}

TEST(Triplanar, BlendsByTheFourthPowersOfTheNormal) {
  const HeightField image = someImage();
  const SurfaceFunction f = triplanar(image, 6);
  const Vec3 place(0.7, 2.2, 1.4);
  const double x = image.at({place.y, place.z});
  const double y = image.at({place.z, place.x});
  const double z = image.at({place.x, place.y});
  EXPECT_NEAR(f(place, {1, 0, 0}), x, 1e-12);
  EXPECT_NEAR(f(place, {0, 0, -1}), z, 1e-12);
  EXPECT_NEAR(f(place, glm::normalize(Vec3(1, -1, 1))), (x + y + z) / 3, 1e-12);
  const double tilt = radians(30);
  EXPECT_NEAR(f(place, {std::sin(tilt), 0, std::cos(tilt)}), 0.1 * x + 0.9 * z, 1e-12);
  EXPECT_NEAR(f(place, Vec3(0)), (x + y + z) / 3, 1e-12);
  EXPECT_GT(std::abs(x - z), 0.1);
}

TEST(Triplanar, IsContinuousWhereTheImageEnds) {
  const SurfaceFunction f = triplanar(someImage(), 6);
  constexpr double e = 1e-9;
  for (const double side : {-12.0, -6.0, 0.0, 3.0, 6.0, 9.0, 12.0}) {
    for (const double other : {0.3, 1.1, 2.8}) {
      const Vec3 normal(0, 0, 1);
      EXPECT_NEAR(f({side - e, other, 0}, normal), f({side + e, other, 0}, normal), 1e-8);
      EXPECT_NEAR(f({other, side - e, 0}, normal), f({other, side + e, 0}, normal), 1e-8);
    }
  }
}

TEST(Triplanar, RefusesPeriodsOutOfRange) {
  for (const double bad : {0.0, -1.0, 1e10}) {
    EXPECT_THAT(messageOf<InputError>([&] { (void)triplanar(someImage(), bad); }),
                StartsWith("period: "));
  }
}

}  // namespace
}  // namespace gnomon::relief
