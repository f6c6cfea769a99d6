#include "surface/closed_surface.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "surface/cage/shapes.h"
#include "surface/mesh_file.h"
#include "surface/test_surfaces.h"

namespace gnomon::surface {
namespace {

/// The same cage with its inside out: every face's corners in the other order.
Cage turnedInsideOut(Cage cage) {
  for (std::size_t corner = 0; corner < cage.faceVertices.size(); corner += 4) {
    std::swap(cage.faceVertices[corner + 1], cage.faceVertices[corner + 3]);
    std::swap(cage.faceUvs[corner + 1], cage.faceUvs[corner + 3]);
  }
  cage.grid.reset();
  return cage;
}

/// A cube whose edges are creases, so that its limit surface is the cube itself, moved away.
Cage sharpCube() {
  Cage cage = cubeCage();
  for (int a = 0; a < 8; ++a) {
    for (const int axis : {1, 2, 4}) {
      if ((a & axis) == 0) cage.creases.push_back({{a, a | axis}, 10});
    }
    cage.sharpVertices.push_back({a, 10});
  }
  for (Vec3& position : cage.positions) position = Vec3(3, 4, 5) * position + Vec3(1000, -200, 7);
  return cage;
}

TEST(ClosedSurface, HasNoBorder) {
  EXPECT_TRUE(isClosed(LimitSurface(cubeCage())));
  EXPECT_TRUE(isClosed(LimitSurface(makeTorus(30, 10, 66, 58))));
  EXPECT_TRUE(isClosed(LimitSurface(readMeshFile(GNOMON_SCENES "/meshes/spot_control_mesh.obj"))));
  EXPECT_FALSE(isClosed(LimitSurface(openGrid(3, 2))));
  Cage open = cubeCage();
  open.faceVertices.resize(4 * 5);
  open.faceUvs.resize(4 * 5);
  EXPECT_FALSE(isClosed(LimitSurface(open)));
}

TEST(ClosedSurface, EnclosesTheVolumeOfABox) {
  EXPECT_NEAR(enclosedVolume(LimitSurface(sharpCube())), 6 * 8 * 10, 1e-6);
  EXPECT_NEAR(enclosedVolume(LimitSurface(turnedInsideOut(sharpCube()))), -6 * 8 * 10, 1e-6);
}

TEST(ClosedSurface, EnclosesTheVolumeOfATorus) {
  // Pappus: 2 π R · π r². The polyhedron lies inside by the sagitta of its faces.
  const double volume = 2 * pi * 30 * pi * 10 * 10;
  const double found = enclosedVolume(LimitSurface(makeTorus(30, 10, 66, 58)));
  EXPECT_LT(found, volume);
  EXPECT_GT(found, 0.99 * volume);
}

TEST(ClosedSurface, TurnedInsideOutItEnclosesLessThanNothing) {
  const Cage spot = readMeshFile(GNOMON_SCENES "/meshes/spot_control_mesh.obj");
  const double volume = enclosedVolume(LimitSurface(spot));
  EXPECT_GT(volume, 0);
  EXPECT_NEAR(enclosedVolume(LimitSurface(turnedInsideOut(spot))), -volume, 1e-6 * volume);
}

}  // namespace
}  // namespace gnomon::surface
