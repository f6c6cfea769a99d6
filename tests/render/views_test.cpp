#include <gtest/gtest.h>

#include <array>
#include <random>

#include "common/error.h"
#include "render/render_scene.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::flatRelief;
using test::RenderScene;

TEST(AtlasView, HasEverySampleOfARegularGridOnce) {
  const GlContext gl;
  const RenderScene scene(surface::makeSphere(60, 1.6, 1.2, 20, 15), flatRelief(40, 30), {4, 10},
                          horizon::TableBits::eight);
  constexpr int side = 7;
  const RenderView view = atlasView(scene.surface, side);
  ASSERT_EQ(view.width, 20 * side);
  ASSERT_EQ(view.height, 15 * side);
  const surface::SampleGrid grid = scene.samples(view);
  for (int row = 0; row < view.height; ++row) {
    for (int column = 0; column < view.width; ++column) {
      const auto i = static_cast<std::size_t>(row * view.width + column);
      const int up = view.height - 1 - row;
      const surface::SurfaceSample& sample = grid.samples[i];
      ASSERT_EQ(sample.face, up / side * 20 + column / side);
      EXPECT_NEAR(sample.s, (column % side + 0.5) / side, 2e-6);
      EXPECT_NEAR(sample.t, (up % side + 0.5) / side, 2e-6);
    }
  }
}

Camera cameraAtTheSphere() {
  Camera camera;
  camera.eye = {40, -60, 200};
  camera.target = {0, 0, 50};
  camera.width = 160;
  camera.height = 120;
  return camera;
}

// What a mask shows at a pixel depends on nothing but the mask there.
TEST(ShadePass, APictureIsComposedOfThoseAllLitAndAllShadowed) {
  const GlContext gl;
  const RenderScene scene(surface::makeSphere(60, 1.6, 1.2, 20, 15), flatRelief(40, 30), {4, 10},
                          horizon::TableBits::eight, 2);
  const Camera camera = cameraAtTheSphere();
  const RenderView view = cameraView(camera, scene.mesh);
  const ShadePass pass(shaderFolder(), scene.relief.field.wrap(), DrawnMesh::base);
  const auto shaded = [&](const std::vector<Shade>& samples) {
    return pass.render(view, scene.drawing(glm::normalize(Vec3(1, 1, 2))), {160, 120, samples});
  };
  constexpr std::size_t pixels = 160 * 120;
  std::minstd_rand random(3);
  std::vector<Shade> mixed(pixels);
  for (Shade& shade : mixed)
    shade = std::array{Shade::lit, Shade::shadowed, Shade::none}[random() % 3];
  const auto lit = shaded(std::vector<Shade>(pixels, Shade::lit));
  const auto dark = shaded(std::vector<Shade>(pixels, Shade::shadowed));
  auto composed = lit;
  for (std::size_t i = 0; i < 3 * pixels; ++i) {
    if (mixed[i / 3] == Shade::shadowed) composed[i] = dark[i];
  }
  EXPECT_NE(lit, dark);
  EXPECT_EQ(shaded(mixed), composed);
}

// A run keeps one picture of all shadowed for all its lights.
TEST(ShadePass, WhereNothingIsLitNoLightChangesThePicture) {
  const GlContext gl;
  const RenderScene scene(surface::makeSphere(60, 1.6, 1.2, 20, 15), flatRelief(40, 30), {4, 10},
                          horizon::TableBits::eight, 2);
  const RenderView view = cameraView(cameraAtTheSphere(), scene.mesh);
  const ShadePass pass(shaderFolder(), scene.relief.field.wrap(), DrawnMesh::base);
  const auto shaded = [&](Shade everywhere, const Vec3& light) {
    const Mask mask{160, 120, std::vector<Shade>(160 * 120, everywhere)};
    return pass.render(view, scene.drawing(light), mask);
  };
  const Vec3 above(0, 0, 1);
  const Vec3 aside = glm::normalize(Vec3(1, 1, 2));
  EXPECT_EQ(shaded(Shade::shadowed, above), shaded(Shade::shadowed, aside));
  EXPECT_NE(shaded(Shade::lit, above), shaded(Shade::lit, aside));
}

TEST(AtlasView, AreasSumToTheSurfacesArea) {
  const GlContext gl;
  const RenderScene scene(surface::makeSphere(60, 1.6, 1.2, 20, 15), flatRelief(40, 30), {4, 10},
                          horizon::TableBits::eight);
  const surface::SampleGrid grid = scene.samples(atlasView(scene.surface, 5));
  double sum = 0;
  for (const double area : surface::sampleAreas(scene.surface, grid, 5)) sum += area;
  const double exact = 60.0 * 60 * 1.6 * 2 * std::sin(0.6);
  EXPECT_NEAR(sum / exact, 1, 1e-4);
}

TEST(CameraView, SamplesLieUnderTheirPixels) {
  const GlContext gl;
  const RenderScene scene(surface::makeSphere(60, 1.6, 1.2, 20, 15), flatRelief(40, 30), {4, 10},
                          horizon::TableBits::eight, 8);
  const Camera camera = cameraAtTheSphere();
  const surface::SampleGrid grid = scene.samples(cameraView(camera, scene.mesh));
  const CameraAxes axis = axes(camera);
  std::size_t seen = 0;
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const surface::SurfaceSample& sample =
          grid.samples[static_cast<std::size_t>(row * camera.width + column)];
      if (!sample.isOnSurface()) continue;
      ++seen;
      const surface::LimitPoint point = scene.surface.evaluate(sample);
      const Vec3 direction = pixelDirection(camera, axis, column, row);
      const Vec3 toPoint = point.position - camera.eye;
      const double beside = glm::length(toPoint - glm::dot(toPoint, direction) * direction);
      const double facing = -glm::dot(glm::normalize(glm::cross(point.ds, point.dt)), direction);
      // The chords of the base mesh lie up to 60 (0.08 / 8)² / 8 = 8e-4 below the sphere.
      if (facing > 0.2) {
        EXPECT_LT(beside, 5e-3);
      }
    }
  }
  EXPECT_GT(seen, 3000U);
}

TEST(CameraView, RefusesACameraWithoutADirection) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(8, 8, 2, 2), flatRelief(8, 8), {4, 4},
                          horizon::TableBits::eight);
  Camera camera;
  camera.eye = {0, 0, 10};
  camera.up = {0, 0, 1};
  EXPECT_THROW(cameraView(camera, scene.mesh), InputError);
}

TEST(ShadePass, IsDarkWhereTheMaskIs) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(32, 32, 4, 4), flatRelief(32, 32), {4, 4},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 8);
  Mask mask{view.width, view.height, {}};
  for (int row = 0; row < view.height; ++row) {
    for (int column = 0; column < view.width; ++column) {
      mask.samples.push_back(row < 5 && column < 9 ? Shade::shadowed : Shade::lit);
    }
  }
  const ShadePass pass(shaderFolder(), scene.relief.field.wrap(), DrawnMesh::base);
  const auto rgb = pass.render(view, scene.drawing({0, 0, 1}), mask);
  const auto red = [&](int row, int column) {
    return rgb[static_cast<std::size_t>(3 * (row * view.width + column))];
  };
  EXPECT_LT(red(2, 4), 120);
  EXPECT_GT(red(2, 12), 220);
  EXPECT_GT(red(20, 4), 220);
}

/// As shade.frag has it, before its gamma: ambient light, and the rest in proportion to the share.
TEST(ShadePass, IsAsBrightAsTheShareOfLight) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(32, 32, 4, 4), flatRelief(32, 32), {4, 4},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 8);
  Visibility visibility{view.width, view.height, {}};
  for (int i = 0; i < view.width * view.height; ++i) {
    visibility.shares.push_back(static_cast<float>(i % 33) / 32);
  }
  const ShadePass pass(shaderFolder(), scene.relief.field.wrap(), DrawnMesh::base);
  const auto rgb = pass.render(view, scene.drawing({0, 0, 1}), visibility);
  for (std::size_t i = 0; i < visibility.size(); ++i) {
    const double light = 0.86 * (0.16 + 0.84 * static_cast<double>(visibility.shares[i]));
    ASSERT_NEAR(rgb[3 * i], 255 * std::pow(light, 1 / 2.2), 1) << visibility.shares[i];
  }
}

TEST(CameraMatrices, PutThePixelsRaysWhereThePixelsAre) {
  const surface::LimitSurface surface(surface::makeSphere(60, 1.6, 1.2, 20, 15));
  const surface::BaseMesh mesh = surface::makeBaseMesh(surface, Vec2(40, 30), 1);
  const Camera camera{{10, -20, 200}, {1, 2, 30}, {0, 1, 0.2}, radians(40), 90, 60};
  const CameraMatrices matrices = cameraMatrices(camera, mesh);
  const CameraAxes axis = axes(camera);
  for (const int column : {0, 44, 89}) {
    for (const int row : {0, 31, 59}) {
      const Vec3 seen = camera.eye + 150.0 * pixelDirection(camera, axis, column, row);
      const glm::dvec4 inView = matrices.view * glm::dvec4(seen, 1);
      EXPECT_LT(inView.z, 0);
      const glm::dvec4 clip = matrices.projection * inView;
      EXPECT_NEAR(clip.x / clip.w, 2 * (column + 0.5) / 90 - 1, 1e-12);
      EXPECT_NEAR(clip.y / clip.w, 1 - 2 * (row + 0.5) / 60, 1e-12);
    }
  }
  for (const surface::BaseVertex& vertex : mesh.vertices) {
    const glm::dvec4 clip =
        matrices.projection * matrices.view * glm::dvec4(vertex.frame.position, 1);
    EXPECT_LT(std::abs(clip.z), clip.w) << "near and far hold the mesh";
  }
}

}  // namespace
}  // namespace gnomon::render
