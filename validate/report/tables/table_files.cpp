#include "report/tables/table_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "common/lists.h"
#include "report/tables/cost.h"
#include "report/tables/csv_text.h"
#include "report/tables/latex_text.h"
#include "report/text/number_text.h"
#include "report/text/ranking_text.h"
#include "study/judge/ranking.h"

namespace gnomon {
namespace {

std::uint64_t bytesOf(const CostRecord& cost) {
  return cost.tableBytes + cost.heightBytes;
}

/// A ranked method that is not distinguishable from rank 1.
bool isSameAsBest(const std::vector<RankedMethod>& ranked, std::size_t place) {
  const std::vector<std::string>& same = ranked[place].indistinguishable;
  return place > 0 && ranked[place].rank && contains(same, ranked.front().label);
}

std::string csvRow(const StudyRecord& record, const std::vector<RankedMethod>& ranked,
                   std::size_t place) {
  const RankedMethod& method = ranked[place];
  const CostRecord* cost = costOf(record, method.label);
  return csvLine(
      {method.rank ? std::to_string(*method.rank) : "", method.label,
       exactText(method.errorRate.value), method.interval ? exactText(method.interval->low) : "",
       method.interval ? exactText(method.interval->high) : "", exactText(method.uncertainty),
       isSameAsBest(ranked, place) ? "1" : "0", exactText(method.testError.value),
       exactText(method.falseShadow.value), exactText(method.falseLight.value),
       exactText(method.iou.value), std::to_string(method.cases), std::to_string(method.allCases),
       exactText(method.leaderError), cost ? std::to_string(bytesOf(*cost)) : "",
       cost ? exactText(cost->frameMs) : ""});
}

std::string latexInterval(const RankedMethod& method) {
  if (!method.interval) return "--";
  return fmt::format("{}--{}", escapeLatex(percentText(std::max(0.0, method.interval->low))),
                     escapeLatex(percentText(method.interval->high)));
}

std::string latexRow(const StudyRecord& record, const std::vector<RankedMethod>& ranked,
                     std::size_t place) {
  const RankedMethod& method = ranked[place];
  const CostRecord* cost = costOf(record, method.label);
  const auto percent = [](std::optional<double> share) { return escapeLatex(percentText(share)); };
  const std::string memory =
      cost ? fmt::format("{:.2f}", static_cast<double>(bytesOf(*cost)) / 1e6) : "--";
  const std::string frame = cost && cost->frameMs
                                ? fmt::format("{:.2f}", requireFinite(*cost->frameMs, "frame_ms"))
                                : "--";
  return fmt::format("    {}{} & {} & {} & {} & {} & {} & {} & {} & {} \\\\\n",
                     isSameAsBest(ranked, place) ? "$\\approx$ " : "", escapeLatex(method.label),
                     percent(method.errorRate.value), latexInterval(method),
                     percent(method.testError.value), percent(method.falseShadow.value),
                     percent(method.falseLight.value), percent(method.iou.value), memory, frame);
}

std::string caption(const StudyRecord& record, const std::vector<RankedMethod>& ranked) {
  const std::string title = record.title.empty() ? record.name : record.title;
  std::string text =
      escapeLatex(title) +
      ". Means over all lights and views, in percent of the samples, with 95\\,\\% "
      "intervals of the error. Test: the error of the shadow test without the shading.";
  if (!ranked.empty() && ranked.front().uncertainty) {
    text += fmt::format(
        " The truth itself is uncertain by {}\\,\\%; $\\approx$ marks methods that are not "
        "distinguishable from the best: the interval of the difference holds 0, there is none, or "
        "the difference is no larger than that uncertainty.",
        escapeLatex(percentText(ranked.front().uncertainty)));
  }
  for (const RankedMethod& method : ranked) {
    if (method.rank) continue;
    text += fmt::format(" {} {}.", escapeLatex(method.label),
                        escapeLatex(fewerCasesText(method.cases, method.allCases,
                                                   ranked.front().label, method.leaderError)));
  }
  return text;
}

/// Letters, digits and dashes.
std::string latexKey(const std::string& name) {
  std::string key;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    key += plain ? c : '-';
  }
  return key;
}

}  // namespace

std::string tableCsv(const StudyRecord& record) {
  const std::vector<RankedMethod> ranked = rankMethods(record);
  std::string csv =
      csvLine({"rank", "method", "error_rate", "low", "high", "uncertainty", "same_as_best",
               "test_error_rate", "false_shadow", "false_light", "iou", "cases", "all_cases",
               "leader_error_rate", "bytes", "frame_ms"});
  for (std::size_t i = 0; i < ranked.size(); ++i) csv += csvRow(record, ranked, i);
  return csv;
}

std::string tableTex(const StudyRecord& record) {
  const std::vector<RankedMethod> ranked = rankMethods(record);
  std::string rows;
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    if (i > 0 && ranked[i - 1].rank && !ranked[i].rank) rows += "    \\midrule\n";
    rows += latexRow(record, ranked, i);
  }
  return fmt::format(
      "% \\usepackage{{booktabs}}\n"
      "\\begin{{table}}\n  \\centering\n  \\caption{{{}}}\n  \\label{{tab:{}}}\n"
      "  \\begin{{tabular}}{{lrrrrrrrr}}\n    \\toprule\n"
      "    Method & Error & 95\\,\\% & Test & False shadow & False light & IoU & Memory, MB & "
      "Frame, ms "
      "\\\\\n    \\midrule\n{}    \\bottomrule\n  \\end{{tabular}}\n\\end{{table}}\n",
      caption(record, ranked), latexKey(record.name), rows);
}

}  // namespace gnomon
