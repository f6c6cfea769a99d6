#pragma once

#include <optional>
#include <string>

#include "model/picking.h"
#include "truth/surface_paths.h"
#include "viewer/session/view_session.h"

namespace gnomon::app {

/// Tells what is known of one pixel, in one line:
/// "onoue-2004 lit, truth shadow: cast; horizon slope 0.412, height 3.2". Under a light with a disc
/// the answers are shares, "V 0.412". The region is the run's, by the light's centre; the horizon
/// is the flat relief's slope along the light, the height that of the relief, both in the world, at
/// the study's base mesh.
class PixelProbe {
 public:
  /// @return empty where the pixel shows no surface, or before the camera rests
  std::string textOf(ViewSession& session, ViewPixel pixel);

 private:
  /// Of one sample, by the traced surface.
  std::string regionOf(const ViewSession& session, const surface::SurfaceSample& sample);

  std::optional<truth::SurfacePaths> paths_;
  cache::ContentKey pathsOf_;  ///< SceneKeys::surface
};

}  // namespace gnomon::app
