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

/// Where the figures of a run's cases come from, a case being a study or a step of a sweep: from
/// measuring it, or from what shards have kept.
class CaseSource {
 public:
  CaseSource() = default;
  CaseSource(const CaseSource&) = delete;
  CaseSource& operator=(const CaseSource&) = delete;
  virtual ~CaseSource() = default;

  /// Called for all cases of a plan before the first of them is asked for.
  virtual void prepare(const study::StudySpec& study) = 0;
  /// What was found, no claim judged yet; its pictures are written to the folder.
  virtual study::StudyRecord measure(const study::StudySpec& study, report::RunFolder& folder) = 0;
  /// The figures alone, without pictures and frame times.
  virtual study::StudyRecord measureFigures(const study::StudySpec& study) = 0;
  /// Writes a case's report: perhaps while the next case is measured.
  /// @param write  what it refers to stays until the reports are finished
  virtual void report(const std::function<void()>& write) { write(); }
  /// Waits for the reports.
  /// @throws what the last of them threw; what an earlier one threw leaves `report`
  virtual void finishReports() {}
};

/// Measures, and tells how far it is on the terminal, or whom the request names.
class MeasuredCases final : public CaseSource {
 public:
  /// All outlive the source.
  /// @param count  of the cases that will be measured
  MeasuredCases(const render::GlContext& gl, const RunRequest& request, cache::Cache& cache,
                std::size_t count)
      : gl_(gl), request_(request), cache_(cache), line_("", count) {}

  void prepare(const study::StudySpec& study) override;
  study::StudyRecord measure(const study::StudySpec& study, report::RunFolder& folder) override;
  study::StudyRecord measureFigures(const study::StudySpec& study) override;
  void report(const std::function<void()>& write) override;
  void finishReports() override { reports_.finish(); }

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
