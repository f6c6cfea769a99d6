// The methods that follow the ray's own path over the map: against the ray itself, against each
// other, and where they must agree with the methods that do not.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "relief/patterns.h"
#include "render/open_bowl.h"
#include "render/render_scene.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

namespace fs = std::filesystem;
using test::difference;
using test::lightToward;
using test::openBowl;
using test::randomRelief;
using test::RenderScene;
using test::shareShadowed;
using test::stepRelief;

using Parameters = std::map<std::string, double>;

/// What the shadow test alone says.
Mask testWith(const RenderScene& scene, const std::string& method, const RenderView& view,
              const Vec3& light, const Parameters& parameters) {
  return scene.test(readMethod(methodFile(shaderFolder(), method)), view, light, TableFilter::exact,
                    parameters);
}

Mask drawnWith(const RenderScene& scene, const std::string& method, const RenderView& view,
               const Vec3& light, const Parameters& parameters) {
  return scene.answer(readMethod(methodFile(shaderFolder(), method)), view, light,
                      TableFilter::exact, parameters);
}

/// The march with an attached shadow of its own: all that it knows of the surface, without the
/// bumped normal of the base mesh.
Mask marchAlone(const RenderScene& scene, const RenderView& view, const Vec3& light) {
  return testWith(scene, "geodesic-march", view, light, {{"own_slope", 1}});
}

/// On a surface that ends where the map does, or as if the map went on.
relief::Relief cosineRelief(int texels, double period, double height, bool ends = true) {
  return {relief::makeCosine(texels, texels, {period}, height, relief::Wrap::repeat)
              .withBorder({ends, ends}),
          relief::HeightSpace::world, Vec2(1)};
}

struct SphericalPatch {
  double radius, width, height;  // world; arcs in radians

  /// Longitude and latitude of the place under a point.
  static Vec2 arcs(const Vec3& point) {
    return {std::atan2(point.x, point.z), std::asin(point.y / glm::length(point))};
  }

  [[nodiscard]] bool isOver(const Vec3& point) const {
    const Vec2 place = glm::abs(arcs(point));
    return place.x <= width / 2 && place.y <= height / 2;
  }
};

/// Whether the ray from a displaced point of a sphere meets the relief: the ray in space, taken in
/// steps of a twentieth of a texel, against the height under each of its points.
bool rayMeetsRelief(const SphericalPatch& patch, const relief::HeightField& field,
                    const Vec3& place, const Vec3& light) {
  const Vec2 texelsPerArc = Vec2(field.width(), field.height()) / Vec2(patch.width, patch.height);
  const auto heightUnder = [&](const Vec3& point) {
    const Vec2 corner = Vec2(patch.width, patch.height) / 2.0;
    return field.at((SphericalPatch::arcs(point) + corner) * texelsPerArc);
  };
  const double step = 0.05 * patch.radius / texelsPerArc.x;
  const Vec3 start = place * (1 + heightUnder(place) / patch.radius);
  for (double s = step; s < 2 * patch.radius; s += step) {
    const Vec3 point = start + s * light;
    if (!patch.isOver(point)) return false;
    const double above = glm::length(point) - patch.radius;
    if (above < heightUnder(point)) return true;
    if (above > field.maximum() && glm::dot(point, light) > 0) return false;
  }
  return false;
}

/// On a sphere by longitude and latitude great circles bend away from straight lines in the map,
/// most far from the equator. The method must follow them; the march on the osculating circle does
/// not.
TEST(PathMethods, FollowTheRayWhereLinesOfTheMapDoNot) {
  const GlContext gl;
  const SphericalPatch patch{60, 1.6, 1.6};
  const RenderScene scene(surface::makeSphere(patch.radius, patch.width, patch.height, 32, 32),
                          cosineRelief(96, 24, 8), {32, 96}, horizon::TableBits::eight, 2);
  // No sample on a line of texels, where the relief has two normals.
  const RenderView view = atlasView(scene.surface, 6);
  const surface::SampleGrid grid = scene.samples(view);
  for (const Vec3& light : {lightToward(20, 25), lightToward(160, 30)}) {
    Mask exact{view.width, view.height, std::vector<Shade>(grid.samples.size(), Shade::none)};
    for (std::size_t i = 0; i < grid.samples.size(); ++i) {
      const surface::SurfaceSample& sample = grid.samples[i];
      const Vec3 place = scene.surface.evaluate(sample).position;
      const bool dark = rayMeetsRelief(patch, scene.relief.field, place, light);
      exact.samples[i] = dark ? Shade::shadowed : Shade::lit;
    }
    const double straight = difference(testWith(scene, "osculating-march", view, light, {}), exact);
    const double bent = difference(marchAlone(scene, view, light), exact);
    const double drawn = difference(scene.answer("geodesic-march", view, light), exact);
    const double resampled = difference(scene.answer("resampled-horizon", view, light), exact);
    const double solved = difference(scene.answer("surface-march", view, light), exact);
    EXPECT_GT(shareShadowed(exact), 0.2);
    EXPECT_LT(shareShadowed(exact), 0.8);
    EXPECT_LT(bent, straight / 3);
    EXPECT_LT(bent, 0.002);
    EXPECT_LT(resampled, drawn + 0.001);
    EXPECT_LT(solved, 5e-4);
  }
}

/// Heights in texels grow with the texels: the same sphere, whose texels narrow toward its poles.
TEST(PathMethods, FollowTheGrowthOfHeightsInTexels) {
  const GlContext gl;
  relief::Relief relief = cosineRelief(96, 24, 8);
  relief.space = relief::HeightSpace::texture;
  const SphericalPatch patch{60, 1.6, 2.4};
  const RenderScene scene(surface::makeSphere(patch.radius, patch.width, patch.height, 32, 48),
                          relief, {4, 128}, horizon::TableBits::eight, 2);
  const RenderView view = atlasView(scene.surface, 5);
  const surface::SampleGrid grid = scene.samples(view);
  const Vec3 light = lightToward(265, 30);
  // The world's height under a point: texels are (R cos(lat) · 1.6 / 96) by (R · 2.4 / 96).
  Mask exact{view.width, view.height, std::vector<Shade>(grid.samples.size(), Shade::none)};
  const auto heightUnder = [&](const Vec3& point) {
    const double latitude = std::asin(point.y / glm::length(point));
    const Vec2 arcs(std::atan2(point.x, point.z), latitude);
    const Vec2 texel = (arcs / Vec2(patch.width, patch.height) + 0.5) * 96.0;
    const double unit = patch.radius / 96 *
                        std::sqrt(patch.width * patch.height * std::max(std::cos(latitude), 0.0));
    return unit * relief.field.at(texel);
  };
  const double highest =
      patch.radius / 96 * std::sqrt(patch.width * patch.height) * relief.field.maximum();
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const surface::SurfaceSample& sample = grid.samples[i];
    const Vec3 place = scene.surface.evaluate(sample).position;
    const Vec3 start = place * (1 + heightUnder(place) / patch.radius);
    bool dark = false;
    for (double s = 0.03; s < 100 && !dark; s += 0.03) {
      const Vec3 point = start + s * light;
      if (!patch.isOver(point)) break;
      const double above = glm::length(point) - patch.radius;
      if (above > highest && glm::dot(point, light) > 0) break;
      dark = above < heightUnder(point);
    }
    exact.samples[i] = dark ? Shade::shadowed : Shade::lit;
  }
  EXPECT_GT(shareShadowed(exact), 0.2);
  EXPECT_LT(difference(marchAlone(scene, view, light), exact), 0.001);
  EXPECT_LT(difference(scene.answer("surface-march", view, light), exact), 0.001);
}

/// The arch z = -x² / 120 over |x| ≤ 40, y even: curvature 1/60 at the crown and 0.58 of that at
/// its foot, where a texel is 1.2 times as long.
TEST(PathMethods, FollowTheChangeOfCurvature) {
  const GlContext gl;
  std::array<Vec3, 16> points{};
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const double blossom = i == 0 || i == 3 ? 1600 : -1600.0 / 3;
      points[static_cast<std::size_t>(4 * j + i)] =
          Vec3(40.0 * (Vec2(i, j) / 1.5 - 1.0), -blossom / 120);
    }
  }
  // Clamped: past its border there is nothing.
  const relief::Relief relief{
      relief::makeColumns(96, 96, {32, 6, 4}, 6, relief::Wrap::clamp).withBorder({true, true}),
      relief::HeightSpace::world, Vec2(1)};
  const RenderScene scene(surface::makeBezier(points, 32, 8), relief, {4, 128},
                          horizon::TableBits::eight, 4);
  const RenderView view = atlasView(scene.surface, 9);
  const surface::SampleGrid grid = scene.samples(view);
  const Vec3 light = lightToward(5, 20);
  Mask exact{view.width, view.height, std::vector<Shade>(grid.samples.size(), Shade::none)};
  // How far a point stands over the relief: over its foot on the parabola, found by Newton's
  // method.
  const auto above = [&](const Vec3& point) {
    double x = point.x;
    for (int k = 0; k < 8; ++k) {
      const double gap = -x * x / 120 - point.z;
      x -= (x - point.x - gap * x / 60) / (1 - gap / 60 + x * x / 3600);
    }
    const double side = point.z > -x * x / 120 ? 1 : -1;
    return side * std::hypot(point.x - x, point.z + x * x / 120) -
           scene.relief.field.at((Vec2(x, point.y) / 80.0 + 0.5) * 96.0);
  };
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const surface::SurfaceSample& sample = grid.samples[i];
    const surface::LimitPoint place = scene.surface.evaluate(sample);
    const Vec3 start =
        place.position - above(place.position) * glm::normalize(glm::cross(place.ds, place.dt));
    bool dark = false;
    for (double s = 0.04; s < 60 && !dark; s += 0.04) {
      const Vec3 point = start + s * light;
      if (std::abs(point.x) > 40 || std::abs(point.y) > 40) break;
      dark = above(point) < 0;
    }
    exact.samples[i] = dark ? Shade::shadowed : Shade::lit;
  }
  EXPECT_GT(shareShadowed(exact), 0.2);
  EXPECT_LT(difference(scene.answer("geodesic-march", view, light), exact), 0.002);
  EXPECT_LT(difference(scene.answer("surface-march", view, light), exact), 0.0005);
}

/// The march over maps of the surface knows where it ends, whether or not the map does.
std::vector<const char*> pathMethodsWhere(bool ends) {
  if (ends) return {"geodesic-march", "resampled-horizon", "surface-march"};
  return {"geodesic-march", "resampled-horizon"};
}

TEST(PathMethods, OnAPlaneAreTheMarchOnTheCircle) {
  const GlContext gl;
  for (const bool ends : {false, true}) {
    const RenderScene scene(surface::makePlane(64, 64, 8, 8), cosineRelief(64, 16, 6, ends),
                            {16, 24}, horizon::TableBits::eight);
    const RenderView view = atlasView(scene.surface, 33);
    for (const Vec3& light : {lightToward(20, 30), lightToward(155, 25), lightToward(290, 20)}) {
      const Mask march = drawnWith(scene, "osculating-march", view, light, {{"stride", 0.02}});
      // A bump that is highest between crossings is missed: in cells that are saddles.
      for (const char* method : pathMethodsWhere(ends)) {
        EXPECT_LT(difference(scene.answer(method, view, light), march), 2e-3) << method;
      }
      EXPECT_GT(shareShadowed(march), 0.05);
    }
  }
}

/// At the equator, toward the east, the path is straight and the curvature one: both marches are
/// exact.
TEST(PathMethods, OnACylinderAreTheMarchOnTheCircle) {
  const GlContext gl;
  const RenderScene scene(surface::makeCylinder(60, 64.0 / 60, 64, 32, 32), cosineRelief(64, 16, 6),
                          {16, 24}, horizon::TableBits::eight, 2);
  const RenderView view = atlasView(scene.surface, 8);
  for (const Vec3& light : {lightToward(0, 40), lightToward(180, 25), lightToward(90, 30)}) {
    const Mask march = drawnWith(scene, "osculating-march", view, light, {{"stride", 0.02}});
    EXPECT_LT(difference(scene.answer("geodesic-march", view, light), march), 2e-3);
    EXPECT_LT(difference(scene.answer("resampled-horizon", view, light), march), 2e-3);
    EXPECT_GT(shareShadowed(march), 0.05);
  }
}

/// What bump mapping turns from the light is dark, however few crossings are looked at.
TEST(PathMethods, AreNeverBlindToAttachedShadows) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(64, 64, 8, 8), randomRelief(64, 64, 3, 5), {4, 1},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 16);
  for (const Vec3& light : {lightToward(20, 60), lightToward(200, 30)}) {
    const Mask turned = scene.answer("unshadowed", view, light);
    const std::map<std::string, Parameters> few = {
        {"geodesic-march", {}}, {"resampled-horizon", {{"crossings", 1}, {"search", 0}}}};
    for (const auto& [method, parameters] : few) {
      const Mask mask = drawnWith(scene, method, view, light, parameters);
      for (std::size_t i = 0; i < mask.size(); ++i) {
        if (turned.samples[i] == Shade::shadowed) {
          ASSERT_EQ(mask.samples[i], Shade::shadowed) << method << " " << i;
        }
      }
    }
    EXPECT_GT(shareShadowed(turned), 0.02);
  }
}

relief::Relief columnRelief() {
  return {relief::makeColumns(64, 64, {32, 8, 2}, 8, relief::Wrap::repeat),
          relief::HeightSpace::world, Vec2(1)};
}

/// With a single crossing all else comes from the table.
TEST(PathMethods, ResampledHorizonTendsToTheMarchWithItsAzimuths) {
  const GlContext gl;
  const Vec3 light = lightToward(20, 25);
  const auto differenceAt = [&](int azimuths) {
    const RenderScene scene(surface::makeSphere(60, 1, 1, 16, 16), columnRelief(), {azimuths, 64},
                            horizon::TableBits::eight, 2);
    const RenderView view = atlasView(scene.surface, 12);
    return difference(testWith(scene, "resampled-horizon", view, light, {{"crossings", 1}}),
                      scene.test("geodesic-march", view, light));
  };
  const double few = differenceAt(4);
  const double some = differenceAt(16);
  const double many = differenceAt(64);
  EXPECT_GT(few, 2 * some);
  EXPECT_GT(some, many);
  EXPECT_LT(many, 0.01);
}

TEST(PathMethods, ASearchAboutTheBestCandidateFindsMore) {
  const GlContext gl;
  const RenderScene scene(surface::makeSphere(60, 1, 1, 16, 16), columnRelief(), {16, 64},
                          horizon::TableBits::eight, 2);
  const RenderView view = atlasView(scene.surface, 12);
  const Vec3 light = lightToward(20, 25);
  const auto share = [&](double search) {
    return shareShadowed(
        testWith(scene, "resampled-horizon", view, light, {{"crossings", 1}, {"search", search}}));
  };
  EXPECT_GT(share(1), share(0));
  EXPECT_GT(share(2), share(1));
}

/// A method that goes with the tests.
class OwnMethod {
 public:
  OwnMethod(const std::string& name, const std::string& body)
      : path_(fs::path(testing::TempDir()) / (name + ".glsl")) {
    std::ofstream(path_) << "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\n"
                            "tables = [\"height\"]\n*/\n"
                            "bool isShadowed(Pixel pixel, LocalLight light) {\n"
                         << body << "}\n";
  }
  OwnMethod(const OwnMethod&) = delete;
  OwnMethod& operator=(const OwnMethod&) = delete;
  ~OwnMethod() { fs::remove(path_); }
  [[nodiscard]] Method read() const { return readMethod(path_); }

 private:
  fs::path path_;
};

/// Share of the samples that `mask` shadows and `other` does not.
double shadowedBeyond(const Mask& mask, const Mask& other) {
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    beyond += mask.samples[i] == Shade::shadowed && other.samples[i] == Shade::lit ? 1 : 0;
  }
  return static_cast<double>(beyond) / static_cast<double>(mask.size());
}

/// Its candidates are places of the same path, so that it can only miss shadows, never invent one:
/// against the path in steps of a hundredth of a texel the error is false light. What is left on
/// the other side are grazing rays between two of those steps.
TEST(PathMethods, ResampledHorizonErrsTowardLightAlone) {
  const GlContext gl;
  const OwnMethod dense("dense-path",
                        "  Path path = makePath(pixel, light);\n"
                        "  if (shadowedByBareSurface(path)) return true;\n"
                        "  for (float t = 0.01; t <= path.limit; t += 0.01) {\n"
                        "    if (excess(path, t) >= 0.0) return true;\n"
                        "  }\n"
                        "  return false;\n");
  for (const int azimuths : {4, 32}) {
    const RenderScene scene(surface::makeSphere(60, 1, 1, 16, 16), columnRelief(), {azimuths, 64},
                            horizon::TableBits::eight, 2);
    const RenderView view = atlasView(scene.surface, 8);
    for (const Vec3& light : {lightToward(20, 25), lightToward(140, 40)}) {
      const Mask full = scene.test(dense.read(), view, light);
      const Mask mask = testWith(scene, "resampled-horizon", view, light, {{"crossings", 1}});
      EXPECT_LT(shadowedBeyond(mask, full), 5e-4) << azimuths;
      if (azimuths == 4) {
        EXPECT_GT(shadowedBeyond(full, mask), 0.01);
      }
    }
  }
}

void expectBoundCostsNothing(const RenderScene& scene, double elevation) {
  // geodesic-march without the bound: every crossing up to where the path ends.
  const OwnMethod unbounded("unbounded-march",
                            "  Path path = makePath(pixel, light);\n"
                            "  return shadowedByBareSurface(path) ||\n"
                            "         shadowedAtCrossings(path, pathEnd(path));\n");
  const RenderView view = atlasView(scene.surface, 6);
  for (const double azimuth : {20.0, 110.0, 215.0}) {
    const Vec3 light = lightToward(azimuth, elevation);
    const Mask full = scene.test(unbounded.read(), view, light);
    EXPECT_EQ(difference(scene.test("geodesic-march", view, light), full), 0) << azimuth;
    EXPECT_GT(shareShadowed(full), 0.02);
  }
}

/// The search ends where the ray has left the relief below it: the masks are those of the full one.
TEST(PathMethods, EndOfTheSearchLosesNoShadow) {
  const GlContext gl;
  relief::Relief rough = randomRelief(64, 64, 3, 3);
  const RenderScene sphere(surface::makeSphere(60, 1, 1, 32, 32), rough, {4, 128},
                           horizon::TableBits::eight);
  const RenderScene bowl(openBowl(), rough, {4, 128}, horizon::TableBits::eight);
  // Tall pins on flat ground, all of one height: where the ray leaves them is where it matters.
  const RenderScene pins(
      openBowl(), stepRelief(64, 64, 10, [](int i, int j) { return (7 * i + 13 * j) % 29 == 0; }),
      {4, 128}, horizon::TableBits::eight);
  rough.space = relief::HeightSpace::texture;
  const RenderScene scaled(surface::makeSphere(60, 1, 1.6, 32, 32), rough, {4, 128},
                           horizon::TableBits::eight);
  for (const double elevation : {25.0, 45.0, 65.0}) {
    expectBoundCostsNothing(sphere, elevation);
    expectBoundCostsNothing(bowl, elevation);
    expectBoundCostsNothing(pins, elevation);
    expectBoundCostsNothing(scaled, elevation);
  }
}

}  // namespace
}  // namespace gnomon::render
