#include "report/paper/paper_table.h"

#include <algorithm>
#include <cctype>

#include "common/lists.h"
#include "report/suite/suite_tables.h"
#include "report/tables/ranked_table.h"

namespace gnomon::report {
namespace {

std::string keyOf(const Column& column) {
  if (column.key.empty() && column.name == "95 %") return "interval";
  std::string key = column.key.empty() ? column.name : column.key;
  std::transform(key.begin(), key.end(), key.begin(), [](unsigned char c) {
    return c == ' ' ? '_' : static_cast<char>(std::tolower(c));
  });
  return key;
}

/// Whether people read it, and it is more than the row's name.
bool isChoice(const Column& column) {
  return column.quantity != Quantity::name && column.quantity != Quantity::exact;
}

}  // namespace

std::vector<std::string> paperColumnKeys() {
  std::vector<std::string> keys;
  for (const Table& table : {rankedTable({}, {}), suiteRankedTable({})}) {
    for (const Column& column : table.columns) {
      if (isChoice(column) && !column.name.empty()) appendOnce(keys, keyOf(column));
    }
  }
  return keys;
}

Table withColumns(Table table, const std::vector<std::string>& keys) {
  const auto isChosen = [&](const Column& column) {
    return isChoice(column) && contains(keys, keyOf(column));
  };
  if (std::none_of(table.columns.begin(), table.columns.end(), isChosen)) return table;
  for (Column& column : table.columns) {
    constexpr unsigned papers = onPaper | inColumn;
    const bool isShown = column.quantity == Quantity::name || isChosen(column);
    column.readers = isShown ? column.readers | papers : column.readers & ~papers;
  }
  return table;
}

Table withRows(Table table, const std::vector<std::string>& names) {
  const auto isOther = [&](const Row& row) { return !contains(names, nameOf(table, row)); };
  if (std::all_of(table.rows.begin(), table.rows.end(), isOther)) return table;
  std::erase_if(table.rows, isOther);
  return table;
}

}  // namespace gnomon::report
