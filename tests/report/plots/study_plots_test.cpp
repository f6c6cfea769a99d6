#include "report/plots/study_plots.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>

#include "common/error.h"
#include "report/page/html_page.h"
#include "report/sample_record.h"

namespace gnomon::report {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

study::BinRecord bin(const std::string& method, const std::string& view, std::optional<double> low,
                     std::optional<double> high, double wrong, std::size_t samples) {
  return {method, view, "all", "elevation", low, high, test::countsOf(samples, wrong, 0)};
}

/// "best" has all four bins, "close" not the first; in the third none has a sample.
study::StudyRecord plottedRecord() {
  study::StudyRecord made = test::sampleRecord();
  made.bins = {bin("best", "camera", {}, 0, 5, 100),    bin("best", "camera", 0, 10, 20, 200),
               bin("best", "camera", 20, {}, 7, 700),   bin("close", "camera", 0, 10, 50, 200),
               bin("close", "camera", 20, {}, 70, 700), bin("best", "atlas", 0, 10, 1, 10),
               bin("best", "atlas", 10, 20, 1, 10)};
  return made;
}

std::vector<LinePlot> plotsOf(const study::StudyRecord& record) {
  return studyPlots(record, {"best", "close"});
}

TEST(BinPlot, DrawsEachBinsErrorAtItsMiddle) {
  const LinePlot plot = plotsOf(plottedRecord()).at(0);
  EXPECT_EQ(plot.name, "error-by-elevation_camera");
  const std::string script = sheetOf(plot).commands;
  // Open bins are as wide as their neighbours.
  EXPECT_THAT(script, HasSubstr("$c0 << EOD\n-5 5 NaN NaN\n5 10 NaN NaN\n25 1 NaN NaN\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("$c1 << EOD\n-5 NaN NaN NaN\n5 25 NaN NaN\n25 10 NaN NaN\nEOD\n"));
  // Flips of 0.2 and 0.4 percent under the two lights.
  EXPECT_THAT(script, HasSubstr("$band << EOD\n-10 0.3 NaN NaN\n30 0.3 NaN NaN\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("set xrange [-10:30]\n"));
  EXPECT_THAT(script, HasSubstr("degrees'"));
}

TEST(BinPlot, OfSoftLightErrorsAreSharesOfTheLight) {
  study::StudyRecord record = plottedRecord();
  EXPECT_EQ(plotsOf(record).at(0).yLabel, "wrong, percent of the bin’s samples");
  for (study::ResultRecord& row : record.results) row.shares.push_back({"mae", 0.01, {}});
  EXPECT_EQ(plotsOf(record).at(0).yLabel, "wrong, percent of the bin’s light");
}

/// 1, 2, 4, 8: each bin is as wide as the others on a logarithmic axis, those at the ends too.
TEST(BinAxis, EdgesThatGrowByOneFactorAreLogarithmic) {
  const BinAxis axis = binAxis({{{}, 1}, {1, 2}, {2, 4}, {4, 8}, {8, {}}});
  EXPECT_EQ(axis.commands, "set logscale x\nset xrange [0.5:16]\n");
  EXPECT_DOUBLE_EQ(axis.middles.at(1), std::sqrt(2.0));
  EXPECT_EQ(binAxis({{{}, 0}, {0, 10}}).commands, "set xrange [-10:10]\n");
}

/// On a plane all samples have one curvature.
TEST(BinPlot, OfOneBinThereIsNone) {
  study::StudyRecord record = plottedRecord();
  std::erase_if(record.bins, [&](const study::BinRecord& each) {
    return each.view == "camera" && each.low != record.bins.front().low;
  });
  ASSERT_EQ(plotsOf(record).size(), 1U);
  EXPECT_EQ(plotsOf(record)[0].name, "error-by-elevation_atlas");
}

TEST(StudyPlots, AreDrawnInTheStyleOfADarkPageToo) {
  for (const DrawnPlot& plot : drawPlots(sheetsOf(plotsOf(plottedRecord())), nullptr)) {
    EXPECT_FALSE(plot.sheet.about.empty());
    EXPECT_THAT(plot.svg, HasSubstr("<style>@media screen and (prefers-color-scheme:dark)"));
    EXPECT_THAT(plot.pdf, StartsWith("%PDF-"));
    EXPECT_THAT(htmlPlots({&plot, 1}, plot.sheet.section).text(),
                HasSubstr("src=\"data:image/svg+xml;base64,"));
  }
  EXPECT_TRUE(studyPlots(study::StudyRecord{}, {}).empty());
}

TEST(PlotSheet, PdfDoesNotTellTheTimeZone) {
  const PlotSheet sheet = sheetOf(plotsOf(plottedRecord()).at(0));
  const std::string here = pdfsOf({sheet}).front();
  const char* before = std::getenv("TZ");
  const std::string kept = before == nullptr ? "" : before;
  ::setenv("TZ", "XYZ-05:30", 1);
  const std::string elsewhere = pdfsOf({sheet}).front();
  before == nullptr ? ::unsetenv("TZ") : ::setenv("TZ", kept.c_str(), 1);
  EXPECT_TRUE(elsewhere == here);
}

TEST(PlotSheet, PdfIsOnePageOfTheSizeWithoutADate) {
  const PlotSheet sheet = sheetOf(plotsOf(plottedRecord()).at(0));
  const std::string pdf = pdfsOf({sheet}).front();
  EXPECT_THAT(pdf, StartsWith("%PDF-"));
  EXPECT_THAT(pdf, HasSubstr("%%EOF"));
  EXPECT_THAT(pdf, HasSubstr("/Count 1"));
  EXPECT_THAT(pdf, HasSubstr("/CreationDate (D:19700101000000"));
  // 1000 pixels at 144 an inch are 500 points; 560 are 280.
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [ 0 0 500 280 ]"));
  ::sleep(1);  // what a date would tell apart
  EXPECT_EQ(pdf, pdfsOf({sheet}).front());
  EXPECT_EQ(svgsOf({sheet}).front(), svgsOf({sheet}).front());
  EXPECT_THAT(svgsOf({sheet}).front(), HasSubstr("<title>Error by light over the tangent plane"));
}

/// One gnuplot draws all: nothing that one plot sets reaches the next.
TEST(PlotSheet, IsTheSameBesideOthers) {
  const PlotSheet meddler{
      "x",
      "x",
      "x",
      "plots",
      300,
      200,
      "set logscale xy\nset key off\nset border 15 lc rgb '#ff0000'\nset xrange [2:3]\n"
      "set format x '%.9f'\nset style data lines\nset multiplot layout 1,2\n"
      "set encoding iso_8859_1\n"
      "$bins << EOD\n1 2\nEOD\nplot x\nplot x\nunset multiplot\n"};
  {
    const PlotSheet sheet = sheetOf(plotsOf(plottedRecord()).at(0));
    const std::vector<PlotSheet> beside = {meddler, sheet, meddler, sheet, sheet};
    for (auto* format : {&svgsOf, &pdfsOf}) {
      const std::vector<std::string> drawn = (*format)(beside);
      ASSERT_EQ(drawn.size(), beside.size());
      for (std::size_t i = 0; i < beside.size(); ++i) {
        EXPECT_EQ(drawn[i], (*format)({beside[i]}).front()) << i;
      }
    }
  }
}

TEST(PlotSheet, ErrorsAreGnuplots) {
  EXPECT_THROW((void)pdfsOf({{"x", "x", "x", "plots", 100, 100, "plot nosuch$(\n"}}),
               InternalError);
}

}  // namespace
}  // namespace gnomon::report
