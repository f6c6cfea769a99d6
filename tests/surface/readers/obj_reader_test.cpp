#include "surface/mesh_file.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include "surface/limit_surface.h"
#include "surface/test_surfaces.h"

namespace gnomon::surface {
namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

const char* const spotFile = GNOMON_SCENES "/meshes/spot_control_mesh.obj";

Cage readText(const std::string& text) {
  const TemporaryMesh file(text, ".obj");
  return readMeshFile(file.path());
}

void expectBadObj(const std::string& text, const std::vector<std::string>& messages) {
  expectInputError([&] { readText(text); }, messages);
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
const std::string squareFace = "f 1/1 2/2 3/3 4/4\n";

/// The mesh as its file has it, read by nothing but a stream.
struct RawMesh {
  std::vector<double> positions;
  std::vector<int> sizes, vertices;
  explicit RawMesh(const std::string& path) {
    std::ifstream file(path);
    std::string line, word;
    while (std::getline(file, line)) {
      std::istringstream words(line);
      words >> word;
      if (word == "v") {
        for (double x = 0; words >> x;) positions.push_back(x);
      } else if (word == "f") {
        int size = 0;
        for (; words >> word; ++size) vertices.push_back(std::stoi(word) - 1);
        sizes.push_back(size);
      }
    }
  }
};

TEST(ReadObj, QuadrilateralsStayAsTheyAre) {
  const Cage cage = readText("# a square\r\nmtllib none.mtl\ng left\n" + square +
                             "usemtl red\ns 1\n" + squareFace + "o other\nvn 0 0 1\n");
  EXPECT_EQ(cage.positions.size(), 4u);
  EXPECT_EQ(cage.faceVertices, (std::vector{0, 1, 2, 3}));
  EXPECT_EQ(cage.faceUvs, (std::vector{0, 1, 2, 3}));
  EXPECT_EQ(cage.uvs[2], Vec2(1, 1));
  EXPECT_EQ(cage.positions[2], Vec3(1, 1, 0));
  EXPECT_EQ(cage.border, CageBorder::edgesAndCorners);
  EXPECT_FALSE(cage.grid.has_value());
}

TEST(ReadObj, FormsOfTheSameSquare) {
  const std::vector<int> expected = {0, 1, 2, 3};
  for (const std::string& face : {std::string("f -4/-4 -3/-3 -2/-2 -1/-1"),
                                  std::string("f 1/1/1 2/2/2 3/3/3 4/4/4\nvn 0 0 1"),
                                  std::string("  f\t1/1   2/2\t3/3 4/4   # comment"),
                                  std::string("f 1/1 2/2 3/3 4/4\r\n\r\n")}) {
    EXPECT_EQ(readText(square + face).faceVertices, expected) << face;
  }
  // Faces before their vertices, numbers with signs and exponents, a byte order mark, old Mac ends.
  EXPECT_EQ(readText(squareFace + square).faceVertices, expected);
  EXPECT_EQ(readText("\xEF\xBB\xBF" + square + squareFace).positions.size(), 4u);
  std::string mac = square + squareFace;
  std::replace(mac.begin(), mac.end(), '\n', '\r');
  EXPECT_EQ(readText(mac).faceVertices, expected);
  const Cage cage = readText(
      "v +1.5e-1 -.5 2.\nv 1 0 0 1.0\nv 1 1 0 0.2 0.3 0.4\nv 0 1 0\n"
      "vt 0 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n" +
      squareFace);
  expectNear(cage.positions[0], {0.15, -0.5, 2}, 1e-16);
}

TEST(ReadObj, KeepsDoublePrecision) {
  const Cage cage = readText(
      "v 0.123456789012345 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n" +
      squareFace);
  EXPECT_NEAR(cage.positions[0].x, 0.123456789012345, 1e-15);
}

TEST(ReadObj, GroupsAreJoinedInOrder) {
  const Cage cage = readText(square + "v 2 0 0\nv 2 1 0\ng a\n" + squareFace +
                             "g b\nusemtl c\nf 2/2 5/1 6/4 3/3\nusemtl d\n");
  EXPECT_EQ(cage.faceVertices, (std::vector{0, 1, 2, 3, 1, 4, 5, 2}));
}

TEST(ReadObj, ALineOfNumbersMayGoOnInTheNext) {
  const std::string broken =
      "v 0 0\\\n 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 \\\r\n0\nvt 1 1\nvt 0 1\n"
      "f 1/1 \\\n  2/2\\\n3/3 \\\n4/4\n";
  const Cage cage = readText(broken);
  EXPECT_EQ(cage.faceVertices, (std::vector{0, 1, 2, 3}));
  EXPECT_EQ(cage.faceUvs, (std::vector{0, 1, 2, 3}));
  EXPECT_EQ(cage.uvs[1], Vec2(1, 0));
  // Messages name the line that it begins in; what follows keeps its own.
  expectBadObj(square + "f 1/1 2/2 \\\n3/3 x/4\n", {":9:", "'x'"});
  expectBadObj(square + "f 1/1 2/2 \\\n3/3 4/4\nv 1\n", {":11:", "1 numbers"});
  // At the end of a path, a name or a comment it is a letter.
  EXPECT_EQ(
      readText("# C:\\\n" + square + "mtllib C:\\meshes\\\n" + squareFace + "o a\\\n# f 9/9 \\\n")
          .faceCount(),
      1);
  EXPECT_EQ(readText(square + "f 1/1 2/2 3/3 4/4 \\").faceCount(), 1) << "the file's end";
}

/// The mesh with every face's corners as vertices of its own, as writers cut it for flat shading.
std::string cutApart(const Cage& cage, const std::string& between = "") {
  std::ostringstream text;
  text.precision(17);
  std::ostringstream faces;
  const std::size_t size = cage.faceSize();
  for (std::size_t corner = 0; corner < cage.faceVertices.size(); ++corner) {
    const Vec3& p = cage.positions[static_cast<std::size_t>(cage.faceVertices[corner])];
    const Vec2& uv = cage.uvs[static_cast<std::size_t>(cage.faceUvs[corner])];
    text << "v " << p.x << ' ' << p.y << ' ' << p.z << "\nvt " << uv.x << ' ' << uv.y << '\n';
    if (corner % size == 0) faces << between << 'f';
    faces << ' ' << corner + 1 << '/' << corner + 1 << (corner % size == size - 1 ? "\n" : "");
  }
  return text.str() + faces.str();
}

/// For every vertex of a, its counterpart in b.
void expectSameSurface(const Cage& a, const Cage& b) {
  ASSERT_EQ(a.faceVertices.size(), b.faceVertices.size());
  std::map<int, int> counterparts;
  for (std::size_t i = 0; i < a.faceVertices.size(); ++i) {
    const auto [found, isNew] = counterparts.emplace(a.faceVertices[i], b.faceVertices[i]);
    ASSERT_EQ(found->second, b.faceVertices[i]) << "corner " << i;
    const Vec3& place = a.positions[static_cast<std::size_t>(a.faceVertices[i])];
    expectNear(place, b.positions[static_cast<std::size_t>(b.faceVertices[i])], 1e-14);
  }
}

// Before, such a file was another surface: every face an open patch of its own.
TEST(JoinedVertices, AMeshThatIsCutApartIsTheSameSurface) {
  const Cage whole = readMeshFile(spotFile);  // closed: every side has a neighbour
  const Cage joined = readText(cutApart(whole));
  expectSameSurface(joined, whole);
  expectSameSurface(whole, joined);
  const auto corners = static_cast<int>(whole.faceVertices.size());
  EXPECT_EQ(joined.joined.vertices, corners - static_cast<int>(whole.positions.size()));
  EXPECT_EQ(joined.joined.apartEdges, 0);
  EXPECT_EQ(whole.joined.vertices, 0);
  // Parts are names of faces, and no cuts.
  expectSameSurface(readText(cutApart(whole, "g a\n") + "g b\n"), whole);
}

TEST(JoinedVertices, TagsFollow) {
  const Cage cube = cubeCage();
  std::string text = cutApart(cube);
  // A side of the second face, and a corner of the last.
  const Cage creased = readText(text + "t crease 2/1/0 4 5 2.5\nt corner 1/1/0 23 1.5\n");
  ASSERT_EQ(creased.creases.size(), 1U);
  for (std::size_t end = 0; end < 2; ++end) {
    EXPECT_EQ(creased.creases[0].vertices.at(end), creased.faceVertices[4 + end]);
  }
  EXPECT_EQ(creased.sharpVertices[0].vertex, creased.faceVertices[23]);
}

TEST(JoinedVertices, BodiesThatTouchStayApart) {
  const Cage cube = cubeCage();
  Cage two = cube;
  const auto count = static_cast<int>(cube.positions.size());
  // A second cube that has an edge in common with the first, and a third that has a vertex.
  for (const Vec3 step : {Vec3(1, 1, 0), Vec3(-1, -1, -1)}) {
    const Vec3 size = glm::abs(cube.positions[0]) * 2.0;
    const auto first = static_cast<int>(two.positions.size());
    for (const Vec3& p : cube.positions) two.positions.push_back(p + step * size);
    for (const int vertex : cube.faceVertices) two.faceVertices.push_back(first + vertex);
    two.faceUvs.insert(two.faceUvs.end(), cube.faceUvs.begin(), cube.faceUvs.end());
  }
  const Cage joined = readText(cutApart(two));
  expectSameSurface(joined, two);
  expectSameSurface(two, joined);
  EXPECT_EQ(joined.joined.vertices, 3 * (24 - count));
  EXPECT_EQ(joined.joined.apartEdges, 0);
}

TEST(JoinedVertices, WhereThreeFacesMeetOrTwoRunAlikeTheyStayApart) {
  // Three leaves on one stalk.
  const std::string leaves =
      "v 0 0 1\nv 0 1 1\nv 0 0 0\nv 0 1 0\nv -1 0 0\nv -1 1 0\nv 0 0 0\nv 0 1 0\n";
  const Cage three =
      readText(square + leaves + squareFace + "f 6/1 5/2 7/3 8/4\nf 9/1 10/2 12/3 11/4\n");
  EXPECT_EQ(three.joined.vertices, 0);
  EXPECT_EQ(three.joined.apartEdges, 1);
  // The second square is turned over.
  const std::string turned = "v 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\n";
  const Cage alike = readText(square + turned + squareFace + "f 8/1 7/2 6/3 5/4\n");
  EXPECT_EQ(alike.joined.vertices, 0);
  EXPECT_EQ(alike.joined.apartEdges, 1);
  const Cage right = readText(square + turned + squareFace + "f 5/1 6/2 7/3 8/4\n");
  EXPECT_EQ(right.joined.vertices, 2);
  EXPECT_EQ(right.joined.apartEdges, 0);
}

TEST(JoinedVertices, AnEdgeOfManyFacesTakesNoTime) {
  std::string text = "vt 0 0\nvt 1 0\nvt 0 1\n";
  for (int i = 1; i <= 20000; ++i) {
    text += "v 0 0 0\nv 1 0 0\nv 0 1 " + std::to_string(i) + "\nf -3/1 -2/2 -1/3\n";
  }
  EXPECT_EQ(readText(text).joined.apartEdges, 1);
}

TEST(ReadObj, TrianglesForLoop) {
  const TemporaryMesh file(square + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n", ".obj");
  const Cage cage = readMeshFile(file.path(), SubdivisionScheme::loop);
  EXPECT_EQ(cage.scheme, SubdivisionScheme::loop);
  EXPECT_EQ(cage.faceCount(), 2);
  EXPECT_EQ(cage.faceVertices, (std::vector{0, 1, 2, 0, 2, 3}));
  // For Catmull-Clark they are refined to three quadrilaterals each.
  EXPECT_EQ(readMeshFile(file.path()).faceCount(), 6);
  expectInputError([] { readMeshFile(spotFile, SubdivisionScheme::loop); },
                   {"spot_control_mesh.obj:", "has 4 corners", "triangles only"});
}

TEST(ReadObj, Tags) {
  const Cage cage = readText(square + "v 2 0 0\nv 2 1 0\n" + squareFace +
                             "f 2/2 5/1 6/4 3/3\nusemtl x\n"
                             "t crease 2/1/0 1 2 2.5\nt corner 1/1/0 0 3\n"
                             "t crease 4/2/0 0 1 4 5 10 0.5\nt corner 2/1/0 4 5 1\n"
                             "t interpolateboundary 1/0/0 1\n");
  ASSERT_EQ(cage.creases.size(), 3u);
  EXPECT_EQ(cage.creases[0].vertices, (std::array{1, 2}));
  EXPECT_EQ(cage.creases[0].sharpness, 2.5);
  EXPECT_EQ(cage.creases[1].vertices, (std::array{0, 1}));
  EXPECT_EQ(cage.creases[1].sharpness, 10);
  EXPECT_EQ(cage.creases[2].sharpness, 0.5);
  ASSERT_EQ(cage.sharpVertices.size(), 3u);
  EXPECT_EQ(cage.sharpVertices[0].vertex, 0);
  EXPECT_EQ(cage.sharpVertices[0].sharpness, 3);
  EXPECT_EQ(cage.sharpVertices[2].vertex, 5);
}

TEST(ReadObj, SpotHasTheFacesItShould) {
  const RawMesh raw(spotFile);
  ASSERT_EQ(raw.positions.size(), 3 * 188u);
  ASSERT_EQ(raw.sizes.size(), 180u);
  EXPECT_EQ(std::count(raw.sizes.begin(), raw.sizes.end(), 4), 160);
  const Cage cage = readMeshFile(spotFile);
  EXPECT_EQ(cage.faceCount(), 160 * 4 + 16 * 5 + 4 * 3);
  // Euler: V - E + F is kept by refinement. V' = V + E + F and E = 2 F' / 2 of the corners.
  const auto corners =
      static_cast<std::size_t>(std::count(raw.sizes.begin(), raw.sizes.end(), 4)) * 4 + 16 * 5 +
      4 * 3;
  EXPECT_EQ(raw.vertices.size(), corners);
  EXPECT_EQ(cage.positions.size(), 188 + 180 + corners / 2);  // closed: two corners an edge
  EXPECT_GT(cage.uvs.size(), cage.positions.size());          // seams
  const LimitSurface surface(cage);
  EXPECT_EQ(surface.faceCount(), cage.faceCount());
}

TEST(ReadObj, SpotLimitIsThatOfTheUnrefinedCage) {
  const RawMesh raw(spotFile);
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(raw.positions.size() / 3);
  descriptor.numFaces = static_cast<int>(raw.sizes.size());
  descriptor.numVertsPerFace = raw.sizes.data();
  descriptor.vertIndicesPerFace = raw.vertices.data();
  Sdc::Options sdc;
  sdc.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
  using RefinerFactory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  const std::unique_ptr<Far::TopologyRefiner> refiner(
      RefinerFactory::Create(descriptor, RefinerFactory::Options(Sdc::SCHEME_CATMARK, sdc)));
  ASSERT_TRUE(refiner);
  Bfr::RefinerSurfaceFactory<>::Options options;
  options.SetApproxLevelSmooth(9);
  const Bfr::RefinerSurfaceFactory<> factory(*refiner, options);

  const LimitSurface refined(readMeshFile(spotFile));
  int child = 0;
  double worst = 0;
  double worstNormal = 0;
  for (int face = 0; face < descriptor.numFaces; ++face) {
    Bfr::Surface<double> surface;
    ASSERT_TRUE(factory.InitVertexSurface(face, &surface));
    std::vector<double> points(3 * static_cast<std::size_t>(surface.GetNumPatchPoints()));
    surface.PreparePatchPoints(raw.positions.data(), 3, points.data(), 3);
    const int size = surface.GetFaceSize();
    for (int k = 0; k < size; ++k, ++child) {
      for (const Vec2 st : {Vec2(0.2, 0.3), Vec2(0.5, 0.9), Vec2(0.85, 0.6)}) {
        // A child of a quadrilateral is its quarter about corner k with the corners in the parent's
        // order; a child of another polygon begins at corner k, as Bfr's sub-faces do.
        std::array<double, 2> uv{};
        if (size == 4) {
          const std::array<Vec2, 4> quarter = {Vec2(0, 0), Vec2(0.5, 0), Vec2(0.5, 0.5),
                                               Vec2(0, 0.5)};
          const Vec2 place = quarter[static_cast<std::size_t>(k)] + st / 2.0;
          uv = {place.x, place.y};
        } else {
          const std::array<double, 2> sub = {st.x / 2, st.y / 2};
          surface.GetParameterization().ConvertSubFaceToCoord(k, sub.data(), uv.data());
        }
        Vec3 position, ds, dt;
        surface.Evaluate(uv.data(), points.data(), 3, &position.x, &ds.x, &dt.x);
        const LimitPoint point = refined.evaluate(child, st.x, st.y);
        worst = std::max(worst, glm::length(point.position - position));
        worstNormal = std::max(
            worstNormal, glm::length(outwardNormal(point) - glm::normalize(glm::cross(ds, dt))));
      }
    }
  }
  EXPECT_EQ(child, refined.faceCount());
  EXPECT_LT(worst, 2e-6);
  EXPECT_LT(worstNormal, 2e-5);
}

TEST(ReadObj, RefiningKeepsTextureCoordinatesBilinear) {
  // A square beside a triangle, so that it is refined: its map must be the same bilinear one.
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0.5 0\n"
      "vt 0.1 0.2\nvt 0.9 0.3\nvt 1.3 0.8\nvt 0.2 1.1\nvt 2 2\n"
      "f 1/1 2/2 3/3 4/4\nf 2/2 5/5 3/3\n";
  const LimitSurface surface(readText(text));
  ASSERT_EQ(surface.faceCount(), 7);
  const std::array<Vec2, 4> uv = {Vec2(0.1, 0.2), Vec2(0.9, 0.3), Vec2(1.3, 0.8), Vec2(0.2, 1.1)};
  const std::array<Vec2, 4> quarter = {Vec2(0, 0), Vec2(0.5, 0), Vec2(0.5, 0.5), Vec2(0, 0.5)};
  for (int child = 0; child < 4; ++child) {
    const Vec2 st = quarter[static_cast<std::size_t>(child)] + Vec2(0.3, 0.7) / 2.0;
    const Vec2 expected =
        glm::mix(glm::mix(uv[0], uv[1], st.x), glm::mix(uv[3], uv[2], st.x), st.y);
    EXPECT_LT(glm::length(surface.evaluate(child, 0.3, 0.7).uv - expected), 1e-14);
  }
}

TEST(ReadObj, RefiningTakesOneOffSharpness) {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0.5 0\nvt 0 0\n"
      "f 1/1 2/1 3/1 4/1\nf 2/1 5/1 3/1\n";
  const Cage smooth = readText(text);
  EXPECT_TRUE(smooth.creases.empty());  // the border is sharp by rule
  EXPECT_TRUE(smooth.sharpVertices.empty());
  const Cage creased = readText(text + "t crease 2/1/0 1 2 2.5\n");
  ASSERT_EQ(creased.creases.size(), 2u);
  EXPECT_EQ(creased.creases[0].sharpness, 1.5);
  EXPECT_EQ(creased.creases[1].sharpness, 1.5);
  const Cage sharp = readText(text + "t crease 2/1/0 1 2 10\n");
  ASSERT_EQ(sharp.creases.size(), 2u);
  EXPECT_EQ(sharp.creases[0].sharpness, 10);
}

/// A cube with tags, and far from it a triangle if asked, which makes the reader refine all.
std::string cubeText(const std::string& tags, bool withTriangle) {
  const Cage cube = cubeCage();
  std::ostringstream text;
  for (const Vec3& p : cube.positions) text << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  text << "vt 0 0\n";
  for (std::size_t i = 0; i < cube.faceVertices.size(); i += 4) {
    text << 'f';
    for (std::size_t k = 0; k < 4; ++k) text << ' ' << cube.faceVertices[i + k] + 1 << "/1";
    text << '\n';
  }
  if (withTriangle) text << "v 7 0 0\nv 8 0 0\nv 7 1 0\nf 9/1 10/1 11/1\n";
  return text.str() + tags;
}

double worstAfterRefining(const std::string& tags) {
  const LimitSurface direct(readText(cubeText(tags, false)));
  const LimitSurface refined(readText(cubeText(tags, true)));
  EXPECT_EQ(direct.faceCount(), 6);
  EXPECT_EQ(refined.faceCount(), 24 + 3);
  const std::array<Vec2, 4> quarter = {Vec2(0, 0), Vec2(0.5, 0), Vec2(0.5, 0.5), Vec2(0, 0.5)};
  double worst = 0;
  for (int child = 0; child < 24; ++child) {
    for (int i = 0; i < 81; ++i) {
      const Vec2 st(i % 9 / 8.0, i / 9 / 8.0);
      const Vec2 place = quarter[static_cast<std::size_t>(child % 4)] + st / 2.0;
      const Vec3 expected = direct.evaluate(child / 4, place.x, place.y).position;
      worst = std::max(worst, glm::length(refined.evaluate(child, st.x, st.y).position - expected));
    }
  }
  return worst;
}

TEST(ReadObj, RefiningKeepsTheLimitOfCreases) {
  EXPECT_LT(worstAfterRefining(""), 2e-6);
  // Semi-sharp edges and a vertex; a sharp ring about a face.
  EXPECT_LT(worstAfterRefining("t crease 4/2/0 4 5 7 6 2.5 0.7\nt corner 1/1/0 0 1.3\n"), 2e-6);
  EXPECT_LT(worstAfterRefining("t crease 8/1/0 4 5 5 7 7 6 6 4 10\n"), 2e-6);
  // The ends of a sharp crease are where OpenSubdiv converges slowly.
  EXPECT_LT(worstAfterRefining("t crease 2/1/0 5 7 10\n"), 2e-5);
}

TEST(ReadObjErrors, NoFaces) {
  expectBadObj("", {"no faces"});
  expectBadObj("# nothing\n\n", {"no faces"});
  expectBadObj(square, {"no faces"});
}

TEST(ReadObjErrors, Unreadable) {
  expectInputError([] { readMeshFile("no/such/mesh.obj"); }, {"no/such/mesh.obj"});
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  expectInputError([&] { readMeshFile(folder); }, {folder.string()});
}

// Each was "no faces".
TEST(ReadObjErrors, AFileOfAnotherKindIsNamed) {
  const auto utf16 = [](const std::string& text, bool isBig, bool hasMark) {
    std::string bytes = !hasMark ? "" : isBig ? "\xfe\xff" : "\xff\xfe";
    for (const char c : text) bytes += isBig ? std::string{'\0', c} : std::string{c, '\0'};
    return bytes;
  };
  for (const bool isBig : {false, true}) {
    for (const bool hasMark : {false, true}) {
      expectBadObj(utf16(square + squareFace, isBig, hasMark),
                   {".obj: is text in UTF-16: save it as UTF-8 or ASCII"});
    }
  }
  expectBadObj("\x1f\x8b\x08 and more", {".obj: is compressed (gzip): unpack it"});
  expectBadObj(std::string("PK\x03\x04"), {"is compressed (zip)"});
  expectBadObj(std::string("\x28\xb5\x2f\xfd"), {"is compressed (zstd)"});
  expectBadObj(
      "\xfd"
      "7zXZ",
      {"is compressed (xz)"});
  expectBadObj("BZh9", {"is compressed (bzip2)"});
  expectBadObj("glTF\x02", {"is a binary glTF: export the mesh as OBJ or PLY"});
  expectBadObj("solid ball\nfacet\n", {"is an STL"});
  expectBadObj("ply\nformat ascii 1.0\n", {"is a PLY: a name that ends in .ply expected"});
}

TEST(ReadObjErrors, Indices) {
  expectBadObj(square + "f 1/1 2/2 3/3 5/4\n", {":9:", "face 1", "vertex 5", "1 to 4"});
  expectBadObj(square + "f 1/1 2/2 3/3 4/5\n", {":9:", "texture coordinate 5", "1 to 4"});
  expectBadObj(square + "f 0/1 2/2 3/3 4/4\n", {":9:", "index 0"});
  expectBadObj(square + "f -5/1 2/2 3/3 4/4\n", {":9:", "index -5"});
  expectBadObj(square + "f 1/1 2/2 3/3 99999999999/4\n", {":9:", "99999999999"});
  expectBadObj(square + "f 1/1 2/2 3/3 2147483647/4\n", {":9:", "vertex 2147483647"});
  expectBadObj(square + "f 1/1 2/2 3/3 -2147483648/4\n", {":9:", "-2147483648"});
  expectBadObj(square + "f a/1 2/2 3/3 4/4\n", {":9:", "'a'"});
  expectBadObj(square + "f 1.5/1 2/2 3/3 4/4\n", {":9:", "'1.5'"});
  expectBadObj("f 1/1 2/1 3/1\n", {":1:", "vertex", "none"});
}

TEST(ReadObj, FacesWithoutTextureCoordinatesHaveNoFrames) {
  for (const std::string other :
       {"f 2 5 6 3\n", "f 2//1 5//1 6//1 3//1\nvn 0 0 1\n", "f 2 5 3\n"}) {
    const LimitSurface surface(readText(square + "v 2 0 0\nv 2 1 0\n" + squareFace + other));
    const LimitPoint with = surface.evaluate(0, 0.3, 0.6);
    EXPECT_GT(with.uvDs.x * with.uvDt.y - with.uvDs.y * with.uvDt.x, 0.1);
    const LimitPoint without = surface.evaluate(surface.faceCount() - 1, 0.3, 0.6);
    EXPECT_EQ(without.uvDs, Vec2(0));
    EXPECT_EQ(without.uvDt, Vec2(0));
    EXPECT_GT(glm::length(glm::cross(without.ds, without.dt)), 0.01);
  }
}

TEST(ReadObjErrors, MissingTextureCoordinates) {
  expectBadObj(square + "f 1 2 3 4\n", {"no face has texture coordinates", "unwrap"});
  expectBadObj(square + "f 1//1 2//1 3//1 4//1\n", {"unwrap"});
  expectBadObj(square + "f 1/1 2/2 3/3 4/\n", {":9:", "4 corners, 3 of them"});
}

TEST(ReadObjErrors, Numbers) {
  for (const std::string bad : {"nan", "inf", "-inf", "1e999", "x", "1,5", "0x1p3", "--1", "1e"}) {
    expectBadObj(square + "v 0 " + bad + " 0\n" + squareFace, {":9:", "coordinate 2", bad});
    expectBadObj(square + "vt " + bad + " 0\n" + squareFace, {":9:", "coordinate 1", bad});
  }
  expectBadObj(square + "v 1 2\n" + squareFace, {":9:", "2 numbers", "3"});
  expectBadObj(square + "vt 1\n" + squareFace, {":9:", "1 numbers", "2"});
  expectBadObj(square + "v 1e13 0 0\n" + squareFace, {"vertex 5", "1e+13"});
}

TEST(ReadObjErrors, Faces) {
  expectBadObj(square + "f 1/1 2/2\n", {":9:", "2 corners"});
  expectBadObj(square + "f\n", {":9:", "0 corners"});
  expectBadObj(square + squareFace + "f 1/1 2/2 1/1 4/4\n", {":10:", "face 2", "vertex 1 twice"});
  std::string many = square + "f";
  for (int i = 0; i < 256; ++i) many += " 1/1";
  expectBadObj(many, {":9:", "256 corners"});
}

TEST(ReadObjErrors, NonManifold) {
  expectBadObj(square + squareFace + squareFace, {":10:", "opposite directions"});
  expectBadObj(square + "v 0 0 1\nv 1 0 1\nv 0 0 2\nv 1 0 2\n" + squareFace +
                   "f 2/1 1/1 5/1 6/1\nf 2/1 1/1 7/1 8/1\n",
               {":15:", "vertices 1 and 2"});
  expectBadObj(square + "v 2 1 0\nv 2 2 0\nv 1 2 0\n" + squareFace + "f 3/1 5/1 6/1 7/1\n",
               {"vertex 3", "more than one fan"});
}

TEST(ReadObjErrors, Tags) {
  const std::string mesh = square + squareFace;
  expectBadObj(mesh + "t crease 2/1/0 0 2 1\n", {":10:", "0 and 2", "no edge"});
  expectBadObj(mesh + "t crease 2/1/0 0 9 1\n", {":10:", "vertex 9", "0 to 3"});
  expectBadObj(mesh + "t crease 2/1/0 0 1 nan\n", {":10:", "sharpness"});
  expectBadObj(mesh + "t crease 2/1/0 0 1 -1\n", {":10:", "sharpness -1"});
  expectBadObj(mesh + "t crease 2/1/0 0 1\n", {":10:", "2/1/0"});
  expectBadObj(mesh + "t crease 3/1/0 0 1 2 1\n", {":10:", "3/1/0"});
  expectBadObj(mesh + "t crease\n", {":10:"});
  expectBadObj(mesh + "t crease 4000000000/4000000000/9 1\n", {":10:"});
  expectBadObj(mesh + "t corner 1/1/0 x 1\n", {":10:", "'x'"});
  expectBadObj(mesh + "t hole 1/0/0 0\n", {":10:", "'hole'", "crease or corner"});
}

TEST(ReadObjErrors, BinaryGarbage) {
  Random random(11);
  for (int round = 0; round < 200; ++round) {
    std::string bytes;
    for (int i = 0; i < 500; ++i) bytes += static_cast<char>(random(0, 256));
    EXPECT_THROW(readText(bytes), InputError);
  }
}

TEST(ReadObjErrors, DamagedFilesNeverDoWorseThanAnInputError) {
  std::ifstream file(spotFile);
  std::ostringstream whole;
  whole << file.rdbuf();
  Random random(12);
  int refused = 0;
  for (int round = 0; round < 100; ++round) {
    std::string text = whole.str();
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(random(0, static_cast<double>(text.size())));
      text[at] = "0123456789-./ \nfvte"[static_cast<std::size_t>(random(0, 19))];
    }
    try {
      const LimitSurface surface(readText(text));
      expectFinite(surface.evaluate(0, 0.5, 0.5));
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10);
}

/// Two squares beside each other that share no vertex, with a line before each.
std::string twoSquares(const std::string& first, const std::string& second) {
  return square + "v 2 0 0\nv 3 0 0\nv 3 1 0\nv 2 1 0\n" + first + squareFace + second +
         "f 5/1 6/2 7/3 8/4\n";
}

TEST(ObjReader, ObjectsAreParts) {
  const Cage cage = readText(twoSquares("o floor\n", "o ball\n"));
  EXPECT_EQ(cage.partNames, (std::vector<std::string>{"floor", "ball"}));
  EXPECT_EQ(cage.faceParts, (std::vector<int>{0, 1}));
  EXPECT_EQ(cage.limitFaceParts(), cage.faceParts);
}

TEST(ObjReader, GroupsArePartsWhereThereAreNoObjects) {
  const Cage groups = readText(twoSquares("", "g ball smooth\n"));
  EXPECT_EQ(groups.partNames, (std::vector<std::string>{"unnamed", "ball"}));
  const Cage both = readText("o all\n" + twoSquares("g floor\n", "g ball\n"));
  EXPECT_TRUE(both.partNames.empty());
  EXPECT_TRUE(both.faceParts.empty());
}

TEST(ObjReader, OnePartIsNone) {
  EXPECT_TRUE(readText("o one\n" + square + squareFace).partNames.empty());
  EXPECT_TRUE(readText(twoSquares("o one\n", "o one\n")).faceParts.empty());
}

TEST(ObjReader, MorePartsThanCanBeReportedAreNone) {
  std::string text = square;
  for (std::size_t k = 0; k <= mostParts; ++k) {
    for (int corner = 0; corner < 4; ++corner) {
      text += "v " + std::to_string(corner % 3 == 0 ? 0 : 1) + " " + std::to_string(corner / 2) +
              " " + std::to_string(k + 1) + "\n";
    }
    text += "o part" + std::to_string(k) + "\nf -4/1 -3/2 -2/3 -1/4\n";
    EXPECT_EQ(readText(text).partNames.size(), k == 0 || k >= mostParts ? 0 : k + 1);
  }
}

/// The faces that a pentagon is cut into are all of its part; and a triangle of Loop's scheme
/// counts as three faces of the limit surface.
TEST(ObjReader, FacesKeepTheirPartsWhenTheyAreCut) {
  const std::string text = square + "v 2 0 0\nv 3 0 0\nv 3.5 .5 0\nv 3 1 0\nv 2 1 0\no square\n" +
                           squareFace + "o pentagon\nf 5/1 6/2 7/2 8/3 9/4\n";
  const Cage cage = readText(text);
  ASSERT_EQ(cage.faceCount(), 9);
  const LimitSurface surface(cage);
  const std::vector<int> parts = cage.limitFaceParts();
  ASSERT_EQ(static_cast<int>(parts.size()), surface.faceCount());
  for (int face = 0; face < surface.faceCount(); ++face) {
    EXPECT_EQ(parts[static_cast<std::size_t>(face)],
              surface.evaluate(face, 0.5, 0.5).position.x > 1.5 ? 1 : 0);
  }
  const TemporaryMesh triangles(
      square + "v 2 0 0\nv 3 0 0\nv 3 1 0\no a\nf 1/1 2/2 3/3\n" + "o b\nf 5/1 6/2 7/3\n", ".obj");
  const Cage loop = readMeshFile(triangles.path(), SubdivisionScheme::loop);
  EXPECT_EQ(loop.limitFaceParts(), (std::vector<int>{0, 0, 0, 1, 1, 1}));
}

}  // namespace
}  // namespace gnomon::surface
