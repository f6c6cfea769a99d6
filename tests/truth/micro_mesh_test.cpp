#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "common/error.h"
#include "surface/mesh_file.h"
#include "surface/texel_frame.h"
#include "truth/closed_mesh.h"
#include "truth/micro_mesh.h"
#include "truth/micro_scene.h"
#include "truth/shadow_tracer.h"
#include "truth/truth_scenes.h"

// Closed cages stay closed under any relief: across texture seams, creases, extraordinary vertices,
// and where the texture map is mirrored or has no area.

namespace gnomon::truth {
namespace {

using test::countEdges;
using test::cubeCage;
using test::EdgeCount;
using test::escapes;
using test::flatRelief;
using test::lightToward;
using test::randomRelief;
using test::samplesOfAllFaces;

MicroMeshSettings step(double texels) {
  return {texels, 0};
}

Vec3 vertexOf(const MicroMesh& mesh, std::size_t index) {
  return Vec3(mesh.coordinates()[3 * index], mesh.coordinates()[3 * index + 1],
              mesh.coordinates()[3 * index + 2]) +
         mesh.centre();
}

TEST(MicroMesh, PutsGridLinesOnTexelCentres) {
  const surface::LimitSurface surface(surface::makePlane(12, 8, 5, 3));
  const relief::Relief relief = flatRelief(12, 8);
  const MicroMesh mesh(surface, relief, step(0.3));
  for (int face = 0; face < surface.faceCount(); ++face) {
    const surface::FaceGrid& grid = mesh.grids().faces()[static_cast<std::size_t>(face)];
    const double begin = 12.0 / 5 * (face % 5);
    const double length = 12.0 / 5;
    const std::vector<double>& lines = mesh.grids().sLines(grid);
    for (double centre = std::floor(begin) + 0.5; centre < begin + length; centre += 1) {
      if (centre <= begin) continue;
      const double s = (centre - begin) / length;
      EXPECT_TRUE(std::any_of(lines.begin(), lines.end(),
                              [s](double line) { return std::abs(line - s) < 1e-12; }))
          << "no line at texel " << centre;
    }
    for (std::size_t k = 1; k < lines.size(); ++k) {
      EXPECT_GT(lines[k], lines[k - 1]);
      EXPECT_LE((lines[k] - lines[k - 1]) * length, 0.3 + 1e-9);
    }
  }
}

TEST(MicroMesh, VerticesAreDisplacedLimitPoints) {
  const surface::LimitSurface surface(surface::makeTorus(30, 10, 66, 66));
  const relief::Relief relief = randomRelief(64, 32, 2, 7);
  const MicroMesh mesh(surface, relief, step(0.5));
  const surface::FaceGrid& grid = mesh.grids().faces()[100];
  double worst = 0;
  for (int j = 0; j < grid.rows; ++j) {
    for (int i = 0; i < grid.columns; ++i) {
      const surface::LimitPoint point =
          surface.evaluate(100, mesh.grids().sLines(grid)[static_cast<std::size_t>(i)],
                           mesh.grids().tLines(grid)[static_cast<std::size_t>(j)]);
      const Vec3 expected =
          relief::displaced(relief, surface::texelFrame(point, relief.texelsPerUv()));
      const Vec3 found =
          vertexOf(mesh, grid.firstVertex +
                             static_cast<std::size_t>(j) * static_cast<std::size_t>(grid.columns) +
                             static_cast<std::size_t>(i));
      worst = std::max(worst, glm::length(found - expected));
    }
  }
  EXPECT_LT(worst, 1e-5);  // float coordinates of about 40
}

TEST(MicroMesh, ReachesTheAskedNumberOfTrianglesByDefault) {
  const surface::LimitSurface surface(surface::makePlane(32, 32, 4, 4));
  const MicroMesh mesh(surface, flatRelief(32, 32), {std::nullopt, 3e5});
  EXPECT_GE(mesh.triangleCount(), 300000U);
  EXPECT_LT(mesh.triangleCount(), 600000U);
}

/// The longest micro-edge along s or t, texels: all of them measured on the map.
double longestEdge(const surface::LimitSurface& surface, const relief::Relief& relief,
                   const MicroMesh& mesh) {
  double longest = 0;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const surface::FaceGrid& grid = mesh.grids().faces()[static_cast<std::size_t>(face)];
    const std::vector<double>& s = mesh.grids().sLines(grid);
    const std::vector<double>& t = mesh.grids().tLines(grid);
    const auto texel = [&](double atS, double atT) {
      return surface.tangentPoint(face, atS, atT).uv * relief.texelsPerUv();
    };
    for (std::size_t j = 0; j < t.size(); ++j) {
      for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec2 here = texel(s[i], t[j]);
        if (i > 0) longest = std::max(longest, glm::length(here - texel(s[i - 1], t[j])));
        if (j > 0) longest = std::max(longest, glm::length(here - texel(s[i], t[j - 1])));
      }
    }
  }
  return longest;
}

TEST(MicroMesh, StatesItsLongestMicroEdge) {
  const relief::Relief relief = randomRelief(128, 128, 0.01, 5);
  const surface::LimitSurface spot(
      surface::readMeshFile(GNOMON_SCENES "/meshes/spot_control_mesh.obj"));
  for (const double asked : {0.4, 1.7}) {
    const MicroMesh onSpot(spot, relief, step(asked));
    EXPECT_NEAR(onSpot.stepTexels(), longestEdge(spot, relief, onSpot), 1e-9);
    EXPECT_LE(onSpot.stepTexels(), asked + 1e-9);
    EXPECT_GT(onSpot.stepTexels(), 0.9 * asked) << "no finer than it has to be";
    EXPECT_EQ(onSpot.askedStepTexels(), asked);
    const surface::LimitSurface cube(cubeCage());
    const MicroMesh onCube(cube, relief, step(asked));
    EXPECT_NEAR(onCube.stepTexels(), longestEdge(cube, relief, onCube), 1e-9);
  }
  // Between lines of texel centres a step need not divide what there is.
  const surface::LimitSurface plane(surface::makePlane(12, 8, 4, 2));
  const MicroMesh onPlane(plane, flatRelief(12, 8), step(0.3));
  EXPECT_NEAR(onPlane.stepTexels(), longestEdge(plane, flatRelief(12, 8), onPlane), 1e-9);
  EXPECT_EQ(onPlane.stepTexels(), 0.25);
}

TEST(MicroMesh, LargerFacesGetMorePieces) {
  const surface::LimitSurface surface(
      surface::readMeshFile(GNOMON_SCENES "/meshes/spot_control_mesh.obj"));
  const relief::Relief relief = randomRelief(256, 256, 0.01, 5);
  const MicroMesh mesh(surface, relief, step(0.5));
  int fewest = std::numeric_limits<int>::max();
  int most = 0;
  std::uint64_t triangles = 0;
  for (const surface::FaceGrid& grid : mesh.grids().faces()) {
    fewest = std::min({fewest, grid.columns, grid.rows});
    most = std::max({most, grid.columns, grid.rows});
    triangles += 2 * static_cast<std::uint64_t>((grid.columns - 1) * (grid.rows - 1));
  }
  EXPECT_GT(most, 2 * fewest);
  EXPECT_EQ(mesh.triangleCount(), triangles);
  const auto whole = static_cast<std::uint64_t>(most - 1);
  EXPECT_LT(triangles, 2 * whole * whole * static_cast<std::uint64_t>(surface.faceCount()));
}

TEST(MicroMesh, HalfTheStepGivesAboutFourTimesTheTriangles) {
  // What the truth's own uncertainty rests on: the same everywhere, on small faces too.
  const surface::LimitSurface surface(
      surface::readMeshFile(GNOMON_SCENES "/meshes/spot_control_mesh.obj"));
  const relief::Relief relief = randomRelief(256, 256, 0.01, 5);
  const MicroMesh coarse(surface, relief, step(1));
  const MicroMesh fine(surface, relief, step(0.5));
  for (std::size_t face = 0; face < coarse.grids().faces().size(); ++face) {
    const surface::FaceGrid& half = coarse.grids().faces()[face];
    const surface::FaceGrid& whole = fine.grids().faces()[face];
    EXPECT_EQ(half.columns - 1, (whole.columns - 1 + 1) / 2);
    EXPECT_EQ(half.rows - 1, (whole.rows - 1 + 1) / 2);
  }
}

TEST(MicroMesh, ByDefaultTakesTheLargestStepThatGivesEnoughTriangles) {
  const surface::LimitSurface surface(
      surface::readMeshFile(GNOMON_SCENES "/meshes/spot_control_mesh.obj"));
  const relief::Relief relief = randomRelief(128, 128, 0.01, 5);
  constexpr double wanted = 5e6;
  const MicroMesh mesh(surface, relief, {std::nullopt, wanted});
  const double quarters = 1 / (4 * mesh.askedStepTexels());
  EXPECT_EQ(quarters, std::round(quarters));
  ASSERT_GT(quarters, 1) << "else there is no larger step to compare with";
  EXPECT_GE(mesh.triangleCount(), wanted);
  EXPECT_LT(MicroMesh(surface, relief, step(1 / (4 * (quarters - 1)))).triangleCount(), wanted);
}

TEST(MicroMesh, ClosedCageGivesClosedMeshAcrossSeams) {
  const surface::LimitSurface surface(cubeCage());
  const MicroMesh mesh(surface, randomRelief(16, 16, 1.5, 5), step(0.21));
  EXPECT_EQ(escapes(mesh, Vec3(0), 200000), 0);
}

TEST(MicroMesh, ClosedTorusGivesClosedMesh) {
  const surface::LimitSurface surface(surface::makeTorus(30, 10, 66, 66));
  const MicroMesh mesh(surface, randomRelief(64, 32, 2, 7), step(0.5));
  EXPECT_EQ(escapes(mesh, Vec3(30, 0, 0), 200000), 0);
}

TEST(MicroMesh, EveryEdgeOfAClosedMeshIsSharedByTwoTriangles) {
  // By position, bit for bit: what rays can only sample, an edge count proves.
  const surface::LimitSurface surface(cubeCage());
  const MicroMesh mesh(surface, randomRelief(16, 16, 1.5, 5), step(0.9));
  const EdgeCount edges = countEdges(mesh);
  EXPECT_GT(edges.all, 1000U);
  EXPECT_EQ(edges.open, 0U);
}

TEST(MicroMesh, FacetIsTheOneThatARayMeets) {
  // Random heights give cells that are far from flat: cut along the other diagonal, the facet would
  // lie elsewhere.
  const surface::LimitSurface surface(surface::makePlane(16, 16, 3, 3));
  const relief::Relief relief = randomRelief(16, 16, 3, 11);
  const MicroMesh mesh(surface, relief, step(0.5));
  const MicroScene scene(mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.001, 0.999);
  for (int k = 0; k < 5000; ++k) {
    const int face = static_cast<int>(random() % 9);
    const Facet facet = mesh.facet(face, uniform(random), uniform(random));
    const Vec3 above = facet.point + 1e-3 * facet.normal;
    const auto hit = scene.nearest(above, -facet.normal);
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(hit->distance, 1e-3, 1e-5);
    EXPECT_EQ(hit->face, face);
    EXPECT_GT(glm::dot(hit->normal, facet.normal), 1 - 1e-4);
  }
}

/// On edges and corners of facets neither rounding nor the place itself chooses, but the step.
TEST(MicroMesh, OnAnEdgeAStepChoosesTheFacet) {
  const surface::LimitSurface surface(surface::makePlane(8, 8, 2, 2));
  const MicroMesh mesh(surface, randomRelief(8, 8, 1, 5), step(0.5));
  const std::vector<double>& lines = mesh.grids().sLines(mesh.grids().faces()[0]);
  ASSERT_GE(lines.size(), 8U);
  const double spacing = lines[4] - lines[3];
  std::mt19937 random(7);
  std::uniform_real_distribution<double> rounding(-4e-7, 4e-7);
  std::uniform_real_distribution<double> turn(0, 2 * pi);
  // On a corner, on an edge of each direction, on a cell's diagonal, and inside of a facet.
  for (const Vec2 from : {Vec2(0, 0), Vec2(0.4, 0), Vec2(0, 0.4), Vec2(0.3, 0.7), Vec2(0.2, 0.3)}) {
    const Vec2 place = Vec2(lines[3]) + spacing * from;
    for (int k = 0; k < 100; ++k) {
      const double angle = turn(random);
      const Vec2 toward(std::cos(angle), std::sin(angle));
      const Vec2 beyond = place + 0.01 * spacing * toward;
      const Vec2 rounded = place + Vec2(rounding(random), rounding(random));
      EXPECT_EQ(mesh.facet(0, rounded.x, rounded.y, 3.0 * toward).normal,
                mesh.facet(0, beyond.x, beyond.y).normal)
          << from.x << ' ' << from.y << ' ' << angle;
    }
    // Without a step, and along the lines, where larger s or t decides.
    const Vec2 after = place + 0.01 * spacing;
    EXPECT_EQ(mesh.facet(0, place.x - 4e-7, place.y - 4e-7).normal,
              mesh.facet(0, after.x, after.y).normal);
    EXPECT_EQ(mesh.facet(0, place.x - 4e-7, place.y, Vec2(-1e-9, 1)).normal,
              mesh.facet(0, place.x + 0.001 * spacing, place.y + 0.01 * spacing).normal);
  }
}

TEST(MicroMesh, FacetLiesOnTheDisplacedSurfaceAsTheMeshGrowsFiner) {
  const surface::LimitSurface surface(surface::makeSphere(50, 1, 1, 16, 16));
  const relief::Relief relief = randomRelief(16, 16, 2, 3);
  const auto worstDistance = [&](double texels) {
    const MicroMesh mesh(surface, relief, step(texels));
    double worst = 0;
    for (int k = 0; k < 400; ++k) {
      const double s = (k % 20 + 0.37) / 20;
      const double t = (k / 20 + 0.61) / 20;
      const Vec3 exact = relief::displaced(
          relief, surface::texelFrame(surface.evaluate(k % 256, s, t), relief.texelsPerUv()));
      worst = std::max(worst, glm::length(mesh.facet(k % 256, s, t).point + mesh.centre() - exact));
    }
    return worst;
  };
  const double coarse = worstDistance(0.25);
  const double fine = worstDistance(0.125);
  // Second order in the step: kinks lie on micro-edges.
  EXPECT_LT(fine, coarse / 3);
}

TEST(MicroMesh, RefusesWhatCannotFit) {
  const surface::LimitSurface surface(surface::makePlane(16, 16, 2, 2));
  EXPECT_THROW(MicroMesh(surface, flatRelief(16, 16), step(1e-6)), MemoryError);
  EXPECT_THROW(MicroMesh(surface, flatRelief(16, 16), step(0)), InputError);
  // A face of 60,000 texels: more lines than Embree's grids can have.
  const surface::LimitSurface strip(surface::makePlane(16, 16, 1, 64));
  EXPECT_THROW(MicroMesh(strip, flatRelief(60000, 4), step(100)), InputError);
  EXPECT_THROW(MicroMesh(surface, flatRelief(16, 16), step(std::nan(""))), InputError);
}

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
