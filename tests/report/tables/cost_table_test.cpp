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

}  // namespace
}  // namespace gnomon::report
