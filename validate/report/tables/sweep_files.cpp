#include "report/tables/sweep_files.h"

#include <fmt/core.h>

#include "report/tables/cost.h"
#include "report/tables/csv_text.h"
#include "report/text/number_text.h"
#include "study/judge/study_ranking.h"

namespace gnomon {
std::string sweepCsv(const SweepRecord& sweep) {
  std::string csv = csvLine({"value", "method", "error_rate", "false_shadow", "false_light",
                             "uncertainty", "bytes", "cases", "all_cases"});
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    for (const MethodMeans& method : studyMeans(sweep.steps[i]).methods) {
      const CostRecord* cost = costOf(sweep.steps[i], method.label);
      csv += csvLine({exactText(sweep.values.at(i)), method.label, exactText(method.errorRate),
                      exactText(method.falseShadow), exactText(method.falseLight),
                      exactText(method.uncertainty),
                      cost != nullptr ? fmt::format("{}", memoryBytes(*cost)) : "",
                      std::to_string(method.cases()), std::to_string(method.caseErrors.size())});
    }
  }
  return csv;
}

}  // namespace gnomon
