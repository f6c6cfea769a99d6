#include "surface/polygon_surface.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numeric>
#include <string>

#include "support/polygon_meshes.h"
#include "surface/base_mesh.h"
#include "surface/cage/polygon_cage.h"
#include "surface/closed_surface.h"
#include "surface/curvature.h"
#include "surface/limit_surface.h"
#include "surface/mesh_file.h"
#include "surface/test_surfaces.h"
#include "surface/texel_frame.h"
#include "surface/texture_layout.h"

namespace gnomon::surface {
namespace {

using test::BoxFaces;
using test::boxMesh;
using test::PolygonList;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

double signedArea(const std::vector<Vec3>& p, const std::array<int, 3>& t) {
  const auto at = [&](int k) {
    return p[static_cast<std::size_t>(t.at(static_cast<std::size_t>(k)))];
  };
  return glm::cross(at(1) - at(0), at(2) - at(0)).z / 2;
}

/// Counter-clockwise triangles whose areas sum to the polygon's lie in it and beside each other.
void expectCut(const std::vector<Vec3>& polygon, double area) {
  const auto triangles = cutIntoTriangles(polygon);
  EXPECT_EQ(triangles.size(), polygon.size() - 2);
  double sum = 0;
  for (const auto& triangle : triangles) {
    EXPECT_GE(signedArea(polygon, triangle), 0);
    sum += signedArea(polygon, triangle);
  }
  EXPECT_NEAR(sum, area, 1e-12 * area);
}

TEST(CutIntoTriangles, KeepsConcavePolygons) {
  expectCut({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, 3);  // an L
  expectCut({{0, 0, 0}, {4, 0, 0}, {0.5, 0.5, 0}, {0, 4, 0}}, 2);                    // an arrow
  // A comb: ten teeth of height 1 and width 1 on a strip of height 1.
  std::vector<Vec3> comb = {{0, -1, 0}, {10, -1, 0}};
  for (int tooth = 9; tooth >= 0; --tooth) {
    comb.emplace_back(tooth + 0.999, 0, 0);
    comb.emplace_back(tooth + 0.5, 1, 0);
    comb.emplace_back(tooth, 0, 0);
  }
  expectCut(comb, 10 - 0.0005 + 10 * 0.999 / 2);
  // A frame: a square with a square hole, one cut leads to it and back.
  expectCut({{0, 0, 0},
             {3, 0, 0},
             {3, 3, 0},
             {0, 3, 0},
             {0, 0, 0},
             {1, 1, 0},
             {1, 2, 0},
             {2, 2, 0},
             {2, 1, 0},
             {1, 1, 0}},
            8);
  // Straight corners.
  expectCut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}}, 4);
}

TEST(CutIntoTriangles, TakesTheShortestDiagonalThenTheFirst) {
  EXPECT_THAT(cutIntoTriangles(std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0.5, 1, 0}}),
              ElementsAre(std::array{3, 0, 1}, std::array{1, 2, 3}));
  EXPECT_THAT(cutIntoTriangles(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}),
              ElementsAre(std::array{3, 0, 1}, std::array{1, 2, 3}));
  // Whatever crosses itself is cut somehow.
  EXPECT_EQ(cutIntoTriangles(std::vector<Vec3>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(),
            2U);
  EXPECT_EQ(cutIntoTriangles(std::vector<Vec3>(5, Vec3(1))).size(), 3U);
}

/// A triangle with different normals, and all that is linear on it.
PolygonList triangleMesh() {
  PolygonList mesh;
  mesh.positions = {{1, 2, 3}, {5, 1, 2}, {2, 6, 4}};
  mesh.uvs = {{0.1, 0.2}, {0.9, 0.3}, {0.2, 0.7}};
  mesh.normals = {{0, 0, 2}, {1, 0, 3}, {0, 1, 3}};
  mesh.faceSizes = {3};
  mesh.faceVertices = mesh.faceUvs = mesh.faceNormals = {0, 1, 2};
  return mesh;
}

TEST(PolygonSurface, ATriangleIsThreeFacesAndLinear) {
  const PolygonList mesh = triangleMesh();
  const LimitSurface surface(mesh.cage());
  ASSERT_EQ(surface.faceCount(), 3);
  EXPECT_EQ(surface.facesPerCageFace(), 3);
  EXPECT_TRUE(surface.isPolygons());
  EXPECT_FALSE(surface.isBicubic(0));
  const Vec3 flat = glm::normalize(
      glm::cross(mesh.positions[1] - mesh.positions[0], mesh.positions[2] - mesh.positions[0]));
  Random random(5);
  for (int k = 0; k < 300; ++k) {
    const LimitPoint point = surface.evaluate(k % 3, random(0, 1), random(0, 1));
    // Its place on the triangle by its texture coordinates.
    const glm::dmat2 sides(mesh.uvs[1] - mesh.uvs[0], mesh.uvs[2] - mesh.uvs[0]);
    const Vec2 w = glm::inverse(sides) * (point.uv - mesh.uvs[0]);
    const Vec3 weights(1 - w.x - w.y, w.x, w.y);
    const auto mean = [&](const std::vector<Vec3>& values) {
      return weights.x * values[0] + weights.y * values[1] + weights.z * values[2];
    };
    expectNear(point.position, mean(mesh.positions), 1e-14 * 10);
    std::vector<Vec3> units;
    for (const Vec3& normal : mesh.normals) units.push_back(glm::normalize(normal));
    expectNear(point.ownNormal, glm::normalize(mean(units)), 1e-14);
    expectNear(point.ownDirection, point.ownNormal, 1e-14, "one corner a place");
    expectNear(outwardNormal(point), flat, 1e-12);
    // Chain rule: P_s = P_x x_s + P_y y_s whatever the square.
    const TexelFrame frame = tangentFrame(point, Vec2(64));
    expectNear(frame.px, tangentFrame(surface.evaluate(0, 0.5, 0.5), Vec2(64)).px, 1e-12);
  }
  EXPECT_EQ(textureLayout(surface).chartCount, 1);
  EXPECT_TRUE(textureLayout(surface).isOneToOne);
}

TEST(PolygonSurface, AQuadrilateralIsBilinearHoweverItIsCounted) {
  PolygonList alone;
  alone.positions = {{0, 0, 0}, {2, 0, 0.5}, {2.5, 2, 0}, {0, 1, 1}, {3, 1, 0}};
  alone.add({0, 1, 2, 3}, {{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}});
  PolygonList beside = alone;
  beside.add({1, 4, 2}, {{0.6, 0}, {1, 0}, {0.6, 0.5}});
  const LimitSurface one(alone.cage());
  const LimitSurface mixed(beside.cage());
  ASSERT_EQ(one.faceCount(), 1);
  ASSERT_EQ(mixed.faceCount(), 4 + 3) << "so that they share whole edges";
  EXPECT_EQ(sharedSides(mixed).size(), 4U + 3U + 2U);
  for (int face = 0; face < 4; ++face) {
    for (const Vec2 st : {Vec2(0.2, 0.3), Vec2(0.9, 0.6), Vec2(1, 0)}) {
      const TangentPoint point = mixed.tangentPoint(face, st.x, st.y);
      const Vec2 place = point.uv * 2.0;
      expectNear(point.position, one.tangentPoint(0, place.x, place.y).position, 1e-14);
    }
  }
  // A concave one, whose bilinear map would fold, is two triangles.
  PolygonList arrow;
  arrow.positions = {{0, 0, 0}, {4, 0, 0}, {0.5, 0.5, 0}, {0, 4, 0}};
  arrow.add({0, 1, 2, 3}, {{0, 0}, {1, 0}, {0.1, 0.1}, {0, 1}});
  const LimitSurface folded(arrow.cage());
  ASSERT_EQ(folded.faceCount(), 6);
  for (int face = 0; face < 6; ++face) {
    expectNear(outwardNormal(folded.tangentPoint(face, 0.3, 0.8)), {0, 0, 1}, 1e-14);
  }
}

TEST(PolygonSurface, NormalsAreTheFilesAndDirectionsAreShared) {
  for (const BoxFaces faces : {BoxFaces::quadrilaterals, BoxFaces::triangles, BoxFaces::mixed}) {
    const LimitSurface hard(boxMesh(Vec3(-1), Vec3(1), true, faces).cage());
    const LimitSurface soft(boxMesh(Vec3(-1), Vec3(1), false, faces).cage());
    EXPECT_TRUE(isClosed(hard));
    EXPECT_NEAR(enclosedVolume(hard), 8, 1e-14);
    for (int face = 0; face < hard.faceCount(); ++face) {
      for (const Vec2 st : {Vec2(0, 0), Vec2(1, 0), Vec2(0.3, 0.6)}) {
        const TangentPoint point = hard.tangentPoint(face, st.x, st.y);
        expectNear(point.ownNormal, outwardNormal(point), 1e-15, "of the file");
        const TangentPoint smooth = soft.tangentPoint(face, st.x, st.y);
        // Weighted by angles, so that it does not matter how a side is cut: the cube's own corners.
        const Vec3 expected = glm::normalize(point.position);
        if (st == Vec2(0, 0) && std::abs(std::abs(point.position.x) - 1) < 1e-15 &&
            std::abs(std::abs(point.position.y) - 1) < 1e-15 &&
            std::abs(std::abs(point.position.z) - 1) < 1e-15) {
          expectNear(point.ownDirection, expected, 1e-14);
          expectNear(smooth.ownNormal, expected, 1e-14, "computed");
        }
        expectNear(smooth.ownDirection, point.ownDirection, 1e-14);
      }
    }
  }
}

TEST(PolygonSurface, DirectionsAreSharedByPlaceNotByVertex) {
  const PolygonList apart = boxMesh(Vec3(-1), Vec3(1), true).apart();
  const LimitSurface surface(apart.cage());
  expectNear(surface.tangentPoint(0, 0, 0).ownDirection, glm::normalize(Vec3(-1, -1, 1)), 1e-15);
  // A normal without length is none, as at a corner that has none.
  PolygonList empty = boxMesh(Vec3(-1), Vec3(1), true);
  empty.normals[0] = Vec3(0);
  const LimitSurface partly(empty.cage());
  expectNear(partly.tangentPoint(0, 0, 0).ownNormal, glm::normalize(Vec3(-1, -1, 1)), 1e-15);
  expectNear(partly.tangentPoint(2, 0.5, 0.5).ownNormal, {1, 0, 0}, 1e-15);
}

TEST(PolygonSurface, FramesKeepThePolygonsMetric) {
  PolygonList mesh = triangleMesh();
  mesh.normals = {{0.3, 0.1, 1}, {-0.2, 0.4, 1}, {0, 0, 1}};
  const LimitSurface surface(mesh.cage());
  const TangentPoint point = surface.tangentPoint(1, 0.4, 0.7);
  const TexelFrame flat = tangentFrame(point, {32, 64});
  const TexelFrame frame = texelFrame(point, {32, 64});
  ASSERT_TRUE(frame.defined);
  EXPECT_GT(glm::length(flat.normal - frame.normal), 0.1) << "or nothing is tested";
  EXPECT_NEAR(glm::dot(frame.px, frame.normal), 0, 1e-14);
  EXPECT_NEAR(glm::dot(frame.py, frame.normal), 0, 1e-14);
  EXPECT_NEAR(glm::dot(frame.px, frame.px), glm::dot(flat.px, flat.px), 1e-15);
  EXPECT_NEAR(glm::dot(frame.py, frame.py), glm::dot(flat.py, flat.py), 1e-15);
  EXPECT_NEAR(glm::dot(frame.px, frame.py), glm::dot(flat.px, flat.py), 1e-15);
  expectNear(glm::normalize(glm::cross(frame.px, frame.py)), frame.normal, 1e-14);
  // Turned over there is no frame; there is one up to there.
  for (const double z : {-1.0, -0.9}) {
    PolygonList turned;
    turned.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    turned.add({0, 1, 2}, {{0, 0}, {1, 0}, {0, 1}}, {std::sqrt(1 - z * z), 0, z});
    EXPECT_EQ(texelFrame(LimitSurface(turned.cage()).tangentPoint(0, 0.5, 0.5), {8, 8}).defined,
              z > -1);
  }
}

/// The largest error of the curvatures of a base mesh, relative.
double curvatureError(const LimitSurface& surface, int subdivisions, double expected) {
  const BaseMesh mesh = makeBaseMesh(surface, Vec2(64), subdivisions, CurvatureSource::vertices);
  double worst = 0;
  for (const BaseVertex& vertex : mesh.vertices) {
    worst = std::max({worst, std::abs(vertex.curvatures.k1 - expected),
                      std::abs(vertex.curvatures.k2 - expected)});
  }
  return expected == 0 ? worst : worst / expected;
}

TEST(PolygonSurface, CurvatureIsTheTurnOfTheNormals) {
  const double radius = 7;
  for (const int pieces : {1, 2, 5}) {
    const LimitSurface sphere(test::facetedSphere(radius, 1, 1, 12, 12).cage());
    EXPECT_LT(curvatureError(sphere, pieces, 1 / radius), 3e-3) << pieces;
    EXPECT_EQ(curvatureError(LimitSurface(boxMesh(Vec3(-1), Vec3(1), true).cage()), pieces, 0), 0);
  }
  // A control: rounded by its normals, the box is curved.
  EXPECT_GT(curvatureError(LimitSurface(boxMesh(Vec3(-1), Vec3(1), false).cage()), 1, 0), 0.3);
  const LimitPoint middle =
      LimitSurface(test::facetedSphere(radius, 1, 1, 12, 12).cage()).evaluate(70, 0.5, 0.5);
  EXPECT_NEAR(principalCurvatures(middle).k1, 1 / radius, 1e-3);
  EXPECT_NEAR(principalCurvatures(middle).k2, 1 / radius, 1e-3);
}

TEST(PolygonSurface, AnyNumberOfFacesMayMeetAtAnEdge) {
  PolygonList fins;
  fins.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  const std::vector<Vec2> uv = {{0, 0}, {1, 0}, {0, 1}};
  fins.add({0, 1, 2}, uv);
  fins.add({0, 1, 3}, uv);
  fins.add({0, 1, 4}, uv);
  const LimitSurface three(fins.cage());
  EXPECT_EQ(sharedSides(three).size(), 9U) << "each triangle's own three, and none at the edge";
  EXPECT_FALSE(isClosed(three));
  // Two that run the same way do not go on in each other; two that do not, do.
  PolygonList two = fins;
  two.faceSizes.pop_back();
  for (auto* list : {&two.faceVertices, &two.faceUvs, &two.faceNormals}) list->resize(6);
  EXPECT_EQ(sharedSides(LimitSurface(two.cage())).size(), 6U);
  std::swap(two.faceVertices[3], two.faceVertices[4]);
  EXPECT_EQ(sharedSides(LimitSurface(two.cage())).size(), 6U + 2U);
}

TEST(PolygonSurface, ErrorsNameThePart) {
  PolygonList mesh = triangleMesh();
  mesh.faceNormals[1] = 3;
  expectInputError([&] { (void)mesh.cage(); }, {"normal 3", "there are 3"});
  mesh = triangleMesh();
  mesh.normals[1].x = std::nan("");
  expectInputError([&] { (void)mesh.cage(); }, {"normal 1", "finite"});
  mesh = triangleMesh();
  mesh.faceVertices[1] = 0;
  expectInputError([&] { (void)mesh.cage(); }, {"face 0 has vertex 0 twice"});
}

// ---- from files

/// A box with hard edges: every side has its normal and its own texture coordinates.
std::string hardBoxObj(bool withNormals = true) {
  const PolygonList box = boxMesh(Vec3(-1), Vec3(1), true);
  std::string text;
  for (const Vec3& p : box.positions) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const Vec2& t : box.uvs) text += fmt::format("vt {:.17g} {:.17g}\n", t.x, t.y);
  for (const Vec3& n : box.normals) text += fmt::format("vn {} {} {}\n", n.x, n.y, n.z);
  for (std::size_t k = 0; k < box.faceVertices.size(); ++k) {
    text += k % 4 == 0 ? "f" : "";
    text += fmt::format(" {}/{}", box.faceVertices[k] + 1, box.faceUvs[k] + 1);
    if (withNormals) text += fmt::format("/{}", box.faceNormals[k] + 1);
    text += k % 4 == 3 ? "\n" : "";
  }
  return text;
}

/// The same with a vertex a corner, which has the normal.
std::string hardBoxPly() {
  const PolygonList box = boxMesh(Vec3(-1), Vec3(1), true);
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 24\nproperty double x\nproperty double y\nproperty "
      "double z\nproperty double nx\nproperty double ny\nproperty double nz\nproperty double s\n"
      "property double t\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::size_t k = 0; k < box.faceVertices.size(); ++k) {
    const Vec3& p = box.positions[static_cast<std::size_t>(box.faceVertices[k])];
    const Vec3& n = box.normals[static_cast<std::size_t>(box.faceNormals[k])];
    const Vec2& t = box.uvs[static_cast<std::size_t>(box.faceUvs[k])];
    text +=
        fmt::format("{} {} {} {} {} {} {:.17g} {:.17g}\n", p.x, p.y, p.z, n.x, n.y, n.z, t.x, t.y);
  }
  for (int face = 0; face < 6; ++face) {
    text += fmt::format("4 {} {} {} {}\n", 4 * face, 4 * face + 1, 4 * face + 2, 4 * face + 3);
  }
  return text;
}

TEST(PolygonFiles, AnObjAndAPlyAreTheSameSurface) {
  const TemporaryMesh obj(hardBoxObj(), ".obj");
  const TemporaryMesh ply(hardBoxPly(), ".ply");
  const LimitSurface a(readMeshFile(obj.path(), SubdivisionScheme::none));
  const LimitSurface b(readMeshFile(ply.path(), SubdivisionScheme::none));
  ASSERT_EQ(a.faceCount(), 6);
  ASSERT_EQ(b.faceCount(), 6);
  EXPECT_TRUE(isClosed(b)) << "vertices in one place are joined";
  for (int face = 0; face < 6; ++face) {
    for (const Vec2 st : {Vec2(0, 0), Vec2(0.3, 0.7)}) {
      const TangentPoint p = a.tangentPoint(face, st.x, st.y);
      const TangentPoint q = b.tangentPoint(face, st.x, st.y);
      EXPECT_EQ(p.position, q.position);
      EXPECT_EQ(p.ownNormal, q.ownNormal);
      EXPECT_EQ(p.ownDirection, q.ownDirection);
      EXPECT_EQ(p.uv, q.uv);
      EXPECT_EQ(p.ownNormal, outwardNormal(p)) << "the file's";
    }
  }
  const TemporaryMesh bare(hardBoxObj(false), ".obj");
  const LimitSurface rounded(readMeshFile(bare.path(), SubdivisionScheme::none));
  expectNear(rounded.tangentPoint(0, 0, 0).ownNormal, glm::normalize(Vec3(-1, -1, 1)), 1e-15);
}

TEST(PolygonFiles, OtherSchemesDoNotLookAtNormals) {
  std::string text = hardBoxObj();
  text.replace(text.find("vn 0 0 1"), 8, "vn 0 x 1");
  const TemporaryMesh bad(text, ".obj");
  EXPECT_EQ(LimitSurface(readMeshFile(bad.path())).faceCount(), 6);
  expectInputError([&] { (void)readMeshFile(bad.path(), SubdivisionScheme::none); },
                   {":", "coordinate 2 is 'x'"});
}

TEST(PolygonFiles, TellsWhatEachSchemeWouldMakeOfThem) {
  const TemporaryMesh box(hardBoxObj(), ".obj");
  EXPECT_THAT(schemeChoice(box.path()),
              ::testing::StartsWith("6 quadrilaterals: catmull-clark would round them"));
  EXPECT_THAT(schemeChoice(box.path()), HasSubstr("loop cannot take"));
  const TemporaryMesh triangle("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n", ".obj");
  EXPECT_THAT(schemeChoice(triangle.path()), ::testing::StartsWith("1 triangle: "));
  EXPECT_THAT(schemeChoice(triangle.path()), HasSubstr("loop too; none keeps it"));
}

}  // namespace
}  // namespace gnomon::surface
