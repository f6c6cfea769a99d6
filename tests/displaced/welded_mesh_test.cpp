#include "displaced/welded_mesh.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "common/error.h"
#include "support/error_messages.h"
#include "surface/texel_frame.h"
#include "truth/truth_scenes.h"

namespace gnomon::displaced {
namespace {

using test::cubeCage;
using test::flatRelief;
using test::randomRelief;
using ::testing::HasSubstr;

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
