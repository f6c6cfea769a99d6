#pragma once

#include <cstddef>
#include <functional>

#include "cache/cache.h"
#include "cli/commands/run_command.h"
#include "cli/terminal_progress.h"
#include "common/work_beside.h"
#include "render/gl_context.h"
#include "report/run_folder.h"
#include "study/record/record.h"
#include "study/run/scene/scene_store.h"
#include "study/spec/study_file.h"

namespace gnomon::cli {

/// Measures the cases of a run, a case being a study or a step of a sweep, and tells how far it is
/// on the terminal, or whom the request names.
class MeasuredCases {
 public:
  /// All outlive the source.
  /// @param count  of the cases that will be measured
  MeasuredCases(const render::GlContext& gl, const RunRequest& request, cache::Cache& cache,
                std::size_t count)
      : gl_(gl), request_(request), cache_(cache), line_("", count) {}

  /// Called for all cases of a plan before the first of them is measured.
  void prepare(const study::StudySpec& study);
  /// What was found, no claim judged yet; its pictures are written to the folder.
  study::StudyRecord measure(const study::StudySpec& study, report::RunFolder& folder);
  /// The figures alone, without pictures and frame times.
  study::StudyRecord measureFigures(const study::StudySpec& study);
  /// Writes a case's report: perhaps while the next case is measured.
  /// @param write  what it refers to stays until the reports are finished
  void report(const std::function<void()>& write);
  /// Waits for the reports.
  /// @throws what the last of them threw; what an earlier one threw leaves `report`
  void finishReports() { reports_.finish(); }

 private:
  template <typename Work>
  study::StudyRecord shown(const study::StudySpec& study, const Work& work);

  const render::GlContext& gl_;
  const RunRequest& request_;
  cache::Cache& cache_;
  study::SceneStore store_;
  TerminalProgress line_;
  WorkBeside reports_;
};

}  // namespace gnomon::cli
