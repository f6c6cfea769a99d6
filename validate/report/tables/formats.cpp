#include "report/tables/formats.h"

#include <array>

#include "report/tables/csv_format.h"
#include "report/tables/html_format.h"
#include "report/tables/latex_format.h"
#include "report/tables/markdown_format.h"
#include "report/tables/terminal_format.h"

namespace gnomon {

std::span<const TableFormat> tableFormats() {
  static constexpr std::array<TableFormat, 5> formats = {{
      {"txt", terminalTable, false},
      {"html", [](const Table& table) { return htmlTable(table).text(); }, false},
      {"csv", csvTable, true},
      {"tex", latexTable, true},
      {"md", markdownTable, true},
  }};
  return formats;
}

}  // namespace gnomon
