#pragma once

#include <set>
#include <string>
#include <vector>

#include "study/spec/study_file.h"

namespace gnomon::study {

/// Whether a study's name may hold a character, since it names a folder: letters, digits, `-`, `_`,
/// `.`.
bool isNameCharacter(char c);

/// Names as parts of file names: at most some sixty letters, digits, dots and dashes, distinct for
/// distinct indices.
/// @param taken  parts that none of them may become
std::vector<std::string> fileNames(const std::vector<std::string>& names,
                                   std::set<std::string> taken = {});

/// Parts of the names of a run's pictures, in the study's order.
struct CaseNames {
  std::vector<std::string> views, lights, methods;
};
CaseNames caseNames(const StudySpec& study);

}  // namespace gnomon::study
