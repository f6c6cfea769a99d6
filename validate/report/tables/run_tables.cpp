#include "report/tables/run_tables.h"

#include "report/text/names.h"
#include "report/text/refinement_text.h"

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

Table refinementTable(const std::vector<study::RefinementRecord>& levels) {
  Table table{
      .kind = "refinement",
      .columns = {{"Step", "step_texels", Quantity::exact, byAll, "texels"},
                  {"Micro-triangles", "micro_triangles", Quantity::count},
                  {"Differ from the level before", "flip_rate", Quantity::exact, byAll, "%"}}};
  for (const study::RefinementRecord& level : levels) {
    Row row{
        {valueCell(level.stepTexels), countCell(level.microTriangles), valueCell(level.flipRate)}};
    row.cells[0].text = stepText(level.stepTexels);
    row.cells[2].text = flipText(level.flipRate);
    table.rows.push_back(std::move(row));
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
