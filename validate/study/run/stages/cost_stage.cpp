#include "study/run/stages/cost_stage.h"

#include <fmt/chrono.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <string>

#include "common/parallel.h"
#include "study/run/scene/cached_fields.h"

namespace gnomon::study {
namespace {

/// What is kept of a method's cost.
struct KeptCost {
  std::uint64_t polygons = 0, tableBytes = 0, heightBytes = 0;
  std::optional<double> frameMs, stillMs, texels;
  std::string day;  ///< of the measurement
};

template <typename Stream, cache::SameAs<KeptCost> T>
void fields(Stream& stream, T& cost) {
  stream(cost.polygons, cost.tableBytes, cost.heightBytes, cost.frameMs, cost.stillMs, cost.texels,
         cost.day);
}

std::string today() {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
}

std::string hostName() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

std::optional<std::size_t> firstCamera(const StudySpec& study) {
  const auto camera = std::find_if(study.views.begin(), study.views.end(), cameraOf);
  if (camera == study.views.end()) return std::nullopt;
  return static_cast<std::size_t>(camera - study.views.begin());
}

cache::ContentKey costKey(const RunScene& scene, const MethodCase& method,
                          std::optional<std::size_t> view, render::FrameLimits limits) {
  cache::KeyBuilder key("cost");
  key.add("method", method.key).add("host", hostName());
  key.add("threads", threadCount());
  auto header = static_cast<const StudyHeader&>(scene.study);
  header.frames = limits.frames;
  addSettings(key, header, Enters::costs);
  key.add("milliseconds", limits.milliseconds);
  if (view) key.add("mask", scene.keys.mask(method.key, method.base->choice, *view, 0));
  return key.key();
}

}  // namespace

render::FrameLimits frameLimits(int frames, std::size_t cases) {
  constexpr double casesOfFullTime = 5;
  const double share = std::min(1.0, casesOfFullTime / static_cast<double>(cases));
  return {frames, share * render::FrameLimits{}.milliseconds};
}

std::optional<std::size_t> CostStage::timedView(const StudySpec& study) const {
  return frames_ > 0 ? firstCamera(study) : std::nullopt;
}

std::optional<render::FrameClock> CostStage::clockOf(const StudySpec& study, std::size_t view,
                                                     std::size_t light) const {
  return light == 0 && timedView(study) == view ? std::optional(clock_) : std::nullopt;
}

CostRecord CostStage::measure(RunScene& scene, MethodCase& method) const {
  const render::FrameLimits limits = frameLimits(frames_, scene.study.sweepCases);
  const auto view = timedView(scene.study);
  const cache::ContentKey key = costKey(scene, method, view, limits);
  std::optional<KeptCost> cost = scene.cache.find<KeptCost>(key);
  const bool isKept = cost.has_value();
  if (!cost) {
    cost.emplace();
    cost->polygons = polygonsOf(scene, method);
    cost->tableBytes = tableBytes(scene, method);
    if (method.method.tables.height) cost->heightBytes = scene.heights.byteCount();
    cost->day = today();
    if (view) {
      const CompiledMethod& ready = compiled(scene, method);
      const render::FrameCosts costs = scene.clock.measure("frame times", [&](const Progress&) {
        return ready.pass->frameCosts(method.base->views[*view].view, drawingOf(scene, method, 0),
                                      ready.tables, limits, ready.frameMs, clock_,
                                      *texelCounter(scene, method));
      });
      cost->frameMs = costs.every;
      cost->stillMs = costs.still;
      cost->texels = costs.texels;
    }
    scene.cache.keep(key, *cost);
  }
  CostRecord record;
  record.method = method.spec->label;
  record.polygons = cost->polygons;
  record.tableBytes = cost->tableBytes;
  record.heightBytes = cost->heightBytes;
  record.frameMs = cost->frameMs;
  record.stillMs = cost->stillMs;
  record.texels = cost->texels;
  record.passes = method.method.passes.count();
  if (isKept && cost->frameMs) record.keptSince = cost->day;
  return record;
}

}  // namespace gnomon::study
