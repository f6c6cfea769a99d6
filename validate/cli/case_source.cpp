#include "cli/case_source.h"

#include <fmt/core.h>

#include "cli/study_plans.h"
#include "common/parallel.h"
#include "report/folder_writer.h"
#include "study/run/method_trial.h"
#include "study/run/run_study.h"

namespace gnomon::cli {

/// Does work that takes a StageProgress: that of the request, or a line on the terminal.
template <typename Work>
study::StudyRecord MeasuredCases::shown(const study::StudySpec& study, const Work& work) {
  study::StageProgress progress = request_.progress;
  if (!progress) {
    progress = [this](std::string_view stage, double share) { line_.update(stage, share); };
  }
  store_.expectCases(isStep(study));
  study::StudyRecord record = inStudy(study, [&] { return work(progress); });
  line_.clear();
  return record;
}

void MeasuredCases::prepare(const study::StudySpec& study) {
  inStudy(study, [&] { study::tryMethods(study, gl_, cache_); });
}

study::StudyRecord MeasuredCases::measure(const study::StudySpec& study,
                                          report::RunFolder& folder) {
  line_.beginCase(study.name);
  report::FolderWriter writer(folder, [this] { reports_.wait(); });
  return shown(study, [&](const study::StageProgress& progress) {
    return study::runStudy(study, gl_, writer, cache_, store_, progress);
  });
}

study::StudyRecord MeasuredCases::measureFigures(const study::StudySpec& study) {
  line_.beginCase(study.name);
  return shown(study, [&](const study::StageProgress& progress) {
    return study::runStudyFigures(study, gl_, cache_, store_, progress);
  });
}

void MeasuredCases::report(const std::function<void()>& write) {
  if (threadCount() > 1) return reports_.start(write);
  write();
}

}  // namespace gnomon::cli
