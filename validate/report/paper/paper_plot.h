#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/paper/paper_options.h"
#include "report/plots/plot_sheet.h"

namespace gnomon::report {

/// A plot as a figure of a paper: as wide as asked for, with its legend below and all of its text
/// in one size; a label that is wider than the figure is cut (cutText). Its commands are those of
/// the page; what the page says of margins, fonts and the legend's place is said anew before the
/// plot is drawn. Of a sheet of several panels it is the first one.
struct PaperFigure {
  std::string name;      ///< of its files
  double width = 0;      ///< millimetres
  double height = 0;     ///< likewise
  double fontSize = 9;   ///< points
  std::string commands;  ///< gnuplot's, without the terminal
};

/// None of a sheet that is not for a paper or has no legend.
std::optional<PaperFigure> paperFigure(const PlotSheet& sheet, PaperWidth width, double fontSize);

/// Figures as PDFs of one page. Same figure, same bytes.
/// @throws InternalError as runGnuplot
std::vector<std::string> paperPdfs(const std::vector<PaperFigure>& figures);

}  // namespace gnomon::report
