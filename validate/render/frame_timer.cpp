#include "render/frame_timer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <vector>

#include "common/lists.h"
#include "render/gl_context.h"
#include "render/gl_objects.h"

namespace gnomon::render {
namespace {

double wallMilliseconds(const std::function<void()>& draw) {
  using Clock = std::chrono::steady_clock;
  glFinish();
  const Clock::time_point start = Clock::now();
  draw();
  glFinish();
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double queryMilliseconds(const std::function<void()>& draw) {
  const gl::Query query = gl::makeTimeQuery();
  glFinish();
  glBeginQuery(GL_TIME_ELAPSED, query.name());
  draw();
  glEndQuery(GL_TIME_ELAPSED);
  GLuint64 nanoseconds = 0;
  glGetQueryObjectui64v(query.name(), GL_QUERY_RESULT, &nanoseconds);  // waits for the result
  return static_cast<double>(nanoseconds) * 1e-6;
}

/// The largest k for which the median lies between the k-th smallest and the k-th largest of so
/// many times with at least 95 %: below the former, as above the latter, it does with the
/// probability that a fair coin shows heads less than k times. 0 where there are too few.
std::size_t rankAroundMedian(std::size_t times) {
  constexpr double tail = 0.025;
  double ways = 1;  // to choose `heads` of the times
  double below = 0;
  for (std::size_t heads = 0; heads < times; ++heads) {
    below += ways;
    if (std::ldexp(below, -static_cast<int>(times)) > tail) return heads;
    ways *= static_cast<double>(times - heads) / static_cast<double>(heads + 1);
  }
  return 0;
}

bool isMedianKnown(const std::vector<double>& sorted) {
  constexpr std::size_t fewest = 9;
  constexpr double width = 0.02;
  if (sorted.size() < fewest) return false;
  const std::size_t rank = rankAroundMedian(sorted.size());
  return sorted[sorted.size() - rank] - sorted[rank - 1] <= width * quantile(sorted, 0.5);
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

double medianMilliseconds(const std::function<double()>& frame, FrameLimits limits,
                          const EarlierFrames& earlier) {
  std::vector<double> sorted;
  double total = 0;
  if (!earlier.isWarm) (void)frame();
  for (int i = 0; i < limits.frames; ++i) {
    const double elapsed = i == 0 && earlier.milliseconds ? *earlier.milliseconds : frame();
    sorted.insert(std::upper_bound(sorted.begin(), sorted.end(), elapsed), elapsed);
    total += elapsed;
    // Half of another would come before the end, half after it.
    if (total + elapsed / 2 > limits.milliseconds || isMedianKnown(sorted)) break;
  }
  return quantile(sorted, 0.5);
}

double medianFrameMilliseconds(const std::function<void()>& draw, FrameLimits limits,
                               const EarlierFrames& earlier, FrameClock clock) {
  return medianMilliseconds([&] { return frameMilliseconds(draw, clock); }, limits, earlier);
}

double frameMilliseconds(const std::function<void()>& draw, FrameClock clock) {
  const double elapsed =
      clock == FrameClock::wall ? wallMilliseconds(draw) : queryMilliseconds(draw);
  throwOnGlError("timing a frame");
  return elapsed;
}

}  // namespace gnomon::render
