#include "report/tables/html_cells.h"

#include <fmt/core.h>

#include <cmath>

#include "report/text/html_text.h"
#include "report/text/number_text.h"

namespace gnomon {

std::string textCell(std::string_view text) {
  return fmt::format("<td>{}</td>", escapeHtml(text));
}

std::string numberCell(std::string_view html, std::string_view tooltip) {
  const std::string title =
      tooltip.empty() ? "" : fmt::format(" title=\"{}\"", escapeHtml(tooltip));
  return fmt::format("<td class=\"n\"{}>{}</td>", title, html);
}

std::string gateValueCell(const std::optional<double>& value, std::string_view reason) {
  return value ? numberCell(fmt::format("{:.4g}", *value), exactText(*value))
               : numberCell("undefined", reason);
}

std::string heatCell(double share, double worst, std::string_view tooltip, std::string_view mark) {
  // By the square root: beside a control that gets everything wrong, small errors still differ.
  const double shade = worst > 0 ? std::sqrt(share / worst) : 0;
  return fmt::format("<td class=\"n heat\" style=\"--heat:{:.3f}\" title=\"{}\">{}{}</td>", shade,
                     escapeHtml(tooltip), rateText(share), mark);
}

std::string headCells(std::initializer_list<std::string_view> texts,
                      std::initializer_list<std::string_view> numbers) {
  std::string cells;
  for (const auto& text : texts) cells += fmt::format("<th>{}</th>", text);
  for (const auto& number : numbers) cells += fmt::format("<th class=\"n\">{}</th>", number);
  return cells;
}

std::string rateText(std::optional<double> share) {
  return escapeHtml(percentText(share));
}

std::string withUncertainty(std::optional<double> share, std::optional<double> uncertainty) {
  if (!uncertainty) return rateText(share);
  return fmt::format("{} <small>±&#8239;{}</small>", rateText(share), rateText(uncertainty));
}

}  // namespace gnomon
