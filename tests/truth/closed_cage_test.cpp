// Closed cages stay closed under any relief: across texture seams, creases, extraordinary vertices,
// and where the texture map is mirrored or has no area.

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "surface/mesh_file.h"
#include "surface/texel_frame.h"
#include "truth/closed_mesh.h"
#include "truth/shadow_tracer.h"
#include "truth/truth_scenes.h"

namespace gnomon::truth {
namespace {

using test::countEdges;
using test::cubeCage;
using test::EdgeCount;
using test::escapes;
using test::lightToward;
using test::randomRelief;
using test::samplesOfAllFaces;

void expectClosed(const MicroMesh& mesh, const Vec3& inside) {
  const EdgeCount edges = countEdges(mesh);
  EXPECT_GT(edges.all, 1000U);
  EXPECT_EQ(edges.open, 0U);
  EXPECT_EQ(escapes(mesh, inside, 50000), 0);
}

surface::Cage spot() {
  return surface::readMeshFile(GNOMON_SCENES "/meshes/spot_control_mesh.obj");
}

TEST(ClosedCage, SpotLeaksNoRayFromAnyPartOfItsBody) {
  const surface::LimitSurface surface(spot());
  relief::Relief relief = randomRelief(128, 128, 0.04, 5);
  for (const relief::HeightSpace space :
       {relief::HeightSpace::world, relief::HeightSpace::texture}) {
    relief.space = space;
    const MicroMesh mesh(surface, relief, {0.5, 0});
    expectClosed(mesh, Vec3(0, 0.1, 0.3));
    EXPECT_EQ(escapes(mesh, Vec3(0, 0.45, -0.4), 20000), 0);  // the head
  }
}

TEST(ClosedCage, HeightsDifferAcrossSpotsSeams) {
  // Else the test above would show nothing of seams: neighbours' own heights on common edges.
  const surface::LimitSurface surface(spot());
  const relief::Relief relief = randomRelief(128, 128, 0.04, 5);
  int jumps = 0;
  std::map<std::pair<int, int>, Vec3> middles;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const std::array<int, 4> corners = surface.corners(face);
    const std::array<Vec2, 4> sides = {Vec2(0.5, 0), Vec2(1, 0.5), Vec2(0.5, 1), Vec2(0, 0.5)};
    for (std::size_t side = 0; side < 4; ++side) {
      const Vec3 middle = relief::displaced(
          relief, surface::texelFrame(surface.evaluate(face, sides[side].x, sides[side].y),
                                      relief.texelsPerUv()));
      const auto [entry, first] =
          middles.try_emplace(std::minmax(corners[side], corners[(side + 1) % 4]), middle);
      jumps += !first && glm::length(entry->second - middle) > 1e-3 ? 1 : 0;
    }
  }
  EXPECT_GT(jumps, 50);
  EXPECT_LT(jumps, surface.faceCount());  // and most edges are none
}

TEST(ClosedCage, TrianglesOfLoopStayClosed) {
  surface::Cage cage;
  cage.scheme = surface::SubdivisionScheme::loop;
  cage.positions = {{8, 0, 0}, {-8, 0, 0}, {0, 8, 0}, {0, -8, 0}, {0, 0, 8}, {0, 0, -8}};
  cage.faceVertices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  cage.uvs = {{0, 0}, {1, 0}, {0, 1}};
  for (int corner = 0; corner < 24; ++corner) cage.faceUvs.push_back(corner % 3);
  expectClosed(MicroMesh(surface::LimitSurface(cage), randomRelief(16, 16, 1, 5), {0.3, 0}),
               Vec3(0));
}

TEST(ClosedCage, FacesOfUnequalSizeStayClosed) {
  // One side of the cube has five times the texels along s, another three times along t.
  surface::Cage cage = cubeCage();
  cage.uvs.insert(cage.uvs.end(), {{5, 0}, {5, 1}, {1, 3}, {0, 3}});
  cage.faceUvs[1] = 4;
  cage.faceUvs[2] = 5;
  cage.faceUvs[4 * 3 + 2] = 6;
  cage.faceUvs[4 * 3 + 3] = 7;
  const MicroMesh mesh(surface::LimitSurface(cage), randomRelief(16, 16, 1.5, 5), {0.5, 0});
  const auto hasSide = [&](int vertices) {
    return std::any_of(
        mesh.grids().faces().begin(), mesh.grids().faces().end(),
        [vertices](const auto& grid) { return grid.columns == vertices || grid.rows == vertices; });
  };
  EXPECT_TRUE(hasSide(2 * 16 + 1));
  EXPECT_TRUE(hasSide(2 * 5 * 16 + 1));
  EXPECT_TRUE(hasSide(2 * 3 * 16 + 1));
  expectClosed(mesh, Vec3(0));
}

TEST(ClosedCage, CreasesStayClosed) {
  surface::Cage cage = cubeCage();
  cage.creases = {{{0, 1}, 10}, {{1, 3}, 10}, {{3, 2}, 2.5}};
  cage.sharpVertices = {{7, 10}};
  expectClosed(MicroMesh(surface::LimitSurface(cage), randomRelief(16, 16, 1.5, 5), {0.3, 0}),
               Vec3(0));
}

/// A cube whose faces' texture maps are, one each: mirrored, without area, folded along a diagonal,
/// with two corners in one place; the other two are sound.
surface::Cage badlyUnwrappedCube() {
  surface::Cage cage = cubeCage();
  cage.faceUvs = {1, 0, 3, 2, 0, 0, 0, 0, 0, 1, 2, 1, 0, 1, 2, 2, 0, 1, 2, 3, 0, 1, 2, 3};
  return cage;
}

TEST(ClosedCage, BadTextureMapsStayClosedAndFinite) {
  const surface::LimitSurface surface(badlyUnwrappedCube());
  relief::Relief relief = randomRelief(16, 16, 1.5, 5);
  for (const relief::HeightSpace space :
       {relief::HeightSpace::world, relief::HeightSpace::texture}) {
    relief.space = space;
    // Where a map folds, a texel is endlessly large: heights in texels are too. World heights are
    // not.
    const MicroMesh mesh(surface, relief, {0.3, 0});
    for (const float coordinate : mesh.coordinates()) ASSERT_TRUE(std::isfinite(coordinate));
    if (space == relief::HeightSpace::world) expectClosed(mesh, Vec3(0));
  }
}

TEST(ClosedCage, SamplesWithoutAFrameAreUndefinedAndCounted) {
  const surface::LimitSurface surface(badlyUnwrappedCube());
  const relief::Relief relief = randomRelief(16, 16, 1.5, 5);
  const MicroMesh mesh(surface, relief, {0.3, 0});
  const MicroScene scene(mesh);
  constexpr int side = 8;
  const surface::SampleGrid samples = samplesOfAllFaces(surface, side);
  const Truth truth =
      traceShadows(surface, relief, mesh, scene, samples, TraceSettings{{lightToward(20, 30)}});
  std::size_t undefined = 0;
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const surface::SurfaceSample& sample = samples.samples[i];
    const surface::TexelFrame frame =
        surface::texelFrame(surface.evaluate(sample), relief.texelsPerUv());
    for (const Vec3& vector : {frame.normal, frame.px, frame.py}) {
      ASSERT_TRUE(std::isfinite(glm::dot(vector, vector)));
    }
    EXPECT_EQ(truth.mask.samples[i] == Shade::none, !frame.defined);
    EXPECT_EQ(truth.regions[i] == Region::none, !frame.defined);
    undefined += frame.defined ? 0 : 1;
  }
  // The face without area, and the diagonal along which the folded one turns.
  EXPECT_EQ(truth.undefinedSamples, undefined);
  EXPECT_GE(undefined, std::size_t{side * side});
  EXPECT_LE(undefined, std::size_t{side * side + side});
}

TEST(ClosedCage, PolesAreFinite) {
  // A face of which one side has no length: P_s vanishes on it, and there alone no frame exists.
  surface::Cage cage = surface::makePlane(8, 8, 2, 2);
  for (Vec3& position : cage.positions) position.x *= (position.y + 4) / 8;
  const surface::LimitSurface surface(cage);
  for (int face = 0; face < surface.faceCount(); ++face) {
    for (const double s : {0.0, 0.3, 1.0}) {
      for (const double t : {0.0, 1e-9, 0.5}) {
        const surface::TexelFrame frame =
            surface::texelFrame(surface.evaluate(face, s, t), Vec2(16));
        for (const Vec3& vector : {frame.position, frame.normal, frame.px, frame.py}) {
          EXPECT_TRUE(std::isfinite(glm::dot(vector, vector)));
        }
        EXPECT_EQ(frame.defined, t > 0 || face >= 2);
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::truth
