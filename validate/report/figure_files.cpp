#include "report/figure_files.h"

#include "report/json/summary_json.h"
#include "report/json/sweep_json.h"
#include "report/tables/long_table.h"

namespace gnomon::report {

study::StudyRecord figuresAlone(study::StudyRecord record, bool isStep) {
  record.timings.clear();
  record.cache.reset();
  record.truth.bvhBytes.reset();
  record.environment.threads = 0;
  if (isStep) record.bins = {};
  return record;
}

void writeFigureFiles(const study::StudyRecord& record, RunFolder& folder) {
  folder.write("cases.csv", longCsv(record));
  folder.finish(summaryJson(record));
}

void writeFigureFiles(const study::SweepRecord& sweep, RunFolder& folder) {
  folder.write("cases.csv", longCsv(sweep));
  folder.finish(sweepJson(sweep));
}

}  // namespace gnomon::report
