#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include "common/error.h"
#include "displaced/displaced_mesh.h"
#include "relief/patterns.h"
#include "support/error_messages.h"
#include "surface/texel_frame.h"
#include "truth/truth_scenes.h"

namespace gnomon::displaced {
namespace {

using test::cubeCage;
using test::flatRelief;
using test::randomRelief;
using ::testing::HasSubstr;

/// A position to the bit.
using Place = std::tuple<double, double, double>;

Place placeOf(const DisplacedMesh& mesh, std::uint32_t vertex) {
  const Vec3& p = mesh.mesh.vertices[vertex].frame.position;
  return {p.x, p.y, p.z};
}

std::array<std::uint32_t, 3> cornersOf(const DisplacedMesh& mesh, std::size_t triangle) {
  return {mesh.mesh.triangles[3 * triangle], mesh.mesh.triangles[3 * triangle + 1],
          mesh.mesh.triangles[3 * triangle + 2]};
}

/// The corner opposite to each directed side, by the places of the side's ends.
std::map<std::pair<Place, Place>, Place> sidesOf(const DisplacedMesh& mesh) {
  std::map<std::pair<Place, Place>, Place> sides;
  for (std::size_t triangle = 0; triangle < mesh.mesh.triangleCount(); ++triangle) {
    const auto corners = cornersOf(mesh, triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::pair side(placeOf(mesh, corners.at(k)), placeOf(mesh, corners.at((k + 1) % 3)));
      EXPECT_TRUE(sides.emplace(side, placeOf(mesh, corners.at((k + 2) % 3))).second);
    }
  }
  return sides;
}

/// Every side's opposite vertex is the neighbour's third corner, or the own one at a border.
/// @returns the number of border sides
std::size_t expectAdjacency(const DisplacedMesh& mesh) {
  const auto sides = sidesOf(mesh);
  EXPECT_EQ(mesh.adjacency.size(), 6 * mesh.mesh.triangleCount());
  std::size_t borders = 0;
  for (std::size_t triangle = 0; triangle < mesh.mesh.triangleCount(); ++triangle) {
    const auto corners = cornersOf(mesh, triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(mesh.adjacency[6 * triangle + 2 * k], corners.at(k));
      const std::uint32_t opposite = mesh.adjacency[6 * triangle + 2 * k + 1];
      const auto neighbour =
          sides.find({placeOf(mesh, corners.at((k + 1) % 3)), placeOf(mesh, corners.at(k))});
      if (neighbour == sides.end()) {
        ++borders;
        EXPECT_EQ(opposite, corners.at((k + 2) % 3));
      } else {
        EXPECT_EQ(placeOf(mesh, opposite), neighbour->second);
      }
    }
  }
  return borders;
}

TEST(DisplacedMesh, VerticesAreTheDisplacedPointsOfTheLimitSurface) {
  for (const relief::HeightSpace space :
       {relief::HeightSpace::world, relief::HeightSpace::texture}) {
    relief::Relief relief = randomRelief(96, 66, 2, 3);
    relief.space = space;
    relief.repeats = Vec2(2, 1);
    const surface::LimitSurface surface(surface::makeTorus(30, 10, 64, 60));
    const DisplacedMesh mesh = makeDisplacedMesh(surface, relief, 4);
    double highest = 0;
    for (const surface::BaseVertex& v : mesh.mesh.vertices) {
      const surface::LimitPoint point = surface.evaluate(v.face, v.st.x, v.st.y);
      const surface::TexelFrame frame = surface::texelFrame(point, relief.texelsPerUv());
      // Where the texture's two ends meet the first face's height rules: 0 and 192 are alike, since
      // the map repeats.
      const Vec3 expected = point.position + relief::worldPerHeight(space, frame) *
                                                 relief.field.at(frame.texel) * frame.normal;
      ASSERT_LT(glm::length(v.frame.position - expected), 1e-6);
      highest = std::max(highest, glm::length(v.frame.position - point.position));
    }
    EXPECT_GT(highest, 1);
  }
}

TEST(DisplacedMesh, AllButPositionsIsTheUndisplacedMeshs) {
  const relief::Relief relief = randomRelief(32, 32, 2, 3);
  const surface::LimitSurface surface(surface::makeSphere(40, 1, 1, 16, 16));
  const DisplacedMesh mesh = makeDisplacedMesh(surface, relief, 3);
  const surface::BaseMesh base = surface::makeBaseMesh(surface, relief.texelsPerUv(), 3);
  ASSERT_EQ(mesh.mesh.vertices.size(), base.vertices.size());
  EXPECT_EQ(mesh.mesh.triangles, base.triangles);
  for (std::size_t i = 0; i < base.vertices.size(); ++i) {
    const surface::BaseVertex& a = mesh.mesh.vertices[i];
    const surface::BaseVertex& b = base.vertices[i];
    ASSERT_EQ(std::tie(a.frame.normal, a.frame.px, a.frame.py, a.frame.texel, a.face, a.st,
                       a.curvatures.k1, a.curvatures.k2),
              std::tie(b.frame.normal, b.frame.px, b.frame.py, b.frame.texel, b.face, b.st,
                       b.curvatures.k1, b.curvatures.k2));
  }
}

TEST(DisplacedMesh, HasThePapersNumberOfPolygons) {
  const surface::LimitSurface surface(surface::makePlane(24, 20, 24, 20));
  EXPECT_EQ(makeDisplacedMesh(surface, flatRelief(24, 20), 1).mesh.triangleCount(), 960U);
  EXPECT_EQ(makeDisplacedMesh(surface, flatRelief(24, 20), 9).mesh.triangleCount(), 77760U);
}

TEST(DisplacedMesh, OfAClosedCageIsWatertightAcrossTextureSeams) {
  const surface::LimitSurface surface(cubeCage());
  for (const int subdivisions : {1, 2, 7}) {
    const DisplacedMesh mesh = makeDisplacedMesh(surface, randomRelief(16, 16, 1, 5), subdivisions);
    EXPECT_EQ(expectAdjacency(mesh), 0U);
    // Euler: V - E + F = 2, with 3 F = 2 E.
    std::set<Place> places;
    for (const std::uint32_t vertex : mesh.mesh.triangles) places.insert(placeOf(mesh, vertex));
    EXPECT_EQ(2 * places.size(), 4 + mesh.mesh.triangleCount());
  }
}

TEST(DisplacedMesh, NeighboursOfATorusMeetAcrossItsSeams) {
  const surface::LimitSurface surface(surface::makeTorus(30, 10, 58, 58));
  EXPECT_EQ(expectAdjacency(makeDisplacedMesh(surface, randomRelief(96, 66, 2, 3), 2)), 0U);
}

TEST(DisplacedMesh, RimOfAnOpenPatchSeesItsOwnTriangle) {
  const surface::LimitSurface surface(surface::makePlane(12, 8, 3, 2));
  const DisplacedMesh mesh = makeDisplacedMesh(surface, randomRelief(12, 8, 1, 9), 4);
  EXPECT_EQ(expectAdjacency(mesh), 2U * (3 + 2) * 4);
}

TEST(DisplacedMesh, NeighboursSeeEachOther) {
  const surface::LimitSurface surface(cubeCage());
  const DisplacedMesh mesh = makeDisplacedMesh(surface, randomRelief(16, 16, 1, 5), 3);
  // The pairs (own third corner, opposite vertex) come once in each of both orders.
  std::map<std::tuple<Place, Place>, int> seen;
  for (std::size_t triangle = 0; triangle < mesh.mesh.triangleCount(); ++triangle) {
    const auto corners = cornersOf(mesh, triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      ++seen[{placeOf(mesh, corners.at((k + 2) % 3)),
              placeOf(mesh, mesh.adjacency[6 * triangle + 2 * k + 1])}];
    }
  }
  for (const auto& [pair, count] : seen) {
    const auto& [own, other] = pair;
    EXPECT_EQ(seen.at({other, own}), count);
  }
}

TEST(DisplacedMesh, FirstFacesHeightRulesASeam) {
  const surface::LimitSurface surface(cubeCage());
  const relief::Relief relief = randomRelief(16, 16, 1, 5);
  const DisplacedMesh mesh = makeDisplacedMesh(surface, relief, 4);
  const auto faceVertices = 5U * 5U;
  std::size_t moved = 0;
  for (std::size_t i = 0; i < mesh.mesh.vertices.size(); ++i) {
    const surface::BaseVertex& v = mesh.mesh.vertices[i];
    const surface::TexelFrame frame =
        surface::texelFrame(surface.evaluate(v.face, v.st.x, v.st.y), relief.texelsPerUv());
    const bool own = glm::length(v.frame.position - relief::displaced(relief, frame)) < 1e-9;
    if (i < faceVertices) {
      EXPECT_TRUE(own);
    }
    moved += own ? 0 : 1;
  }
  // Along an edge of which both sides run over the map alike heights agree; at corners the map's
  // four do, since it repeats. At most: every inner vertex of an edge, once.
  EXPECT_GT(moved, 0U);
  EXPECT_LE(moved, 12U * 3);
}

/// The directed sides of all triangles, each of which may be there once.
std::set<std::pair<std::uint32_t, std::uint32_t>> sidesOf(const WeldedMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const std::size_t next = k % 3 == 2 ? k - 2 : k + 1;
    EXPECT_TRUE(sides.emplace(mesh.triangles[k], mesh.triangles[next]).second);
  }
  return sides;
}

/// Sides without one in the opposite direction.
std::ptrdiff_t openSides(const WeldedMesh& mesh) {
  const auto sides = sidesOf(mesh);
  return std::count_if(sides.begin(), sides.end(), [&](const auto& side) {
    return !sides.contains({side.second, side.first});
  });
}

TEST(WeldedMesh, OfAPlaneIsItsGrid) {
  const surface::LimitSurface surface(surface::makePlane(12, 8, 4, 2));
  const WeldedMesh mesh = makeWeldedMesh(surface, flatRelief(4, 2), 3);
  EXPECT_EQ(mesh.vertices.size(), (4 * 3 + 1) * (2 * 3 + 1));
  EXPECT_EQ(mesh.triangleCount(), 4 * 2 * 3 * 3 * 2);
  EXPECT_FALSE(mesh.closed);
  EXPECT_EQ(openSides(mesh), 2 * (4 + 2) * 3);
  double area = 0;
  for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) {
    const glm::vec3 a = mesh.vertices[mesh.triangles[k]];
    const glm::vec3 n = glm::cross(mesh.vertices[mesh.triangles[k + 1]] - a,
                                   mesh.vertices[mesh.triangles[k + 2]] - a);
    EXPECT_GT(n.z, 0);
    area += n.z / 2;
  }
  EXPECT_NEAR(area, 12 * 8, 1e-4);
  // As the truth's cells, the first is cut from (1, 0) to (0, 1).
  EXPECT_EQ(std::vector(mesh.triangles.begin(), mesh.triangles.begin() + 6),
            (std::vector<std::uint32_t>{0, 1, 4, 5, 4, 1}));
}

TEST(WeldedMesh, OfAClosedSurfaceIsClosedAcrossSeams) {
  const surface::LimitSurface surface(cubeCage());
  const relief::Relief relief = randomRelief(5, 5, 2, 7);
  for (const int pieces : {1, 2, 7}) {
    const WeldedMesh mesh = makeWeldedMesh(surface, relief, pieces);
    EXPECT_TRUE(mesh.closed);
    EXPECT_EQ(openSides(mesh), 0);
    // Euler: V - E + F = 2, with 3 F = 2 E.
    EXPECT_EQ(mesh.vertices.size(), 2 + mesh.triangleCount() / 2);
    std::set<std::uint32_t> used(mesh.triangles.begin(), mesh.triangles.end());
    EXPECT_EQ(used.size(), mesh.vertices.size());
    EXPECT_EQ(*used.rbegin() + 1, mesh.vertices.size());
  }
}

TEST(WeldedMesh, EveryVertexIsTheDisplacedPoint) {
  const surface::LimitSurface surface(surface::makeCylinder(10, 1.5, 12, 15, 3));
  relief::Relief relief = randomRelief(30, 12, 2, 3);
  relief.space = relief::HeightSpace::texture;
  constexpr int pieces = 4;
  const WeldedMesh mesh = makeWeldedMesh(surface, relief, pieces);
  for (const int face : {0, 22, 44}) {
    for (int cell = 0; cell < pieces * pieces; ++cell) {
      const std::size_t triangle = 2U * static_cast<std::size_t>(face * pieces * pieces + cell);
      const surface::LimitPoint corner =
          surface.evaluate(face, double(cell % pieces) / pieces, double(cell / pieces) / pieces);
      const Vec3 expected =
          relief::displaced(relief, surface::texelFrame(corner, relief.texelsPerUv()));
      const glm::vec3 found = mesh.vertices[mesh.triangles[3 * triangle]];
      EXPECT_LT(glm::length(Vec3(found) - expected), 2e-6 * glm::length(expected));
    }
  }
}

TEST(WeldedMesh, SubdivisionsGiveEightATexelOrWhatIsAllowed) {
  // Faces of 8 × 3 texels: 96 pieces a side have a line at every texel's centre, 64 only along s.
  const surface::LimitSurface surface(surface::makePlane(32, 32, 4, 4));
  const Vec2 texels(32, 12);
  EXPECT_EQ(subdivisionsForTexels(surface, texels), 96);
  EXPECT_EQ(subdivisionsForTexels(surface, texels, 2 * 16 * 96 * 96 - 1), 48);
  EXPECT_EQ(subdivisionsForTexels(surface, Vec2(32, 16)), 64);
  EXPECT_EQ(subdivisionsForTexels(surface, Vec2(28, 16), 2 * 16 * 56 * 56), 56) << "7 and 4";
  EXPECT_EQ(subdivisionsForTexels(surface, Vec2(30.4, 16)), 61) << "no whole texels";
  EXPECT_EQ(subdivisionsForTexels(surface, texels, 2 * 16 * 32 * 32), 32);
  EXPECT_EQ(subdivisionsForTexels(surface, texels, 2 * 16 * 32 * 32 - 1), 31);
  EXPECT_EQ(subdivisionsForTexels(surface, texels, 2 * 16 * 8 * 8), 8);
  EXPECT_EQ(subdivisionsForTexels(surface, texels, 2 * 16 * 7 * 7), 7);
  EXPECT_EQ(subdivisionsForTexels(surface, texels, 1), 1);
  EXPECT_EQ(subdivisionsForTexels(surface, Vec2(1e-3)), 1);
}

TEST(WeldedMesh, RefusesWhatCannotBe) {
  const surface::LimitSurface surface(surface::makePlane(32, 32, 64, 64));
  for (const int pieces : {0, -1, 8193}) {
    EXPECT_THAT(messageOf<InputError>([&] { makeWeldedMesh(surface, flatRelief(4, 4), pieces); }),
                HasSubstr("1 to 8192 expected"));
  }
  EXPECT_THAT(messageOf<InputError>([&] { makeWeldedMesh(surface, flatRelief(4, 4), 8192); }),
              HasSubstr("fewer than 2^31 expected"));
}

}  // namespace
}  // namespace gnomon::displaced
