#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon {

/// Cells of the report's tables, as HTML.

std::string textCell(std::string_view text);

/// A cell whose content stands at the right.
/// @param tooltip  as text; none, if empty
std::string numberCell(std::string_view html, std::string_view tooltip = "");

/// The value of a gate, or "undefined" with the reason for whoever points at it.
std::string gateValueCell(const std::optional<double>& value, std::string_view reason);

/// A share in percent, shaded by its size.
/// @param worst  the table's largest share: its cell gets the full shade
/// @param mark   behind the figure
std::string heatCell(double share, double worst, std::string_view tooltip,
                     std::string_view mark = "");

/// The head row's cells: the columns of text, then those of numbers; all as HTML.
std::string headCells(std::initializer_list<std::string_view> texts,
                      std::initializer_list<std::string_view> numbers);

/// A share in percent, or "–".
std::string rateText(std::optional<double> share);

/// "9.80 ± 0.04" in percent, or without the second where it is not known.
std::string withUncertainty(std::optional<double> share, std::optional<double> uncertainty);

}  // namespace gnomon
