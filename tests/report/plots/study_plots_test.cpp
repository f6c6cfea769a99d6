#include "report/plots/study_plots.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>

#include "common/error.h"
#include "report/plots/bin_plot.h"
#include "report/sample_record.h"

namespace gnomon::report {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
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

MethodStyles styles() {
  return MethodStyles(study::studyMeans(plottedRecord()));
}

TEST(BinPlot, DrawsEachBinsErrorAtItsPlace) {
  const std::string script = binPlot(plottedRecord(), "elevation", "camera", styles()).commands;
  // The middle, the error, the lower end and the width; open bins are as wide as their neighbours.
  EXPECT_THAT(script, HasSubstr("$m0 << EOD\n-5 5 -10 10\n5 10 0 10\n25 1 20 10\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("$m1 << EOD\n-5 NaN -10 10\n5 25 0 10\n25 10 20 10\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("set xtics ('0' 0, '10' 10, '20' 20)\n"));
  EXPECT_THAT(script, HasSubstr("set x2tics ('10.0 %%' -5, '20.0 %%' 5, '70.0 %%' 25)\n"));
  // Flips of 0.2 and 0.4 percent under the two lights.
  EXPECT_THAT(script, HasSubstr("$truth << EOD\n-10 0.3\n30 0.3\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("degrees'"));
}

TEST(BinPlot, OfSoftLightErrorsAreSharesOfTheLight) {
  study::StudyRecord record = plottedRecord();
  const auto axisOf = [&] {
    return binPlot(record, "elevation", "camera", MethodStyles(study::studyMeans(record))).commands;
  };
  EXPECT_THAT(axisOf(), HasSubstr("set ylabel 'wrong, percent of the bin’s samples'"));
  for (study::ResultRecord& row : record.results) row.shares.push_back({"mae", 0.01, {}});
  EXPECT_THAT(axisOf(), HasSubstr("set ylabel 'wrong, percent of the bin’s light'"));
}

/// 1, 2, 4, 8: each bin is as wide as the others on a logarithmic axis, those at the ends too.
TEST(BinPlot, EdgesThatGrowByOneFactorAreLogarithmic) {
  study::StudyRecord record = test::sampleRecord();
  record.bins = {bin("best", "camera", {}, 1, 5, 100), bin("best", "camera", 1, 2, 5, 100),
                 bin("best", "camera", 2, 4, 5, 100), bin("best", "camera", 4, 8, 5, 100),
                 bin("best", "camera", 8, {}, 5, 100)};
  const std::string script =
      binPlot(record, "elevation", "camera", MethodStyles(study::studyMeans(record))).commands;
  EXPECT_THAT(script, HasSubstr("set logscale x\n"));
  EXPECT_THAT(script, HasSubstr("set xrange [0.5:16]\n"));
  const std::string linear = binPlot(plottedRecord(), "elevation", "camera", styles()).commands;
  EXPECT_THAT(linear, Not(HasSubstr("set logscale")));
  EXPECT_THAT(linear, HasSubstr("set xrange [-10:30]\n"));
}

TEST(BinPlot, NamesTheViewsOfAnAxis) {
  EXPECT_THAT(binAxes(plottedRecord()), ElementsAre("elevation"));
  EXPECT_THAT(binViews(plottedRecord(), "elevation"), ElementsAre("camera", "atlas"));
  EXPECT_TRUE(binViews(plottedRecord(), "nosuch").empty());
}

/// On a plane all samples have one curvature.
TEST(BinPlot, OfOneBinThereIsNone) {
  study::StudyRecord record = plottedRecord();
  std::erase_if(record.bins, [&](const study::BinRecord& each) {
    return each.view == "camera" && each.low != record.bins.front().low;
  });
  EXPECT_THAT(binViews(record, "elevation"), ElementsAre("atlas"));
}

TEST(StudyPlots, AreNamedApartAndDrawn) {
  std::vector<std::string> names;
  for (const PlotSheet& sheet : studyPlots(plottedRecord())) {
    names.push_back(sheet.name);
    EXPECT_FALSE(sheet.about.empty());
    EXPECT_THAT(svgOf(sheet), HasSubstr("</svg>"));
  }
  EXPECT_THAT(names, ElementsAre("error-by-elevation_camera", "error-by-elevation_atlas"));
  EXPECT_TRUE(studyPlots(study::StudyRecord{}).empty());
}

TEST(PlotSheet, PdfDoesNotTellTheTimeZone) {
  const PlotSheet sheet = binPlot(plottedRecord(), "elevation", "camera", styles());
  const std::string here = pdfsOf({sheet}).front();
  const char* before = std::getenv("TZ");
  const std::string kept = before == nullptr ? "" : before;
  ::setenv("TZ", "XYZ-05:30", 1);
  const std::string elsewhere = pdfsOf({sheet}).front();
  before == nullptr ? ::unsetenv("TZ") : ::setenv("TZ", kept.c_str(), 1);
  EXPECT_TRUE(elsewhere == here);
}

TEST(PlotSheet, PdfIsOnePageOfTheSizeWithoutADate) {
  const PlotSheet sheet = binPlot(plottedRecord(), "elevation", "camera", styles());
  const std::string pdf = pdfsOf({sheet}).front();
  EXPECT_THAT(pdf, StartsWith("%PDF-"));
  EXPECT_THAT(pdf, HasSubstr("%%EOF"));
  EXPECT_THAT(pdf, HasSubstr("/Count 1"));
  EXPECT_THAT(pdf, HasSubstr("/CreationDate (D:19700101000000"));
  // 1000 pixels at 144 an inch are 500 points; 560 are 280.
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [ 0 0 500 280 ]"));
  ::sleep(1);  // what a date would tell apart
  EXPECT_EQ(pdf, pdfsOf({sheet}).front());
  EXPECT_EQ(svgOf(sheet), svgOf(sheet));
  EXPECT_THAT(svgOf(sheet), HasSubstr("<title>Error by light over the tangent plane"));
}

/// One gnuplot draws all: nothing that one plot sets reaches the next.
TEST(PlotSheet, IsTheSameBesideOthers) {
  const PlotSheet meddler{
      "x",
      "x",
      "x",
      300,
      200,
      "set logscale xy\nset key off\nset border 15 lc rgb '#ff0000'\nset xrange [2:3]\n"
      "set format x '%.9f'\nset style data lines\nset multiplot layout 1,2\n"
      "set encoding iso_8859_1\n"
      "$bins << EOD\n1 2\nEOD\nplot x\nplot x\nunset multiplot\n"};
  for (const PlotPlace place : {PlotPlace::paper, PlotPlace::phone}) {
    PlotSheet sheet = binPlot(plottedRecord(), "elevation", "camera", styles());
    sheet.place = place;
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
  EXPECT_THROW((void)pdfsOf({{"x", "x", "x", 100, 100, "plot nosuch$(\n"}}), InternalError);
}

}  // namespace
}  // namespace gnomon::report
