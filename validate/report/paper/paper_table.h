#pragma once

#include <string>
#include <vector>

#include "report/tables/table.h"

namespace gnomon::report {

/// The keys by which columns of a paper's tables can be chosen: those of rankedTable and of
/// suiteRankedTable, each once. An interval's is "interval", that of a column without a key its
/// heading in small letters.
std::vector<std::string> paperColumnKeys();

/// The table with the chosen columns alone, as any paper shows it; as it is where it has none of
/// them or none is chosen. The names of its rows stay.
Table withColumns(Table table, const std::vector<std::string>& keys);

/// The table with the rows of these names alone, in its own order; as it is where it has none of
/// them or none is given.
Table withRows(Table table, const std::vector<std::string>& names);

}  // namespace gnomon::report
