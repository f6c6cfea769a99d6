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

using ::testing::HasSubstr;

class ApiSurface : public TemporaryFolder {};

double areaOf(const Surface& surface) {
  const SurfaceSamples samples = atlasSamples(surface, 8);
  return std::accumulate(samples.weights.begin(), samples.weights.end(), 0.0);
}

// What a sphere of radius R has between two longitudes and two latitudes: R² Δλ 2 sin(Δφ / 2).
TEST_F(ApiSurface, WeightsOfAnAtlasSumToTheArea) {
  EXPECT_NEAR(areaOf(makeShape("plane", {3, 5}, 3, 2)), 15, 15e-5);
  EXPECT_NEAR(areaOf(makeShape("sphere", {7, 1, 2}, 40, 40)), 49 * 2 * std::sin(1), 1e-2);
  EXPECT_NEAR(areaOf(makeShape("cylinder", {5, 2, 4}, 40, 2)), 5 * 2 * 4, 1e-2);
  const double pi = std::acos(-1);
  EXPECT_NEAR(areaOf(makeShape("torus", {6, 2}, 64, 64)), 4 * pi * pi * 6 * 2, 0.1);
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

TEST_F(ApiSurface, TakesAFile) {
  std::ofstream(file("square.obj"))
      << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
         "f 1/1 2/2 3/3 4/4\n";
  EXPECT_EQ(readSurface(file("square.obj")).faceCount(), 1);
  EXPECT_THAT(failureOf([&] { (void)readSurface(file("none.obj")); }), HasSubstr("none.obj"));
}

TEST_F(ApiSurface, AnAtlasHasItsFirstRowAtTheTop) {
  const SurfaceSamples samples = atlasSamples(makeShape("plane", {1, 1}, 2, 2), 4);
  ASSERT_EQ(samples.width, 8);
  ASSERT_EQ(samples.height, 8);
  EXPECT_EQ(samples.places.front().face, 2);
  EXPECT_EQ(samples.places.front().s, 0.125F);
  EXPECT_EQ(samples.places.front().t, 0.875F);
  EXPECT_EQ(samples.places.back().face, 1);
}

// Seen from straight above, a pixel shows the point of the plane that lies under it.
TEST_F(ApiSurface, ACameraShowsWhatIsUnderItsPixels) {
  constexpr int pixels = 16;
  const Surface plane = makeShape("plane", {2, 2}, 1, 1);
  PinholeCamera camera;
  camera.eye = {0, 0, 2};
  camera.verticalFov = 2 * std::atan(0.5);  // one unit wide
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
  EXPECT_THAT(failureOf([] { (void)makeShape("cone", {1}, 2, 2); }), HasSubstr("cone"));
  EXPECT_THAT(failureOf([] { (void)makeShape("torus", {1}, 2, 2); }), HasSubstr("2 expected"));
  EXPECT_NE(failureOf([] { (void)makeShape("plane", {1, -1}, 2, 2); }), "");
  TwoSquares squares;
  squares.faces.back() = 77;
  EXPECT_THAT(failureOf([&] { (void)makeSurface(squares.mesh()); }), HasSubstr("77"));
  squares.faces.pop_back();
  EXPECT_THAT(failureOf([&] { (void)makeSurface(squares.mesh()); }), HasSubstr("7 corners"));
  squares.positions.pop_back();
  EXPECT_THAT(failureOf([&] { (void)makeSurface(squares.mesh()); }), HasSubstr("positions"));
  const Surface plane = makeShape("plane", {1, 1}, 2, 2);
  EXPECT_THAT(failureOf([&] { (void)atlasSamples(plane, 0); }), HasSubstr("side"));
  EXPECT_THAT(failureOf([&] { (void)atlasSamples(plane, 1 << 20); }), HasSubstr("side"));
  PinholeCamera camera;
  camera.width = 0;
  EXPECT_THAT(failureOf([&] { (void)cameraSamples(plane, camera); }), HasSubstr("camera"));
}

}  // namespace
}  // namespace gnomon::test
