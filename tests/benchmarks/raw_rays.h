#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "truth/embree.h"
#include "truth/shadow_tracer.h"

namespace gnomon::benchmarks {

/// The rays that one light's truth takes, in Embree's own packets and already in the best order: of
/// tiles of 4 × 4 samples only those samples that need a ray, sixteen to a packet. All that is left
/// to do is rtcOccluded16, on all threads.
class RawRays {
 public:
  /// @param truth  of the placed samples under the light
  RawRays(const truth::MicroMesh& mesh, const truth::PlacedSamples& placed,
          const truth::TraceSettings& light, const truth::Truth& truth);

  /// Traces all of them.
  /// @returns how many were blocked
  [[nodiscard]] std::size_t trace() const;

  /// How many they are.
  [[nodiscard]] std::size_t count() const { return count_; }
  /// How many of them are blocked, as the truth has it.
  [[nodiscard]] std::size_t blocked() const { return blocked_; }

 private:
  struct Packet {
    alignas(64) std::array<int, 16> valid{};
    RTCRay16 rays{};
  };

  void add(std::size_t lane, const Vec3& origin, const Vec3& direction);

  truth::embree::Device device_;
  truth::embree::Scene scene_;
  std::vector<Packet> packets_;
  std::size_t count_ = 0;
  std::size_t blocked_ = 0;
};

}  // namespace gnomon::benchmarks
