#pragma once

#include <functional>
#include <optional>
#include <string_view>

namespace gnomon::render {

/// The clock that measures a frame's time.
enum class FrameClock {
  wall,   ///< the wall clock between two glFinish
  query,  ///< the GPU's own, GL_TIME_ELAPSED: without the driver and the wait
};

/// The clock that is right for a renderer, by its GL_RENDERER. Software renderers take the wall
/// clock: their queries see only the part of the work that the calling thread does (Mesa's llvmpipe
/// answers 0.002 ms for a frame of 15 ms).
FrameClock frameClockOf(std::string_view renderer);

/// As reports say it: "wall clock" or "GL timer queries".
std::string_view frameClockName(FrameClock clock);

/// What has been drawn of the frames that are to be timed.
struct EarlierFrames {
  /// Whether any has: else the first is slower than the others, since the driver compiles for the
  /// state that it is drawn in and allocates memory; it is drawn before them, and left out.
  bool isWarm = false;
  /// The time of one that was drawn when others had been: it counts as the first of those timed.
  std::optional<double> milliseconds = {};
};

/// After how many frames, and after about which time, no more are drawn.
struct FrameLimits {
  int frames = 25;
  double milliseconds = 100;  ///< 0 to 100
};

/// Median of the times of frames. They end
///   once the median is known: the interval between two of the sorted times that holds it with 95 %
///     whatever the times' distribution (order statistics, by the binomial; nine times are the
///     fewest of which it leaves the outermost out) is no wider than 2 % of it;
///   after `limits.milliseconds`, or before, where another like the last would lead farther beyond
///     them than they are now; after at least one;
///   after `limits.frames`.
/// The look at every further frame costs little: by simulation, of times that scatter independently
/// by 0.5 to 5 %, normal or with a tail, the interval at the end holds the median in 93 to 96 %.
/// Where what disturbs them lasts over several frames, times resemble their neighbours and it holds
/// the median less often, in 80 % and less. On a machine that others shared the medians of
/// twenty runs scattered by 6 to 17 %, and still by 6 to 12 % with 0.3 s for slow frames.
/// @param frame  draws one and returns its time, milliseconds
double medianMilliseconds(const std::function<double()>& frame, FrameLimits limits,
                          const EarlierFrames& earlier);

/// The same for frames that `draw` draws.
/// @param draw  issues the GL commands of one frame; a context is current
/// @throws InternalError where GL recorded an error
double medianFrameMilliseconds(const std::function<void()>& draw, FrameLimits limits,
                               const EarlierFrames& earlier, FrameClock clock);

/// The time of one frame.
/// @throws likewise
double frameMilliseconds(const std::function<void()>& draw, FrameClock clock);

}  // namespace gnomon::render
