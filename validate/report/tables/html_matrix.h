#pragma once

#include <span>
#include <string>
#include <vector>

#include "study/judge/study_ranking.h"

namespace gnomon {

/// Error rates in percent as a table of methods × studies (or steps of a sweep), shaded by size,
/// with the truth's uncertainty as its last row. A mean over fewer cases than others of its column
/// have has a star.
/// @param labels  of the methods, a row each
/// @param heads   the heading of each study, as HTML
std::string errorMatrix(const std::vector<std::string>& labels, std::span<const StudyMeans> studies,
                        const std::vector<std::string>& heads);

/// " * mean over fewer views and lights …", the star's meaning; empty where no cell has one.
std::string fewerCasesNote(std::span<const StudyMeans> studies);

}  // namespace gnomon
