#include "report/highlights.h"

#include <array>

#include "common/lists.h"
#include "report/tables/cost_table.h"
#include "study/judge/study_ranking.h"

namespace gnomon::report {
namespace {

std::string nameOf(std::span<const study::MethodMeans> methods, const std::string& label) {
  for (const study::MethodMeans& method : methods) {
    if (method.label == label) return method.name;
  }
  return label;
}

/// Those of the chosen and of the first, in the order of the ranking.
std::vector<std::string> choose(const std::vector<std::string>& ranked,
                                std::vector<std::string> chosen) {
  for (const std::string& label : ranked) {
    if (chosen.size() < mostHighlights) appendOnce(chosen, label);
  }
  std::vector<std::string> ordered;
  for (const std::string& label : ranked) {
    if (contains(chosen, label)) ordered.push_back(label);
  }
  return ordered;
}

}  // namespace

std::optional<std::string> labelOf(std::span<const study::MethodMeans> methods,
                                   std::string_view name) {
  std::optional<std::string> first;
  for (const study::MethodMeans& method : methods) {
    if (method.name != name) continue;
    if (method.label == name) return method.label;
    if (!first) first = method.label;
  }
  return first;
}

std::optional<std::string> claimedMethod(std::span<const study::MethodMeans> methods,
                                         std::span<const study::ClaimRecord> claims) {
  for (const study::ClaimRecord& claim : claims) {
    for (const std::string& label : claim.methods) {
      const std::string name = nameOf(methods, label);
      if (name != costReference && name != controlMethod) return label;
    }
  }
  return std::nullopt;
}

std::vector<std::string> highlights(const study::StudyMeans& study) {
  std::vector<std::string> ranked;
  for (const study::RankedOverStudies& method : study::rankOverStudies(std::array{study})) {
    ranked.push_back(method.label);
  }
  std::vector<std::string> chosen;
  for (const auto& label :
       {labelOf(study.methods, costReference), claimedMethod(study.methods, study.claims)}) {
    if (label) appendOnce(chosen, *label);
  }
  return choose(ranked, std::move(chosen));
}

std::vector<std::string> highlights(const study::SuiteStatistics& statistics) {
  std::vector<std::string> ranked;
  std::vector<std::string> chosen;
  for (const study::SuiteMethod& method : statistics.methods) {
    ranked.push_back(method.label);
    if (chosen.empty() && contains(method.names, costReference)) chosen.push_back(method.label);
  }
  return choose(ranked, std::move(chosen));
}

}  // namespace gnomon::report
