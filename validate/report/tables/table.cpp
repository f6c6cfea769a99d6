#include "report/tables/table.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "common/error.h"
#include "common/system/memory.h"
#include "report/text/confidence_text.h"
#include "report/text/number_text.h"

namespace gnomon::report {
namespace {

std::string valueText(Quantity quantity, double value) {
  switch (quantity) {
    case Quantity::percent:
      return percentText(value);
    case Quantity::signedPercent:
      return signedPercent(value);
    case Quantity::correlation:
      return correlationText(value);
    case Quantity::ratio:
      return ratioText(value);
    case Quantity::times:
      return ratioText(value) + "×";
    case Quantity::count:
      return groupedText(static_cast<std::uint64_t>(requireFinite(value, "count")));
    case Quantity::bytes:
      return formatBytes(requireFinite(value, "bytes"));
    case Quantity::megabytes:
      return fmt::format("{:.2f}", requireFinite(value, "bytes") / 1e6);
    case Quantity::decimals:
      return fmt::format("{:.2f}", requireFinite(value, "value"));
    default:
      return exactText(value);
  }
}

}  // namespace

Cell textCell(std::string text, std::string about) {
  return {.text = std::move(text), .about = std::move(about)};
}

Cell valueCell(std::optional<double> value, std::string about) {
  return {.value = value, .about = std::move(about)};
}

Cell countCell(std::size_t count) {
  return {.value = static_cast<double>(count)};
}

Cell flagCell(bool flag) {
  return {.value = flag ? 1 : 0};
}

Cell intervalCell(const std::optional<compare::Interval>& interval, std::string about) {
  return {.interval = interval, .about = std::move(about)};
}

Cell metricCell(const compare::Metric& metric) {
  return {.value = metric.value, .about = std::string(metric.reason)};
}

Cell heatCell(double share, double worst, std::string about) {
  Cell cell = valueCell(share, std::move(about));
  // By the square root: beside a control that gets everything wrong, small errors still differ.
  cell.heat = worst > 0 ? std::sqrt(share / worst) : 0;
  return cell;
}

bool isText(Quantity quantity) {
  return quantity == Quantity::name || quantity == Quantity::text || quantity == Quantity::code ||
         quantity == Quantity::rank;
}

std::string cellText(Quantity quantity, const Cell& cell) {
  if (cell.text) return *cell.text;
  if (quantity == Quantity::interval) return intervalText(cell.interval);
  return cell.value ? valueText(quantity, *cell.value) : "–";
}

std::string heading(const Column& column) {
  return column.unit.empty() ? column.name : column.name + ", " + column.unit;
}

std::string nameOf(const Table& table, const Row& row) {
  for (std::size_t i = 0; i < table.columns.size() && i < row.cells.size(); ++i) {
    if (table.columns[i].quantity == Quantity::name) return row.cells[i].text.value_or("");
  }
  return "";
}

std::vector<std::size_t> columnsFor(const Table& table, Readers reader) {
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if ((table.columns[i].readers & reader) != 0) columns.push_back(i);
  }
  for (const Row& row : table.rows) {
    if (row.cells.size() == table.columns.size()) continue;
    throw InternalError(fmt::format("table {}: a row of {} cells found, {} expected", table.kind,
                                    row.cells.size(), table.columns.size()));
  }
  return columns;
}

}  // namespace gnomon::report
