#include "report/tables/frontier_table.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "report/tables/cost_table.h"
#include "study/judge/study_ranking.h"

namespace gnomon::report {
namespace {

bool hasChoice(const std::vector<FrontierPoint>& points) {
  std::map<std::string, std::set<double>> memories;
  for (const FrontierPoint& point : points) memories[point.name].insert(point.bytes);
  return std::any_of(memories.begin(), memories.end(),
                     [](const auto& entry) { return entry.second.size() > 1; });
}

void markEfficient(std::vector<FrontierPoint>& points) {
  double best = std::numeric_limits<double>::infinity();
  for (FrontierPoint& point : points) {
    point.efficient = point.errorRate < best;
    best = std::min(best, point.errorRate);
  }
}

}  // namespace

std::vector<FrontierPoint> frontier(const study::StudyRecord& record) {
  std::vector<FrontierPoint> points;
  for (const study::MethodMeans& method : study::studyMeans(record).methods) {
    const study::CostRecord* cost = costOf(record, method.label);
    if (cost == nullptr || !method.errorRate || !method.isInEveryCase() ||
        memoryBytes(*cost) == 0) {
      continue;
    }
    points.push_back(
        {method.label, method.name, static_cast<double>(memoryBytes(*cost)), *method.errorRate});
  }
  std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return std::pair(a.bytes, a.errorRate) < std::pair(b.bytes, b.errorRate);
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
    table.rows.push_back({{textCell(point.label), textCell(point.name), valueCell(point.bytes),
                           valueCell(point.errorRate), flagCell(point.efficient)}});
  }
  return table;
}

}  // namespace gnomon::report
