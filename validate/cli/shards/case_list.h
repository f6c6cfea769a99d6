#pragma once

#include <cstddef>
#include <vector>

#include "cli/shards/shard.h"
#include "study/spec/sweep/sweep.h"

namespace gnomon::cli {

/// A case of a command: a study, or a step of a sweep.
struct CasePlace {
  std::size_t plan = 0;
  std::size_t step = 0;
};

/// All cases, in the order in which a run without shards measures them.
std::vector<CasePlace> allCases(const std::vector<study::StudyPlan>& plans);

/// Those that a shard measures: neighbours of the list, by their cost as the studies alone tell it
/// (standardCost, dividedByCost).
std::vector<CasePlace> casesOf(const std::vector<study::StudyPlan>& plans, const Shard& shard);

/// All shards' cases, the first shard's first.
std::vector<std::vector<CasePlace>> casesOfShards(const std::vector<study::StudyPlan>& plans,
                                                  int count);

}  // namespace gnomon::cli
