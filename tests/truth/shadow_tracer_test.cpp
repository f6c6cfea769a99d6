#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "truth/embree.h"
#include "truth/micro_surface.h"
#include "truth/shadow_tracer.h"
#include "truth/surface_paths.h"
#include "truth/truth_scenes.h"

// The truth on planes whose texture is stretched, sheared or mirrored, against the closed form.
// An implementation that shares nothing with ours but the height function: Embree's own
// Catmull-Clark surface, displaced by its callback, against the OpenSubdiv micro-mesh.

namespace gnomon::truth {
namespace {

using test::flatRelief;
using test::lightToward;
using test::randomRelief;
using test::sampleAt;
using test::sampleLine;
using test::samplesOfAllFaces;
using test::ShearedPlane;
using test::shearedPlanes;
using test::stepRelief;
using test::wallPlane;
using test::wallRelief;

/// A surface with its relief, ready to be traced.
struct TruthScene : test::MicroSurface {
  using MicroSurface::MicroSurface;

  [[nodiscard]] Truth trace(const surface::SampleGrid& samples, const Vec3& light) const {
    return traceShadows(surface, relief, mesh, scene, samples, {light, 1e-6});
  }
};

/// Where along a line of samples the shadow ends: the place of the last shadowed sample.
double lastShadowed(const Truth& truth) {
  double last = -1;
  for (std::size_t i = 0; i < truth.mask.size(); ++i) {
    if (truth.mask.samples[i] == Shade::shadowed) last = static_cast<double>(i);
  }
  return (last + 1) / static_cast<double>(truth.mask.size());
}

TEST(ShadowTracer, FacetsTurnedFromTheLightAreAttached) {
  const TruthScene scene(wallPlane(), wallRelief(), 0.25);
  // The wall's lee side, between the centres of its last texel and the next.
  const surface::SampleGrid lee =
      sampleLine(scene.surface, scene.relief, {31.6, 16}, {32.4, 16}, 16);
  const Truth truth = scene.trace(lee, lightToward(180, 45));
  for (std::size_t i = 0; i < lee.samples.size(); ++i) {
    EXPECT_EQ(truth.mask.samples[i], Shade::shadowed);
    EXPECT_EQ(truth.regions[i], Region::attached);
  }
}

TEST(ShadowTracer, BareSphereIsLitUpToItsTerminator) {
  constexpr double radius = 40;
  const TruthScene scene(surface::makeSphere(radius, 2.4, 1.2, 64, 32), flatRelief(96, 48), 0.1);
  const Vec3 light = lightToward(0, 30);
  const surface::SampleGrid samples = samplesOfAllFaces(scene.surface, 5);
  const Truth truth = scene.trace(samples, light);
  std::size_t lit = 0;
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const surface::SurfaceSample& sample = samples.samples[i];
    const Vec3 normal = scene.surface.evaluate(sample).position / radius;
    const double elevation = glm::dot(normal, light);
    if (std::abs(elevation) < 2e-3)
      continue;  // a facet is tilted by half its angle from its samples
    EXPECT_EQ(truth.mask.samples[i], elevation > 0 ? Shade::lit : Shade::shadowed);
    EXPECT_EQ(truth.regions[i], elevation > 0 ? Region::lit : Region::beyondTerminator);
    lit += elevation > 0 ? 1 : 0;
  }
  EXPECT_GT(lit, samples.samples.size() / 10);
  EXPECT_LT(lit, samples.samples.size() * 9 / 10);
}

/// Eq. (3) of Onoue, Max & Nishita 2004: from height h over a bare sphere the horizon lies
/// arccos(R / (R + h)) below the tangent plane.
TEST(ShadowTracer, TipOfAPinIsLitDownToTheSpheresHorizon) {
  constexpr double radius = 60;
  constexpr double height = 5;
  const TruthScene scene(
      surface::makeSphere(radius, 2, 2, 40, 40),
      stepRelief(81, 81, height, [](int i, int j) { return i == 40 && j == 40; }), 0.1);
  const double dip = std::acos(radius / (radius + height)) * 180 / pi;
  surface::SampleGrid tip{1, 1, {sampleAt(scene.surface, scene.relief, {40.5, 40.5})}};
  // From (+, +): the tip's own facet, of the cell toward greater x and y, faces that way.
  EXPECT_EQ(scene.trace(tip, lightToward(45, -dip + 0.1)).mask.samples[0], Shade::lit);
  EXPECT_EQ(scene.trace(tip, lightToward(45, -dip - 0.1)).mask.samples[0], Shade::shadowed);
  EXPECT_EQ(scene.trace(tip, lightToward(45, -dip + 0.1)).regions[0], Region::beyondTerminator);
}

TEST(ShadowTracer, ColumnOnASphereShadesAsTheCircleSays) {
  // In the plane of the light the ground at arc angle γ from the column's foot is shadowed where
  // (cos γ - 1/(1 + κh)) / sin γ, the exact horizon on a circle, exceeds the light's slope there.
  constexpr double radius = 80;
  constexpr double height = 6;
  const TruthScene scene(surface::makeSphere(radius, 1.6, 0.4, 64, 16),
                         stepRelief(128, 32, height, [](int i, int) { return i >= 60 && i < 64; }),
                         0.1);
  const surface::SampleGrid samples =
      sampleLine(scene.surface, scene.relief, {64.6, 16}, {94.6, 16}, 4000);
  const Vec3 light =
      lightToward(180, 0) * std::cos(radians(25)) + Vec3(0, 0, std::sin(radians(25)));
  const Truth truth = scene.trace(samples, light);
  const double edge = (63.5 - 64) / 128 * 1.6;  // longitude of the wall's upper edge
  const auto shadowed = [&](double longitude) {
    const double gamma = longitude - edge;
    const double horizon = (std::cos(gamma) - radius / (radius + height)) / std::sin(gamma);
    return std::tan(radians(25) - longitude) < horizon;
  };
  double expected = 0;
  for (int k = 0; k < 400000; ++k) {
    const double texel = 64.6 + 30 * (k + 0.5) / 400000;
    if (shadowed((texel - 64) / 128 * 1.6)) expected = (k + 1) / 400000.0;
  }
  ASSERT_GT(expected, 0.1);
  ASSERT_LT(expected, 0.9);
  EXPECT_NEAR(lastShadowed(truth), expected, 1e-3);
}

TEST(ShadowTracer, DegenerateFramesAreLeftOutAndCounted) {
  surface::Cage cage = surface::makePlane(8, 8, 2, 2);
  std::fill(cage.uvs.begin(), cage.uvs.end(), Vec2(0.5));
  cage.grid.reset();
  const TruthScene scene(cage, flatRelief(8, 8), 0.5);
  const surface::SampleGrid samples = samplesOfAllFaces(scene.surface, 3);
  const Truth truth = scene.trace(samples, lightToward(0, 45));
  EXPECT_EQ(truth.undefinedSamples, truth.mask.size());
  for (const Shade shade : truth.mask.samples) EXPECT_EQ(shade, Shade::none);

  // Once, however many lights there are, and whether or not their places are kept.
  const std::array lights = {TraceSettings{{lightToward(30, 20)}},
                             TraceSettings{{lightToward(200, 55)}}};
  for (const Truth& each :
       traceShadows(scene.surface, scene.relief, scene.mesh, scene.scene, samples, lights)) {
    EXPECT_EQ(each.undefinedSamples, samples.samples.size());
  }
  const PlacedSamples placed =
      placeSamples(scene.surface, scene.relief.texelsPerUv(), scene.mesh, samples);
  EXPECT_EQ(traceShadows(scene.scene, placed, lights.front()).undefinedSamples,
            samples.samples.size());
}

TEST(ShadowTracer, DoesNotDependOnTheNumberOfThreads) {
  const surface::Cage cage = surface::makeTorus(30, 10, 66, 66);
  const auto masksWith = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const TruthScene scene(cage, randomRelief(256, 96, 2, 7), 0.5);
    return scene.trace(samplesOfAllFaces(scene.surface, 5), lightToward(30, 20)).mask.samples;
  };
  EXPECT_EQ(masksWith(1), masksWith(2));
}

/// A rough torus and the samples of an atlas whose sides are no multiples of a packet's.
struct RoughTorus {
  TruthScene scene{surface::makeTorus(30, 10, 66, 66), randomRelief(256, 96, 2, 7), 0.5};
  surface::SampleGrid samples = samplesOfAllFaces(scene.surface, 5);

  [[nodiscard]] PlacedSamples placed(const surface::SampleGrid& part) const {
    return placeSamples(scene.surface, scene.relief.texelsPerUv(), scene.mesh, part);
  }
};

TEST(ShadowTracer, SeveralLightsAtOnceAreEachLightAlone) {
  const RoughTorus torus;
  const std::array lights = {TraceSettings{{lightToward(30, 20)}},
                             TraceSettings{{lightToward(200, 55)}},
                             TraceSettings{{lightToward(-80, 5)}}};
  const TruthScene& s = torus.scene;
  const auto together = traceShadows(s.surface, s.relief, s.mesh, s.scene, torus.samples, lights);
  ASSERT_EQ(together.size(), lights.size());
  for (std::size_t l = 0; l < lights.size(); ++l) {
    const Truth alone =
        traceShadows(s.surface, s.relief, s.mesh, s.scene, torus.samples, lights[l]);
    EXPECT_EQ(together[l].mask.samples, alone.mask.samples);
    EXPECT_EQ(together[l].regions, alone.regions);
    EXPECT_EQ(together[l].undefinedSamples, alone.undefinedSamples);
  }
  EXPECT_NE(together[0].mask.samples, together[1].mask.samples);
}

/// Some rows of a grid, as a grid of its own.
surface::SampleGrid rowsOf(const surface::SampleGrid& grid, int first, int count) {
  const auto row = [&](int i) {
    return grid.samples.begin() + static_cast<std::ptrdiff_t>(i) * grid.width;
  };
  return {grid.width, count, {row(first), row(first + count)}};
}

TEST(ShadowTracer, PlacedSamplesAndPartsOfThemGiveTheSame) {
  const RoughTorus torus;
  const TraceSettings light{{lightToward(30, 20)}};
  const TruthScene& s = torus.scene;
  const Truth whole = traceShadows(s.surface, s.relief, s.mesh, s.scene, torus.samples, light);
  const Truth placed = traceShadows(s.scene, torus.placed(torus.samples), light);
  EXPECT_EQ(placed.mask.samples, whole.mask.samples);
  EXPECT_EQ(placed.regions, whole.regions);
  Truth joined;
  for (int row = 0; row < torus.samples.height; row += 7) {
    const int rows = std::min(7, torus.samples.height - row);
    const Truth part = traceShadows(s.scene, torus.placed(rowsOf(torus.samples, row, rows)), light);
    joined.mask.samples.insert(joined.mask.samples.end(), part.mask.samples.begin(),
                               part.mask.samples.end());
    joined.regions.insert(joined.regions.end(), part.regions.begin(), part.regions.end());
  }
  EXPECT_EQ(joined.mask.samples, whole.mask.samples);
  EXPECT_EQ(joined.regions, whole.regions);
}

struct Cancelled {};

TEST(ShadowTracer, AThrowingProgressCancelsEveryStage) {
  const RoughTorus torus;
  const TruthScene& s = torus.scene;
  const Vec2 texels = s.relief.texelsPerUv();
  const TraceSettings light{{lightToward(30, 20)}};
  const Progress cancel = [](double) { throw Cancelled(); };
  EXPECT_THROW(MicroMesh(s.surface, s.relief, {0.5, 0}, cancel), Cancelled);
  EXPECT_THROW(MicroScene(s.mesh, cancel), Cancelled);
  EXPECT_THROW(placeSamples(s.surface, texels, s.mesh, torus.samples, cancel), Cancelled);
  EXPECT_THROW(traceShadows(s.scene, torus.placed(torus.samples), light, cancel), Cancelled);
  EXPECT_THROW(traceShadows(s.surface, s.relief, s.mesh, s.scene, torus.samples, light, cancel),
               Cancelled);
}

TEST(ShadowTracer, ProgressRisesToOne) {
  const RoughTorus torus;
  double last = 0;
  const Progress progress = [&last](double share) {
    EXPECT_GT(share, last);
    last = share;
  };
  const TraceSettings light{{lightToward(30, 20)}};
  (void)traceShadows(torus.scene.scene, torus.placed(torus.samples), light, progress);
  EXPECT_EQ(last, 1);
}

TEST(ShadowTracer, FlipRateCountsDifferences) {
  const Mask a{2, 2, {Shade::lit, Shade::shadowed, Shade::none, Shade::lit}};
  const Mask b{2, 2, {Shade::lit, Shade::lit, Shade::lit, Shade::shadowed}};
  EXPECT_DOUBLE_EQ(flipRate(a, a), 0);
  EXPECT_DOUBLE_EQ(flipRate(a, b), 2.0 / 3);
}

TEST(ShadowTracer, HalfTheResolutionFlipsFew) {
  const surface::Cage cage = surface::makeSphere(60, 2, 1, 40, 20);
  const auto mask = [&](double step) {
    const TruthScene scene(cage, randomRelief(30, 15, 1.5, 9), step);
    return scene.trace(samplesOfAllFaces(scene.surface, 9), lightToward(20, 30)).mask;
  };
  const Mask finest = mask(0.02);
  const double coarse = flipRate(mask(0.25), finest);
  const double fine = flipRate(mask(0.0625), finest);
  EXPECT_GT(coarse, 0);  // else the comparison shows nothing
  EXPECT_LT(fine, coarse / 2);
  EXPECT_LT(fine, 0.005);
}

class ShearedTruth : public testing::TestWithParam<relief::HeightSpace> {};

/// A wall along the texture's y axis, 6 height units high, whose top ends at x = 31.5. Along the
/// light's direction e in the texture plane one texel is σ long, so that the shadow on the floor
/// ends 6 a |e_x| / (σ tan θ) texels from there.
TEST_P(ShearedTruth, WallsShadowEndsWhereTheMetricSays) {
  int shadows = 0;
  for (const ShearedPlane& plane : shearedPlanes()) {
    relief::Relief relief =
        stepRelief(plane.width, plane.height, 6, [](int i, int) { return i >= 28 && i < 32; });
    relief.space = GetParam();
    const surface::LimitSurface surface(plane.cage());
    const MicroMesh mesh(surface, relief, {plane.mirrored() ? 0.0625 : 0.25, 0});
    const MicroScene scene(mesh);
    for (const double azimuth : {180.0, 150.0, 215.0, 120.0}) {
      for (const double elevation : {50.0, 35.0, 25.0}) {
        const double a = radians(azimuth);
        const double e = radians(elevation);
        const double length = 6 * plane.worldPerHeight(relief.space) * std::abs(std::cos(a)) /
                              (plane.worldPerTexel(a) * std::tan(e));
        const double aside = length * std::abs(std::tan(a));
        if (length < 2 || length > 28 || aside > 14) continue;  // on the lee slope, or off the map
        ++shadows;
        // The samples run slightly oblique, off the lines of texel centres.
        surface::SampleGrid samples{2,
                                    1,
                                    {plane.sampleAt({31.5 + length - 0.05, 15.7}),
                                     plane.sampleAt({31.5 + length + 0.05, 15.7})}};
        const Truth truth = traceShadows(surface, relief, mesh, scene, samples,
                                         TraceSettings{{plane.lightOver(a, e)}});
        EXPECT_EQ(truth.mask.samples[0], Shade::shadowed)
            << plane.px.x << " " << plane.py.x << " azimuth " << azimuth << " " << elevation;
        EXPECT_EQ(truth.mask.samples[1], Shade::lit)
            << plane.px.x << " " << plane.py.x << " azimuth " << azimuth << " " << elevation;
      }
    }
  }
  EXPECT_GT(shadows, 15);
}

/// An occluder's reach is measured in texels along the light's azimuth, at the sample's own metric:
/// the wall's top edge lies `length` texels / |e_x| away.
TEST_P(ShearedTruth, RadiusIsInTexelsAlongTheLight) {
  for (const ShearedPlane& plane : shearedPlanes()) {
    if (plane.mirrored()) continue;
    relief::Relief relief =
        stepRelief(plane.width, plane.height, 30, [](int i, int) { return i < 32; });
    relief.space = GetParam();
    const surface::LimitSurface surface(plane.cage());
    const MicroMesh mesh(surface, relief, {0.25, 0});
    const MicroScene scene(mesh);
    const SurfacePaths paths(surface);
    const double a = radians(160);
    const double e = radians(4);
    const surface::SampleGrid samples{1, 1, {plane.sampleAt({42.5, 15.7})}};
    // The ray meets the wall's slope, which rises from 0 at x = 32.5 to 30 a at 31.5.
    const double rise = std::tan(e) * plane.worldPerTexel(a) / std::abs(std::cos(a));  // a texel
    const double steep = 30 * plane.worldPerHeight(relief.space);
    const double met = 10 + rise * 10 / (steep - rise);  // texels along x
    const double reach = met / std::abs(std::cos(a));
    ASSERT_LT(met, 11);
    for (const auto& [radius, region] :
         {std::pair{reach + 0.02, Region::cast}, {reach - 0.02, Region::distant}}) {
      const TraceSettings light{{plane.lightOver(a, e)}};
      Truth truth = traceShadows(surface, relief, mesh, scene, samples, light);
      splitCastShadows(surface, relief, mesh, scene, paths, {radius}, samples, {&light, 1},
                       {&truth, 1});
      EXPECT_EQ(truth.regions[0], region) << plane.px.x << " " << plane.py.x;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(HeightSpaces, ShearedTruth,
                         testing::Values(relief::HeightSpace::world, relief::HeightSpace::texture));

struct Displacement {
  const surface::Cage* cage;
  const relief::Relief* relief;
};

/// Bilinear uv of a face, as Cage defines it.
Vec2 uvAt(const surface::Cage& cage, unsigned face, double s, double t) {
  const auto corner = [&](unsigned k) {
    return cage.uvs[static_cast<std::size_t>(cage.faceUvs[4 * face + k])];
  };
  return (1 - s) * (1 - t) * corner(0) + s * (1 - t) * corner(1) + s * t * corner(2) +
         (1 - s) * t * corner(3);
}

void displace(const RTCDisplacementFunctionNArguments* arguments) {
  const auto& data = *static_cast<const Displacement*>(arguments->geometryUserPtr);
  for (unsigned i = 0; i < arguments->N; ++i) {
    const Vec2 uv = uvAt(*data.cage, arguments->primID, arguments->u[i], arguments->v[i]);
    const auto height = static_cast<float>(data.relief->field.at(uv * data.relief->texelsPerUv()));
    const Vec3 normal =
        glm::normalize(Vec3(arguments->Ng_x[i], arguments->Ng_y[i], arguments->Ng_z[i]));
    arguments->P_x[i] += height * static_cast<float>(normal.x);
    arguments->P_y[i] += height * static_cast<float>(normal.y);
    arguments->P_z[i] += height * static_cast<float>(normal.z);
  }
}

template <typename T>
T* newBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count,
             std::size_t values = 1) {
  return static_cast<T*>(
      rtcSetNewGeometryBuffer(geometry, type, 0, format, values * sizeof(T), count));
}

embree::Scene subdivisionScene(RTCDevice device, Displacement& data, float pieces) {
  const surface::Cage& cage = *data.cage;
  embree::Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SUBDIVISION));
  auto* positions = newBuffer<float>(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                     cage.positions.size(), 3);
  for (const Vec3& position : cage.positions) {
    for (int axis = 0; axis < 3; ++axis) *positions++ = static_cast<float>(position[axis]);
  }
  auto* faces = newBuffer<unsigned>(geometry.get(), RTC_BUFFER_TYPE_FACE, RTC_FORMAT_UINT,
                                    static_cast<std::size_t>(cage.faceCount()));
  std::fill_n(faces, cage.faceCount(), 4U);
  auto* indices = newBuffer<unsigned>(geometry.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT,
                                      cage.faceVertices.size());
  std::copy(cage.faceVertices.begin(), cage.faceVertices.end(), indices);
  rtcSetGeometryTessellationRate(geometry.get(), pieces);
  rtcSetGeometryUserData(geometry.get(), &data);
  rtcSetGeometryDisplacementFunction(geometry.get(), displace);
  rtcCommitGeometry(geometry.get());
  embree::Scene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(scene.get(), geometry.get());
  rtcCommitScene(scene.get());
  return scene;
}

bool blocked(RTCScene scene, const Vec3& origin, const Vec3& light) {
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(origin.x);
  ray.ray.org_y = static_cast<float>(origin.y);
  ray.ray.org_z = static_cast<float>(origin.z);
  ray.ray.dir_x = static_cast<float>(light.x);
  ray.ray.dir_y = static_cast<float>(light.y);
  ray.ray.dir_z = static_cast<float>(light.z);
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  embree::intersect1(scene, ray);
  return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

TEST(SubdivisionCheck, EmbreesOwnDisplacedSurfaceGivesTheSameShadows) {
  const surface::Cage cage = surface::makeTorus(30, 10, 66, 66);
  // Smooth waves: both tessellations must show the same surface, not the same texels.
  std::vector<float> texels;
  for (int j = 0; j < 132; ++j) {
    for (int i = 0; i < 264; ++i) {
      texels.push_back(
          static_cast<float>(1.2 + 1.2 * std::cos(2 * pi * i / 22) * std::cos(2 * pi * j / 22)));
    }
  }
  const relief::Relief relief{relief::HeightField(264, 132, texels, relief::Wrap::repeat),
                              relief::HeightSpace::world, Vec2(1)};
  const surface::LimitSurface surface(cage);
  const MicroMesh mesh(surface, relief, {0.125, 0});
  const MicroScene scene(mesh);
  const surface::SampleGrid samples = test::samplesOfAllFaces(surface, 3);
  const Vec3 light = test::lightToward(30, 25);
  const Truth truth = traceShadows(surface, relief, mesh, scene, samples, {light, 1e-6});

  Displacement data{&cage, &relief};
  const embree::Device device(rtcNewDevice(nullptr));
  const embree::Scene other = subdivisionScene(device.get(), data, 32);
  std::size_t differ = 0;
  std::size_t shadowed = 0;
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const surface::SurfaceSample& sample = samples.samples[i];
    const Facet facet = mesh.facet(sample);
    const bool turned = glm::dot(facet.normal, light) <= 0;
    // Lifted over the difference of the two tessellations.
    const Vec3 origin = mesh.centre() + facet.point + 2e-3 * facet.normal;
    const bool dark = turned || blocked(other.get(), origin, light);
    differ += dark != (truth.mask.samples[i] == Shade::shadowed) ? 1 : 0;
    shadowed += dark ? 1 : 0;
  }
  const auto all = static_cast<double>(samples.samples.size());
  EXPECT_GT(static_cast<double>(shadowed) / all, 0.2);
  EXPECT_LT(static_cast<double>(shadowed) / all, 0.9);
  EXPECT_LT(static_cast<double>(differ) / all, 0.002);
}

}  // namespace
}  // namespace gnomon::truth
