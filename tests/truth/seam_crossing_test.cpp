#include "truth/surface_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "surface/mesh_file.h"
#include "surface/texel_frame.h"
#include "truth/truth_scenes.h"

namespace gnomon::truth {
namespace {

using test::cubeCage;
using test::flatRelief;
using test::lightToward;
using test::stepRelief;

relief::Relief flat(int width, int height, relief::Wrap wrap) {
  return stepRelief(
      width, height, 0, [](int, int) { return false; }, wrap);
}

/// A plane of one world unit a texel in 12 × 4 faces of 8 texels; from column 6 on the texture
/// coordinates lie elsewhere, `shift` units of uv away.
surface::Cage planeInTwoCharts(Vec2 shift) {
  surface::Cage cage = surface::makePlane(96, 32, 12, 4);
  const auto uvs = static_cast<int>(cage.uvs.size());
  for (int i = 0; i < uvs; ++i) cage.uvs.push_back(cage.uvs[static_cast<std::size_t>(i)] + shift);
  for (std::size_t corner = 0; corner < cage.faceUvs.size(); ++corner) {
    const std::size_t face = corner / 4;
    double middle = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      middle += cage.positions[static_cast<std::size_t>(cage.faceVertices[4 * face + k])].x / 4;
    }
    if (middle > 0) cage.faceUvs[corner] += uvs;
  }
  cage.grid.reset();
  return cage;
}

TEST(TextureCharts, SeamsAreWhereNeighboursDisagree) {
  const surface::LimitSurface cube(cubeCage());
  EXPECT_EQ(TextureCharts(cube, flatRelief(16, 16)).seamCount(), 12U);
  const surface::LimitSurface plane(surface::makePlane(8, 8, 3, 3));
  EXPECT_EQ(TextureCharts(plane, flatRelief(16, 16)).seamCount(), 0U);
  const surface::LimitSurface halves(planeInTwoCharts({0.3, 0.1}));
  EXPECT_EQ(TextureCharts(halves, flatRelief(96, 32)).seamCount(), 4U);
  // By whole maps apart: no seam where the map repeats.
  const surface::LimitSurface whole(planeInTwoCharts({2, -1}));
  EXPECT_EQ(TextureCharts(whole, flat(96, 32, relief::Wrap::repeat)).seamCount(), 0U);
  EXPECT_EQ(TextureCharts(whole, flat(96, 32, relief::Wrap::clamp)).seamCount(), 4U);
}

TEST(TextureCharts, ATorusHasSeamsOnlyWhereItsMapDoesNotRepeat) {
  const surface::LimitSurface torus(surface::makeTorus(30, 10, 66, 60));
  EXPECT_EQ(TextureCharts(torus, flat(64, 32, relief::Wrap::repeat)).seamCount(), 0U);
  EXPECT_EQ(TextureCharts(torus, flat(64, 32, relief::Wrap::clamp)).seamCount(), 66U + 60U);
  relief::Relief twoAndAHalf = flat(64, 32, relief::Wrap::repeat);
  twoAndAHalf.repeats = Vec2(2.5, 3);
  EXPECT_EQ(TextureCharts(torus, twoAndAHalf).seamCount(), 60U);
  // Round and round without an end.
  const TextureCharts charts(torus, flat(64, 32, relief::Wrap::repeat));
  EXPECT_FALSE(charts.crossesSeam({0, 0.5F, 0.5F}, glm::normalize(Vec2(3, 1)), 1e4));
}

TEST(TextureCharts, MirroredNeighboursAndFacesWithoutAreaAreSeams) {
  surface::Cage cage = surface::makePlane(8, 8, 2, 1);
  cage.grid.reset();
  const std::size_t right = 4 * (cage.faceVertices.size() / 4 == 2 ? 1U : 6U);
  const auto seams = [&] {
    return TextureCharts(surface::LimitSurface(cage), flatRelief(16, 16)).seamCount();
  };
  EXPECT_EQ(seams(), 0U);
  // Folded back onto the left face: the common edge stays where it was.
  const surface::Cage sound = cage;
  const auto uv = [&](std::size_t k) -> Vec2& {
    cage.uvs.push_back(cage.uvs[static_cast<std::size_t>(cage.faceUvs[right + k])]);
    cage.faceUvs[right + k] = static_cast<int>(cage.uvs.size()) - 1;
    return cage.uvs.back();
  };
  const double fold = cage.uvs[static_cast<std::size_t>(cage.faceUvs[right])].x;
  for (const std::size_t k : {1U, 2U}) uv(k).x = 2 * fold - uv(k).x;
  EXPECT_EQ(seams(), 1U);
  cage = sound;
  for (const std::size_t k : {1U, 2U}) uv(k).x = fold;
  EXPECT_EQ(seams(), 1U);
}

TEST(TextureCharts, ALineCrossesWhereItIsLongEnough) {
  const surface::LimitSurface surface(planeInTwoCharts({0.3, 0.1}));
  const TextureCharts charts(surface, flatRelief(96, 32));
  // (s, t) = (0.25, 0.5) of the third column: x = 18 of 48 texels to the seam, y = 20 of 32.
  const surface::SurfaceSample sample{2 * 12 + 2, 0.25F, 0.5F};
  for (const double degrees : {0.0, 20.0, -12.0, 7.0}) {
    const double a = radians(degrees);
    const double length = 30 / std::cos(a);
    EXPECT_TRUE(charts.crossesSeam(sample, {std::cos(a), std::sin(a)}, length + 1e-6)) << degrees;
    EXPECT_FALSE(charts.crossesSeam(sample, {std::cos(a), std::sin(a)}, length - 1e-6)) << degrees;
  }
  // Over the border, and away from the seam.
  EXPECT_FALSE(charts.crossesSeam(sample, {0, 1}, 1000));
  EXPECT_FALSE(charts.crossesSeam(sample, {-1, 0}, 1000));
  // Through vertices of the cage: (16, 16) to (48, 32) is on the border's way only at its end.
  const surface::SurfaceSample corner{2 * 12 + 2, 0, 0};
  EXPECT_TRUE(charts.crossesSeam(corner, glm::normalize(Vec2(4, 1)), 40));
  EXPECT_FALSE(charts.crossesSeam(corner, glm::normalize(Vec2(1, 1)), 40));
}

/// The point of a face at a place of the map lies in a chart if it lies in one of its faces: a walk
/// along the line against a look at all faces.
TEST(TextureCharts, AgreesWithASearchOfAllFacesOnSpot) {
  const surface::LimitSurface surface(
      surface::readMeshFile(GNOMON_SCENES "/meshes/spot_control_mesh.obj"));
  const relief::Relief relief = flatRelief(256, 256);
  const TextureCharts charts(surface, relief);
  EXPECT_GT(charts.seamCount(), 50U);
  EXPECT_LT(charts.seamCount(), 500U);
  std::vector<std::array<Vec2, 4>> faces;
  for (int f = 0; f < surface.faceCount(); ++f) {
    const auto at = [&](double s, double t) { return surface.evaluate(f, s, t).uv * 256.0; };
    faces.push_back({at(0, 0), at(1, 0), at(1, 1), at(0, 1)});
  }
  const auto covered = [&](Vec2 p) {
    return std::any_of(faces.begin(), faces.end(), [&](const std::array<Vec2, 4>& c) {
      bool inside = false;
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 begin = c.at(k);
        const Vec2 edge = c.at((k + 1) % 4) - begin;
        const double along = glm::clamp(glm::dot(p - begin, edge) / glm::dot(edge, edge), 0.0, 1.0);
        if (glm::length(p - begin - along * edge) < 0.06) return true;
        const bool above = begin.y > p.y;
        if (above == (begin.y + edge.y > p.y)) continue;
        inside ^= begin.x + edge.x * (p.y - begin.y) / edge.y > p.x;
      }
      return inside;
    });
  };
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  int compared = 0;
  int crossing = 0;
  int wrong = 0;
  while (compared < 400) {
    const surface::SurfaceSample sample{static_cast<int>(random() % faces.size()),
                                        static_cast<float>(uniform(random)),
                                        static_cast<float>(uniform(random))};
    const surface::TexelFrame frame =
        surface::texelFrame(surface.evaluate(sample), relief.texelsPerUv());
    if (!frame.defined || glm::dot(glm::cross(frame.px, frame.py), frame.normal) < 0) continue;
    const double a = 2 * pi * uniform(random);
    const Vec2 direction(std::cos(a), std::sin(a));
    const double reach = 40 * uniform(random);
    bool leaves = false;
    for (double r = 0; r < reach && !leaves; r += 0.05)
      leaves = !covered(frame.texel + r * direction);
    const bool crosses = charts.crossesSeam(sample, direction, reach);
    // Two charts that touch in the map look like one to the search: the walk may cross where it
    // sees nothing, not the other way. Faces are widened by more than a step.
    wrong += leaves && !crosses ? 1 : 0;
    crossing += crosses ? 1 : 0;
    ++compared;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(crossing, 40);
  EXPECT_LT(crossing, 360);
}

/// A wall 6 high before the seam at x = 48, whose shadow falls across it: what lies in the shadow
/// beyond the seam takes its light from over it, up to the wall; what is lit behind the shadow has
/// a ray that passes over the relief's height before or after the seam.
TEST(SeamCrossings, ArePathsFromTheSampleToWhatDecides) {
  const surface::LimitSurface surface(planeInTwoCharts({1, 0}));
  const relief::Relief relief =
      stepRelief(192, 32, 6, [](int i, int) { return i >= 40 && i < 44; });
  relief::Relief scaled = relief;
  scaled.repeats = Vec2(0.5, 1);  // 96 texels a unit of u: the right half lies at 96 + x
  const MicroMesh mesh(surface, scaled, {0.25, 0});
  const MicroScene scene(mesh);
  const TextureCharts charts(surface, scaled);
  ASSERT_EQ(charts.seamCount(), 4U);
  const double tangent = std::tan(radians(20));
  const double end = 43.5 + 6 / tangent;  // of the shadow: x = 60
  const Vec3 light = lightToward(180, 20);
  surface::SampleGrid samples{0, 1, {}};
  std::vector<double> places;
  for (double x = 1.2; x < 96; x += 0.37) {
    places.push_back(x);
    samples.samples.push_back(
        {12 + static_cast<int>(x / 8), static_cast<float>(x / 8 - std::floor(x / 8)), 0.4F});
  }
  samples.width = static_cast<int>(places.size());
  const std::array lights = {TraceSettings{{light}}, TraceSettings{{lightToward(180, 70)}}};
  const auto truths = traceShadows(surface, scaled, mesh, scene, samples, lights);
  const auto both =
      seamCrossings(surface, scaled, mesh, scene, charts, samples, truths, lights, 14);
  const std::vector<std::uint8_t>& crossings = both[0];
  int crossing = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double x = places[i];
    if (std::abs(x - end) < 0.1) continue;
    // On the floor beyond the seam a ray in the shadow runs to the wall, but no path is longer than
    // 14 texels; a lit one rises over 6 within 6 / tan θ = 16.5 texels, or 14.
    const double floorReach = 14;
    const bool expected = x > 48 && x - 48 < floorReach;
    EXPECT_EQ(crossings[i] != 0, expected) << x;
    crossing += crossings[i];
  }
  EXPECT_GT(crossing, 30);
  // With a high light a lit ray is soon over the relief: 6 / tan 70° = 2.2 texels.
  const std::vector<std::uint8_t>& few = both[1];
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double beyond = places[i] - 48;
    if (std::abs(beyond - 6 / std::tan(radians(70))) < 0.1) continue;
    EXPECT_EQ(few[i] != 0, beyond > 0 && beyond < 6 / std::tan(radians(70))) << places[i];
  }
}

}  // namespace
}  // namespace gnomon::truth
