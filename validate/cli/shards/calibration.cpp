#include "cli/shards/calibration.h"

#include <fmt/chrono.h>
#include <fmt/core.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "cli/case_source.h"
#include "cli/plan_runs.h"
#include "cli/shards/kept_case.h"
#include "common/error.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "report/plots/gnuplot.h"

/// Where the streams look it up.
namespace gnomon::cache {

template <typename Stream, SameAs<study::WorkSpeed> T>
void fields(Stream& stream, T& speed) {
  auto& [microTriangle, ray, frame, horizon, start] = speed;
  stream(microTriangle, ray, frame, horizon, start);
}

}  // namespace gnomon::cache

namespace gnomon::cli {
namespace fs = std::filesystem;

template <typename Stream, cache::SameAs<Calibration> T>
void fields(Stream& stream, T& calibration) {
  auto& [speed, held, perTriangle, perRay, name, seconds, threads, day, isKept] = calibration;
  stream(speed, held, perTriangle, perRay, name, seconds, threads, day, isKept);
}

namespace {

/// The part of the work that a stage's time grows with.
double study::WorkSpeed::*partOf(std::string_view stage) {
  constexpr std::array<std::string_view, 3> ofMesh = {"surface", "micro-mesh", "hierarchy"};
  constexpr std::array<std::string_view, 4> ofRays = {"samples", "truth", "displaced picture",
                                                      "bins"};
  constexpr std::array<std::string_view, 3> ofTables = {"bake", "tables", "surface horizons"};
  const auto isIn = [&](const auto& list) {
    return std::find(list.begin(), list.end(), stage) != list.end();
  };
  if (isIn(ofMesh)) return &study::WorkSpeed::microTriangle;
  if (isIn(ofTables)) return &study::WorkSpeed::horizon;
  // Half of it is a coarser mesh, half its rays; the mesh is the larger where it matters.
  if (stage == "uncertainty" || stage.starts_with("refine"))
    return &study::WorkSpeed::microTriangle;
  return isIn(ofRays) ? &study::WorkSpeed::ray : &study::WorkSpeed::frame;
}

/// A part that the case does not have tells nothing: then the standard speed holds.
double perUnit(double seconds, double units, double otherwise) {
  return units > 0 ? seconds / units : otherwise;
}

double peakBytes() {
  struct rusage usage {};
  ::getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

std::string hostName() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

std::string today() {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
}

/// A folder that goes with all that is in it.
class WorkFolder {
 public:
  WorkFolder() {
    std::string name = (fs::temp_directory_path() / "gnomon-plan-XXXXXX").string();
    const char* made = ::mkdtemp(name.data());
    if (made == nullptr) throw InputError(name + ": cannot create the folder");
    path_ = made;
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Calibration measured(const study::StudyPlan& plan, const study::StudySpec& step,
                     RunRequest request) {
  const WorkFolder folder;
  request.out = folder.path();
  cache::Cache none;
  report::askGnuplotVersion();
  const render::GlContext gl;
  requirePlots();
  MeasuredCases cases(gl, request, none, 1);
  cases.prepare(step);
  Records records;
  records.folders.claim(plan, request.out);
  records.folders.clear(request.out);
  Calibration result;
  result.heldBytes = static_cast<double>(residentMemoryBytes());
  const auto begin = std::chrono::steady_clock::now();
  runStep(plan, step, cases, request, none, records);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const study::StudyWork work = study::workOf(step);
  const study::TruthRecord& truth = records.all.front().truth;
  const auto ofMesh = static_cast<double>(truth.bvhBytes.value_or(0) + truth.meshBytes);
  result.speed = speedOf(work, records.all.front().timings, result.seconds);
  result.bytesPerTriangle = ofMesh / std::max(1.0, work.microTriangles);
  result.bytesPerRay =
      std::max(0.0, peakBytes() - result.heldBytes - ofMesh) / std::max(1.0, work.rays);
  result.name = step.name;
  result.threads = static_cast<int>(threadCount());
  result.day = today();
  return result;
}

}  // namespace

double expectedBytes(const study::StudyWork& work, const Calibration& calibration) {
  return calibration.heldBytes + work.microTriangles * calibration.bytesPerTriangle +
         work.rays * calibration.bytesPerRay;
}

study::WorkSpeed speedOf(const study::StudyWork& work,
                         const std::vector<study::TimingRecord>& timings, double seconds) {
  study::WorkSpeed sums;
  double inStages = 0;
  for (const study::TimingRecord& timing : timings) {
    sums.*partOf(timing.stage) += timing.seconds;
    inStages += timing.seconds;
  }
  const study::WorkSpeed& standard = study::standardSpeed;
  return {
      perUnit(sums.microTriangle, work.microTriangles, standard.microTriangle),
      perUnit(sums.ray, work.rays, standard.ray), perUnit(sums.frame, work.frames, standard.frame),
      perUnit(sums.horizon, work.horizons, standard.horizon), std::max(0.0, seconds - inStages)};
}

Calibration calibrate(const study::StudyPlan& plan, const study::StudySpec& step,
                      const RunRequest& request, cache::Cache& cache) {
  cache::KeyBuilder key("calibration");
  key.add("case", caseHash(step)).add("host", hostName()).add("threads", threadCount());
  if (std::optional<Calibration> kept = cache.find<Calibration>(key.key())) {
    kept->isKept = true;
    return *kept;
  }
  Calibration found = measured(plan, step, request);
  cache.keep(key.key(), found);
  return found;
}

}  // namespace gnomon::cli
