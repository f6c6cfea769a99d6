#pragma once

#include <span>
#include <string>
#include <vector>

#include "study/judge/ranking.h"
#include "study/record/cases.h"
#include "study/record/record.h"

namespace gnomon {

/// The tables of the report page, as HTML. Rates are percent of the samples; where one is
/// undefined, its cell is "–" and the reason its tooltip.

/// Methods from best to worst over all cases, each error with the truth's uncertainty and a bar of
/// its two parts, and which methods it cannot be told from.
std::string rankingTable(const std::vector<RankedMethod>& ranked);

/// All main metrics of one case, over all its samples.
std::string caseTable(const StudyRecord& record, const Case& which);

/// Error rates of one case, methods × regions, shaded by size. Empty if there is no region but
/// "all".
std::string regionTable(const StudyRecord& record, const Case& which);

std::string thresholdTable(std::span<const Judgement> thresholds);
/// Memory, triangles, passes and frame time of each method, and that time's ratio to max-forsyth's.
std::string costTable(const StudyRecord& record);
std::string flipTable(const std::vector<UncertaintyRecord>& flips);
/// Step, micro-triangles and flip rate of each level.
std::string refinementTable(const std::vector<RefinementRecord>& levels);
std::string timingTable(const std::vector<TimingRecord>& timings);

}  // namespace gnomon
