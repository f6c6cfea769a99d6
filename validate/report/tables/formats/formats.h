#pragma once

#include <span>
#include <string>
#include <string_view>

#include "report/tables/table.h"

namespace gnomon::report {

/// One way to print any table.
struct TableFormat {
  std::string_view name;  ///< as files of the format end
  std::string (*print)(const Table&);
  bool isFile;  ///< a run writes its ranked table in it, as `table.NAME`; LaTeX: see paper_files.h
};

/// All formats of tables. A new one is a file beside these and a line in formats.cpp.
std::span<const TableFormat> tableFormats();

}  // namespace gnomon::report
