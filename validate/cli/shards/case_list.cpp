#include "cli/shards/case_list.h"

#include <cstdint>
#include <utility>

#include "cli/shards/division.h"
#include "study/spec/study_work.h"

namespace gnomon::cli {

std::vector<CasePlace> allCases(const std::vector<study::StudyPlan>& plans) {
  std::vector<CasePlace> places;
  for (std::size_t p = 0; p < plans.size(); ++p) {
    for (std::size_t s = 0; s < plans[p].steps.size(); ++s) places.push_back({p, s});
  }
  return places;
}

std::vector<std::vector<CasePlace>> casesOfShards(const std::vector<study::StudyPlan>& plans,
                                                  int count) {
  const std::vector<CasePlace> all = allCases(plans);
  std::vector<std::uint64_t> costs;
  costs.reserve(all.size());
  for (const CasePlace& place : all) {
    costs.push_back(study::standardCost(plans[place.plan].steps[place.step]));
  }
  const std::vector<std::size_t> begins = dividedByCost(costs, count);
  std::vector<std::vector<CasePlace>> parts;
  for (std::size_t i = 0; i + 1 < begins.size(); ++i) {
    parts.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(begins[i]),
                       all.begin() + static_cast<std::ptrdiff_t>(begins[i + 1]));
  }
  return parts;
}

std::vector<CasePlace> casesOf(const std::vector<study::StudyPlan>& plans, const Shard& shard) {
  return std::move(casesOfShards(plans, shard.count).at(static_cast<std::size_t>(shard.index - 1)));
}

}  // namespace gnomon::cli
