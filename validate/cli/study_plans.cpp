#include "cli/study_plans.h"

#include <fmt/core.h>

#include <set>

namespace gnomon {

std::vector<StudyPlan> readPlans(const std::vector<std::filesystem::path>& studies,
                                 const StudyOptions& options) {
  std::vector<StudyPlan> plans;
  std::set<std::string> names;
  for (const std::filesystem::path& file : studies) {
    plans.push_back(readStudyPlan(file, options));
    const StudyPlan& plan = plans.back();
    if (!names.insert(plan.name).second) {
      throw InputError(
          fmt::format("{}: study.name: \"{}\" is the name of another study of this run",
                      file.string(), plan.name));
    }
  }
  return plans;
}

std::string placeOf(const StudySpec& study) {
  const bool isStep = study.name.find('/') != std::string::npos;
  return isStep ? fmt::format("{}: {}", study.file.string(), study.name) : study.file.string();
}

}  // namespace gnomon
