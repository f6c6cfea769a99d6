#include "surface/texel_frame.h"

#include <cmath>

#include "surface/cage/shapes.h"
#include "surface/test_surfaces.h"

namespace gnomon::surface {
namespace {

/// A flat face spanned by a and b, whose uv map has the given derivatives.
LimitPoint flatPoint(const Vec3& a, const Vec3& b, Vec2 uvDs, Vec2 uvDt) {
  LimitPoint point{};
  point.position = {1, 2, 3};
  point.ds = a;
  point.dt = b;
  point.uv = {0.25, 0.5};
  point.uvDs = uvDs;
  point.uvDt = uvDt;
  return point;
}

void expectReconstructs(const TexelFrame& frame, const Vec3& light) {
  const LocalLight local = localLight(frame, light);
  // ℓ's length follows from σ: the tangential part of L is |ℓ| σ long.
  const double rise = glm::dot(light, frame.normal);
  const double run = glm::length(light - rise * frame.normal);
  const Vec2 l = local.direction * run / local.worldPerTexel;
  expectNear(l.x * frame.px + l.y * frame.py + rise * frame.normal, light, 1e-10, "light");
  EXPECT_NEAR(glm::length(local.direction), 1, 1e-14);
  EXPECT_NEAR(std::cos(local.azimuth()), local.direction.x, 1e-14);
  EXPECT_NEAR(std::sin(local.azimuth()), local.direction.y, 1e-14);
  EXPECT_NEAR(local.slope, rise / run, 1e-12 * (1 + std::abs(local.slope)));
}

TEST(TexelFrame, OfThePlane) {
  const LimitSurface surface(makePlane(4, 2, 8, 4));
  const TexelFrame frame = texelFrame(surface.evaluate(11, 0.5, 0.25), {128, 32});
  ASSERT_TRUE(frame.defined);
  expectNear(frame.px, {4.0 / 128, 0, 0}, 1e-15);
  expectNear(frame.py, {0, 2.0 / 32, 0}, 1e-15);
  expectNear(frame.normal, {0, 0, 1}, 1e-15);
  EXPECT_NEAR(frame.texel.x, 128 * 3.5 / 8, 1e-12);
  EXPECT_NEAR(frame.texel.y, 32 * 1.25 / 4, 1e-12);
}

TEST(TexelFrame, ObeysTheChainRule) {
  Random random(9);
  for (int i = 0; i < 500; ++i) {
    const LimitPoint point =
        flatPoint(random.vector(), random.vector(), {random(-1, 1), random(-1, 1)},
                  {random(-1, 1), random(-1, 1)});
    const Vec2 scale(random(1, 100), random(1, 100));
    const TexelFrame frame = texelFrame(point, scale);
    ASSERT_TRUE(frame.defined);
    const Vec2 xyS = point.uvDs * scale;
    const Vec2 xyT = point.uvDt * scale;
    const double size = 1 + glm::length(frame.px * xyS.x) + glm::length(frame.py * xyS.y);
    expectNear(frame.px * xyS.x + frame.py * xyS.y, point.ds, 1e-11 * size);
    expectNear(frame.px * xyT.x + frame.py * xyT.y, point.dt, 1e-11 * size);
  }
}

TEST(TexelFrame, ShearedAndStretchedClosedForm) {
  // P = a s + b t with x = 10 s + 5 t, y = 20 t: so s = x/10 - y/40, t = y/20.
  const Vec3 a(3, 0, 0), b(1, 2, 0);
  const TexelFrame frame = texelFrame(flatPoint(a, b, {10, 0}, {5, 20}), {1, 1});
  ASSERT_TRUE(frame.defined);
  expectNear(frame.px, a / 10.0, 1e-15);
  expectNear(frame.py, b / 20.0 - a / 40.0, 1e-15);
}

TEST(TexelFrame, MirroredTextureKeepsTheOutwardNormal) {
  const TexelFrame frame = texelFrame(flatPoint({2, 0, 0}, {0, 2, 0}, {-1, 0}, {0, 1}), {8, 8});
  ASSERT_TRUE(frame.defined);
  expectNear(frame.normal, {0, 0, 1}, 1e-15);
  expectNear(frame.px, {-0.25, 0, 0}, 1e-15);
  EXPECT_LT(glm::dot(glm::cross(frame.px, frame.py), frame.normal), 0);  // left-handed tangents
  expectReconstructs(frame, glm::normalize(Vec3(0.3, 0.5, 0.7)));
  EXPECT_LT(localLight(frame, glm::normalize(Vec3(1, 0, 1))).direction.x, 0);
}

TEST(TexelFrame, DegenerateIsUndefinedAndKeepsTheSurfacesNormal) {
  const Vec3 a(1, 0, 0), b(0, 1, 0);
  for (const LimitPoint& point :
       {flatPoint(a, b, {0, 0}, {0, 1}), flatPoint(a, b, {1, 2}, {2, 4}),
        flatPoint(a, 2.0 * a, {1, 0}, {0, 1}), flatPoint({}, b, {1, 0}, {0, 1})}) {
    const TexelFrame frame = texelFrame(point, {64, 64});
    EXPECT_FALSE(frame.defined);
    EXPECT_EQ(frame.px, Vec3(0));
    EXPECT_EQ(frame.py, Vec3(0));
    EXPECT_EQ(frame.normal, outwardNormal(point));
    EXPECT_EQ(frame.position, Vec3(1, 2, 3));
    EXPECT_EQ(frame.texel, Vec2(16, 32));
  }
  EXPECT_FALSE(texelFrame(flatPoint(a, b, {1, 0}, {0, 1}), {0, 64}).defined);
}

TEST(LocalLight, ReconstructsTheLightInAnyFrame) {
  Random random(10);
  for (int i = 0; i < 500; ++i) {
    const TexelFrame frame =
        texelFrame(flatPoint(random.vector(), random.vector(), {random(0.2, 1), random(-1, 1)},
                             {random(-1, 1), random(-1, 1)}),
                   {32, 64});
    // Skip frames so thin that rounding, not the formula, would be tested.
    const double sine = glm::length(glm::cross(frame.px, frame.py)) /
                        (glm::length(frame.px) * glm::length(frame.py));
    if (!(sine > 0.01)) continue;
    expectReconstructs(frame, glm::normalize(random.vector()));
  }
}

TEST(LocalLight, ClosedFormOnAnAnisotropicFrame) {
  // One texel is 3 wide and 1 high: a light at 45° in the world stands at (1/3, 1) in texels.
  const TexelFrame frame = texelFrame(flatPoint({3, 0, 0}, {0, 1, 0}, {1, 0}, {0, 1}), {1, 1});
  const LocalLight local = localLight(frame, glm::normalize(Vec3(1, 1, 1)));
  EXPECT_NEAR(local.azimuth(), std::atan2(1, 1.0 / 3), 1e-15);
  EXPECT_NEAR(local.slope, 1 / std::sqrt(2), 1e-15);
  EXPECT_NEAR(local.worldPerTexel, std::sqrt(2) / std::hypot(1.0 / 3, 1), 1e-14);
}

TEST(LocalLight, ClosedFormOnAShearedFrame) {
  // P_x = (1,0,0), P_y = (1,1,0): L's tangential part (0,1,0) is P_y - P_x.
  const TexelFrame frame = texelFrame(flatPoint({1, 0, 0}, {1, 1, 0}, {1, 0}, {0, 1}), {1, 1});
  const LocalLight local = localLight(frame, glm::normalize(Vec3(0, 1, 2)));
  EXPECT_NEAR(local.azimuth(), 3 * pi / 4, 1e-15);
  EXPECT_NEAR(local.slope, 2, 1e-14);
  EXPECT_NEAR(local.worldPerTexel, 1 / std::sqrt(2), 1e-15);
}

TEST(LocalLight, AlongTheNormal) {
  const TexelFrame frame = texelFrame(flatPoint({3, 1, 0}, {0, 1, 2}, {1, 0}, {0, 1}), {1, 1});
  for (const double side : {1.0, -1.0}) {
    const LocalLight local = localLight(frame, side * frame.normal);
    EXPECT_EQ(local.direction, Vec2(1, 0));
    EXPECT_EQ(local.azimuth(), 0);
    EXPECT_TRUE(std::isinf(local.slope));
    EXPECT_EQ(std::signbit(local.slope), side < 0);
    EXPECT_DOUBLE_EQ(local.worldPerTexel, glm::length(frame.px));
  }
}

TEST(LocalLight, BelowTheHorizonHasNegativeSlope) {
  const TexelFrame frame = texelFrame(flatPoint({1, 0, 0}, {0, 1, 0}, {1, 0}, {0, 1}), {1, 1});
  EXPECT_NEAR(localLight(frame, glm::normalize(Vec3(1, 0, -2))).slope, -2, 1e-14);
}

}  // namespace
}  // namespace gnomon::surface
