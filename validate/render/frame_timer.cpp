#include "render/frame_timer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

#include "render/gl_context.h"
#include "render/gl_handles.h"

namespace gnomon {
namespace {

double wallMilliseconds(const std::function<void()>& draw) {
  using Clock = std::chrono::steady_clock;
  glFinish();
  const Clock::time_point start = Clock::now();
  draw();
  glFinish();
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double queryMilliseconds(const std::function<void()>& draw, const gl::Query& query) {
  glFinish();
  glBeginQuery(GL_TIME_ELAPSED, query.name());
  draw();
  glEndQuery(GL_TIME_ELAPSED);
  GLuint64 nanoseconds = 0;
  glGetQueryObjectui64v(query.name(), GL_QUERY_RESULT, &nanoseconds);  // waits for the result
  return static_cast<double>(nanoseconds) * 1e-6;
}

}  // namespace

FrameClock frameClockOf(std::string_view renderer) {
  constexpr std::array<std::string_view, 5> software = {"llvmpipe", "softpipe", "SWR",
                                                        "SwiftShader", "Software Rasterizer"};
  const bool isSoftware = std::any_of(software.begin(), software.end(), [&](std::string_view name) {
    return renderer.find(name) != std::string_view::npos;
  });
  return isSoftware ? FrameClock::wall : FrameClock::query;
}

std::string_view frameClockName(FrameClock clock) {
  return clock == FrameClock::wall ? "wall clock" : "GL timer queries";
}

double medianFrameMilliseconds(const std::function<void()>& draw, int frames, FrameClock clock) {
  constexpr double enoughMilliseconds = 300;
  const gl::Query query = gl::makeTimeQuery();
  std::vector<double> milliseconds;
  double total = 0;
  for (int i = 0; i <= frames; ++i) {
    const double elapsed =
        clock == FrameClock::wall ? wallMilliseconds(draw) : queryMilliseconds(draw, query);
    if (i == 0) continue;  // warms up
    milliseconds.push_back(elapsed);
    total += elapsed;
    if (total > enoughMilliseconds) break;
  }
  throwOnGlError("timing a frame");
  const auto middle = milliseconds.begin() + static_cast<std::ptrdiff_t>(milliseconds.size() / 2);
  std::nth_element(milliseconds.begin(), middle, milliseconds.end());
  return *middle;
}

}  // namespace gnomon
