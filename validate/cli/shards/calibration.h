#pragma once

#include <string>

#include "cache/cache.h"
#include "cli/commands/run_command.h"
#include "study/record/record.h"
#include "study/spec/study_work.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

/// How long a case takes on this machine and how much memory, by one case that was measured.
struct Calibration {
  study::WorkSpeed speed;
  double heldBytes = 0;         ///< by the process before it measures a case, OpenGL included
  double bytesPerTriangle = 0;  ///< micro-mesh and hierarchy
  double bytesPerRay = 0;       ///< all else that a case holds
  std::string name;             ///< of the case
  double seconds = 0;           ///< that it took, by the clock
  int threads = 1;
  std::string day;      ///< of the measurement, "2026-11-23"
  bool isKept = false;  ///< an earlier call measured it
};

/// Expected peak of a process that runs the case.
double expectedBytes(const study::StudyWork& work, const Calibration& calibration);

/// What one case tells, as it was measured.
/// @param timings  of its stages
/// @param seconds  by the clock, with all that no stage has: what is left over is the case's start
study::WorkSpeed speedOf(const study::StudyWork& work,
                         const std::vector<study::TimingRecord>& timings, double seconds);

/// The speed by one case, with all that a run of it writes, in a folder of its own that goes again;
/// or by the cache, where an earlier call has measured the same case on this machine with as many
/// threads.
Calibration calibrate(const study::StudyPlan& plan, const study::StudySpec& step,
                      const RunRequest& request, cache::Cache& cache);

}  // namespace gnomon::cli
