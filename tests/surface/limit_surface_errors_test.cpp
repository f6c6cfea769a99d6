#include <functional>
#include <limits>
#include <utility>

#include "surface/limit_surface.h"
#include "surface/test_surfaces.h"

namespace gnomon::surface {
namespace {

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

}  // namespace
}  // namespace gnomon::surface
