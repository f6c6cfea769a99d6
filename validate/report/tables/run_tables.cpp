#include "report/tables/run_tables.h"

#include "report/text/names.h"

namespace gnomon::report {

Table flipTable(const std::vector<study::UncertaintyRecord>& flips) {
  Table table{.kind = "flips",
              .columns = {{"View", "view"},
                          {"Light", "light"},
                          {"Samples that change", "flip_rate", Quantity::percent}}};
  for (const study::UncertaintyRecord& flip : flips) {
    table.rows.push_back({{textCell(flip.view), textCell(flip.light), valueCell(flip.flipRate)}});
  }
  return table;
}

Table timingTable(const std::vector<study::TimingRecord>& timings) {
  Table table{.kind = "timings",
              .columns = {{"Stage", "stage"}, {"Seconds", "seconds", Quantity::decimals}}};
  for (const study::TimingRecord& timing : timings) {
    table.rows.push_back({{textCell(timing.stage), valueCell(timing.seconds)}});
  }
  return table;
}

Table inputTable(const std::vector<study::InputRecord>& inputs) {
  Table table{
      .kind = "inputs",
      .columns = {{"Kind", "kind"}, {"File", "file"}, {"SHA-256", "sha256", Quantity::code}}};
  for (const study::InputRecord& input : inputs) {
    table.rows.push_back({{textCell(std::string(inputKindName(input.kind))), textCell(input.file),
                           textCell(input.sha256)}});
  }
  return table;
}

}  // namespace gnomon::report
