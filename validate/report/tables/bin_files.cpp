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

Json jsonBin(const BinRecord& bin) {
  Json json = {{"method", bin.method},
               {"view", bin.view},
               {"light", bin.light},
               {"axis", bin.axis},
               {"low", jsonNumber(bin.low, "bins.low")},
               {"high", jsonNumber(bin.high, "bins.high")},
               {"samples", bin.counts.samples},
               {"tp", jsonNumber(bin.counts.truePositive, "bins.tp")},
               {"fp", jsonNumber(bin.counts.falsePositive, "bins.fp")},
               {"fn", jsonNumber(bin.counts.falseNegative, "bins.fn")},
               {"tn", jsonNumber(bin.counts.trueNegative, "bins.tn")}};
  for (const std::string_view name : binRates) {
    json[std::string(name)] = jsonNumber(rate(bin.counts, name).value, name);
  }
  return json;
}

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
