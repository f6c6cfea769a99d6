#include "cli/study_plans.h"

#include <fmt/core.h>

namespace gnomon::cli {

std::vector<study::StudyPlan> readPlans(const std::vector<std::filesystem::path>& studies,
                                        const study::StudyOptions& options) {
  std::vector<study::StudyPlan> plans;
  std::set<std::string> names;
  for (const std::filesystem::path& file : studies) {
    plans.push_back(study::readStudyPlan(file, options));
    requireNewName(names, file, plans.back().name);
  }
  return plans;
}

std::vector<study::StudyPlan> readOutlines(const std::vector<std::filesystem::path>& studies,
                                           study::StudyOptions options) {
  options.isOutline = true;
  return readPlans(studies, options);
}

void requireNewName(std::set<std::string>& names, const std::filesystem::path& file,
                    const std::string& name) {
  if (names.insert(name).second) return;
  throw InputError(fmt::format("{}: study.name: \"{}\" is the name of another study of this run",
                               file.string(), name));
}

bool isStep(const study::StudySpec& study) {
  return study.name.find('/') != std::string::npos;
}

std::string placeOf(const study::StudySpec& study) {
  return isStep(study) ? fmt::format("{}: {}", study.file.string(), study.name)
                       : study.file.string();
}

}  // namespace gnomon::cli
