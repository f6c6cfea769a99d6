#pragma once

#include <cstddef>
#include <optional>

#include "render/frame_timer.h"
#include "study/record/record.h"
#include "study/run/scene/method_case.h"
#include "study/run/scene/run_scene.h"

namespace gnomon::study {

/// How long the frames of one method are timed: of a study for up to 0.1 s. The cases of a sweep
/// have the time of five together, if they are more.
/// @param cases  of the sweep that the study is one of
render::FrameLimits frameLimits(int frames, std::size_t cases);

/// What a method costs: on the first camera view under the first light; without a camera view there
/// is no frame time. The frame that draws the answers there is the first of those timed, unless the
/// driver still had to compile for it.
///
/// A frame time that an earlier run measured is used again if nothing that it depends on has
/// changed: the method, the study, the program, the renderer, the machine and its number of
/// threads. The record then names the day. To measure it again, run without the cache.
class CostStage {
 public:
  /// @param frames  that are timed at most; with 0 there is no frame time
  CostStage(render::FrameClock clock, int frames) : clock_(clock), frames_(frames) {}

  /// The clock for the frames that draw the answers of a view under a light, where their times are
  /// wanted: nothing else may go on then.
  [[nodiscard]] std::optional<render::FrameClock> clockOf(const StudySpec& study, std::size_t view,
                                                          std::size_t light) const;
  [[nodiscard]] CostRecord measure(RunScene& scene, MethodCase& method) const;

 private:
  [[nodiscard]] std::optional<std::size_t> timedView(const StudySpec& study) const;

  render::FrameClock clock_;
  int frames_;
};

}  // namespace gnomon::study
