#pragma once

#include <array>
#include <atomic>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "truth/embree.h"
#include "truth/micro_mesh.h"

namespace gnomon::truth {

/// Up to sixteen endless shadow rays that share a direction.
struct RayPacket {
  static constexpr std::size_t size = 16;
  std::array<float, size> x, y, z;  ///< origins, in the mesh's centred coordinates
  std::size_t count = 0;            ///< rays 0 to count - 1 are there

  void add(const Vec3& origin);
};

/// Up to sixteen endless shadow rays, each with a unit direction of its own.
struct RayBundle {
  std::array<float, RayPacket::size> x, y, z;     ///< origins, in the mesh's centred coordinates
  std::array<float, RayPacket::size> dx, dy, dz;  ///< directions
  std::size_t count = 0;                          ///< rays 0 to count - 1 are there

  void add(const Vec3& origin, const Vec3& direction);
};

/// The nearest surface along one ray.
struct SurfaceHit {
  double distance;  ///< world units along a unit direction
  int face;
  Vec3 normal;  ///< of the facet, unit, outward
  Vec2 place;   ///< on the face's grid: 0 to 1 from its first to its last line along s and along t
};

/// A micro-mesh in Embree, as grids that share its vertices: nothing is copied, so the mesh must
/// outlive the scene.
class MicroScene {
 public:
  /// @param progress  may throw to cancel, see common/progress.h
  /// @throws MemoryError or InternalError with Embree's reason
  explicit MicroScene(const MicroMesh& mesh, const Progress& progress = {});
  MicroScene(const MicroScene&) = delete;
  MicroScene& operator=(const MicroScene&) = delete;
  ~MicroScene() = default;

  /// Which of the rays toward `direction` (unit) meet the surface.
  [[nodiscard]] std::bitset<RayPacket::size> occluded(const RayPacket& rays,
                                                      const Vec3& direction) const;
  /// Which of the rays meet the surface.
  [[nodiscard]] std::bitset<RayPacket::size> occluded(
      const RayBundle& rays, embree::Rays kind = embree::Rays::incoherent) const;
  /// Whether an endless ray with a unit direction meets the surface.
  [[nodiscard]] bool occluded(const Vec3& origin, const Vec3& direction) const;
  /// The nearest hit of a ray with a unit direction, if any.
  [[nodiscard]] std::optional<SurfaceHit> nearest(const Vec3& origin, const Vec3& direction) const;

  /// What Embree holds for this scene, bytes, without the shared vertices.
  [[nodiscard]] std::uint64_t byteCount() const {
    return static_cast<std::uint64_t>(bytes_.load());
  }
  [[nodiscard]] static std::string embreeVersion();

 private:
  std::atomic<std::int64_t> bytes_{0};  // outlives the device, which counts into it
  embree::Device device_;
  embree::Scene scene_;
};

}  // namespace gnomon::truth
