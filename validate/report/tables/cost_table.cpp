#include "report/tables/cost_table.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "report/text/number_text.h"
#include "report/text/verdict_text.h"
#include "study/judge/ranking.h"

namespace gnomon::report {

const study::CostRecord* costOf(const study::StudyRecord& record, std::string_view label) {
  const auto found =
      std::find_if(record.cost.begin(), record.cost.end(),
                   [&](const study::CostRecord& cost) { return cost.method == label; });
  return found == record.cost.end() ? nullptr : &*found;
}

std::uint64_t memoryBytes(const study::CostRecord& cost) {
  return cost.tableBytes + cost.heightBytes;
}

namespace {

/// The cost of the method of that name, of several as `frameRatio` chooses.
const study::CostRecord* costOfNamed(const study::StudyRecord& record, std::string_view name) {
  const study::CostRecord* first = nullptr;
  for (const study::MethodRecord& method : record.methods) {
    if (method.name != name) continue;
    if (method.label == name) return costOf(record, method.label);
    if (first == nullptr) first = costOf(record, method.label);
  }
  return first;
}

/// None for a time of nothing too: no ratio to it exists.
std::optional<double> timeOf(const study::CostRecord* cost) {
  if (cost == nullptr || !cost->frameMs) return std::nullopt;
  const double time = requireFinite(*cost->frameMs, "cost.frame_ms");
  return time > 0 ? std::optional(time) : std::nullopt;
}

/// A frame's time, or that it was not measured.
Cell timeCell(std::optional<double> milliseconds) {
  return milliseconds ? valueCell(milliseconds) : textCell("not timed");
}

}  // namespace

std::optional<double> frameRatio(const study::StudyRecord& record, const study::CostRecord& cost) {
  const auto time = timeOf(&cost);
  const auto reference = timeOf(costOfNamed(record, costReference));
  if (!time || !reference) return std::nullopt;
  return *time / *reference;
}

Table costTable(const study::StudyRecord& record) {
  using Q = Quantity;
  Table table{.kind = "cost",
              .columns = {{"Method", "method", Q::name},
                          {"Triangles", "polygons", Q::count},
                          {"Tables", "table_bytes", Q::bytes},
                          {"Height map", "height_bytes", Q::bytes, byAll & ~onTerminal},
                          {"Passes", "passes", Q::exact},
                          {"Texels read", "texels", Q::decimals, byAll & ~onTerminal},
                          {"Frame", "frame_ms", Q::decimals, byAll, "ms"},
                          {"Light still", "still_ms", Q::decimals, byAll, "ms"},
                          {fmt::format("To {}", costReference), "frame_ratio", Q::times}}};
  for (const study::CostRecord& cost : record.cost) {
    const auto ratio = frameRatio(record, cost);
    table.rows.push_back(
        {{textCell(cost.method), countCell(cost.polygons), countCell(cost.tableBytes),
          countCell(cost.heightBytes), valueCell(cost.passes),
          valueCell(cost.texels, cost.texels ? "" : "not counted"), timeCell(cost.frameMs),
          timeCell(cost.stillMs),
          valueCell(ratio, ratio ? "" : fmt::format("{} was not timed", costReference))}});
  }
  return table;
}

std::string publishedRates(const study::StudyRecord& record) {
  const auto flat = timeOf(costOfNamed(record, "max-forsyth"));
  const auto curved = timeOf(costOfNamed(record, "onoue-2004"));
  const auto volumes = timeOf(costOfNamed(record, "shadow-volume"));
  if (!flat || !curved || !volumes) return "";
  // Rates are the inverses of times.
  return fmt::format(
      "Onoue, Max & Nishita 2004, section 4, state equal frame rates for the flat and the "
      "curvature-aware method, and a fifth of it (0.20) for the displaced mesh with shadow "
      "volumes. Here, drawn by {}, the curvature-aware method has {:.2f} of the flat one's frame "
      "rate and shadow volumes {:.2f} of it.",
      record.environment.glRenderer, *flat / *curved, *flat / *volumes);
}

std::string keptFrames(const study::StudyRecord& record) {
  std::set<std::string> days;
  std::vector<std::string> measured;
  for (const study::CostRecord& cost : record.cost) {
    if (!cost.keptSince.empty()) days.insert(cost.keptSince);
    if (cost.keptSince.empty() && cost.frameMs) measured.push_back(cost.method);
  }
  if (days.empty()) return "";
  return fmt::format(
      "Frame times{} were measured by an earlier run on this machine ({}): nothing that they "
      "depend "
      "on has changed since. Run with --no-cache to measure them again.",
      measured.empty() ? "" : fmt::format(" but that of {}", listText(measured)),
      fmt::join(days, ", "));
}

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
