#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/polygon_meshes.h"
#include "surface/cage/shapes.h"
#include "truth/closed_mesh.h"
#include "truth/disc_scenes.h"
#include "truth/micro_surface.h"
#include "truth/shadow_tracer.h"
#include "truth/surface_paths.h"
#include "truth/truth_scenes.h"
#include "truth/visibility_tracer.h"

// The truth on polygons as they are, against closed forms and against itself.

namespace gnomon::truth {
namespace {

using test::BoxFaces;
using test::boxMesh;
using test::flatRelief;
using test::flatShare;
using test::lightToward;
using test::PolygonList;
using test::randomRelief;
using test::samplesOfAllFaces;
using test::stepRelief;

struct PolygonTruth : test::MicroSurface {
  using MicroSurface::MicroSurface;

  [[nodiscard]] Truth trace(const surface::SampleGrid& samples, const Vec3& light) const {
    return traceShadows(surface, relief, mesh, scene, samples, {light, 1e-6});
  }
  [[nodiscard]] Truth traceDisc(const surface::SampleGrid& samples, const Vec3& light,
                                double radius) const {
    Truth truth = trace(samples, light);
    truth.answerBy(traceVisibility(mesh, scene, samples, truth.mask, {{light, radius}, 256}));
    return truth;
  }
  [[nodiscard]] Vec3 positionOf(const surface::SurfaceSample& sample) const {
    return surface.tangentPoint(sample).position;
  }
};

double shareAt(const Truth& truth, std::size_t i) {
  return truth.visibility.shares[i];
}

/// How many samples of two masks differ.
std::size_t flips(const Mask& a, const Mask& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a.samples[i] != b.samples[i] ? 1 : 0;
  return count;
}

std::size_t shadowed(const Mask& mask) {
  return static_cast<std::size_t>(
      std::count(mask.samples.begin(), mask.samples.end(), Shade::shadowed));
}

/// One square of 64 × 64 units, a texel a unit, in z = 0 about the origin; cut where asked for.
surface::Cage square(bool isCut) {
  PolygonList mesh;
  mesh.positions = {{-32, -32, 0}, {32, -32, 0}, {32, 32, 0}, {-32, 32, 0}};
  if (isCut) {
    mesh.add({0, 1, 2}, {{0, 0}, {1, 0}, {1, 1}});
    mesh.add({0, 2, 3}, {{0, 0}, {1, 1}, {0, 1}});
  } else {
    mesh.add({0, 1, 2, 3}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  }
  return mesh.cage();
}

constexpr double cliffHeight = 4;

/// High where x < -8.5; it falls to 0 at x = -7.5.
relief::Relief cliff() {
  return stepRelief(64, 64, cliffHeight, [](int i, int) { return i < 24; });
}

// A step of height H shades H / tan θ of the plane behind it. On a quadrilateral the micro-mesh has
// lines at the relief's kinks; across triangles they run askew, so that a kink is cut by up to a
// micro-edge, the step's edge by that times its slope over four, and the shadow by that over tan θ.
TEST(PolygonTruth, AStepOnAFlatPolygonShadesAsFarAsItsHeightSays) {
  for (const bool isCut : {false, true}) {
    const double edge = isCut ? std::sqrt(2.0) / 8 : 0;
    const PolygonTruth scene(square(isCut), cliff(), isCut ? 0.125 : 0.25);
    const surface::SampleGrid samples = samplesOfAllFaces(scene.surface, isCut ? 41 : 71);
    const double end = -8.5 + cliffHeight / std::tan(radians(20));
    const Truth truth = scene.trace(samples, lightToward(180, 20));
    std::size_t count = 0;
    for (std::size_t i = 0; i < samples.samples.size(); ++i) {
      const double x = scene.positionOf(samples.samples[i]).x;
      if (std::abs(x - end) < 1e-3 + edge * cliffHeight / 4 / std::tan(radians(20)) ||
          std::abs(x + 8.5) < 0.05 + edge)
        continue;
      const bool isShadowed = x > -8.5 && x < end;
      EXPECT_EQ(truth.mask.samples[i], isShadowed ? Shade::shadowed : Shade::lit) << x;
      count += isShadowed ? 1 : 0;
    }
    EXPECT_GT(count, samples.samples.size() / 8);
  }
}

// Of a disc of radius ρ at elevation θ the ground sees what is above the step's edge at elevation
// β, a straight horizon far wider than the disc.
TEST(PolygonTruth, AStepHasThePenumbraOfAStraightEdge) {
  const double rho = radians(2);
  const double theta = radians(20);
  const PolygonTruth scene(square(false), cliff(), 0.25);
  const surface::SampleGrid samples = samplesOfAllFaces(scene.surface, 101);
  const Truth truth = scene.traceDisc(samples, lightToward(180, 20), rho);
  std::size_t partial = 0;
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const Vec3 p = scene.positionOf(samples.samples[i]);
    if (p.x < -7 || std::abs(p.y) > 20) continue;
    const double beta = std::atan(cliffHeight / (p.x + 8.5));
    const double expected = flatShare(theta, beta, rho);
    EXPECT_NEAR(shareAt(truth, i), expected, 0.02) << p.x;
    partial += expected > 0.1 && expected < 0.9 ? 1 : 0;
  }
  EXPECT_GT(partial, 20U);
}

/// A box on the ground z = 0, as one mesh. The box's uv tiles come first, the ground's is the map's
/// last; all without relief.
PolygonList boxOnGround(const Vec3& low, const Vec3& high, BoxFaces faces) {
  PolygonList mesh = boxMesh(low, high, true, faces);
  const int first = static_cast<int>(mesh.positions.size());
  for (const Vec2 corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) {
    mesh.positions.emplace_back(20 * corner.x, 20 * corner.y, 0);
  }
  mesh.add({first, first + 1, first + 2, first + 3}, test::tileUv(5), {0, 0, 1});
  return mesh;
}

/// Where a ray from a point outside a box meets it.
bool meetsBox(const Vec3& from, const Vec3& direction, const Vec3& low, const Vec3& high) {
  double enter = 0;
  double leave = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (low[axis] - from[axis]) / direction[axis];
    const double b = (high[axis] - from[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

TEST(PolygonTruth, ABoxShadesTheGroundAsItsOutlineSays) {
  const Vec3 low(-2, -3, 0.5);
  const Vec3 high(3, 1, 4.5);
  for (const BoxFaces faces : {BoxFaces::quadrilaterals, BoxFaces::triangles, BoxFaces::mixed}) {
    const PolygonTruth scene(boxOnGround(low, high, faces).cage(), flatRelief(96, 64), 0.5);
    const surface::SampleGrid samples = samplesOfAllFaces(scene.surface, 47);
    const Vec3 light = lightToward(200, 35);
    const Truth truth = scene.trace(samples, light);
    std::size_t cast = 0;
    for (std::size_t i = 0; i < samples.samples.size(); ++i) {
      const surface::TangentPoint point = scene.surface.tangentPoint(samples.samples[i]);
      const Vec3 normal = surface::outwardNormal(point);
      if (point.position.z > 1e-9) {
        // On the box itself only its own sides' turn counts.
        EXPECT_EQ(truth.mask.samples[i],
                  glm::dot(normal, light) > 0 ? Shade::lit : Shade::shadowed);
        continue;
      }
      const bool isShadowed = meetsBox(point.position, light, low, high);
      const auto isNear = [&](double by) {
        return meetsBox(point.position, light, low - by, high + by) != isShadowed;
      };
      if (isNear(1e-4) || isNear(-1e-4)) continue;
      EXPECT_EQ(truth.mask.samples[i], isShadowed ? Shade::shadowed : Shade::lit);
      cast += isShadowed ? 1 : 0;
    }
    EXPECT_GT(cast, 60U);
  }
}

TEST(PolygonTruth, OfATetrahedronTheSidesTowardTheLightAreLit) {
  PolygonList mesh;
  mesh.positions = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  int tile = 0;
  const std::vector<std::vector<int>> sides = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  for (const std::vector<int>& side : sides) {
    std::vector<Vec2> uv = test::tileUv(tile++);
    uv.pop_back();
    mesh.add(side, uv);
  }
  const PolygonTruth scene(mesh.cage(), flatRelief(48, 32), 0.5);
  EXPECT_TRUE(surface::isClosed(scene.surface));
  const surface::SampleGrid samples = samplesOfAllFaces(scene.surface, 9);
  int lit = 0;
  for (const Vec3& light : {lightToward(13, 27), lightToward(110, -50), lightToward(250, 70)}) {
    const Truth truth = scene.trace(samples, light);
    for (std::size_t i = 0; i < samples.samples.size(); ++i) {
      const Vec3 normal = surface::outwardNormal(scene.surface.tangentPoint(samples.samples[i]));
      const bool isLit = glm::dot(normal, light) > 0;
      EXPECT_EQ(truth.mask.samples[i], isLit ? Shade::lit : Shade::shadowed);
      lit += isLit ? 1 : 0;
    }
  }
  EXPECT_GT(lit, 0);
  EXPECT_LT(lit, static_cast<int>(3 * samples.samples.size()));
}

// ---- cracks

std::size_t openEdges(const surface::Cage& cage) {
  const PolygonTruth scene(cage, randomRelief(96, 64, 0.2, 7), 0.5);
  const test::EdgeCount count = test::countEdges(scene.mesh);
  EXPECT_GT(count.all, 1000U);
  return count.open;
}

TEST(PolygonTruth, ADisplacedCrateHasNoCrackAtItsHardEdges) {
  for (const BoxFaces faces : {BoxFaces::quadrilaterals, BoxFaces::triangles, BoxFaces::mixed}) {
    surface::Cage cage = boxMesh(Vec3(-1), Vec3(1), true, faces).cage();
    EXPECT_EQ(openEdges(cage), 0U);
  }
  // A control: sides with vertices of their own, displaced along their own normals, come apart.
  const PolygonList apart = boxMesh(Vec3(-1), Vec3(1), true).apart();
  surface::Cage cage = apart.cage();
  for (std::size_t k = 0; k < cage.directions.size(); ++k) {
    cage.directions[static_cast<std::size_t>(cage.faceVertices[k])] =
        cage.normals[static_cast<std::size_t>(cage.faceNormals[k])];
  }
  EXPECT_GT(openEdges(cage), 50U);
}

// ---- the same surface told otherwise

/// Columns on a part of a sphere, in texels of the map.
relief::Relief columns() {
  return stepRelief(64, 64, 2,
                    [](int i, int j) { return std::hypot(i % 16 - 7.5, j % 16 - 7.5) < 4; });
}

/// The mask at 97 × 97 places of the map.
Mask maskAtPlaces(const PolygonTruth& scene, int columnsOfFaces) {
  constexpr int side = 97;
  surface::SampleGrid samples{side, side, {}};
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const Vec2 at = Vec2(i + 0.5, j + 0.5) * static_cast<double>(columnsOfFaces) / 97.0;
      const Vec2 cell = glm::floor(at);
      samples.samples.push_back(
          {static_cast<int>(cell.y) * columnsOfFaces + static_cast<int>(cell.x),
           static_cast<float>(at.x - cell.x), static_cast<float>(at.y - cell.y)});
    }
  }
  return scene.trace(samples, lightToward(150, 35)).mask;
}

TEST(PolygonTruth, AFacetedSphereComesToTheSmoothOne) {
  constexpr double radius = 60;
  const PolygonTruth smooth(surface::makeSphere(radius, 1, 1, 32, 32), columns(), 0.25);
  const Mask truth = maskAtPlaces(smooth, 32);
  std::vector<double> wrong;
  for (const int faces : {2, 4, 8, 16, 32}) {
    const PolygonTruth faceted(test::facetedSphere(radius, 1, 1, faces, faces).cage(), columns(),
                               0.25);
    wrong.push_back(static_cast<double>(flips(maskAtPlaces(faceted, faces), truth)) /
                    static_cast<double>(truth.size()));
  }
  EXPECT_GT(shadowed(truth), truth.size() / 10);
  EXPECT_GT(wrong.front(), 0.01) << "a coarse one is another body";
  for (std::size_t k = 1; k < wrong.size(); ++k) EXPECT_LT(wrong[k], wrong[k - 1]) << k;
  EXPECT_LT(wrong.back(), 2e-3);
}

/// A lumpy mesh with both kinds of polygons, hard and soft edges, and a relief that repeats.
PolygonList lump() {
  PolygonList mesh = boxMesh({-1, -1.5, -0.7}, {1.2, 1, 0.8}, true, BoxFaces::mixed);
  mesh.positions[7] += Vec3(0.4, 0.3, 0.2);
  mesh.positions[4] += Vec3(-0.2, 0.1, 0.3);
  for (std::size_t k = 0; k < mesh.faceNormals.size(); k += 5) mesh.faceNormals[k] = -1;
  return mesh;
}

/// The mesh with x turned round, and so its faces' corners: the first stays the first.
PolygonList mirrored(const PolygonList& mesh) {
  PolygonList result = mesh;
  for (Vec3& p : result.positions) p.x = -p.x;
  for (Vec3& n : result.normals) n.x = -n.x;
  std::ptrdiff_t begin = 0;
  for (const int size : mesh.faceSizes) {
    for (auto* list : {&result.faceVertices, &result.faceUvs, &result.faceNormals}) {
      std::reverse(list->begin() + begin + 1, list->begin() + begin + size);
    }
    begin += size;
  }
  return result;
}

/// The relief's map turned round.
relief::Relief mirrored(const relief::Relief& relief) {
  const int width = relief.field.width();
  std::vector<float> texels = relief.field.texels();
  for (auto row = texels.begin(); row != texels.end(); row += width) std::reverse(row, row + width);
  return {relief::HeightField(width, relief.field.height(), std::move(texels), relief.field.wrap()),
          relief.space, relief.repeats};
}

TEST(PolygonTruth, AMirroredMeshHasTheMirroredMask) {
  const relief::Relief relief = randomRelief(48, 32, 0.15, 3);
  const PolygonTruth scene(lump().cage(), relief, 0.25);
  const PolygonTruth other(mirrored(lump()).cage(), relief, 0.25);
  const surface::SampleGrid samples = samplesOfAllFaces(scene.surface, 21);
  surface::SampleGrid across = samples;  // s and t change places
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const surface::SurfaceSample& sample = samples.samples[i];
    // The first corner of a polygon stays the first; the squares of the others come in reverse.
    across.samples[i] = {sample.face, sample.t, sample.s};
  }
  // Squares of a triangle, and of a quadrilateral cut in four: the first, then the rest backward.
  for (surface::SurfaceSample& sample : across.samples) {
    const Vec3 here = scene.positionOf({sample.face, sample.t, sample.s});
    for (int face = std::max(0, sample.face - 3);
         face <= std::min(other.surface.faceCount() - 1, sample.face + 3); ++face) {
      const Vec3 there = other.positionOf({face, sample.s, sample.t});
      if (glm::length(there - Vec3(-here.x, here.y, here.z)) > 1e-9) continue;
      sample.face = face;
      break;
    }
  }
  const Vec3 light = lightToward(20, 25);
  const Mask mask = scene.trace(samples, light).mask;
  const Mask mirror = other.trace(across, Vec3(-light.x, light.y, light.z)).mask;
  EXPECT_EQ(flips(mask, mirror), 0U);
  EXPECT_GT(shadowed(mask), mask.size() / 10);
  EXPECT_LT(shadowed(mask), mask.size() * 9 / 10);
  // A control: the light as it was.
  EXPECT_GT(flips(mask, other.trace(across, light).mask), mask.size() / 20);
}

TEST(PolygonTruth, MirroredTextureCoordinatesWithAMirroredMapChangeNothing) {
  const relief::Relief relief = randomRelief(48, 32, 0.15, 3);
  PolygonList turned = lump();
  for (Vec2& uv : turned.uvs) uv.x = 1 - uv.x;
  const PolygonTruth scene(lump().cage(), relief, 0.25);
  const PolygonTruth other(turned.cage(), mirrored(relief), 0.25);
  const surface::SampleGrid samples = samplesOfAllFaces(scene.surface, 21);
  const Vec3 light = lightToward(20, 25);
  const Mask mask = scene.trace(samples, light).mask;
  EXPECT_EQ(flips(mask, other.trace(samples, light).mask), 0U);
  const PolygonTruth control(turned.cage(), relief, 0.25);
  EXPECT_GT(flips(mask, control.trace(samples, light).mask), mask.size() / 20);
}

TEST(PolygonTruth, ATurnOfMeshAndLightChangesNothingBeyondTheUncertainty) {
  const relief::Relief relief = randomRelief(48, 32, 0.15, 3);
  const PolygonTruth scene(lump().cage(), relief, 0.25);
  const PolygonTruth coarse(lump().cage(), relief, 0.5);
  const glm::dmat3 turn(glm::normalize(Vec3(2, 1, 2)), glm::normalize(Vec3(-2, 2, 1)),
                        glm::normalize(Vec3(1, 2, -2)));
  const double handed = glm::determinant(turn);
  const glm::dmat3 rotation(turn[0], turn[1], handed * turn[2]);
  PolygonList turned = lump();
  for (Vec3& p : turned.positions) p = rotation * p;
  for (Vec3& n : turned.normals) n = rotation * n;
  const PolygonTruth other(turned.cage(), relief, 0.25);
  const surface::SampleGrid samples = samplesOfAllFaces(scene.surface, 41);
  const Vec3 light = lightToward(20, 25);
  const Mask mask = scene.trace(samples, light).mask;
  const double uncertainty = flipRate(mask, coarse.trace(samples, light).mask);
  EXPECT_GT(uncertainty, 0);
  EXPECT_LE(flipRate(mask, other.trace(samples, rotation * light).mask), uncertainty);
}

}  // namespace
}  // namespace gnomon::truth
