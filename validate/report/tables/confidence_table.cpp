#include "report/tables/confidence_table.h"

#include "report/text/confidence_text.h"
#include "report/text/ranking_text.h"
#include "study/judge/distinguish.h"

namespace gnomon::report {
namespace {

Row confidenceRow(const study::StudyRecord& record, const study::ConfidenceRecord& row,
                  const std::string& best) {
  Row cells{{textCell(row.method), valueCell(row.rate), intervalCell(row.interval, row.reason)}};
  const auto worse = study::differenceOf(record, row.view, row.light, row.method, best);
  if (row.method == best || !worse) {
    cells.cells.push_back(textCell(""));
    cells.cells.push_back(textCell(""));
    return cells;
  }
  cells.cells.push_back(valueCell(worse->difference));
  cells.cells.push_back(intervalCell(worse->interval, worse->reason));
  cells.mark = differenceSign(worse->verdict);
  return cells;
}

}  // namespace

Table confidenceTable(const study::StudyRecord& record, const std::string& view) {
  using Q = Quantity;
  Table table{.kind = "confidence",
              .columns = {{"Method", "method", Q::name},
                          {"Error", "error_rate", Q::percent},
                          {"95 %", "", Q::interval},
                          {"To best", "to_best", Q::signedPercent},
                          {"95 %", "to_best", Q::interval}}};
  table.columns[0].width = 44;
  const std::vector<study::ConfidenceRecord> ranked = rankedIn(record, view);
  for (const study::ConfidenceRecord& row : ranked) {
    table.rows.push_back(confidenceRow(record, row, ranked.front().method));
  }
  table.notes = noIntervalNotes(differencesToBest(record, view));
  return table;
}

}  // namespace gnomon::report
