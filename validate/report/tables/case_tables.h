#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/tables/table.h"
#include "study/record/cases.h"
#include "study/record/gate.h"
#include "study/record/record.h"

namespace gnomon::report {

/// The main metrics of each method over all samples, case by case; ≈ marks what is not
/// distinguishable from the best of its case.
/// @param cases  of one view; of several, each row names its light
Table caseTable(const study::StudyRecord& record, std::span<const study::Case> cases);

/// Error rates of one case, methods × regions, tinted by size. Without rows if there is no region
/// but "all".
Table regionTable(const study::StudyRecord& record, const study::Case& which);

/// All results for programs, a row a method × light × view × answer × region, in the record's
/// order: study, method, light, view, answer, region, samples, tp, fp, fn, tn, then every metric by
/// name.
Table metricsTable(const study::StudyRecord& record);

/// The bins for programs, a row each, in the record's order: study, method, view, light, axis, low,
/// high (none where the bin has no end), samples, tp, fp, fn, tn, error_rate, false_shadow,
/// false_light.
Table binsTable(const study::StudyRecord& record);

/// Of each axis of samples and each view, all lights together: every method's error in each bin,
/// tinted by size. None of one bin alone.
std::vector<Table> binErrorTables(const study::StudyRecord& record);

/// The error of every method in every case: a row a case.
/// @param methods  labels, a column each
/// @param links    where each case leads to
Table caseErrorsTable(const study::StudyRecord& record, const std::vector<std::string>& methods,
                      std::span<const study::Case> cases, std::span<const std::string> links);

/// Gates, each with its verdict, what it judges, the value and the limit; references also with
/// their committed value and the change.
/// @param judgements  one or more, of one origin
Table gateTable(std::span<const study::Judgement> judgements);

/// Tables of a run itself.

/// The truth's uncertainty in each view under each light.
Table flipTable(const std::vector<study::UncertaintyRecord>& flips);
/// The time of each stage, seconds.
Table timingTable(const std::vector<study::TimingRecord>& timings);
/// Each file that the run was made of.
Table inputTable(const std::vector<study::InputRecord>& inputs);

}  // namespace gnomon::report
