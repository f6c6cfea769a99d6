#include "report/tables/formats/formats.h"

#include <array>

#include "report/tables/formats/html_format.h"
#include "report/tables/formats/latex_format.h"
#include "report/tables/formats/terminal_format.h"
#include "report/tables/formats/text_formats.h"

namespace gnomon::report {

std::span<const TableFormat> tableFormats() {
  static constexpr std::array<TableFormat, 5> formats = {{
      {"txt", terminalTable, false},
      {"html", [](const Table& table) { return htmlTable(table).text(); }, false},
      {"csv", csvTable, true},
      {"tex", [](const Table& table) { return latexTabular(table); }, false},
      {"md", markdownTable, true},
  }};
  return formats;
}

}  // namespace gnomon::report
