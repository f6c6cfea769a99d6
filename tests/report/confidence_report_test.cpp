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
            R"("verdict":"worse","radius":null})");
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

}  // namespace
}  // namespace gnomon::report
