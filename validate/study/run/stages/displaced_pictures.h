#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "study/run/scene/truth_stage.h"
#include "study/run/stages/picture_output.h"

namespace gnomon::study {

/// The displaced surface by its own rays, in every camera view under every light:
/// `images/VIEW_LIGHT_displaced.png`.
class DisplacedPictures {
 public:
  /// @param output  outlives this
  explicit DisplacedPictures(PictureOutput& output) : output_(output) {}

  /// Traces them, where the cache does not have them, and puts them into the queue.
  void queue(SurfaceOnDemand& surface);

  /// As a page embeds one, once the queue is finished; null where there is none.
  [[nodiscard]] const std::string* embedded(std::size_t view, std::size_t light) const;

 private:
  /// Diffuse light per pixel, 0 to 1, -1 for background.
  std::vector<float> trace(std::size_t view, std::size_t light, const Camera& camera,
                           const TracedSurface& traced);
  void queue(std::size_t view, std::size_t light, const Camera& camera, SurfaceOnDemand& surface);

  PictureOutput& output_;
  std::map<std::pair<std::size_t, std::size_t>, std::string> embedded_;  ///< by view and light
};

}  // namespace gnomon::study
