#include "report/tables/bin_files.h"

#include <array>
#include <string_view>
#include <vector>

#include "compare/rates.h"
#include "report/tables/csv_text.h"
#include "report/text/number_text.h"

namespace gnomon {
namespace {

constexpr std::array<std::string_view, 3> binRates = {"error_rate", "false_shadow", "false_light"};

}  // namespace

std::string binsCsv(const StudyRecord& record) {
  std::string csv = csvLine({"study", "method", "view", "light", "axis", "low", "high", "samples",
                             "tp", "fp", "fn", "tn", "error_rate", "false_shadow", "false_light"});
  for (const BinRecord& bin : record.bins) {
    std::vector<std::string> cells = {record.name,
                                      bin.method,
                                      bin.view,
                                      bin.light,
                                      bin.axis,
                                      exactText(bin.low),
                                      exactText(bin.high),
                                      std::to_string(bin.counts.samples),
                                      exactText(bin.counts.truePositive),
                                      exactText(bin.counts.falsePositive),
                                      exactText(bin.counts.falseNegative),
                                      exactText(bin.counts.trueNegative)};
    for (const std::string_view name : binRates) {
      cells.push_back(exactText(rate(bin.counts, name).value));
    }
    csv += csvLine(cells);
  }
  return csv;
}

}  // namespace gnomon
