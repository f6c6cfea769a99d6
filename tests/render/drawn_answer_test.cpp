#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "relief/patterns.h"
#include "render/method_text.h"
#include "render/render_scene.h"
#include "render/shader_files.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::DisplacedScene;
using test::lightToward;
using test::RenderScene;

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
