#pragma once

#include <span>
#include <string>

#include "study/judge/study_ranking.h"

namespace gnomon {

/// The ranking over all studies of a run for the terminal, at most 100 columns wide: one row a
/// method with its mean and worst error rate in percent, the study it is worst on, in how many it
/// was measured, and the truth's mean uncertainty. A method that
/// is not distinguishable from the best says why. Methods that are not in every study stand below,
/// without a rank, each beside what the best one reaches on the same studies.
/// @param colours  as `resultTable` takes it
std::string rankingOverStudies(std::span<const StudyMeans> studies, bool colours);

}  // namespace gnomon
