// Confidence, differences and bins in every kind of report.

#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/error.h"
#include "report/json/summary_json.h"
#include "report/page/report_html.h"
#include "report/page/terminal_report.h"
#include "report/sample_record.h"
#include "report/tables/case_tables.h"
#include "report/tables/formats/csv_format.h"
#include "report/tables/formats/html_format.h"
#include "report/tables/formats/latex_format.h"
#include "report/tables/formats/markdown_format.h"
#include "report/tables/ranked_table.h"
#include "report/text/confidence_text.h"
#include "report/text/interval_text.h"
#include "report/text/text_width.h"

namespace gnomon::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

study::DifferenceRecord difference(const std::string& first, const std::string& second,
                                   double value, std::optional<compare::Interval> interval,
                                   study::DifferenceVerdict verdict) {
  return {"camera", "all",  first, second, value, interval, interval ? "" : "too few differ",
          0.003,    verdict};
}

/// "rough" 10 %, "close" 1.2 %, "best" 1 %.
study::StudyRecord recordOfThree() {
  study::StudyRecord made = test::sampleRecord();
  made.confidence = {
      {"rough, \"old\"", "camera", "all", 0.1, compare::Interval{0.08, 0.13}, "", 25, 40},
      {"rough, \"old\"", "camera", "elevation 15°", 0.1, compare::Interval{0.07, 0.14}, "", 25, 40},
      {"close", "camera", "all", 0.012, compare::Interval{0.009, 0.016}, "", 25, 40},
      {"best", "camera", "all", 0.01, std::nullopt, "too few blocks", 25, 40}};
  made.differences = {
      difference("rough, \"old\"", "close", 0.088, compare::Interval{0.07, 0.11},
                 study::DifferenceVerdict::worse),
      difference("rough, \"old\"", "best", 0.09, compare::Interval{0.072, 0.115},
                 study::DifferenceVerdict::worse),
      difference("close", "best", 0.02, std::nullopt, study::DifferenceVerdict::noInterval)};
  made.bins = {{"best", "camera", "all", "elevation", {}, 10.0, {1, 2, 3, 4, 10}},
               {"best", "camera", "all", "elevation", 10.0, {}, {5, 0, 0, 5, 10}}};
  return made;
}

TEST(ConfidenceText, RanksWhatAllLightsTogetherGive) {
  const std::vector<study::ConfidenceRecord> ranked = rankedIn(recordOfThree(), "camera");
  ASSERT_EQ(ranked.size(), 3U);
  EXPECT_EQ(ranked[0].method, "best");
  EXPECT_EQ(ranked[2].light, "all");
  EXPECT_EQ(confidenceViews(recordOfThree()), std::vector<std::string>{"camera"});
  EXPECT_TRUE(rankedIn(recordOfThree(), "atlas").empty());
}

TEST(ConfidenceText, SaysWhatTheBestIsBetterThan) {
  EXPECT_EQ(
      verdictText(recordOfThree(), "camera"),
      "“best” is better than “rough, \"old\"” by 9.00 % of the samples (95 % interval 7.20 to "
      "11.50). “best” could not be compared with “close”: the difference has no 95 % interval.");
  EXPECT_EQ(intervalText(compare::Interval{-0.001, 0.02}), "−0.10 to 2.00");
  EXPECT_EQ(intervalText(compare::Interval{-0.012, 0.5}), "−1.20 to 50.00");
  EXPECT_EQ(intervalText(compare::Interval{-1e-7, 0}), "0.00 to 0.00");
  EXPECT_EQ(intervalText(std::nullopt), "–");
  EXPECT_EQ(verdictText(test::sampleRecord(), "camera"), "");
  study::StudyRecord many = recordOfThree();
  for (const char* name : {"a", "b", "c"}) {
    many.confidence.push_back(
        {name, "camera", "all", 0.011, compare::Interval{0, 0.1}, "", 25, 40});
    many.differences.push_back(difference("best", name, -0.001, compare::Interval{-0.002, 0.001},
                                          study::DifferenceVerdict::notDistinguishable));
  }
  EXPECT_THAT(verdictText(many, "camera"),
              HasSubstr("“best” is not distinguishable from “a”, “b” and “c”. “best” could not"));
  for (const char* name : {"d, e", "f"}) {
    many.confidence.push_back({name, "camera", "all", 0.011, {}, "", 25, 40});
    many.differences.push_back(difference("best", name, -0.001, compare::Interval{-0.002, 0.001},
                                          study::DifferenceVerdict::notDistinguishable));
  }
  EXPECT_THAT(verdictText(many, "camera"),
              HasSubstr("“best” is not distinguishable from “a”, “b”, “c” and 2 more."));
  EXPECT_THAT(
      confidenceNote(recordOfThree(), "camera"),
      HasSubstr(
          "over all random draws of the bumps, on the same surface, in the same view, under the "
          "same lights. It comes from 25 blocks of 40 × 40 samples. Compared with the best: ≈ not "
          "distinguishable from it: the 95 % interval of the difference contains 0, or the "
          "difference is within the truth’s uncertainty; = the same answers, to the sample; ? the "
          "difference has no interval; without a sign they differ. The truth’s uncertainty is 0.30 "
          "%."));
}

/// Three methods that answer alike are equal, not unknown.
TEST(ConfidenceText, TellsEqualAnswersAsSuch) {
  study::StudyRecord record = recordOfThree();
  record.differences[2].verdict = study::DifferenceVerdict::equal;
  EXPECT_THAT(verdictText(record, "camera"),
              HasSubstr(" “best” gives the same answers as “close”."));
  EXPECT_THAT(verdictText(record, "camera"), Not(HasSubstr("could not be compared")));
  const std::string text = terminalReport(record, false);
  EXPECT_THAT(text, HasSubstr("– =\n"));
  EXPECT_THAT(text, Not(HasSubstr("No interval of the difference")));
}

TEST(ConfidenceText, StatesTheUncertaintyThatItsMarksWereJudgedBy) {
  study::StudyRecord record = recordOfThree();
  // A pair in which the best is not says nothing of the marks.
  record.differences[0].uncertainty = 0.5;
  EXPECT_THAT(confidenceNote(record, "camera"), HasSubstr("truth’s uncertainty is 0.30 %."));
  // Two pairs with the best, of two uncertainties.
  record.differences[2].uncertainty = 0.0055;
  EXPECT_THAT(confidenceNote(record, "camera"),
              HasSubstr("truth’s uncertainty is 0.30 to 0.55 %."));
}

TEST(ConfidenceJson, HoldsEveryFigure) {
  const auto json = nlohmann::ordered_json::parse(summaryJson(recordOfThree()));
  EXPECT_EQ(json["confidence"][0].dump(),
            R"({"method":"rough, \"old\"","view":"camera","light":"all","error_rate":0.1,)"
            R"("low":0.08,"high":0.13,"reason":null,"blocks":25,"block_side":40})");
  EXPECT_EQ(json["confidence"][3]["low"], nullptr);
  EXPECT_EQ(json["confidence"][3]["reason"], "too few blocks");
  EXPECT_EQ(json["differences"][0].dump(),
            R"({"view":"camera","light":"all","first":"rough, \"old\"","second":"close",)"
            R"("difference":0.088,"low":0.07,"high":0.11,"reason":null,"uncertainty":0.003,)"
            R"("verdict":"worse"})");
  EXPECT_EQ(json["differences"][2]["high"], nullptr);
  EXPECT_EQ(json["differences"][2]["reason"], "too few differ");
  EXPECT_EQ(json["differences"][2]["verdict"], "no interval");
  EXPECT_EQ(json["bins"][0].dump(),
            R"({"method":"best","view":"camera","light":"all","axis":"elevation","low":null,)"
            R"("high":10.0,"samples":10,"tp":1.0,"fp":2.0,"fn":3.0,"tn":4.0,"error_rate":0.5,)"
            R"("false_shadow":0.2,"false_light":0.3})");
  EXPECT_EQ(json["bins"][1]["high"], nullptr);
  study::StudyRecord broken = recordOfThree();
  broken.confidence[0].interval->high = std::numeric_limits<double>::infinity();
  EXPECT_THROW(summaryJson(broken), InternalError);
}

/// One record with every answer: each format has the same sign of each.
TEST(Signs, AreTheSameInEveryFormat) {
  study::StudyRecord record = test::sampleRecord(1);
  const auto add = [&](const std::string& method, double wrong) {
    record.results.push_back(
        test::result(method, "elevation 15°", "camera", "all", test::countsOf(1000, wrong, 0)));
  };
  add("same", 10);
  add("unknown", 300);
  test::addDifferences(record, 0.001);
  for (study::DifferenceRecord& row : record.differences) {
    const auto isOf = [&](const char* method) {
      return row.first == method || row.second == method;
    };
    if (!isOf("best")) continue;
    if (isOf("same")) row.verdict = study::DifferenceVerdict::equal;
    if (isOf("close")) row.interval = compare::Interval{-0.1, 0.1};
    if (isOf("unknown")) row.reason = "too few blocks";
    if (isOf("unknown")) row.interval.reset();
    if (!isOf("same")) row.verdict = study::distinguish(study::estimateOf(row));
  }
  const std::vector<study::RankedMethod> ranked = study::rankMethods(record);
  const Table table = rankedTable(record, ranked);
  const std::string note = "? No interval of the difference of “unknown”: too few blocks.";
  EXPECT_EQ(table.notes, std::vector<std::string>{note});
  const std::string markdown = markdownTable(table);
  const std::string latex = latexTabular(table, {onPaper, 500, 9});
  const std::string page = htmlTable(table).text();
  const std::string csv = csvTable(table);
  const std::string terminal = terminalReport(record, false);
  for (const auto& [method, sign, inLatex, name] :
       {std::array{"same", " =", "=~", "equal"},
        std::array{"close", " ≈", "$\\approx$~", "not distinguishable"},
        std::array{"unknown", " ?", "?~", "no interval"}, std::array{"rough", "", "", "worse"}}) {
    EXPECT_THAT(markdown, HasSubstr(std::string("| ") + method + (*sign != 0 ? sign : ", ")));
    EXPECT_THAT(latex, HasSubstr(std::string("  ") + inLatex + method));
    EXPECT_THAT(page, HasSubstr(std::string(method) + (*sign != 0 ? sign : ", ")));
    const std::size_t row = csv.find(method);
    EXPECT_THAT(csv.substr(row, csv.find('\n', row) - row),
                HasSubstr(std::string(",") + name + ","));
  }
  EXPECT_THAT(terminal, HasSubstr(" ?\n"));
  EXPECT_THAT(terminal, HasSubstr(" =\n"));
  EXPECT_THAT(terminal, HasSubstr(" ≈\n"));
  EXPECT_THAT(terminal, HasSubstr("\n  " + note));
}

TEST(BinsCsv, HasARowABin) {
  EXPECT_EQ(csvTable(binsTable(recordOfThree())),
            "study,method,view,light,axis,low,high,samples,tp,fp,fn,tn,error_rate,false_shadow,"
            "false_light\n"
            "sample,best,camera,all,elevation,,10,10,1,2,3,4,0.5,0.2,0.3\n"
            "sample,best,camera,all,elevation,10,,10,5,0,0,5,0,0,0\n");
}

TEST(TerminalConfidence, RanksMethodsWithTheirIntervals) {
  const std::string text = terminalReport(recordOfThree(), false);
  EXPECT_THAT(text, HasSubstr("Verdict · camera\n"));
  EXPECT_LT(text.find("Verdict"), text.find("camera · elevation 15°")) << "the verdict first";
  std::istringstream lines(text);
  std::vector<std::string> rows;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(displayWidth(line), 100U) << line;
    if (line.find(" to ") != std::string::npos && line.rfind("  ", 0) == 0) rows.push_back(line);
  }
  EXPECT_THAT(text, HasSubstr("1.20     0.90 to 1.60      +2.00                – ?\n"));
  EXPECT_THAT(text, HasSubstr("10.00    8.00 to 13.00      +9.00    7.20 to 11.50\n"));
  EXPECT_THAT(terminalReport(test::sampleRecord(), false), Not(HasSubstr("Verdict")));
  EXPECT_THAT(text, HasSubstr("  ? No interval of the difference of “close”: too few differ.\n"));
  study::StudyRecord wide = recordOfThree();
  wide.confidence[3].method = std::string(300, 'x');
  std::istringstream wideLines(terminalReport(wide, false));
  for (std::string line; std::getline(wideLines, line);) EXPECT_LE(displayWidth(line), 100U);
}

TEST(ConfidenceHtml, HasATableAView) {
  const std::string html = confidenceSection(recordOfThree()).text();
  EXPECT_THAT(html, HasSubstr("rough, &quot;old&quot;"));
  EXPECT_THAT(html, HasSubstr("0.90 to 1.60"));
  EXPECT_THAT(html, HasSubstr("too few blocks"));
  EXPECT_THAT(html, HasSubstr("close ?"));
  EXPECT_THAT(html, HasSubstr("? No interval of the difference of “close”: too few differ."));
  EXPECT_THAT(reportHtml(recordOfThree(), "/none").text(), HasSubstr(html));
  EXPECT_TRUE(confidenceSection(test::sampleRecord()).empty());
}

}  // namespace
}  // namespace gnomon::report
