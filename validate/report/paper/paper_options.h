#pragma once

#include <string>
#include <vector>

#include "report/tables/formats/latex_format.h"

namespace gnomon::report {

/// How wide a figure or a table of a paper is.
enum class PaperWidth {
  column,  ///< one of two columns: 84 mm
  page,    ///< both of them: 178 mm
};

/// "column" or "page".
const char* paperWidthName(PaperWidth width);

/// 84 or 178.
double millimetresOf(PaperWidth width);

/// What a run writes for a paper.
struct PaperOptions {
  std::vector<PaperWidth> widths = {};    ///< of the figures that are wanted, each once
  double fontSize = 9;                    ///< of the text of figures and tables, points
  std::vector<std::string> methods = {};  ///< labels of those that they show; none for the rule
  std::vector<std::string> columns = {};  ///< keys of the tables' columns (paperColumnKeys); none
                                          ///< for the default
};

/// The room of a table.
TabularRoom roomOf(PaperWidth width, double fontSize);

}  // namespace gnomon::report
