#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/progress.h"
#include "render/gl_context.h"
#include "study/record/record.h"
#include "study/spec/study_file.h"

namespace gnomon::study {

/// The processor's name as the kernel knows it, or "unknown".
std::string processorName();

/// What the processor can do, as the kernel lists it: "fpu … avx2 … avx512f …"; empty where it does
/// not tell.
std::string processorFeatures();

/// Of the program, "0.1.0".
std::string programVersion();

/// Of the sources that the program was built from, or empty outside a checkout.
std::string programCommit();

/// Versions and hardware, for whoever gets other figures.
EnvironmentRecord describeEnvironment(const render::GlContext& gl);

/// The names of the views whose lengths are in texels.
std::vector<std::string> atlasViewsOf(const StudySpec& study);

/// A record that says which study was measured where, and nothing that was found.
StudyRecord startRecord(const StudySpec& study, const render::GlContext& gl);

/// Told which stage a run is in and what share of that stage is done, 0 to 1.
using StageProgress = std::function<void(std::string_view stage, double share)>;

/// Measures the stages of a run by the wall clock. A stage that runs more than once adds up.
class StageClock {
 public:
  explicit StageClock(StageProgress progress) : progress_(std::move(progress)) {}

  /// Runs `work(progress)` as part of a stage and returns what it returns.
  template <typename Work>
  decltype(auto) measure(std::string_view stage, const Work& work) {
    const Span span(*this, stage);
    return work(Progress([this, stage](double share) {
      if (progress_) progress_(stage, share);
    }));
  }

  [[nodiscard]] const std::vector<TimingRecord>& timings() const { return timings_; }

 private:
  using Clock = std::chrono::steady_clock;

  class Span {
   public:
    Span(StageClock& clock, std::string_view stage)
        : clock_(clock), stage_(stage), start_(Clock::now()) {
      if (clock_.progress_) clock_.progress_(stage_, 0);
    }
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;
    ~Span() { clock_.add(stage_, std::chrono::duration<double>(Clock::now() - start_).count()); }

   private:
    StageClock& clock_;
    std::string_view stage_;
    Clock::time_point start_;
  };

  void add(std::string_view stage, double seconds) {
    for (TimingRecord& timing : timings_) {
      if (timing.stage == stage) {
        timing.seconds += seconds;
        return;
      }
    }
    timings_.push_back({std::string(stage), seconds});
  }

  StageProgress progress_;
  std::vector<TimingRecord> timings_;
};

}  // namespace gnomon::study
