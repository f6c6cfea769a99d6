#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/picking.h"
#include "truth/region.h"
#include "truth/surface_paths.h"
#include "viewer/session/view_session.h"

namespace gnomon::app {

/// Tells what is known of one pixel, a line each: what every method shown answers, what the truth
/// is, in which region it lies and what that means, the horizon beside the light, the height.
///   onoue-2004: lit
///   truth: in shadow
///   region cast: a bump nearby is in the way
///   horizon 31.2° over the surface, light 24.0°
///   height 3.2
/// Under a light with a disc the answers are shares, "V = 0.412". The region is the run's, by the
/// light's centre; the horizon is the flat relief's along the light, the height that of the relief,
/// in the world, both at the study's base mesh.
class PixelProbe {
 public:
  /// @return nothing where the pixel shows no surface, or before the camera rests
  std::vector<std::string> linesOf(ViewSession& session, ViewPixel pixel);

 private:
  /// Of one sample, by the traced surface; none before it is there.
  truth::Region regionOf(const ViewSession& session, const surface::SurfaceSample& sample);

  std::optional<truth::SurfacePaths> paths_;
  cache::ContentKey pathsOf_;  ///< SceneKeys::surface
};

}  // namespace gnomon::app
