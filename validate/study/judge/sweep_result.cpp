#include "study/judge/sweep_result.h"

#include <fmt/core.h>

#include <utility>

#include "common/error.h"
#include "study/judge/claims.h"
#include "study/spec/resolved_study.h"

namespace gnomon::study {

SweepRecord makeSweepRecord(const StudyPlan& plan, std::vector<StudyRecord> steps,
                            const std::string& command) {
  if (!plan.sweep || steps.size() != plan.sweep->cases.size()) {
    throw InternalError(
        fmt::format("sweep {}: {} records found, one a case expected", plan.name, steps.size()));
  }
  SweepRecord record{plan.name,        plan.title,
                     plan.source,      plan.steps.front().file.string(),
                     command,          studyCopyName(plan.name),
                     plan.sweep->keys, plan.sweep->cases,
                     std::move(steps), {}};
  record.claims = judgeSweepClaims(plan.steps.front().claims, record);
  return record;
}

}  // namespace gnomon::study
