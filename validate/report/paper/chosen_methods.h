#pragma once

#include <string>
#include <vector>

#include "study/judge/suite/suite_statistics.h"
#include "study/record/record.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// What plots are made of, of some methods alone; without pictures. All methods where `labels`
/// holds none of them.
study::StudyRecord withMethods(const study::StudyRecord& record,
                               const std::vector<std::string>& labels);
study::SweepRecord withMethods(const study::SweepRecord& sweep,
                               const std::vector<std::string>& labels);
study::SuiteStatistics withMethods(study::SuiteStatistics statistics,
                                   const std::vector<std::string>& labels);

}  // namespace gnomon::report
