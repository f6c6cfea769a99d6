#include "report/plotted_methods.h"

#include <algorithm>
#include <array>

#include "common/lists.h"
#include "report/tables/cost_table.h"

namespace gnomon::report {
namespace {

std::string nameOf(std::span<const study::MethodMeans> methods, const std::string& label) {
  for (const study::MethodMeans& method : methods) {
    if (method.label == label) return method.name;
  }
  return label;
}

/// An entry of a ranking.
struct Ranked {
  std::string label, name;
};

/// Those of the chosen and of the first, in the order of the ranking.
std::vector<std::string> choose(const std::vector<Ranked>& ranked,
                                std::vector<std::string> chosen) {
  std::vector<std::string> names;
  for (const Ranked& entry : ranked) {
    if (contains(chosen, entry.label)) appendOnce(names, entry.name);
  }
  const std::size_t given = chosen.size();
  for (const bool isNew : {true, false}) {
    for (const Ranked& entry : ranked) {
      if (chosen.size() >= std::max(mostPlotted, given)) break;
      if (isNew && contains(names, entry.name)) continue;
      appendOnce(chosen, entry.label);
      appendOnce(names, entry.name);
    }
  }
  std::vector<std::string> ordered;
  for (const Ranked& entry : ranked) {
    if (contains(chosen, entry.label)) ordered.push_back(entry.label);
  }
  return ordered;
}

/// The labels that a report has a method of.
template <typename Method>
std::vector<std::string> amongOwn(const std::vector<std::string>& labels,
                                  const std::vector<Method>& methods) {
  std::vector<std::string> own;
  for (const std::string& label : labels) {
    const bool isOwn = std::any_of(methods.begin(), methods.end(),
                                   [&](const Method& method) { return method.label == label; });
    if (isOwn) own.push_back(label);
  }
  return own;
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

std::optional<std::string> bestMethod(const std::vector<study::RankedMethod>& ranked) {
  for (const study::RankedMethod& method : ranked) {
    if (method.rank && method.means.name != controlMethod) return method.label;
  }
  return std::nullopt;
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

std::vector<std::string> plottedMethods(const study::StudyMeans& study,
                                        const std::vector<std::string>& wanted) {
  if (auto own = amongOwn(wanted, study.methods); !own.empty()) return own;
  std::vector<Ranked> ranked;
  for (const study::RankedOverStudies& method : study::rankOverStudies(std::array{study})) {
    ranked.push_back({method.label, nameOf(study.methods, method.label)});
  }
  std::vector<std::string> chosen;
  for (const auto& label :
       {labelOf(study.methods, costReference), claimedMethod(study.methods, study.claims)}) {
    if (label) appendOnce(chosen, *label);
  }
  return choose(ranked, std::move(chosen));
}

std::vector<std::string> plottedMethods(const study::SuiteStatistics& statistics,
                                        const std::vector<std::string>& wanted) {
  if (auto own = amongOwn(wanted, statistics.methods); !own.empty()) return own;
  std::vector<Ranked> ranked;
  std::vector<std::string> chosen;
  for (const study::SuiteMethod& method : statistics.methods) {
    ranked.push_back({method.label, method.names.empty() ? method.label : method.names.front()});
    if (chosen.empty() && contains(method.names, costReference)) chosen.push_back(method.label);
  }
  return choose(ranked, std::move(chosen));
}

}  // namespace gnomon::report
