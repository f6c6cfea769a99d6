#include "study/run/scene/view_samples.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/camera.h"
#include "surface/base_mesh.h"
#include "truth/shadow_tracer.h"
#include "truth/truth_scenes.h"

namespace gnomon::study {
namespace {

using test::cubeCage;
using test::lightToward;
using test::stepRelief;

/// The samples that an atlas of a grid chart has, by its description.
surface::SampleGrid atlasSamples(const surface::LimitSurface& surface,
                                 const render::RenderView& view) {
  const int columns = surface.grid().value().columns;
  const int side = view.width / columns;
  surface::SampleGrid grid{view.width, view.height, {}};
  for (int row = 0; row < view.height; ++row) {
    const int up = view.height - 1 - row;
    for (int column = 0; column < view.width; ++column) {
      grid.samples.push_back({up / side * columns + column / side,
                              (static_cast<float>(column % side) + 0.5F) / static_cast<float>(side),
                              (static_cast<float>(up % side) + 0.5F) / static_cast<float>(side)});
    }
  }
  return grid;
}

/// Samples here and there on all faces.
surface::SampleGrid scatteredSamples(const surface::LimitSurface& surface) {
  surface::SampleGrid grid{surface.faceCount(), 1, {}};
  for (int face = 0; face < surface.faceCount(); ++face) {
    const auto share = [face](int k) { return static_cast<float>((face * k + 3) % 17 + 1) / 19; };
    grid.samples.push_back({face, share(5), share(7)});
  }
  return grid;
}

/// Where a camera shows a point, in columns and rows, by its axes.
Vec2 pixelOf(const Camera& camera, const Vec3& point) {
  const CameraAxes axis = axes(camera);
  const Vec3 to = point - camera.eye;
  const double scale = camera.height / (2 * std::tan(camera.verticalFov / 2));
  const Vec2 offset =
      Vec2(glm::dot(to, axis.right), -glm::dot(to, axis.up)) / -glm::dot(to, axis.back) * scale;
  return offset + Vec2(camera.width, camera.height) / 2.0;
}

/// The direction in which shadows fall at a point, unit.
Vec3 fallDirection(const surface::LimitPoint& point, const Vec3& light) {
  const Vec3 normal = surface::outwardNormal(point);
  return glm::normalize(glm::cross(normal, glm::cross(normal, light)));
}

Camera obliqueCamera() {
  Camera camera;
  camera.eye = {40, -90, 160};
  camera.target = {3, 0, 30};
  camera.width = 300;
  camera.height = 200;
  return camera;
}

TEST(LightField, IsTheMotionOfThePictureInACamera) {
  const surface::LimitSurface surface(surface::makeSphere(60, 1.6, 1.2, 20, 15));
  const Camera camera = obliqueCamera();
  const render::RenderView view =
      render::cameraView(camera, surface::makeBaseMesh(surface, Vec2(1), 1));
  const surface::SampleGrid samples = scatteredSamples(surface);
  const Vec3 light = lightToward(35, 40);
  const compare::LightField field = makeLightField(surface, camera, view, samples, light);
  ASSERT_EQ(field.steps.size(), samples.samples.size());
  EXPECT_EQ(field.width, samples.width);
  EXPECT_EQ(field.height, 1);
  EXPECT_EQ(field.tileSide, 0);
  int defined = 0;
  for (std::size_t i = 0; i < field.steps.size(); ++i) {
    const compare::LightStep& step = field.steps[i];
    const surface::SurfaceSample& sample = samples.samples[i];
    const surface::LimitPoint point = surface.evaluate(sample);
    if (step.away == glm::vec2(0)) continue;
    ++defined;
    EXPECT_NEAR(glm::length(step.away), 1, 1e-6);
    // Half a step on and back by the camera's own axes.
    const Vec3 half = 0.005 * static_cast<double>(step.length) * fallDirection(point, light);
    const Vec2 motion =
        (pixelOf(camera, point.position + half) - pixelOf(camera, point.position - half)) / 0.01;
    EXPECT_NEAR(glm::distance(motion, Vec2(step.away)), 0, 1e-4);
    EXPECT_NEAR(glm::distance(Vec3(step.place), point.position), 0, 1e-5);
  }
  EXPECT_GT(defined, 200);
}

TEST(LightField, FromPointsIsTheSame) {
  const surface::LimitSurface surface(surface::makeSphere(60, 1.6, 1.2, 20, 15));
  const Camera camera = obliqueCamera();
  const surface::SampleGrid samples = scatteredSamples(surface);
  const render::RenderView seen =
      render::cameraView(camera, surface::makeBaseMesh(surface, Vec2(1), 1));
  const FieldPoints points = makeFieldPoints(surface, camera, seen, samples);
  for (const double azimuth : {35.0, -70.0}) {
    const Vec3 light = lightToward(azimuth, 40);
    const compare::LightField alone = makeLightField(surface, camera, seen, samples, light);
    const compare::LightField found = makeLightField(surface, camera, seen, samples, points, light);
    ASSERT_EQ(found.steps.size(), alone.steps.size());
    for (std::size_t i = 0; i < alone.steps.size(); ++i) {
      EXPECT_EQ(found.steps[i].away, alone.steps[i].away) << i;
      EXPECT_EQ(found.steps[i].length, alone.steps[i].length) << i;
      EXPECT_EQ(found.steps[i].place, alone.steps[i].place) << i;
      EXPECT_EQ(found.steps[i].spacing, alone.steps[i].spacing) << i;
    }
  }
}

TEST(LightField, IsTheMotionOfTheParametersInAnAtlas) {
  const surface::LimitSurface surface(surface::makeSphere(60, 1.6, 1.2, 20, 15));
  constexpr int side = 8;
  const render::RenderView view = render::atlasView(surface, side);
  const surface::SampleGrid samples = scatteredSamples(surface);
  const Vec3 light = lightToward(-70, 50);
  const compare::LightField field = makeLightField(surface, AtlasSpec{side}, view, samples, light);
  int defined = 0;
  for (std::size_t i = 0; i < field.steps.size(); ++i) {
    const compare::LightStep& step = field.steps[i];
    if (step.away == glm::vec2(0)) continue;
    ++defined;
    const surface::SurfaceSample& sample = samples.samples[i];
    const surface::LimitPoint point = surface.evaluate(sample);
    // A hundredth of a step there and back: columns along s, rows against t.
    const Vec2 move = 0.01 * Vec2(step.away.x, -step.away.y) / double{side};
    const auto at = [&](double sign) {
      return surface
          .evaluate(sample.face, sample.s + sign * move.x / 2, sample.t + sign * move.y / 2)
          .position;
    };
    const Vec3 motion = (at(1) - at(-1)) / (0.01 * static_cast<double>(step.length));
    EXPECT_NEAR(glm::distance(motion, fallDirection(point, light)), 0, 1e-3);
  }
  EXPECT_GT(defined, 200);
}

TEST(LightField, HasNoDirectionWhereShadowsHaveNone) {
  const surface::LimitSurface surface(surface::makeSphere(60, 1.6, 1.2, 20, 15));
  const render::RenderView view = render::atlasView(surface, 8);
  surface::SampleGrid samples = scatteredSamples(surface);
  samples.samples[7].face = -1;
  const Vec3 light = lightToward(20, 25);
  const compare::LightField field = makeLightField(surface, AtlasSpec{8}, view, samples, light);
  int turned = 0;
  for (std::size_t i = 0; i < field.steps.size(); ++i) {
    const surface::SurfaceSample& sample = samples.samples[i];
    if (!sample.isOnSurface()) continue;
    const Vec3 normal = surface::outwardNormal(surface.evaluate(sample));
    EXPECT_EQ(field.steps[i].away == glm::vec2(0), glm::dot(normal, light) <= 0);
    turned += glm::dot(normal, light) <= 0 ? 1 : 0;
  }
  EXPECT_GT(turned, 20);
  EXPECT_EQ(field.steps[7].away, glm::vec2(0));
  // Straight from above nothing is cast.
  const surface::LimitSurface plane(surface::makePlane(8, 8, 2, 2));
  for (const compare::LightStep& step :
       makeLightField(plane, AtlasSpec{4}, render::atlasView(plane, 4), scatteredSamples(plane),
                      {0, 0, 1})
           .steps) {
    EXPECT_EQ(step.away, glm::vec2(0));
  }
}

TEST(LightField, ReachesNeighboursAndNotMuchFarther) {
  const surface::LimitSurface plane(surface::makePlane(8, 4, 2, 2));
  const render::RenderView view =
      render::atlasView(plane, 4);  // samples 1 apart along x, ½ along y
  const surface::SampleGrid samples = atlasSamples(plane, view);
  for (const compare::LightStep& step :
       makeLightField(plane, AtlasSpec{4}, view, samples, lightToward(30, 45)).steps) {
    EXPECT_NEAR(step.spacing, 3 * (1 + 0.5), 1e-5);
  }
  Camera camera;
  camera.eye = {0, 0, 100};
  camera.height = 50;
  const double pixel = 2 * 100 * std::tan(camera.verticalFov / 2) / camera.height;
  const render::RenderView above =
      render::cameraView(camera, surface::makeBaseMesh(plane, Vec2(1), 1));
  for (const compare::LightStep& step :
       makeLightField(plane, camera, above, samples, lightToward(30, 45)).steps) {
    EXPECT_NEAR(step.spacing, 3 * 2 * pixel, 1e-4);
    EXPECT_NEAR(step.length, pixel, 1e-5);
  }
}

TEST(LightField, HasTilesWhereTheChartIsNoGrid) {
  const surface::LimitSurface cube(cubeCage());
  const render::RenderView view = render::atlasView(cube, 6);
  EXPECT_EQ(makeLightField(cube, AtlasSpec{6}, view, scatteredSamples(cube), lightToward(30, 45))
                .tileSide,
            6);
  Camera camera = obliqueCamera();
  const render::RenderView seen =
      render::cameraView(camera, surface::makeBaseMesh(cube, Vec2(1), 1));
  EXPECT_EQ(
      makeLightField(cube, camera, seen, scatteredSamples(cube), lightToward(30, 45)).tileSide, 0);
  const surface::LimitSurface plane(surface::makePlane(8, 4, 2, 2));
  EXPECT_EQ(makeLightField(plane, AtlasSpec{6}, render::atlasView(plane, 6),
                           scatteredSamples(plane), {0, 0, 1})
                .tileSide,
            0);
}

// ---- through the truth, to a closed form

/// A block 20 × 12 texels wide and 5 high on a plane of one unit a texel: its rim is at the centres
/// of its outermost texels, and beyond it every line is in shadow for height / tan(elevation).
class BlockShadow : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(BlockShadow, IsAsLongAsTheTangentOfTheLightSays) {
  const auto [azimuth, elevation] = GetParam();
  constexpr double height = 5;
  const surface::LimitSurface surface(surface::makePlane(96, 64, 24, 16));
  const relief::Relief relief = stepRelief(
      96, 64, height, [](int i, int j) { return i >= 38 && i < 58 && j >= 26 && j < 38; });
  const truth::MicroMesh mesh(surface, relief, {0.25, 0});
  const truth::MicroScene scene(mesh);
  constexpr int side = 24;  // six samples a unit
  const render::RenderView view = render::atlasView(surface, side);
  const surface::SampleGrid samples = atlasSamples(surface, view);
  const Vec3 light = lightToward(azimuth, elevation);
  const truth::Truth truth =
      truth::traceShadows(surface, relief, mesh, scene, samples, {light, 1e-6});
  const compare::ShadowLengths found = compare::compareShadowLengths(
      truth.mask, truth.mask, makeLightField(surface, AtlasSpec{side}, view, samples, light));
  ASSERT_TRUE(found.truthLength) << found.runs;
  EXPECT_NEAR(*found.truthLength, height / std::tan(radians(elevation)), 1.0 / 6);
  EXPECT_EQ(found.ratio, 1);
  // The rim has a line a sample of its width across the light; the slopes around it, a texel on
  // each side, have shorter ones.
  const auto across = [turn = azimuth](double width, double depth) {
    return width * std::abs(std::sin(radians(turn))) + depth * std::abs(std::cos(radians(turn)));
  };
  EXPECT_GT(found.runs, 6 * across(19, 11));
  EXPECT_LT(found.runs, 6 * across(21, 13) * (1 + std::sqrt(2) / 34));
}

INSTANTIATE_TEST_SUITE_P(Lights, BlockShadow,
                         testing::Values(std::pair{0.0, 45.0}, std::pair{90.0, 30.0},
                                         std::pair{200.0, 35.0}, std::pair{-55.0, 30.0},
                                         std::pair{135.0, 60.0}, std::pair{270.0, 25.0}));

}  // namespace
}  // namespace gnomon::study
