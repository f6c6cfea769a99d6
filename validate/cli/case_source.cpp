#include "cli/case_source.h"

#include <fmt/core.h>

#include "cli/study_plans.h"
#include "report/folder_writer.h"
#include "study/judge/radius_check.h"
#include "study/run/method_trial.h"
#include "study/run/run_study.h"

namespace gnomon {

/// Does work that takes a StageProgress: that of the request, or a line on the terminal.
template <typename Work>
StudyRecord MeasuredCases::shown(const StudySpec& study, const Work& work) {
  StageProgress progress = request_.progress;
  if (!progress) {
    progress = [this](std::string_view stage, double share) { line_.update(stage, share); };
  }
  store_.expectCases(isStep(study) || request_.varyRadius);
  StudyRecord record = inStudy(study, [&] { return work(progress); });
  line_.clear();
  return record;
}

void MeasuredCases::prepare(const StudySpec& study) {
  inStudy(study, [&] { tryMethods(study, gl_, cache_); });
}

StudyRecord MeasuredCases::measure(const StudySpec& study, RunFolder& folder) {
  line_.beginCase(study.name);
  FolderWriter writer(folder);
  return shown(study, [&](const StageProgress& progress) {
    return runStudy(study, gl_, writer, cache_, store_, progress);
  });
}

StudyRecord MeasuredCases::measureFigures(const StudySpec& study) {
  line_.beginCase(study.name);
  return shown(study, [&](const StageProgress& progress) {
    return runStudyFigures(study, gl_, cache_, store_, progress);
  });
}

StudyRecord MeasuredCases::measureAt(const StudySpec& study, double radiusFactor) {
  line_.setTitle(fmt::format("{}, radius × {}", study.name, radiusFactor));
  return shown(study, [&](const StageProgress& progress) {
    return measureStudy(withRadiusTimes(study, radiusFactor), gl_, cache_, store_, progress);
  });
}

}  // namespace gnomon
