#include "relief/patch_border.h"

#include <gtest/gtest.h>

#include "surface/cage/shapes.h"

namespace gnomon::relief {
namespace {

/// As from a file, which tells no grid.
surface::Cage quad() {
  surface::Cage cage;
  cage.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  cage.faceVertices = {0, 1, 2, 3};
  cage.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  cage.faceUvs = {0, 1, 2, 3};
  return cage;
}

TEST(DefaultWrap, ClampsOpenMeshesThatTheMapIsLaidOverOnce) {
  EXPECT_EQ(defaultWrap(quad(), Vec2(1)), Wrap::clamp);
  EXPECT_EQ(defaultWrap(quad(), Vec2(2, 1)), Wrap::repeat) << "laid twice";
  EXPECT_EQ(defaultWrap(surface::makePlane(8, 8, 4, 4), Vec2(1)), Wrap::repeat)
      << "a shape knows its border";
  surface::Cage torus = surface::makeTorus(30, 10, 66, 58);
  torus.grid.reset();
  EXPECT_EQ(defaultWrap(torus, Vec2(1)), Wrap::repeat) << "closed";
  surface::Cage twoSided = quad();
  twoSided.faceVertices.insert(twoSided.faceVertices.end(), {3, 2, 1, 0});
  twoSided.faceUvs.insert(twoSided.faceUvs.end(), {3, 2, 1, 0});
  EXPECT_EQ(defaultWrap(twoSided, Vec2(1)), Wrap::repeat) << "closed, of two faces";
}

}  // namespace
}  // namespace gnomon::relief
