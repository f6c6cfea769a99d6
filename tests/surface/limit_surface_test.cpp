#include "surface/limit_surface.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "common/parallel.h"
#include "surface/shapes.h"
#include "surface/test_surfaces.h"

namespace gnomon {
namespace {

/// Catmull-Clark by the rules of the paper on a closed mesh of quadrilaterals, and the limit masks
/// of Halstead, Kass & DeRose 1993. Shares nothing with OpenSubdiv.
struct PlainSubdivision {
  struct Face {
    std::array<int, 4> vertices;
    std::array<Vec2, 4> st;
    int cageFace;
  };
  std::vector<Vec3> positions;
  std::vector<Face> faces;

  explicit PlainSubdivision(const Cage& cage) : positions(cage.positions) {
    for (int f = 0; f < cage.faceCount(); ++f) {
      Face face{{}, {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}, f};
      for (std::size_t k = 0; k < 4; ++k) {
        face.vertices[k] = cage.faceVertices[4 * static_cast<std::size_t>(f) + k];
      }
      faces.push_back(face);
    }
  }

  [[nodiscard]] const Vec3& at(int vertex) const {
    return positions[static_cast<std::size_t>(vertex)];
  }

  void step() {
    const std::size_t old = positions.size();
    std::vector<Vec3> facePoints;
    std::vector<Vec3> faceSum(old, Vec3(0)), midSum(old, Vec3(0));
    std::vector<int> valence(old, 0);
    std::map<std::pair<int, int>, Vec3> edgeFaceSum;
    for (const Face& face : faces) {
      Vec3 centre(0);
      for (const int v : face.vertices) centre += at(v) / 4.0;
      facePoints.push_back(centre);
      for (std::size_t k = 0; k < 4; ++k) {
        const int a = face.vertices[k];
        const int b = face.vertices[(k + 1) % 4];
        const auto i = static_cast<std::size_t>(a);
        faceSum[i] += centre;
        midSum[i] += (at(a) + at(b)) / 2.0;  // each edge leaves the vertex in one face
        ++valence[i];
        edgeFaceSum.try_emplace(std::minmax(a, b), Vec3(0)).first->second += centre;
      }
    }
    std::vector<Vec3> next(old);
    for (std::size_t i = 0; i < old; ++i) {
      const double n = valence[i];
      next[i] = (faceSum[i] / n + 2.0 * midSum[i] / n + (n - 3) * positions[i]) / n;
    }
    std::map<std::pair<int, int>, int> edgePoint;
    for (const auto& [edge, sum] : edgeFaceSum) {
      edgePoint[edge] = static_cast<int>(next.size());
      next.push_back((at(edge.first) + at(edge.second) + sum) / 4.0);
    }
    std::vector<Face> children;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const Face& face = faces[f];
      const int middle = static_cast<int>(next.size());
      next.push_back(facePoints[f]);
      const auto edge = [&](std::size_t k) {
        return edgePoint.at(std::minmax(face.vertices[k % 4], face.vertices[(k + 1) % 4]));
      };
      const auto half = [&](std::size_t k) {
        return (face.st[k % 4] + face.st[(k + 1) % 4]) / 2.0;
      };
      const Vec2 centre = (face.st[0] + face.st[2]) / 2.0;
      for (std::size_t k = 0; k < 4; ++k) {
        children.push_back({{face.vertices[k], edge(k), middle, edge(k + 3)},
                            {face.st[k], half(k), centre, half(k + 3)},
                            face.cageFace});
      }
    }
    positions = std::move(next);
    faces = std::move(children);
  }

  /// Keeps the faces that lie within `reach` of a corner of the cage, where that corner is a vertex
  /// of theirs. Rules that miss a neighbour then spoil the rim: by one ring a step.
  void crop(const Cage& cage, int corner, double reach) {
    constexpr std::array<Vec2, 4> places = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
    const auto isFar = [&](const Face& face) {
      for (std::size_t k = 0; k < 4; ++k) {
        if (cage.faceVertices[4 * static_cast<std::size_t>(face.cageFace) + k] != corner) continue;
        const Vec2 offset = glm::abs((face.st[0] + face.st[2]) / 2.0 - places[k]);
        return std::max(offset.x, offset.y) > reach;
      }
      return true;
    };
    faces.erase(std::remove_if(faces.begin(), faces.end(), isFar), faces.end());
  }

  [[nodiscard]] std::vector<Vec3> limits() const {
    std::vector<Vec3> edges(positions.size(), Vec3(0)), corners(positions.size(), Vec3(0));
    std::vector<int> valence(positions.size(), 0);
    for (const Face& face : faces) {
      for (std::size_t k = 0; k < 4; ++k) {
        const auto i = static_cast<std::size_t>(face.vertices[k]);
        edges[i] += at(face.vertices[(k + 1) % 4]);
        corners[i] += at(face.vertices[(k + 2) % 4]);
        ++valence[i];
      }
    }
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double n = valence[i];
      result.push_back((n * n * positions[i] + 4.0 * edges[i] + corners[i]) / (n * (n + 5)));
    }
    return result;
  }
};

/// A closed cage with vertices of valence 3, 4 and 5: the cube with its top extruded thrice and
/// one side as well.
Cage branchedCage() {
  Cage cage = cubeCage();
  const auto extrude = [&cage](std::size_t face, const Vec3& by) {
    const int first = static_cast<int>(cage.positions.size());
    std::array<int, 4> base{};
    for (std::size_t k = 0; k < 4; ++k) {
      base[k] = cage.faceVertices[4 * face + k];
      cage.positions.push_back(cage.positions[static_cast<std::size_t>(base[k])] + by);
      cage.faceVertices[4 * face + k] = first + static_cast<int>(k);
    }
    for (int k = 0; k < 4; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const int next = (k + 1) % 4;
      for (const int v : {base[i], base[static_cast<std::size_t>(next)], first + next, first + k}) {
        cage.faceVertices.push_back(v);
      }
      for (int corner = 0; corner < 4; ++corner) cage.faceUvs.push_back(corner);
    }
  };
  extrude(0, {0.2, 0, 1.5});
  extrude(2, {1.5, 0.3, 0});
  extrude(4, {0, 1, 0.4});
  return cage;
}

double worstAgainst(const PlainSubdivision& plain, const LimitSurface& surface) {
  const std::vector<Vec3> limits = plain.limits();
  double worst = 0;
  for (const auto& face : plain.faces) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 position = surface.evaluate(face.cageFace, face.st[k].x, face.st[k].y).position;
      const Vec3& expected = limits[static_cast<std::size_t>(face.vertices[k])];
      worst = std::max(worst, glm::length(position - expected));
    }
  }
  return worst;
}

TEST(LimitSurface, AgreesWithPlainSubdivision) {
  // Outside the last isolated rings, which 6 steps do not reach, agreement is exact.
  for (const Cage& cage : {cubeCage(), branchedCage()}) {
    PlainSubdivision plain(cage);
    for (int i = 0; i < 6; ++i) plain.step();
    EXPECT_LT(worstAgainst(plain, LimitSurface(cage)), 1e-13);
  }
}

/// Largest errors at distances of 2⁻⁷ to 2⁻¹³ of a face from a corner of the cage.
struct CapErrors {
  double outside = 0;  ///< farther than 2⁻¹⁰
  double slide = 0;    ///< within: in all, nearly all of it along the surface
  double lift = 0;     ///< within: along the normal
};

CapErrors errorsBeside(const Cage& cage, int corner) {
  const LimitSurface surface(cage);
  PlainSubdivision plain(cage);
  CapErrors worst;
  for (int level = 1; level <= 13; ++level) {
    plain.step();
    const double size = std::ldexp(1, -level);
    if (level >= 3) plain.crop(cage, corner, 4 * size);
    if (level < 7) continue;
    const std::vector<Vec3> limits = plain.limits();
    PlainSubdivision sound = plain;
    sound.crop(cage, corner, 2 * size);
    for (const auto& face : sound.faces) {
      for (std::size_t k = 0; k < 4; ++k) {
        const LimitPoint point = surface.evaluate(face.cageFace, face.st[k].x, face.st[k].y);
        const Vec3 error = point.position - limits[static_cast<std::size_t>(face.vertices[k])];
        const double length = glm::length(error);
        if (level <= 10) worst.outside = std::max(worst.outside, length);
        worst.slide = std::max(worst.slide, length);
        worst.lift = std::max(worst.lift, std::abs(glm::dot(error, outwardNormal(point))));
      }
    }
  }
  return worst;
}

TEST(LimitSurface, ErrsAsDocumentedBesideExtraordinaryVertices) {
  const Cage cage = branchedCage();  // faces of about 1.5
  std::set<long> seen;
  for (int corner = 0; corner < static_cast<int>(cage.positions.size()); ++corner) {
    const long valence = std::count(cage.faceVertices.begin(), cage.faceVertices.end(), corner);
    if (!seen.insert(valence).second) continue;
    const CapErrors worst = errorsBeside(cage, corner);
    EXPECT_LT(worst.outside, 1e-13) << valence;
    if (valence == 4) {
      EXPECT_LT(worst.slide, 1e-13);
      continue;
    }
    EXPECT_LT(worst.slide, 1e-3) << valence;
    EXPECT_LT(worst.lift, 1e-6) << valence;
    EXPECT_GT(worst.slide, 1e-8) << valence;  // the approximated part was reached
  }
  EXPECT_TRUE(seen.count(3) && seen.count(4) && seen.count(5) && seen.count(6));
}

TEST(LimitSurface, CubeCornerLimitIsTheClosedForm) {
  // (9 v + 4 Σe + Σf) / 24 with v = Σe = -Σf = (1, 1, 1).
  const LimitSurface surface(cubeCage());
  const LimitPoint point = surface.evaluate(0, 1, 1);
  expectNear(point.position, Vec3(0.5), 1e-12);
  expectNear(outwardNormal(point), glm::normalize(Vec3(1)), 1e-7);
}

TEST(LimitSurface, NormalsOfAClosedCageFaceOutward) {
  const LimitSurface surface(cubeCage());
  for (int face = 0; face < 6; ++face) {
    for (const double s : {0.0, 0.3, 1.0}) {
      for (const double t : {0.0, 0.6, 1.0}) {
        const LimitPoint point = surface.evaluate(face, s, t);
        EXPECT_GT(glm::dot(outwardNormal(point), glm::normalize(point.position)), 0.9);
      }
    }
  }
}

TEST(LimitSurface, DerivativesAreThoseOfThePosition) {
  const Cage cage = branchedCage();
  const LimitSurface surface(cage);
  Random random(1);
  const double h = 1e-4;
  for (int face = 0; face < surface.faceCount(); ++face) {
    // Inside one polynomial piece: away from the dyadic lines about extraordinary corners.
    const double s = 0.5 + random(0.05, 0.2);
    const double t = 0.25 + random(0.05, 0.2);
    const auto p = [&](double i, double j) {
      return surface.evaluate(face, s + i * h, t + j * h).position;
    };
    const LimitPoint point = surface.evaluate(face, s, t);
    expectNear(point.ds, (p(1, 0) - p(-1, 0)) / (2 * h), 1e-7, "ds");
    expectNear(point.dt, (p(0, 1) - p(0, -1)) / (2 * h), 1e-7, "dt");
    expectNear(point.dss, (p(1, 0) - 2.0 * p(0, 0) + p(-1, 0)) / (h * h), 1e-6, "dss");
    expectNear(point.dtt, (p(0, 1) - 2.0 * p(0, 0) + p(0, -1)) / (h * h), 1e-6, "dtt");
    expectNear(point.dst, (p(1, 1) - p(1, -1) - p(-1, 1) + p(-1, -1)) / (4 * h * h), 1e-6, "dst");
  }
}

TEST(LimitSurface, FacesMeetAlongSharedEdges) {
  const LimitSurface surface(branchedCage());
  const auto onEdge = [](std::size_t corner, double r) {
    const std::array<Vec2, 4> start = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
    return glm::mix(start[corner], start[(corner + 1) % 4], r);
  };
  std::map<std::pair<int, int>, std::pair<int, std::size_t>> seen;
  int shared = 0;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const auto corners = surface.corners(face);
    for (std::size_t k = 0; k < 4; ++k) {
      seen[{corners[k], corners[(k + 1) % 4]}] = {face, k};
      const auto other = seen.find({corners[(k + 1) % 4], corners[k]});
      if (other == seen.end()) continue;
      ++shared;
      for (const double r : {0.1, 0.25, 0.5, 0.8}) {
        const Vec2 here = onEdge(k, r);
        const Vec2 there = onEdge(other->second.second, 1 - r);
        const LimitPoint a = surface.evaluate(face, here.x, here.y);
        const LimitPoint b = surface.evaluate(other->second.first, there.x, there.y);
        expectNear(a.position, b.position, 1e-12);
        expectNear(outwardNormal(a), outwardNormal(b), 1e-12);
      }
    }
  }
  EXPECT_EQ(shared, 2 * surface.faceCount());  // Euler: a closed quad mesh has 2 F edges
}

TEST(LimitSurface, SharpCreasesKeepTheCube) {
  Cage cage = cubeCage();
  for (int face = 0; face < 6; ++face) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t first = 4 * static_cast<std::size_t>(face);
      cage.creases.push_back(
          {{cage.faceVertices[first + k], cage.faceVertices[first + (k + 1) % 4]}, 10});
    }
  }
  const LimitSurface surface(cage);
  expectNear(surface.evaluate(0, 1, 1).position, Vec3(1), 1e-12);
  expectNear(surface.evaluate(0, 0.5, 1).position, Vec3(0, 1, 1), 1e-12);
  EXPECT_NEAR(surface.evaluate(0, 0.3, 0.8).position.z, 1, 1e-12);
}

TEST(LimitSurface, SharpnessGrowsTowardTheCube) {
  const auto cornerHeight = [](double sharpness) {
    Cage cage = cubeCage();
    if (sharpness > 0) cage.sharpVertices.push_back({7, sharpness});
    return LimitSurface(cage).evaluate(0, 1, 1).position.z;
  };
  EXPECT_NEAR(cornerHeight(0), 0.5, 1e-12);
  EXPECT_GT(cornerHeight(1), cornerHeight(0) + 0.05);
  EXPECT_GT(cornerHeight(3), cornerHeight(1) + 0.05);
  EXPECT_NEAR(cornerHeight(10), 1, 1e-12);
  EXPECT_NEAR(cornerHeight(50), 1, 1e-12);
}

TEST(LimitSurface, SupportBorderLeavesTheInnerFacesInOrder) {
  Cage cage = openGrid(6, 5);
  cage.border = CageBorder::support;
  cage.grid = GridChart{4, 3};
  const LimitSurface surface(cage);
  ASSERT_EQ(surface.faceCount(), 12);
  ASSERT_TRUE(surface.grid().has_value());
  EXPECT_EQ(surface.grid()->columns, 4);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      const LimitPoint point = surface.evaluate(row * 4 + column, 0.25, 0.5);
      expectNear(point.position, {column + 1.25, row + 1.5, 0}, 1e-13);
    }
  }
  EXPECT_EQ(surface.corners(0), (std::array{8, 9, 16, 15}));
  EXPECT_EQ(surface.vertexCount(), 42);
}

TEST(LimitSurface, EdgesAndCornersInterpolatesTheBorder) {
  const LimitSurface surface(openGrid(3, 3));
  EXPECT_EQ(surface.faceCount(), 9);
  EXPECT_FALSE(surface.grid().has_value());
  expectNear(surface.evaluate(0, 0, 0).position, {0, 0, 0}, 1e-13);
  expectNear(surface.evaluate(8, 1, 1).position, {3, 3, 0}, 1e-13);
  EXPECT_NEAR(surface.evaluate(1, 0.3, 0).position.y, 0, 1e-13);
}

TEST(LimitSurface, TextureCoordinatesAreBilinear) {
  Cage cage = openGrid(1, 1);
  cage.uvs = {{0.1, 0.2}, {0.9, 0.3}, {0.2, 1.1}, {1.3, 0.8}};  // corners 0, 1, 3, 2
  const LimitSurface surface(cage);
  const double s = 0.3;
  const double t = 0.6;
  const LimitPoint point = surface.evaluate(0, s, t);
  const Vec2 expected = (1 - s) * (1 - t) * cage.uvs[0] + s * (1 - t) * cage.uvs[1] +
                        s * t * cage.uvs[3] + (1 - s) * t * cage.uvs[2];
  EXPECT_LT(glm::length(point.uv - expected), 1e-15);
  const double h = 1e-6;
  const Vec2 ds = (surface.evaluate(0, s + h, t).uv - surface.evaluate(0, s - h, t).uv) / (2 * h);
  const Vec2 dt = (surface.evaluate(0, s, t + h).uv - surface.evaluate(0, s, t - h).uv) / (2 * h);
  EXPECT_LT(glm::length(point.uvDs - ds), 1e-9);
  EXPECT_LT(glm::length(point.uvDt - dt), 1e-9);
}

TEST(LimitSurface, UvSeamKeepsEachFacesOwnCoordinates) {
  const LimitSurface surface(cubeCage());
  for (int face = 0; face < 6; ++face) {
    EXPECT_EQ(surface.evaluate(face, 1, 0).uv, Vec2(1, 0));
    EXPECT_EQ(surface.evaluate(face, 0, 1).uv, Vec2(0, 1));
  }
}

TEST(LimitSurface, ThreadsSeeTheSameBits) {
  const LimitSurface surface(branchedCage());
  const LimitSurface again(branchedCage());
  constexpr std::size_t count = 20000;
  const auto evaluate = [&](const LimitSurface& which, std::size_t i) {
    const double x = static_cast<double>(i) / count;
    return which.evaluate(static_cast<int>(i) % which.faceCount(), x, std::fmod(7 * x, 1.0));
  };
  std::vector<LimitPoint> points(count);
  parallelFor(0, count, [&](std::size_t i) { points[i] = evaluate(surface, i); });
  for (std::size_t i = 0; i < count; ++i) {
    const LimitPoint point = evaluate(again, i);
    ASSERT_EQ(points[i].position, point.position);
    ASSERT_EQ(points[i].dst, point.dst);
  }
}

TEST(LimitSurface, UnusedVerticesDoNoHarm) {
  Cage cage = cubeCage();
  cage.positions.emplace_back(9, 9, 9);
  expectNear(LimitSurface(cage).evaluate(0, 1, 1).position, Vec3(0.5), 1e-12);
}

TEST(LimitSurface, APillowOfTwoFacesIsFinite) {
  Cage cage = openGrid(1, 1);
  cage.faceVertices = {0, 1, 3, 2, 0, 2, 3, 1};
  cage.faceUvs = cage.faceVertices;
  const LimitSurface surface(cage);
  expectFinite(surface.evaluate(0, 0, 0));
  expectFinite(surface.evaluate(1, 0.4, 0.5));
}

/// Two poles of `count` quadrilaterals each.
Cage polesCage(int count) {
  Cage cage;
  cage.positions = {{0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 2 * count; ++i) {
    const double angle = pi * i / count;
    cage.positions.emplace_back(std::cos(angle), std::sin(angle), i % 2 ? 0.3 : -0.3);
  }
  cage.uvs = {{0, 0}};
  const auto ring = [count](int i) { return 2 + (i + 2 * count) % (2 * count); };
  for (int i = 0; i < 2 * count; i += 2) {
    for (const int v : {0, ring(i - 1), ring(i), ring(i + 1)}) cage.faceVertices.push_back(v);
    for (const int v : {1, ring(i + 2), ring(i + 1), ring(i)}) cage.faceVertices.push_back(v);
  }
  cage.faceUvs.assign(cage.faceVertices.size(), 0);
  return cage;
}

TEST(LimitSurface, HighValenceIsFinite) {
  const LimitSurface surface(polesCage(64));
  for (const double s : {0.0, 1e-3, 0.5, 1.0}) {
    expectFinite(surface.evaluate(0, s, s));
    expectFinite(surface.evaluate(1, s, 0));
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
  const double nan = std::numeric_limits<double>::quiet_NaN();
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
  expectInputError(broken([&](Cage& c) { c.positions[3].y = nan; }),
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
  expectInputError(broken([&](Cage& c) { c.sharpVertices.push_back({0, nan}); }), {"nan"});
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

TEST(OutwardNormal, IsZeroWhereDegenerate) {
  LimitPoint point{};
  EXPECT_EQ(outwardNormal(point), Vec3(0));
  point.ds = {1, 2, 3};
  point.dt = {2, 4, 6};
  EXPECT_EQ(outwardNormal(point), Vec3(0));
  point.dt = {0, 1, 0};
  EXPECT_NEAR(glm::length(outwardNormal(point)), 1, 1e-15);
}

}  // namespace
}  // namespace gnomon
