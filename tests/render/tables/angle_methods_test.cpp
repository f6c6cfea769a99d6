// Methods of horizon angles and of elliptical cones: against the same arithmetic on the processor,
// closed forms, the truth, and methods that they must agree with.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "relief/patterns.h"
#include "render/render_scene.h"
#include "render/traced_scene.h"
#include "surface/texel_frame.h"
#include "truth/surface_horizons.h"

namespace gnomon::render {
namespace {

using test::difference;
using test::flatRelief;
using test::lightToward;
using test::MirroredScenes;
using test::randomRelief;
using test::RenderScene;
using test::shareShadowed;
using test::stepRelief;
using test::TracedScene;

relief::Relief cosineRelief(int texels, double period, double height, relief::HeightSpace space) {
  return {relief::makeCosine(texels, texels, {period}, height, relief::Wrap::repeat), space,
          Vec2(1)};
}

// ---- Sloan & Cohen's arithmetic, §4 of the paper, in double

double inSteps(double share) {
  return std::floor(std::clamp(share, 0.0, 1.0) * 255 + 0.5) / 255;
}

/// B_k(s, t) of their Figure 1 as a map of 256² texels, looked up bilinearly.
double basis(int k, Vec2 st) {
  const auto entry = [k](double x, double y) {
    const double azimuth = std::atan2((2 * y + 1) / 256 - 1, (2 * x + 1) / 256 - 1);
    double turn = azimuth - k * pi / 4;
    while (turn > pi) turn -= 2 * pi;
    while (turn < -pi) turn += 2 * pi;
    return inSteps(std::max(0.0, 1 - std::abs(turn) / (pi / 4)));
  };
  const Vec2 place = glm::clamp((st + 1.0) * 128.0 - 0.5, 0.0, 255.0);
  const Vec2 i = glm::floor(place);
  const Vec2 j = glm::min(i + 1.0, Vec2(255));
  const Vec2 f = place - i;
  return (1 - f.y) * ((1 - f.x) * entry(i.x, i.y) + f.x * entry(j.x, i.y)) +
         f.y * ((1 - f.x) * entry(i.x, j.y) + f.x * entry(j.x, j.y));
}

/// On a plane of one world unit a texel the light's place (s, t) is the same at all vertices.
class EightAzimuths {
 public:
  EightAzimuths(const horizon::HorizonTables& tables, const Vec3& light) : tables_(tables) {
    const Vec2 st(light.x, light.y);
    for (int k = 0; k < 8; ++k) weights_.at(static_cast<std::size_t>(k)) = basis(k, st);
    // The light's own angle off the normal by a map of 256 entries.
    const double place = std::clamp(light.z, 0.0, 1.0) * 255;
    const auto entry = [](double i) {
      return inSteps(std::acos(std::min(i / 255, 1.0)) / (pi / 2));
    };
    const double i = std::floor(place);
    lightAngle_ = entry(i) + (place - i) * (entry(std::min(i + 1, 255.0)) - entry(i));
  }

  [[nodiscard]] bool isShadowed(Vec2 texel) const {
    const Vec2 corner = glm::floor(texel - 0.5);
    const Vec2 f = texel - 0.5 - corner;
    const auto at = [&](int dx, int dy) {
      // The texture pass has the plane's own texels and no more.
      return horizon(std::clamp(static_cast<int>(corner.x) + dx, 0, tables_.width - 1),
                     std::clamp(static_cast<int>(corner.y) + dy, 0, tables_.height - 1));
    };
    const double angle = (1 - f.y) * ((1 - f.x) * at(0, 0) + f.x * at(1, 0)) +
                         f.y * ((1 - f.x) * at(0, 1) + f.x * at(1, 1));
    return !(inSteps(angle - lightAngle_) > 0);
  }

 private:
  /// Four directions summed and kept in eight bits, then the other four.
  [[nodiscard]] double horizon(int x, int y) const {
    double sum = 0;
    for (int half = 0; half < 2; ++half) {
      double four = 0;
      for (int k = 4 * half; k < 4 * half + 4; ++k) {
        const double slope =
            tables_.horizon[static_cast<std::size_t>((k * tables_.height + y) * tables_.width + x)];
        const double angle = std::min(pi / 2 - std::atan(slope), pi / 2);
        four += weights_.at(static_cast<std::size_t>(k)) * inSteps(angle / (pi / 2));
      }
      sum = inSteps(sum + inSteps(four));
    }
    return sum;
  }

  const horizon::HorizonTables& tables_;
  std::array<double, 8> weights_{};
  double lightAngle_ = 0;
};

TEST(SloanCohen, IsThePapersArithmeticOnAPlane) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(32, 32, 4, 4), randomRelief(32, 32, 4, 3), {8, 32},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 24);
  for (const auto& [azimuth, elevation] : {std::pair{0.0, 30.0},
                                           {20.0, 35.0},
                                           {100.0, 20.0},
                                           {223.0, 50.0},
                                           {-3.0, 8.0},
                                           {45.0, 75.0}}) {
    const Vec3 light = lightToward(azimuth, elevation);
    const EightAzimuths expected(scene.tables, light);
    const Mask mask = scene.test("sloan-cohen", view, light);
    std::size_t differ = 0;
    for (int row = 0; row < view.height; ++row) {
      for (int column = 0; column < view.width; ++column) {
        const Vec2 place((column + 0.5) / view.width, 1 - (row + 0.5) / view.height);
        const bool dark =
            mask.samples[static_cast<std::size_t>(row * view.width + column)] == Shade::shadowed;
        differ += dark != expected.isShadowed(32.0 * place) ? 1 : 0;
      }
    }
    EXPECT_GT(shareShadowed(mask), 0.002) << elevation;
    EXPECT_LT(shareShadowed(mask), 0.98) << elevation;
    // Sums that lie on the border between two steps are rounded either way in single precision.
    EXPECT_LE(differ, mask.size() / 500) << azimuth << " " << elevation;
  }
}

TEST(SloanCohen, WithManyAzimuthsAndBitsIsTheFlatHorizonMapButForAnglesInsteadOfSlopes) {
  const GlContext gl;
  const Vec3 light = lightToward(20, 30);  // in an azimuth of 72, so that none is interpolated
  const auto differenceAt = [&](int texels) {
    const RenderScene scene(surface::makePlane(64, 64, 8, 8),
                            cosineRelief(texels, texels / 4.0, 8, relief::HeightSpace::world),
                            {72, static_cast<double>(texels)}, horizon::TableBits::thirtyTwo);
    const RenderView view = atlasView(scene.surface, 25);
    const Mask flat = scene.test("max-forsyth", view, light);
    EXPECT_GT(shareShadowed(flat), 0.1);
    EXPECT_LT(shareShadowed(flat), 0.9);
    return difference(scene.test("sloan-cohen", view, light), flat);
  };
  // One texel a world unit, then four: between texels angles and slopes differ by second order.
  const double coarse = differenceAt(64);
  const double fine = differenceAt(256);
  EXPECT_GT(coarse, 0);
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(fine, 0.006);
}

TEST(SloanCohen, NeverSeesALightBelowTheTangentPlane) {
  const GlContext gl;
  const RenderScene scene(surface::makeSphere(40, 2.4, 1.2, 64, 32),
                          cosineRelief(96, 24, 3, relief::HeightSpace::texture), {8, 96},
                          horizon::TableBits::eight, 2);
  const RenderView view = atlasView(scene.surface, 6);
  const surface::SampleGrid samples = scene.samples(view);
  for (const Vec3& light : {lightToward(0, 20), lightToward(200, -10)}) {
    for (const char* method : {"sloan-cohen", "ellipse"}) {
      const Mask mask = scene.test(method, view, light);
      std::size_t lit = 0;
      for (std::size_t i = 0; i < mask.size(); ++i) {
        const surface::SurfaceSample& s = samples.samples[i];
        const double cosine = glm::dot(scene.surface.evaluate(s).position / 40.0, light);
        if (cosine < -1e-3) {
          ASSERT_EQ(mask.samples[i], Shade::shadowed) << method;
        }
        lit += mask.samples[i] == Shade::lit ? 1 : 0;
      }
      EXPECT_GT(lit, mask.size() / 10) << method;
    }
  }
}

TEST(SloanCohen, MirroredTextureGivesTheMirroredRelief) {
  const GlContext gl;
  const MirroredScenes scenes(8);
  const Vec3 light = lightToward(20, 30);
  for (const char* method : {"sloan-cohen", "ellipse"}) {
    const Mask a = scenes.scene.test(method, atlasView(scenes.scene.surface, 8), light);
    const Mask b = scenes.mirrored.test(method, atlasView(scenes.mirrored.surface, 8), light);
    EXPECT_LT(difference(a, b), 2e-3) << method;
    EXPECT_GT(shareShadowed(a), 0.1) << method;
    EXPECT_LT(shareShadowed(a), 0.9) << method;
  }
}

TEST(SloanCohen, DoesNotDependOnWhereTheTextureBegins) {
  const GlContext gl;
  const surface::Cage cage = surface::makePlane(64, 64, 8, 8);
  const Vec3 light = lightToward(20, 20);
  for (const int side : {32, 48}) {  // a power of two, and not
    const relief::Relief relief = randomRelief(side, side, 6, 5);
    for (const char* method : {"sloan-cohen", "ellipse", "max-forsyth", "relief-march"}) {
      const auto maskWith = [&](Vec2 shift) {
        surface::Cage moved = cage;
        for (Vec2& uv : moved.uvs) uv += shift;
        moved.grid.reset();
        const RenderScene scene(moved, relief, {8, 32}, horizon::TableBits::eight);
        EXPECT_EQ(scene.texture.texelWindow,
                  glm::ivec4(glm::ivec2(static_cast<double>(side) * shift), side, side));
        return scene.test(method, atlasView(scene.surface, 12), light);
      };
      const Mask mask = maskWith({3, 3});
      EXPECT_GT(shareShadowed(mask), 0.1) << method;
      // Whole maps away the relief is the same; but texel coordinates have other roundings.
      EXPECT_LT(difference(maskWith({2, 1}), mask), 1e-3) << method << " " << side;
      EXPECT_LT(difference(maskWith({-3, 5}), mask), 1e-3) << method << " " << side;
    }
  }
}

TEST(SloanCohen, DoesNotDependOnTheSizeOfATexelWhereHeightsAreInTexels) {
  const GlContext gl;
  const relief::Relief relief = cosineRelief(48, 12, 8, relief::HeightSpace::texture);
  for (const char* method : {"sloan-cohen", "ellipse", "max-forsyth"}) {
    const auto maskOn = [&](double size) {
      const RenderScene scene(surface::makePlane(size, size, 8, 8), relief, {8, 48},
                              horizon::TableBits::eight);
      return scene.test(method, atlasView(scene.surface, 12), lightToward(20, 30));
    };
    const Mask mask = maskOn(48);
    EXPECT_GT(shareShadowed(mask), 0.1) << method;
    EXPECT_LT(shareShadowed(mask), 0.9) << method;
    for (const double size : {480.0, 10.0}) {
      EXPECT_LT(difference(maskOn(size), mask), 1e-3) << method << " " << size;
    }
  }
}

// ---- horizons of the real geometry

TEST(SloanCohenSurface, OnASphereIsBetterThanTheFlatHorizonMap) {
  const GlContext gl;
  RenderScene scene(surface::makeSphere(60, 1.2, 1.2, 24, 24),
                    cosineRelief(72, 24, 8, relief::HeightSpace::world), {32, 72},
                    horizon::TableBits::thirtyTwo, 2);
  const TracedScene traced(scene.surface, scene.relief, 0.25);
  scene.angleLimit = pi;
  scene.surfaceAngles = shot(scene, traced, 32, pi);
  const RenderView view = atlasView(scene.surface, 8);
  const surface::SampleGrid samples = scene.samples(view);
  double surfaces = 0;
  double flats = 0;
  for (const Vec3& light : {lightToward(20, 30), lightToward(160, 45), lightToward(265, 20)}) {
    const Mask truth = traced.mask(scene.surface, scene.relief, samples, light);
    const double surface = difference(scene.test("sloan-cohen-surface", view, light), truth);
    const double flat = difference(scene.test("max-forsyth", view, light), truth);
    EXPECT_LT(surface, flat);
    EXPECT_LT(surface, 0.02);
    EXPECT_GT(shareShadowed(truth), 0.1);
    surfaces += surface;
    flats += flat;
  }
  EXPECT_LT(surfaces, flats / 4);
}

surface::Cage shiftedPlane(Vec2 shift) {
  surface::Cage cage = surface::makePlane(48, 48, 8, 8);
  for (Vec2& uv : cage.uvs) uv += shift;
  cage.grid.reset();
  return cage;
}

TEST(SloanCohenSurface, WithTheFlatReliefsAnglesIsTheFlatReliefsMethod) {
  const GlContext gl;
  for (const Vec2& shift : {Vec2(0), Vec2(2, -3)}) {
    RenderScene scene(shiftedPlane(shift), cosineRelief(48, 12, 6, relief::HeightSpace::world),
                      {8, 100}, horizon::TableBits::eight);
    scene.surfaceAngles = horizon::horizonAngles(scene.tables, pi / 2, 1);
    scene.surfaceAngles->originX = scene.texture.texelWindow.x;
    scene.surfaceAngles->originY = scene.texture.texelWindow.y;
    const RenderView view = atlasView(scene.surface, 16);
    for (const double azimuth : {45.0, 130.0, 251.0}) {
      const Vec3 light = lightToward(azimuth, 30);
      const Mask flat = scene.test("sloan-cohen", view, light);
      EXPECT_GT(shareShadowed(flat), 0.1);
      EXPECT_EQ(difference(flat, scene.test("sloan-cohen-surface", view, light)), 0) << azimuth;
    }
  }
}

TEST(SloanCohenSurface, OnAPlaneIsTheFlatReliefsMethodUpToALittle) {
  const GlContext gl;
  for (const Vec2& shift : {Vec2(0), Vec2(2, -3)}) {
    RenderScene scene(shiftedPlane(shift), cosineRelief(48, 12, 6, relief::HeightSpace::world),
                      {8, 100}, horizon::TableBits::eight);
    const TracedScene traced(scene.surface, scene.relief, 0.25);
    scene.surfaceAngles = shot(scene, traced, 8, pi / 2);
    const RenderView view = atlasView(scene.surface, 16);
    const Vec3 light = lightToward(45, 30);
    const Mask flat = scene.test("sloan-cohen", view, light);
    const Mask surface = scene.test("sloan-cohen-surface", view, light);
    EXPECT_GT(shareShadowed(flat), 0.2);
    EXPECT_LT(shareShadowed(flat), 0.8);
    // A ray starts from one of the facets that meet at a texel's centre, where the flat relief
    // takes the one toward the light; and the plane ends where the map would go on.
    EXPECT_LT(difference(flat, surface), 0.06) << shift.x;
  }
}

// ---- elliptical cones

TEST(EllipseMethod, FlatReliefIsLit) {
  const GlContext gl;
  for (const horizon::TableBits bits :
       {horizon::TableBits::eight, horizon::TableBits::sixteen, horizon::TableBits::thirtyTwo}) {
    const RenderScene scene(surface::makePlane(32, 32, 4, 4), flatRelief(32, 32), {8, 16}, bits);
    const RenderView view = atlasView(scene.surface, 8);
    for (const double elevation : {90.0, 60.0, 30.0, 10.0, 5.0}) {
      EXPECT_EQ(shareShadowed(scene.test("ellipse", view, lightToward(20, elevation))), 0);
    }
    EXPECT_EQ(shareShadowed(scene.test("ellipse", view, lightToward(20, -1))), 1);
  }
}

TEST(EllipseMethod, GrooveIsLitAlongAndDarkAcross) {
  const GlContext gl;
  // A groove along x, 8 wide and 8 deep, over the whole map.
  const RenderScene scene(surface::makePlane(48, 48, 6, 6),
                          stepRelief(48, 48, 8, [](int, int j) { return j < 20 || j >= 28; }),
                          {32, 100}, horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 16);
  const surface::SampleGrid samples = scene.samples(view);
  const auto bottomShadowed = [&](const Vec3& light) {
    const Mask mask = scene.test("ellipse", view, light);
    double dark = 0;
    double all = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      const surface::SurfaceSample& s = samples.samples[i];
      const double y = scene.surface.evaluate(s).position.y;
      if (std::abs(y) > 2) continue;
      ++all;
      dark += mask.samples[i] == Shade::shadowed ? 1 : 0;
    }
    EXPECT_GT(all, 100);
    return dark / all;
  };
  for (const double azimuth : {0.0, 180.0}) EXPECT_EQ(bottomShadowed(lightToward(azimuth, 20)), 0);
  for (const double azimuth : {90.0, 270.0}) EXPECT_EQ(bottomShadowed(lightToward(azimuth, 20)), 1);
  EXPECT_EQ(bottomShadowed(lightToward(90, 85)), 0);
}

TEST(EllipseMethod, IsItsFormulaAtTexelCentres) {
  const GlContext gl;
  for (const relief::HeightSpace space :
       {relief::HeightSpace::world, relief::HeightSpace::texture}) {
    relief::Relief relief = randomRelief(32, 32, 5, 5);
    relief.space = space;
    // Texels 3 wide and 1.5 high.
    const RenderScene scene(surface::makePlane(96, 48, 8, 8), relief, {16, 32},
                            horizon::TableBits::thirtyTwo);
    const horizon::EllipseTable table = horizon::fitEllipses(
        scene.tables, space == relief::HeightSpace::world ? 1 / std::sqrt(4.5) : 1);
    const RenderView view = atlasView(scene.surface, 4);
    for (const Vec3& light : {lightToward(20, 25), lightToward(200, 40), lightToward(95, 15)}) {
      const Mask mask = scene.test("ellipse", view, light);
      // A texel is √4.5 wide on average, whatever heights are: the light leans as in the world.
      const Vec3 local = glm::normalize(Vec3(light.x / 3, light.y / 1.5, light.z / std::sqrt(4.5)));
      std::size_t differ = 0;
      for (std::size_t i = 0; i < 32 * 32; ++i) {
        const std::size_t texel = (31 - i / 32) * 32 + i % 32;
        const auto entry = [&](std::size_t layer) {
          return double{table.values[layer * 32 * 32 + texel]};
        };
        // A⁻¹ (l - c) by Cramer's rule.
        const Vec2 off = Vec2(local.x, local.y) - Vec2(entry(0), entry(1));
        const double area = entry(2) * entry(4) - entry(3) * entry(3);
        const Vec2 place =
            Vec2(entry(4) * off.x - entry(3) * off.y, entry(2) * off.y - entry(3) * off.x) / area;
        const bool dark = glm::dot(place, place) > 1;
        differ += dark != (mask.samples[i] == Shade::shadowed) ? 1 : 0;
      }
      EXPECT_LE(differ, 1U);  // where |A⁻¹ (l - c)| is 1 to a float's rounding
      EXPECT_GT(shareShadowed(mask), 0.01);
      EXPECT_LT(shareShadowed(mask), 0.99);
    }
  }
}

TEST(EllipseMethod, IsTheFlatHorizonMapWhereTheLitPartIsAnEllipse) {
  const GlContext gl;
  // In the middle of a long V of slope 1 horizons are |sin φ|: an ellipse, exactly.
  std::vector<float> texels;
  for (int j = 0; j < 65; ++j) {
    for (int i = 0; i < 65; ++i) texels.push_back(static_cast<float>(std::abs(j - 32)));
  }
  const relief::Relief relief{relief::HeightField(65, 65, texels, relief::Wrap::clamp),
                              relief::HeightSpace::world, Vec2(1)};
  const RenderScene scene(surface::makePlane(65, 65, 13, 13), relief, {72, 20},
                          horizon::TableBits::thirtyTwo);
  const RenderView view = atlasView(scene.surface, 5);  // one sample a texel, at its centre
  const auto middle = static_cast<std::size_t>(32 * 65 + 32);
  for (double azimuth = 0; azimuth < 360; azimuth += 15) {
    const double horizon = std::atan(std::abs(std::sin(radians(azimuth)))) * 180 / pi;
    const auto shade = [&](double elevation) {
      return scene.test("ellipse", view, lightToward(azimuth, elevation)).samples[middle];
    };
    EXPECT_EQ(shade(horizon + 1), Shade::lit) << azimuth;
    if (horizon > 3) {
      EXPECT_EQ(shade(horizon - 1), Shade::shadowed) << azimuth;
    }
  }
}

/// Two corners of the middle face have one texture coordinate: its triangle has no frame there, but
/// the pixels between them and the others do.
TEST(HorizonAngleMethods, AVertexWithoutAFrameSpreadsNothingOverItsTriangles) {
  const GlContext gl;
  surface::Cage cage = surface::makePlane(24, 24, 3, 3);
  cage.grid.reset();
  constexpr std::size_t middle = 12;  // of the cage's 5 × 5 faces, of which the outer ones support
  ASSERT_EQ(cage.faceCount(), 25);
  cage.faceUvs[4 * middle + 3] = cage.faceUvs[4 * middle + 2];
  for (const relief::HeightSpace space :
       {relief::HeightSpace::world, relief::HeightSpace::texture}) {
    relief::Relief relief = flatRelief(24, 24);
    relief.space = space;
    const RenderScene scene(cage, relief, {8, 16}, horizon::TableBits::eight);
    const RenderView view = atlasView(scene.surface, 8);
    for (const char* method : {"sloan-cohen", "max-forsyth", "ellipse"}) {
      EXPECT_EQ(shareShadowed(scene.test(method, view, lightToward(20, 60))), 0) << method;
      EXPECT_EQ(shareShadowed(scene.test(method, view, lightToward(20, -30))), 1) << method;
    }
  }
}

}  // namespace
}  // namespace gnomon::render
