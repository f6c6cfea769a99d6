#include "cli/case_source.h"

#include <fmt/core.h>

#include <memory>
#include <utility>

#include "cli/study_plans.h"
#include "cli/terminal_progress.h"
#include "report/folder_writer.h"
#include "study/judge/radius_check.h"
#include "study/run/method_trial.h"
#include "study/run/run_study.h"

namespace gnomon {
namespace {

/// Where a run's progress goes: to who asked for it, or to the terminal.
StageProgress progressOf(const RunRequest& request, std::string title) {
  if (request.progress) return request.progress;
  return [line = std::make_shared<TerminalProgress>(std::move(title))](
             std::string_view stage, double share) { line->update(stage, share); };
}

}  // namespace

void MeasuredCases::prepare(const StudySpec& study) {
  inStudy(study, [&] { tryMethods(study, gl_, cache_); });
}

StudyRecord MeasuredCases::measure(const StudySpec& study, RunFolder& folder) {
  FolderWriter writer(folder);
  return inStudy(study, [&] {
    return runStudy(study, gl_, writer, cache_, progressOf(request_, study.name));
  });
}

StudyRecord MeasuredCases::measureAt(const StudySpec& study, double radiusFactor) {
  return inStudy(study, [&] {
    return measureStudy(
        withRadiusTimes(study, radiusFactor), gl_, cache_,
        progressOf(request_, fmt::format("{}, radius × {}", study.name, radiusFactor)));
  });
}

}  // namespace gnomon
