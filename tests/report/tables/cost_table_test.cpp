#include "report/tables/cost_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "common/error.h"
#include "report/json/summary_json.h"
#include "report/page/report_html.h"
#include "report/page/terminal_report.h"
#include "report/sample_record.h"
#include "report/text/text_width.h"

namespace gnomon::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The three of the paper's section 4: 4, 5 and 16 ms a frame.
study::StudyRecord threeMethods() {
  study::StudyRecord record;
  record.environment.glRenderer = "A <rasteriser>";
  record.methods = {{"flat", "max-forsyth", "", ""},
                    {"onoue-2004", "onoue-2004", "", ""},
                    {"shadow-volume", "shadow-volume", "", ""}};
  record.cost = {{"flat", 960, 524'288, 0, 4.0, 4.0},
                 {"onoue-2004", 960, 1'048'576, 16'384, 5.0, 5.0},
                 {"shadow-volume", 1'234'567, 0, 0, 16.0, 12.0, 24.5, 3}};
  return record;
}

TEST(Cost, IsSetAgainstTheMethodOfTheNameWhateverItsLabel) {
  study::StudyRecord record = threeMethods();
  EXPECT_EQ(frameRatio(record, record.cost[0]), 1.0);
  EXPECT_EQ(frameRatio(record, record.cost[1]), 1.25);
  EXPECT_EQ(frameRatio(record, record.cost[2]), 4.0);
  // One that bears the name as its label goes before.
  record.methods.push_back({"max-forsyth", "max-forsyth", "", ""});
  record.cost.push_back({"max-forsyth", 960, 0, 0, 2.0});
  EXPECT_EQ(frameRatio(record, record.cost[1]), 2.5);
}

TEST(Cost, HasNoRatioWhereEitherWasNotTimed) {
  study::StudyRecord record = threeMethods();
  record.cost[1].frameMs.reset();
  EXPECT_FALSE(frameRatio(record, record.cost[1]));
  record.cost[0].frameMs = 0;
  EXPECT_FALSE(frameRatio(record, record.cost[2]));
  record.cost[0].frameMs.reset();
  EXPECT_FALSE(frameRatio(record, record.cost[2]));
  record = threeMethods();
  record.methods[0].name = "another";
  EXPECT_FALSE(frameRatio(record, record.cost[2]));
}

TEST(Cost, RefusesATimeThatIsNotFinite) {
  study::StudyRecord record = threeMethods();
  record.cost[0].frameMs = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)frameRatio(record, record.cost[1]), InternalError);
}

TEST(Cost, SaysWhatThePaperSaysAndWhatTheRunGave) {
  const std::string text = publishedRates(threeMethods());
  EXPECT_THAT(text, HasSubstr("a fifth of it (0.20)"));
  EXPECT_THAT(text, HasSubstr("drawn by A <rasteriser>, the curvature-aware method has 0.80 of"));
  EXPECT_THAT(text, HasSubstr("shadow volumes 0.25 of it"));
}

TEST(Cost, SaysNothingOfThePaperUnlessAllThreeWereTimed) {
  for (std::size_t i = 0; i < 3; ++i) {
    study::StudyRecord record = threeMethods();
    record.cost[i].frameMs.reset();
    EXPECT_EQ(publishedRates(record), "");
    record = threeMethods();
    record.methods[i].name = "another";
    EXPECT_EQ(publishedRates(record), "");
  }
}

TEST(Cost, StandsInEveryReport) {
  const study::StudyRecord record = threeMethods();
  const auto json = nlohmann::json::parse(summaryJson(record));
  EXPECT_EQ(json["cost"][2]["passes"], 3);
  EXPECT_EQ(json["cost"][2]["frame_ratio"], 4.0);
  EXPECT_EQ(json["cost"][2]["texels"], 24.5);
  EXPECT_TRUE(json["cost"][0]["texels"].is_null());
  EXPECT_EQ(json["cost"][0]["passes"], 1);
  const std::string table = terminalReport(record, false);
  EXPECT_THAT(table, HasSubstr("  shadow-volume    1\u202f234\u202f567         0 B       3      "
                               "16.00            12.00           4.00×\n"));
  EXPECT_THAT(table, HasSubstr("  flat                   960      524 kB       1       4.00"
                               "             4.00           1.00×\n"));
  const std::string html = reportHtml(record, ".").text();
  EXPECT_THAT(html, HasSubstr(">4.00×<"));
  EXPECT_THAT(html, HasSubstr(">24.50<"));
  EXPECT_THAT(html, HasSubstr("drawn by A &lt;rasteriser&gt;"));
}

TEST(Cost, WithoutTheReferenceIsADash) {
  study::StudyRecord record = threeMethods();
  record.methods[0].name = "another";
  const auto json = nlohmann::json::parse(summaryJson(record));
  EXPECT_TRUE(json["cost"][2]["frame_ratio"].is_null());
  EXPECT_THAT(terminalReport(record, false), HasSubstr("16.00            12.00               –\n"));
  const std::string html = reportHtml(record, ".").text();
  EXPECT_THAT(html, HasSubstr("max-forsyth was not timed"));
  EXPECT_THAT(html, Not(HasSubstr("section 4")));
}

TEST(Cost, FitsATerminal) {
  study::StudyRecord record = threeMethods();
  record.cost[2] = {std::string(200, 'm'), 4'000'000'000, 40'000'000'000, 0, 12'345.6, 100};
  std::istringstream lines(terminalReport(record, false));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(displayWidth(line), 100U) << line;
}

}  // namespace
}  // namespace gnomon::report
