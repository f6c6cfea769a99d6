#include "surface/face_texels.h"

#include <gtest/gtest.h>

#include "surface/test_surfaces.h"

namespace gnomon::surface {
namespace {

/// One square, its corners at these places of the map.
LimitSurface squareOf(const std::vector<Vec2>& uvs) {
  Cage cage = openGrid(1, 1);
  cage.uvs = uvs;
  cage.faceUvs = {0, 1, 2, 3};
  return LimitSurface(cage);
}

TEST(FaceTexels, AreTheLongestLinesAndTheArea) {
  // A trapezoid: 4 along its base, 2 along its top, sides 3 and √(2² + 3²).
  const LimitSurface surface = squareOf({{0, 0}, {4, 0}, {2, 3}, {0, 3}});
  const FaceTexels face = faceTexels(surface, Vec2(10, 10), 0);
  EXPECT_NEAR(face.s, 40, 1e-9);
  EXPECT_NEAR(face.t, 10 * std::sqrt(13), 1e-9);
  EXPECT_NEAR(face.area, 900, 1e-9);
  EXPECT_NEAR(longestEdgeTexels(surface, Vec2(10, 10)), 40, 1e-9);
  EXPECT_NEAR(longestEdgeTexels(surface, Vec2(1, 10)), std::sqrt(4 + 900), 1e-9);
}

TEST(FaceTexels, NoLineInsideIsLonger) {
  const LimitSurface surface = squareOf({{0, 0}, {4, 1}, {3, 5}, {-1, 2}});
  const FaceTexels face = faceTexels(surface, Vec2(1), 0);
  for (double at = 0; at <= 1; at += 0.125) {
    EXPECT_LE(glm::length(surface.tangentPoint(0, 0.5, at).uvDs), face.s + 1e-12);
    EXPECT_LE(glm::length(surface.tangentPoint(0, at, 0.5).uvDt), face.t + 1e-12);
  }
}

TEST(FaceTexels, MirroredFacesHaveThePositiveArea) {
  const LimitSurface surface = squareOf({{4, 0}, {0, 0}, {0, 3}, {4, 3}});
  EXPECT_NEAR(faceTexels(surface, Vec2(1), 0).area, 12, 1e-12);
}

}  // namespace
}  // namespace gnomon::surface
