// An implementation that shares nothing with ours but the height function: Embree's own
// Catmull-Clark surface, displaced by its callback, against the OpenSubdiv micro-mesh.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "truth/embree.h"
#include "truth/shadow_tracer.h"
#include "truth/truth_scenes.h"

namespace gnomon::truth {
namespace {

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
