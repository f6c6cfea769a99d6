#include "raw_rays.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "common/parallel.h"
#include "truth/embree.h"

namespace gnomon::benchmarks {
namespace {

/// The order of tiles: rows of four samples' height, as they lie beside each other.
std::vector<std::size_t> tileOrder(int width, int height) {
  constexpr int side = 4;
  std::vector<std::size_t> order;
  for (int top = 0; top < height; top += side) {
    for (int left = 0; left < width; left += side) {
      for (int y = top; y < std::min(top + side, height); ++y) {
        for (int x = left; x < std::min(left + side, width); ++x) {
          order.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(x));
        }
      }
    }
  }
  return order;
}

}  // namespace

RawRays::RawRays(const truth::MicroMesh& mesh, const truth::PlacedSamples& placed,
                 const truth::TraceSettings& light, const truth::Truth& truth)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_.get())) {
  const truth::embree::Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_GRID));
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             mesh.coordinates().data(), 0, 3 * sizeof(float), mesh.vertexCount());
  auto* grids = static_cast<RTCGrid*>(rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_GRID,
                                                              0, RTC_FORMAT_GRID, sizeof(RTCGrid),
                                                              mesh.grids().faces().size()));
  for (const surface::FaceGrid& grid : mesh.grids().faces()) {
    const auto columns = static_cast<unsigned short>(grid.columns);
    *grids++ = {grid.firstVertex, columns, columns, static_cast<unsigned short>(grid.rows)};
  }
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene_.get(), geometry.get());
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcCommitScene(scene_.get());

  constexpr std::size_t lanes = 16;
  for (const std::size_t i : tileOrder(placed.width, placed.height)) {
    const truth::RayStart& start = placed.starts[i];
    if (!start.defined || start.facet.facesAwayFrom(light.light.direction)) continue;
    add(count_++ % lanes, start.facet.rayOrigin(light.rayOffset * placed.extent),
        light.light.direction);
    blocked_ += truth.mask.samples[i] == Shade::shadowed ? 1 : 0;
  }
}

void RawRays::add(std::size_t lane, const Vec3& origin, const Vec3& direction) {
  if (lane == 0) packets_.emplace_back();
  Packet& packet = packets_.back();
  packet.valid.at(lane) = -1;
  packet.rays.org_x[lane] = static_cast<float>(origin.x);
  packet.rays.org_y[lane] = static_cast<float>(origin.y);
  packet.rays.org_z[lane] = static_cast<float>(origin.z);
  packet.rays.dir_x[lane] = static_cast<float>(direction.x);
  packet.rays.dir_y[lane] = static_cast<float>(direction.y);
  packet.rays.dir_z[lane] = static_cast<float>(direction.z);
  packet.rays.tfar[lane] = std::numeric_limits<float>::infinity();
  packet.rays.mask[lane] = ~0U;
}

std::size_t RawRays::trace() const {
  std::atomic<std::size_t> blocked = 0;
  constexpr std::size_t grain = 64;
  const std::size_t pieces = (packets_.size() + grain - 1) / grain;
  parallelFor(0, pieces, [&](std::size_t piece) {
    const truth::FlushDenormals flush;
    std::size_t own = 0;
    for (std::size_t k = piece * grain; k < std::min(packets_.size(), (piece + 1) * grain); ++k) {
      RTCRay16 rays = packets_[k].rays;  // the answer overwrites them
      truth::embree::occluded16(packets_[k].valid.data(), scene_.get(), rays,
                                truth::embree::Rays::incoherent);
      for (std::size_t lane = 0; lane < 16; ++lane) own += rays.tfar[lane] < 0 ? 1 : 0;
    }
    blocked += own;
  });
  return blocked;
}

}  // namespace gnomon::benchmarks
