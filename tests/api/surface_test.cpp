#include "gnomon/surface.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numeric>
#include <vector>

#include "api/failure_of.h"
#include "support/temporary_folder.h"

namespace gnomon::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ApiSurface : public TemporaryFolder {};

double areaOf(const Surface& surface) {
  const SurfaceSamples samples = atlasSamples(surface, 8);
  return std::accumulate(samples.weights.begin(), samples.weights.end(), 0.0);
}

// What a sphere of radius R has between two longitudes and two latitudes: R² Δλ 2 sin(Δφ / 2).
TEST_F(ApiSurface, WeightsOfAnAtlasSumToTheArea) {
  EXPECT_NEAR(areaOf(makeShape("plane", {{"quads", {3, 2}}, {"size", {3, 5}}})), 15, 15e-5);
  const ShapeKeys patch = {{"quads", {40, 40}}, {"curvature", {1.0 / 7}}, {"size", {7, 14}}};
  EXPECT_NEAR(areaOf(makeShape("sphere", patch)), 49 * 2 * std::sin(1), 1e-2);
  const ShapeKeys pipe = {{"quads", {40, 2}}, {"curvature", {1.0 / 5}}, {"size", {10, 4}}};
  EXPECT_NEAR(areaOf(makeShape("cylinder", pipe)), 5 * 2 * 4, 1e-2);
  const double pi = std::acos(-1);
  EXPECT_NEAR(areaOf(makeShape("torus", {{"quads", {64, 64}}, {"major", {6}}, {"minor", {2}}})),
              4 * pi * pi * 6 * 2, 0.1);
}

/// Two squares side by side in z = 0, u along x and v along y.
struct TwoSquares {
  std::vector<double> positions = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
  std::vector<int> faces = {0, 1, 4, 3, 1, 2, 5, 4};
  std::vector<double> uvs = {0, 0, 0.5, 0, 1, 0, 0, 1, 0.5, 1, 1, 1};
  [[nodiscard]] ControlMesh mesh() const { return {positions, faces, uvs, {}}; }
};

TEST_F(ApiSurface, TakesAControlMesh) {
  const TwoSquares squares;
  const Surface surface = makeSurface(squares.mesh());
  EXPECT_EQ(surface.faceCount(), 2);
  EXPECT_NEAR(areaOf(surface), 2, 1e-3);
}

// As they are, a bent square keeps its area, and a cube its corners, which a limit surface rounds
// off.
TEST_F(ApiSurface, TakesPolygonsAsTheyAre) {
  const std::vector<double> corners = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                                       -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
  const std::vector<int> faces = {4, 5, 7, 6, 1, 0, 2, 3, 5, 1, 3, 7,
                                  0, 4, 6, 2, 6, 7, 3, 2, 0, 1, 5, 4};
  const std::vector<double> uvs(16, 0.5);
  ControlMesh cube{corners, faces, uvs, {}};
  EXPECT_LT(areaOf(makeSurface(cube)), 12);
  cube.polygons = true;
  EXPECT_EQ(makeSurface(cube).faceCount(), 6);
  EXPECT_NEAR(areaOf(makeSurface(cube)), 24, 1e-3);
}

TEST_F(ApiSurface, TakesAFile) {
  std::ofstream(file("square.obj"))
      << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
         "f 1/1 2/2 3/3 4/4\n";
  EXPECT_EQ(readSurface(file("square.obj"), "catmull-clark").faceCount(), 1);
  EXPECT_EQ(readSurface(file("square.obj"), "none").faceCount(), 1);
  EXPECT_THAT(failureOf([&] { (void)readSurface(file("none.obj"), "none"); }),
              HasSubstr("none.obj"));
  EXPECT_THAT(failureOf([&] { (void)readSurface(file("square.obj"), "nurbs"); }),
              HasSubstr("one of catmull-clark, loop, none expected"));
}

TEST_F(ApiSurface, AnAtlasHasItsFirstRowAtTheTop) {
  const SurfaceSamples samples =
      atlasSamples(makeShape("plane", {{"quads", {2, 2}}, {"size", {1, 1}}}), 4);
  ASSERT_EQ(samples.width, 8);
  ASSERT_EQ(samples.height, 8);
  EXPECT_EQ(samples.places.front().face, 2);
  EXPECT_EQ(samples.places.front().s, 0.125F);
  EXPECT_EQ(samples.places.front().t, 0.875F);
  EXPECT_EQ(samples.places.back().face, 1);
}

// Points come three numbers each, row by row: a patch of the plane over the unit square.
TEST_F(ApiSurface, TakesControlPoints) {
  std::vector<double> points;
  for (int i = 0; i < 16; ++i) {
    points.insert(points.end(), {i % 4 / 3.0, i / 4 / 3.0, 0.0});
  }
  const Surface patch = makeShape("bezier", {{"quads", {3, 2}}, {"points", points}});
  EXPECT_EQ(patch.faceCount(), 6);
  EXPECT_NEAR(areaOf(patch), 1, 1e-4);
  const Surface spline = makeShape("b-spline", {{"columns", {4}}, {"points", points}});
  EXPECT_EQ(spline.faceCount(), 1);
  EXPECT_NEAR(areaOf(spline), 1.0 / 9, 1e-5) << "the middle of 3 × 3 cells";
  points.pop_back();
  EXPECT_THAT(failureOf([&] {
                (void)makeShape("bezier", {{"quads", {3, 2}}, {"points", points}});
              }),
              HasSubstr("points: "));
}

// Seen from straight above, a pixel shows the point of the plane that lies under it.
TEST_F(ApiSurface, ACameraShowsWhatIsUnderItsPixels) {
  constexpr int pixels = 16;
  const Surface plane = makeShape("plane", {{"quads", {1, 1}}, {"size", {2, 2}}});
  PinholeCamera camera;
  camera.eye = {0, 0, 2};
  camera.fov = 360 / std::acos(-1) * std::atan(0.5);  // one unit wide
  camera.width = camera.height = pixels;
  const SurfaceSamples samples = cameraSamples(plane, camera);
  ASSERT_EQ(samples.places.size(), static_cast<std::size_t>(pixels * pixels));
  for (int y = 0; y < pixels; ++y) {
    for (int x = 0; x < pixels; ++x) {
      const SurfacePlace& place = samples.places[static_cast<std::size_t>(y * pixels + x)];
      EXPECT_EQ(place.face, 0);
      EXPECT_NEAR(place.s, 0.5 + (x + 0.5 - 8) / 16 / 2 * 2, 1e-5);
      EXPECT_NEAR(place.t, 0.5 - (y + 0.5 - 8) / 16 / 2 * 2, 1e-5);
    }
  }
}

TEST_F(ApiSurface, RefusesWhatIsNoSurface) {
  const auto refusal = [](std::string_view shape, const ShapeKeys& keys) {
    return failureOf([&] { (void)makeShape(shape, keys); });
  };
  EXPECT_THAT(refusal("cone", {}), AllOf(HasSubstr("cone"), HasSubstr("torus")));
  EXPECT_THAT(refusal("torus", {{"quads", {64, 64}}, {"major", {1}}}), HasSubstr("minor: missing"));
  EXPECT_THAT(refusal("plane", {{"quads", {2, 2}}, {"size", {1, -1}}}),
              HasSubstr("size: -1 found"));
  EXPECT_THAT(refusal("plane", {{"quads", {2.5, 2}}, {"size", {1, 1}}}), HasSubstr("quads: "));
  EXPECT_THAT(refusal("plane", {{"quads", {2, 2}}, {"size", {1, 1}}, {"major", {1}}}),
              HasSubstr("major: unknown key"));
  EXPECT_THAT(refusal("plane", {{"quads", {2, 2}}, {"size", {1, 1}}, {"radius", {1}}}),
              HasSubstr("radius: unknown key"));
  TwoSquares squares;
  squares.faces.back() = 77;
  EXPECT_THAT(failureOf([&] { (void)makeSurface(squares.mesh()); }), HasSubstr("77"));
  squares.faces.pop_back();
  EXPECT_THAT(failureOf([&] { (void)makeSurface(squares.mesh()); }), HasSubstr("7 corners"));
  squares.positions.pop_back();
  EXPECT_THAT(failureOf([&] { (void)makeSurface(squares.mesh()); }), HasSubstr("positions"));
  const Surface plane = makeShape("plane", {{"quads", {2, 2}}, {"size", {1, 1}}});
  EXPECT_THAT(failureOf([&] { (void)atlasSamples(plane, 0); }), HasSubstr("samples: 0 found"));
  EXPECT_THAT(failureOf([&] { (void)atlasSamples(plane, 4097); }), HasSubstr("samples"));
  const auto refused = [&](const PinholeCamera& camera, int subdivisions = 1) {
    return failureOf([&] { (void)cameraSamples(plane, camera, subdivisions); });
  };
  PinholeCamera camera;
  for (const double fov : {0.0, 171.0, std::nan("")}) {
    camera.fov = fov;
    EXPECT_THAT(refused(camera), AllOf(StartsWith("camera: fov: "), HasSubstr("(degrees")));
  }
  camera = {};
  camera.eye[1] = std::nan("");
  EXPECT_THAT(refused(camera), StartsWith("camera: eye: nan found"));
  EXPECT_THAT(refused({}, 0), StartsWith("camera: subdivisions: 0 found"));
  camera = {};
  camera.width = 0;
  EXPECT_THAT(refused(camera), StartsWith("camera: width: 0 found"));
}

}  // namespace
}  // namespace gnomon::test
