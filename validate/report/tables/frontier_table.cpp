#include "report/tables/frontier_table.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "report/tables/cost_table.h"
#include "study/judge/study_ranking.h"

namespace gnomon::report {
namespace {

bool hasChoice(const std::vector<FrontierPoint>& points) {
  std::map<std::string, std::set<double>> prices;
  for (const FrontierPoint& point : points) prices[point.name].insert(point.price);
  return std::any_of(prices.begin(), prices.end(),
                     [](const auto& entry) { return entry.second.size() > 1; });
}

void markEfficient(std::vector<FrontierPoint>& points) {
  double best = std::numeric_limits<double>::infinity();
  for (FrontierPoint& point : points) {
    point.efficient = point.errorRate < best;
    best = std::min(best, point.errorRate);
  }
}

/// None where the method has no such cost.
std::optional<double> priceOf(const study::CostRecord& cost, Price price) {
  const double value =
      price == Price::memory ? static_cast<double>(memoryBytes(cost)) : cost.frameMs.value_or(0);
  return value > 0 ? std::optional(value) : std::nullopt;
}

}  // namespace

std::vector<FrontierPoint> frontier(const study::StudyRecord& record, Price price) {
  std::vector<FrontierPoint> points;
  for (const study::MethodMeans& method : study::studyMeans(record).methods) {
    const study::CostRecord* cost = costOf(record, method.label);
    if (cost == nullptr || !method.errorRate || !method.isInEveryCase()) continue;
    const auto paid = priceOf(*cost, price);
    if (paid) points.push_back({method.label, method.name, *paid, *method.errorRate});
  }
  std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return std::pair(a.price, a.errorRate) < std::pair(b.price, b.errorRate);
  });
  markEfficient(points);
  return hasChoice(points) ? points : std::vector<FrontierPoint>{};
}

Table frontierTable(const std::vector<FrontierPoint>& points) {
  Table table{.kind = "frontier",
              .columns = {{"method"},
                          {"shader"},
                          {"bytes", "", Quantity::exact},
                          {"error_rate", "", Quantity::exact},
                          {"efficient", "", Quantity::exact}}};
  for (const FrontierPoint& point : points) {
    table.rows.push_back({{textCell(point.label), textCell(point.name), valueCell(point.price),
                           valueCell(point.errorRate), flagCell(point.efficient)}});
  }
  return table;
}

}  // namespace gnomon::report
