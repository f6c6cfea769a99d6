#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "gnomon/horizon.h"
#include "gnomon/surface.h"

namespace gnomon {
inline namespace api {

/// How a height map displaces a surface: D = P + a h n, with the surface's outward unit normal n.
struct Displacement {
  HeightMap map;
  std::array<double, 2> repeats{1, 1};  ///< times that the map is laid over one unit of u and of v
  /// Heights count texels, a = |P_x × P_y|^½ (Max 1988); otherwise world units, a = 1.
  bool heightsInTexels = false;
};

/// Why a sample is lit or shadowed. The values are those of `ShadowTruth::regions`.
enum class ShadowRegion : std::uint8_t {
  none,              ///< no sample, or the texture map is degenerate there
  lit,               ///< the light reaches it
  attached,          ///< its own facet is turned from the light
  cast,              ///< shadowed by an occluder within the search radius
  distant,           ///< shadowed only by an occluder beyond it
  beyondTerminator,  ///< the undisplaced surface is turned from the light
  global,            ///< shadowed from where the path over the surface does not lead: another limb
};

struct TraceOptions {
  /// Longest edge of the traced mesh, texels; where unset, a quarter texel or less, for at least
  /// four million triangles.
  std::optional<double> step;
  /// Occluders farther than this along the surface are `distant`, texels, above 0 and at most 1e5;
  /// where unset, the longest shadow that the lights can cast.
  std::optional<double> radius;
  /// Angular radius of each light's disc, degrees, 0 to 10; 0 is a point. Empty: all are points.
  std::vector<double> lightRadii = {};
  int directions = 256;  ///< toward a disc, each for an equal solid angle: even, 32 to 65536
  /// Told what share is done, 0 to 1, from any thread but never from two at once. What it throws
  /// cancels the trace and comes out of `traceTruth`.
  std::function<void(double share)> progress = {};
};

/// The exact shadow of a displaced surface under one light.
struct ShadowTruth {
  int width = 0, height = 0;
  /// As in MaskMap: 1 lit, 0 shadowed, 2 no answer. Of a disc: shadowed where V < 1/2.
  std::vector<std::uint8_t> mask;
  std::vector<std::uint8_t> regions;  ///< a ShadowRegion for each sample; of the disc's centre
  /// Share of the samples that change at half the mesh's resolution: no difference between methods
  /// below it means anything. Of a disc the mean of |ΔV|, with half as many directions too.
  double uncertainty = 0;
  /// As in ShareMap: V, the share of the disc that each sample sees. Empty of a point light.
  std::vector<float> shares = {};
};

/// Traces one ray from every sample's displaced point toward each light, on all threads; toward a
/// disc as many as decide which share of it is seen. The bytes do not depend on the number of
/// threads.
/// @param lights  vectors toward directional lights, of any length
/// @return one truth for each light
/// @throws Exception  badInput for a height map, sample, light, radius or step out of range, and
/// for
///   another number of radii than of lights; internal where the mesh does not fit into memory
GNOMON_API std::vector<ShadowTruth> traceTruth(const Surface& surface,
                                               const Displacement& displacement,
                                               const SurfaceSamples& samples,
                                               const std::vector<std::array<double, 3>>& lights,
                                               const TraceOptions& options = {});

}  // namespace api
}  // namespace gnomon
