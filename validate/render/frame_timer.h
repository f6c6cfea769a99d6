#pragma once

#include <functional>
#include <string_view>

namespace gnomon {

/// What measures the time of a frame.
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

/// Median time of one frame over at most `frames`, after one that warms up; milliseconds. Slow
/// frames are timed for about 0.3 s, at least one.
/// @param draw  issues the GL commands of one frame; a context is current
/// @throws InternalError where GL recorded an error
double medianFrameMilliseconds(const std::function<void()>& draw, int frames, FrameClock clock);

}  // namespace gnomon
