#include "cli/study_plans.h"

#include <fmt/core.h>

namespace gnomon {

std::vector<StudyPlan> readPlans(const std::vector<std::filesystem::path>& studies,
                                 const StudyOptions& options) {
  std::vector<StudyPlan> plans;
  std::set<std::string> names;
  for (const std::filesystem::path& file : studies) {
    plans.push_back(readStudyPlan(file, options));
    requireNewName(names, file, plans.back().name);
  }
  return plans;
}

std::vector<StudyPlan> readOutlines(const std::vector<std::filesystem::path>& studies,
                                    StudyOptions options) {
  options.isOutline = true;
  return readPlans(studies, options);
}

void requireNewName(std::set<std::string>& names, const std::filesystem::path& file,
                    const std::string& name) {
  if (names.insert(name).second) return;
  throw InputError(fmt::format("{}: study.name: \"{}\" is the name of another study of this run",
                               file.string(), name));
}

bool isStep(const StudySpec& study) {
  return study.name.find('/') != std::string::npos;
}

std::string placeOf(const StudySpec& study) {
  return isStep(study) ? fmt::format("{}: {}", study.file.string(), study.name)
                       : study.file.string();
}

}  // namespace gnomon
