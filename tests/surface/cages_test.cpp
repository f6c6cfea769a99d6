#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <utility>

#include "common/error.h"
#include "common/system/memory.h"
#include "support/sanitized.h"
#include "surface/cage/shapes.h"
#include "surface/closed_surface.h"
#include "surface/limit_surface.h"
#include "surface/mesh_file.h"
#include "surface/test_surfaces.h"

// Loop's limit surface of triangles: against the masks of the paper, linear precision and finite
// differences.
// Cages of many faces take bounded memory, and one that would not fit is refused.

namespace gnomon::surface {
namespace {

/// Closed, eight faces, six vertices of valence 4; each face has its own corner of the texture.
Cage octahedron() {
  Cage cage;
  cage.scheme = SubdivisionScheme::loop;
  cage.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  cage.faceVertices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  cage.uvs = {{0, 0}, {1, 0}, {0, 1}};
  for (int face = 0; face < 8; ++face) {
    for (const int uv : {0, 1, 2}) cage.faceUvs.push_back(uv);
  }
  return cage;
}

/// The border-less middle of a regular triangulation: (columns + 1) × (rows + 1) vertices at
/// (i, j), each square cut along its (0,0)-(1,1) diagonal; inner vertices have valence 6. uv = xy.
Cage triangleGrid(int columns, int rows) {
  const Cage quads = openGrid(columns, rows);
  Cage cage;
  cage.scheme = SubdivisionScheme::loop;
  cage.positions = quads.positions;
  cage.uvs = quads.uvs;
  for (int face = 0; face < quads.faceCount(); ++face) {
    const int* v = &quads.faceVertices[static_cast<std::size_t>(4 * face)];
    for (const int k : {0, 1, 2, 0, 2, 3}) cage.faceVertices.push_back(v[k]);
  }
  cage.faceUvs = cage.faceVertices;
  return cage;
}

TEST(LoopSurface, ATriangleIsThreeFaces) {
  const LimitSurface surface(octahedron());
  EXPECT_EQ(surface.faceCount(), 24);
  EXPECT_EQ(surface.vertexCount(), 6 + 12 + 8);
  EXPECT_FALSE(surface.grid());
  // Euler: 26 vertices, 48 sides, 24 faces; every side is shared by two.
  std::map<std::pair<int, int>, int> sides;
  for (int face = 0; face < 24; ++face) {
    const auto corners = surface.corners(face);
    for (std::size_t k = 0; k < 4; ++k) ++sides[std::minmax(corners[k], corners[(k + 1) % 4])];
  }
  EXPECT_EQ(sides.size(), 48U);
  for (const auto& [side, faces] : sides) EXPECT_EQ(faces, 2);
}

/// The limit of a vertex is (1 - n χ) v + χ Σ neighbours, 1 / χ = n + 3 / (8 β), with Loop's
/// β = (5/8 - (3/8 + cos(2π/n) / 4)²) / n.
Vec3 limitOfVertex(const Vec3& vertex, const std::vector<Vec3>& neighbours) {
  const auto n = static_cast<double>(neighbours.size());
  const double inner = 3.0 / 8 + std::cos(2 * pi / n) / 4;
  const double beta = (5.0 / 8 - inner * inner) / n;
  const double chi = 1 / (n + 3 / (8 * beta));
  Vec3 sum(0);
  for (const Vec3& neighbour : neighbours) sum += neighbour;
  return (1 - n * chi) * vertex + chi * sum;
}

TEST(LoopSurface, VerticesGoWhereThePapersMaskSends) {
  const LimitSurface surface(octahedron());
  for (int face = 0; face < surface.faceCount(); ++face) {
    const int vertex = surface.corners(face)[0];
    ASSERT_LT(vertex, 6);
    const Cage cage = octahedron();
    std::vector<Vec3> neighbours;
    for (int other = 0; other < 6; ++other) {
      if (other / 2 != vertex / 2) {
        neighbours.push_back(cage.positions[static_cast<std::size_t>(other)]);
      }
    }
    expectNear(surface.evaluate(face, 0, 0).position,
               limitOfVertex(cage.positions[static_cast<std::size_t>(vertex)], neighbours), 1e-6);
  }
  // A regular vertex, among heights at random.
  Cage grid = triangleGrid(6, 6);
  Random random(3);
  for (Vec3& position : grid.positions) position += random.vector(0.3);
  const LimitSurface bumpy(grid);
  const int middle = 3 * 7 + 3;
  std::vector<Vec3> neighbours;
  for (const int offset : {1, 8, 7, -1, -8, -7}) {
    neighbours.push_back(grid.positions[static_cast<std::size_t>(middle + offset)]);
  }
  const Vec3 expected = limitOfVertex(grid.positions[middle], neighbours);
  int met = 0;
  for (int face = 0; face < bumpy.faceCount(); ++face) {
    if (bumpy.corners(face)[0] != middle) continue;
    expectNear(bumpy.evaluate(face, 0, 0).position, expected, 1e-12);
    ++met;
  }
  EXPECT_EQ(met, 6);
}

TEST(LoopSurface, AFlatGridStaysItselfWithItsTexture) {
  Cage cage = triangleGrid(6, 6);
  for (Vec3& position : cage.positions) {
    position = {2 * position.x + position.y, position.y, 0.5 * position.x};
  }
  const LimitSurface surface(cage);
  int inner = 0;
  for (int face = 0; face < surface.faceCount(); ++face) {
    for (const Vec2 st : {Vec2(0.2, 0.7), Vec2(0.9, 0.3), Vec2(1, 1)}) {
      const LimitPoint point = surface.evaluate(face, st.x, st.y);
      if (glm::length(point.uv - Vec2(3)) > 1.5) continue;  // clear of the border's rules
      ++inner;
      const Vec2 uv = point.uv;
      expectNear(point.position, {2 * uv.x + uv.y, uv.y, 0.5 * uv.x}, 1e-12);
      const auto image = [](Vec2 d) { return Vec3(2 * d.x + d.y, d.y, 0.5 * d.x); };
      expectNear(point.ds, image(point.uvDs), 1e-12);
      expectNear(point.dt, image(point.uvDt), 1e-12);
      EXPECT_GT(glm::dot(outwardNormal(point), Vec3(-0.5, 0.5, 2)), 0);
    }
  }
  EXPECT_GT(inner, 100);
}

TEST(LoopSurface, DerivativesAreThoseOfThePosition) {
  const LimitSurface surface(octahedron());
  constexpr double step = 1e-5;
  for (int face = 0; face < surface.faceCount(); ++face) {
    for (const Vec2 st : {Vec2(0.31, 0.62), Vec2(0.7, 0.15), Vec2(0.55, 0.9)}) {
      const auto at = [&](double s, double t) { return surface.evaluate(face, s, t); };
      const LimitPoint point = at(st.x, st.y);
      const LimitPoint right = at(st.x + step, st.y), left = at(st.x - step, st.y);
      const LimitPoint up = at(st.x, st.y + step), down = at(st.x, st.y - step);
      expectNear(point.ds, (right.position - left.position) / (2 * step), 1e-8, "ds");
      expectNear(point.dt, (up.position - down.position) / (2 * step), 1e-8, "dt");
      expectNear(point.dss, (right.ds - left.ds) / (2 * step), 1e-7, "dss");
      expectNear(point.dst, (up.ds - down.ds) / (2 * step), 1e-7, "dst");
      expectNear(point.dst, (right.dt - left.dt) / (2 * step), 1e-7, "dst");
      expectNear(point.dtt, (up.dt - down.dt) / (2 * step), 1e-7, "dtt");
    }
  }
}

TEST(LoopSurface, FacesMeetAlongSharedSides) {
  const LimitSurface surface(octahedron());
  std::map<std::pair<int, int>, Vec3> middles;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const auto corners = surface.corners(face);
    const std::array<Vec2, 4> at = {Vec2(0.5, 0), Vec2(1, 0.5), Vec2(0.5, 1), Vec2(0, 0.5)};
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 middle = surface.evaluate(face, at[k].x, at[k].y).position;
      const auto [entry, first] =
          middles.try_emplace(std::minmax(corners[k], corners[(k + 1) % 4]), middle);
      if (!first) expectNear(middle, entry->second, 1e-9);
    }
    expectFinite(surface.evaluate(face, 0, 0));
    EXPECT_GT(glm::dot(outwardNormal(surface.evaluate(face, 0.5, 0.5)),
                       surface.evaluate(face, 0.5, 0.5).position),
              0);
  }
}

TEST(LimitSurfaceErrors, TooManyFacesAboutAVertex) {
  expectInputError([] { const LimitSurface surface(polesCage(300)); },
                   {"vertex 0", "300 faces", "256"});
}

TEST(LimitSurfaceErrors, NameTheFault) {
  const auto broken = [](const std::function<void(Cage&)>& change) {
    return [change] {
      Cage cage = cubeCage();
      change(cage);
      const LimitSurface surface(cage);
    };
  };
  const double undefined = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  expectInputError([] { const LimitSurface surface{Cage{}}; }, {"no faces"});
  expectInputError(broken([](Cage& c) { c.faceVertices[5] = 8; }),
                   {"face 1", "vertex 8", "0 to 7"});
  expectInputError(broken([](Cage& c) { c.faceVertices[5] = -1; }), {"face 1", "vertex -1"});
  expectInputError(broken([](Cage& c) { c.faceUvs[4] = 4; }),
                   {"face 1", "texture coordinate 4", "0 to 3"});
  expectInputError(broken([](Cage& c) { c.uvs.clear(); }), {"texture coordinate", "none"});
  expectInputError(broken([](Cage& c) { c.faceUvs.pop_back(); }), {"24", "23"});
  expectInputError(broken([](Cage& c) { c.faceVertices.pop_back(); }), {"20", "23"});
  expectInputError(broken([&](Cage& c) { c.positions[3].y = undefined; }),
                   {"vertex 3", "coordinate 2", "nan"});
  expectInputError(broken([&](Cage& c) { c.uvs[2].x = infinity; }),
                   {"texture coordinate 2", "inf"});
  expectInputError(broken([](Cage& c) { c.positions[0].x = 1e13; }), {"vertex 0", "1e+13"});
  expectInputError(broken([](Cage& c) { c.faceVertices[1] = c.faceVertices[0]; }),
                   {"face 0", "twice"});
  expectInputError(broken([](Cage& c) { std::swap(c.faceVertices[1], c.faceVertices[3]); }),
                   {"opposite directions"});
  expectInputError(broken([](Cage& c) {
                     c.creases.push_back({{0, 7}, 2});
                   }),
                   {"crease", "0 and 7", "no edge"});
  expectInputError(broken([](Cage& c) { c.creases.push_back({{0, 9}, 2}); }), {"vertex 9"});
  expectInputError(broken([](Cage& c) { c.creases.push_back({{0, 1}, -2}); }), {"sharpness -2"});
  expectInputError(broken([&](Cage& c) { c.sharpVertices.push_back({0, undefined}); }), {"nan"});
  expectInputError(broken([](Cage& c) { c.sharpVertices.push_back({8, 1}); }), {"vertex 8"});
  expectInputError(broken([](Cage& c) { c.grid = GridChart{2, 2}; }), {"6 faces", "2 × 2"});
}

TEST(LimitSurfaceErrors, NonManifold) {
  // Three faces on one edge.
  Cage fin = openGrid(2, 1);
  fin.positions.emplace_back(1, 0, 1);
  fin.positions.emplace_back(1, 1, 1);
  for (const int v : {1, 4, 7, 6}) fin.faceVertices.push_back(v);
  for (const int uv : {0, 1, 2, 3}) fin.faceUvs.push_back(uv);
  expectInputError([&] { const LimitSurface surface(fin); }, {"vertices 1 and 4"});
  // Two faces that meet at one vertex only.
  Cage bowTie = openGrid(2, 2);
  const std::vector<int> kept = {0, 1, 4, 3, 4, 5, 8, 7};
  bowTie.faceVertices = kept;
  bowTie.faceUvs = kept;
  expectInputError([&] { const LimitSurface surface(bowTie); }, {"vertex 4", "more than one fan"});
  // The same face twice.
  Cage twice = openGrid(1, 1);
  twice.faceVertices = {0, 1, 3, 2, 0, 1, 3, 2};
  twice.faceUvs = twice.faceVertices;
  expectInputError([&] { const LimitSurface surface(twice); }, {"opposite directions"});
}

TEST(LimitSurfaceErrors, NoInnerFace) {
  Cage cage = openGrid(2, 2);
  cage.border = CageBorder::support;
  expectInputError([&] { const LimitSurface surface(cage); }, {"no face has a limit surface"});
}

TEST(LimitSurfaceErrors, FaceOutOfRange) {
  const LimitSurface surface(cubeCage());
  EXPECT_THROW(static_cast<void>(surface.evaluate(6, 0, 0)), InternalError);
  EXPECT_THROW(static_cast<void>(surface.corners(-1)), InternalError);
}

/// How much more memory this process holds at most from here on (Linux).
class PeakGrowth {
 public:
  PeakGrowth() {
    std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew
    begin_ = peakBytes();
  }
  [[nodiscard]] double bytes() const { return peakBytes() - begin_; }

 private:
  static double peakBytes() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
      if (line.rfind("VmHWM:", 0) == 0) return 1024 * std::stod(line.substr(6));
    }
    ADD_FAILURE() << "no VmHWM in /proc/self/status";
    return 0;
  }
  double begin_ = 0;
};

/// A grid with hills.
Cage hillyGrid(int columns, int rows) {
  Cage cage = openGrid(columns, rows);
  Random random(3);
  for (Vec3& position : cage.positions) position.z = random(0, 0.3);
  return cage;
}

/// The grid with its squares cut into triangles, as a file: no face of a Catmull-Clark cage made of
/// it is regular.
std::string triangles(const Cage& grid) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " +
                     std::to_string(grid.positions.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nproperty float u\n"
                     "property float v\nelement face " +
                     std::to_string(2 * grid.faceCount()) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : grid.positions) {
    text += fmt::format("{} {} {} {} {}\n", p.x, p.y, p.z, p.x, p.y);
  }
  for (std::size_t i = 0; i < grid.faceVertices.size(); i += 4) {
    const int* v = &grid.faceVertices[i];
    text += fmt::format("3 {} {} {}\n3 {} {} {}\n", v[0], v[1], v[2], v[0], v[2], v[3]);
  }
  return text;
}

TEST(LargeCage, AHundredThousandFacesTakeBoundedMemory) {
  if (test::isSanitized) GTEST_SKIP() << "memory is not the program's own";
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      ("gnomon_large" + std::to_string(std::random_device{}()) + ".ply");
  std::ofstream(path) << triangles(hillyGrid(170, 100));
  const PeakGrowth growth;
  const Cage cage = readMeshFile(path);
  std::filesystem::remove(path);
  ASSERT_EQ(cage.faceCount(), 3 * 2 * 170 * 100);
  const LimitSurface surface(cage);
  EXPECT_EQ(surface.faceCount(), 102000);
  expectFinite(surface.evaluate(101999, 0.5, 0.5));
  // Measured: 1.36 GB, most of it patch points about the vertices that are not of four faces.
  EXPECT_LT(growth.bytes(), 1.6e9);
  EXPECT_GT(growth.bytes(), 1e8);
}

TEST(LargeCage, OneThatWouldNotFitIsRefusedBeforeItIsBuilt) {
  // Every edge another sharpness: no two faces share their patches.
  Cage cage = hillyGrid(400, 250);
  Random random(4);
  for (int face = 0; face < cage.faceCount(); ++face) {
    const int* corner = &cage.faceVertices[4 * static_cast<std::size_t>(face)];
    cage.creases.push_back({{corner[0], corner[1]}, random(4, 10)});
    cage.creases.push_back({{corner[0], corner[3]}, random(4, 10)});
  }
  if (test::isSanitized || static_cast<double>(availableMemoryBytes()) > 50e9) {
    GTEST_SKIP() << "it might fit here";
  }
  const PeakGrowth growth;
  try {
    const LimitSurface surface(cage);
    FAIL() << "not refused";
  } catch (const MemoryError& error) {
    EXPECT_NE(std::string(error.what()).find("of 100000 faces took"), std::string::npos);
  }
  EXPECT_LT(growth.bytes(), 2e9);
}

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
