#include "report/plots/error_bars.h"

#include <gmock/gmock.h>

#include "report/sample_record.h"

namespace gnomon {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

RankedMethod ranked() {
  RankedMethod method;
  method.errorRate = {0.04, 1};
  method.falseShadow = {0.01, 1};
  method.falseLight = {0.03, 1};
  method.uncertainty = 0.005;
  method.interval = Interval{0.02, 0.08};
  return method;
}

TEST(ErrorBar, StandsToScale) {
  EXPECT_DOUBLE_EQ(errorBarScale(std::vector{ranked()}), 0.08);
  const std::string svg = errorBar(ranked(), 0.1);
  EXPECT_THAT(svg, HasSubstr("class=\"shadow\" x=\"0.00\" y=\"4\" width=\"100.00\""));
  EXPECT_THAT(svg, HasSubstr("class=\"light\" x=\"100.00\" y=\"4\" width=\"300.00\""));
  EXPECT_THAT(svg, HasSubstr("class=\"truth\" x=\"350.00\" y=\"1\" width=\"100.00\""));
  EXPECT_THAT(svg, HasSubstr("<line x1=\"200.00\" x2=\"800.00\""));
}

TEST(ErrorBar, LeavesOutWhatIsNotKnown) {
  RankedMethod method = ranked();
  method.interval.reset();
  method.uncertainty.reset();
  EXPECT_THAT(errorBar(method, 0.1), Not(HasSubstr("<line")));
  EXPECT_THAT(errorBar(method, 0.1), Not(HasSubstr("truth")));
  method.errorRate = {};
  EXPECT_EQ(errorBar(method, 0.1), "");
  EXPECT_EQ(errorBar(ranked(), 0), "");
}

/// The mean over views, all lights together; none unless each view has one.
TEST(Ranking, MeansTheIntervalsOfItsViews) {
  StudyRecord record = test::sampleRecord();
  const std::size_t rows = record.results.size();
  for (std::size_t i = 0; i < rows; ++i) {
    record.results.push_back(record.results[i]);
    record.results.back().view = "atlas";
  }
  const auto row = [](const std::string& view, const std::string& light, Interval interval) {
    return ConfidenceRecord{"best", view, light, 0.01, interval, "", 25, 40};
  };
  record.confidence = {row("camera", "all", {0.01, 0.03}),
                       row("camera", "elevation 15°", {0.5, 0.9})};
  EXPECT_FALSE(rankMethods(record).front().interval) << "the atlas has none";
  record.confidence.push_back(row("atlas", "all", {0.02, 0.09}));
  const auto method = rankMethods(record).front();
  ASSERT_TRUE(method.interval);
  EXPECT_EQ(method.label, "best");
  EXPECT_DOUBLE_EQ(method.interval->low, 0.015);
  EXPECT_DOUBLE_EQ(method.interval->high, 0.06);
  record.confidence.back().interval.reset();
  EXPECT_FALSE(rankMethods(record).front().interval);
}

}  // namespace
}  // namespace gnomon
