#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <string_view>

#include "common/error.h"
#include "relief/patterns.h"
#include "render/method_text.h"
#include "render/render_scene.h"
#include "render/shader_files.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::DisplacedScene;
using test::flatRelief;
using test::lightToward;
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

constexpr int bumpSide = 48;

relief::Relief bumps() {
  return {relief::makeColumns(bumpSide, bumpSide, {24, 7, 3}, 5, relief::Wrap::clamp),
          relief::HeightSpace::world, Vec2(1)};
}

RenderView cameraOver(const surface::BaseMesh& mesh) {
  return cameraView(Camera{{0, -70, 60}, {0, 0, 0}, {0, 0, 1}, 0.75, 96, 72}, mesh);
}

/// Of the bilinear relief, from its bumpSide.
Vec2 gradientOf(const relief::HeightField& field, Vec2 at) {
  const Vec2 corner = glm::floor(at - 0.5);
  const Vec2 f = at - 0.5 - corner;
  const auto h = [&](int i, int j) {
    return field.at(Vec2(corner.x + i + 0.5, corner.y + j + 0.5));
  };
  return {(h(1, 0) - h(0, 0)) * (1 - f.y) + (h(1, 1) - h(0, 1)) * f.y,
          (h(0, 1) - h(0, 0)) * (1 - f.x) + (h(1, 1) - h(1, 0)) * f.x};
}

/// On a plane of one texel a world unit N' is (-h_x, -h_y, 1): a point is dark where the shadow
/// test says so or N' · L ≤ 0, and nowhere else.
TEST(DrawnAnswer, IsTheShadowTestOrABumpedNormalTurnedAway) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(bumpSide, bumpSide, 6, 6), bumps(), {16, 32},
                          horizon::TableBits::sixteen);
  const RenderView view = atlasView(scene.surface, 31);
  const surface::SampleGrid samples = scene.samples(view);
  const Vec3 light = lightToward(35, 30);
  for (const char* method : {"unshadowed", "max-forsyth", "sloan-cohen", "ellipse", "onoue-2003",
                             "onoue-2004", "relief-march", "geodesic-march"}) {
    const Method read = readMethod(methodFile(shaderFolder(), method));
    const MethodAnswers found = scene.answers(read, view, {light}).front();
    std::size_t added = 0;
    for (std::size_t i = 0; i < samples.samples.size(); ++i) {
      const surface::SurfaceSample& sample = samples.samples[i];
      const Vec3 place = scene.surface.evaluate(sample).position;
      const Vec2 slope = gradientOf(scene.relief.field, Vec2(place) + bumpSide / 2.0);
      const double cosine = glm::dot(Vec3(-slope, 1), light);
      if (std::abs(cosine) < 1e-4) continue;
      const bool isHidden = found.test.samples[i] == Shade::shadowed;
      ASSERT_EQ(found.drawn.samples[i] == Shade::shadowed, isHidden || cosine < 0) << method;
      added += !isHidden && cosine < 0 ? 1 : 0;
    }
    // Bump mapping alone has no shadow but this.
    if (std::string_view(method) == "unshadowed") {
      EXPECT_GT(added, samples.samples.size() / 50);
    }
  }
}

/// A method whose normal points to the light up to half of the map, and from it beyond.
Method halfTurnedAway() {
  return test::methodOfText("normal = \"own\"",
                            "vec3 shadingNormal(Pixel pixel) {\n"
                            "  return pixel.texel.x < 24.0 ? lightDirection : -lightDirection;\n}\n"
                            "bool isShadowed(Pixel pixel, LocalLight light) { return false; }\n");
}

TEST(DrawnAnswer, IsByTheMethodsOwnNormalWhereItHasOne) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(bumpSide, bumpSide, 6, 6), bumps(), {4, 8},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 31);
  const surface::SampleGrid samples = scene.samples(view);
  const MethodAnswers found = scene.answers(halfTurnedAway(), view, {lightToward(35, 30)}).front();
  std::size_t dark = 0;
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const double x = scene.surface.evaluate(samples.samples[i]).position.x;
    if (std::abs(x) < 1e-3) continue;
    ASSERT_EQ(found.test.samples[i], Shade::lit);
    ASSERT_EQ(found.drawn.samples[i], x > 0 ? Shade::shadowed : Shade::lit) << x;
    dark += x > 0 ? 1 : 0;
  }
  EXPECT_GT(dark, samples.samples.size() / 3);
}

/// The picture is as dark as one without any light exactly where the drawn mask is shadowed, and a
/// point that only the shading darkens is turned from the light in the picture, too.
void expectPictureOf(const RenderView& view, const Drawing& drawing, DrawnMesh mesh,
                     relief::Wrap wrap, const MethodAnswers& answers, const std::string& method) {
  const ShadePass pass(shaderFolder(), wrap, mesh);
  const auto all = [&](Shade shade) {
    return Mask{view.width, view.height, std::vector<Shade>(answers.drawn.size(), shade)};
  };
  const auto picture = pass.render(view, drawing, answers.drawn);
  const auto dark = pass.render(view, drawing, all(Shade::shadowed));
  const auto lit = pass.render(view, drawing, all(Shade::lit));
  std::uint8_t least = 255;  // of red, of a lit point
  for (std::size_t i = 0; i < answers.drawn.size(); ++i) {
    if (answers.drawn.samples[i] != Shade::none) least = std::min(least, lit[3 * i]);
  }
  std::size_t shadowed = 0;
  for (std::size_t i = 0; i < answers.drawn.size(); ++i) {
    if (answers.drawn.samples[i] == Shade::none) continue;
    const bool isDark = std::equal(&picture[3 * i], &picture[3 * i] + 3, &dark[3 * i]);
    ASSERT_EQ(isDark, answers.drawn.samples[i] == Shade::shadowed) << method << " pixel " << i;
    if (answers.test.samples[i] == Shade::lit && isDark) {
      ASSERT_LE(lit[3 * i], least + 1) << method;
    }
    shadowed += isDark ? 1 : 0;
  }
  EXPECT_GT(shadowed, answers.drawn.size() / 100) << method;
}

TEST(DrawnAnswer, IsWhatThePictureShowsForEveryMethod) {
  const GlContext gl;
  const surface::Cage cage = surface::makeSphere(40, 1.2, 1.2, 12, 12);
  RenderScene scene(cage, bumps(), {8, 32}, horizon::TableBits::eight);
  scene.surfaceAngles = horizon::horizonAngles(scene.tables, scene.angleLimit, scene.frame);
  const DisplacedScene displaced(cage, bumps(), 4);
  const Vec3 light = lightToward(160, 25);
  for (const std::string& name : methodNames(shaderFolder())) {
    const Method method = readMethod(methodFile(shaderFolder(), name));
    if (method.mesh == DrawnMesh::displaced) {
      const RenderView view = cameraOver(displaced.displaced.mesh);
      expectPictureOf(view, displaced.drawing(light), method.mesh, relief::Wrap::clamp,
                      displaced.answers(name, view, light), name);
    } else {
      const RenderView view = cameraOver(scene.mesh);
      expectPictureOf(view, scene.drawing(light), method.mesh, relief::Wrap::clamp,
                      scene.answers(method, view, {light}).front(), name);
    }
  }
}

/// The truth lights points that their bumped normal turns from the light: they too are seen as lit.
TEST(DrawnAnswer, APictureShowsEveryMask) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(bumpSide, bumpSide, 6, 6), bumps(), {4, 8},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 16);
  Mask mask{view.width, view.height, {}};
  for (int i = 0; i < view.width * view.height; ++i) {
    mask.samples.push_back(i % 3 == 0 ? Shade::shadowed : Shade::lit);
  }
  expectPictureOf(view, scene.drawing(lightToward(35, 10)), DrawnMesh::base, relief::Wrap::clamp,
                  {mask, mask}, "any");
}

}  // namespace
}  // namespace gnomon::render
