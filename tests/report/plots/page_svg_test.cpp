#include "report/plots/page_svg.h"

#include <gmock/gmock.h>

#include <pugixml.hpp>

#include "common/error.h"
#include "report/page/html_page.h"
#include "report/plots/bin_plot.h"
#include "report/plots/plot_style.h"
#include "report/sample_record.h"

namespace gnomon::report {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

study::StudyRecord plotted(const std::string& best = "best") {
  study::StudyRecord record = test::sampleRecord();
  record.methods.push_back({best, best, "", "", {"march", "circle"}});
  for (const auto& [low, wrong] : {std::pair(0, 5), std::pair(10, 20)}) {
    record.bins.push_back(
        {best, "camera", "all", "elevation", low, low + 10.0, test::countsOf(100, wrong, 0)});
  }
  return record;
}

PlotSheet sheetOf(const study::StudyRecord& record, PlotPlace place) {
  return binPlot(record, "elevation", "camera", MethodStyles(study::studyMeans(record)), place);
}

pugi::xml_document pageOf(const PlotSheet& sheet) {
  pugi::xml_document page;
  EXPECT_TRUE(page.load_string(pageSvg(svgOf(sheet), sheet).text().c_str()));
  return page;
}

std::vector<std::string> valuesOf(const pugi::xml_document& page) {
  std::vector<std::string> words;
  for (const auto& found : page.select_nodes("//g[@class='value']/title")) {
    words.emplace_back(found.node().child_value());
  }
  return words;
}

TEST(PageSvg, HasEveryValueInWordsAtItsPlace) {
  for (const PlotPlace place : {PlotPlace::page, PlotPlace::phone}) {
    const pugi::xml_document page = pageOf(sheetOf(plotted(), place));
    EXPECT_THAT(valuesOf(page),
                ElementsAre("best: 5.00 % wrong, light over the tangent plane 0 to 10",
                            "best: 20.00 % wrong, light over the tangent plane 10 to 20"));
    // Each lies on the symbol that the curve has there.
    for (const auto& found : page.select_nodes("//g[@class='value']/use")) {
      const std::string at = found.node().attribute("transform").value();
      const std::string corner = at.substr(0, at.find(')'));
      const std::string symbol = "//use[starts-with(@transform, '" + corner + "')]";
      EXPECT_EQ(page.select_nodes(symbol.c_str()).size(), 2U) << at;
    }
  }
}

TEST(PageSvg, TakesThePagesColours) {
  const PlotSheet sheet = sheetOf(plotted(), PlotPlace::page);
  const std::string svg = pageSvg(svgOf(sheet), sheet).text();
  EXPECT_THAT(svg, HasSubstr("\"var(--plot-ink)\""));
  EXPECT_THAT(svg, HasSubstr("\"var(--plot-band)\""));
  const std::string own = MethodStyles(study::studyMeans(plotted())).variable("best");
  EXPECT_THAT(svg, HasSubstr("\"var(--plot-" + own + ")\""));
  EXPECT_THAT(svg, HasSubstr("data-method=\"" + own + "\""));
  EXPECT_THAT(svg, Not(HasSubstr("rgb(")));
  EXPECT_THAT(svg, Not(HasSubstr("#ffffff")));
  EXPECT_THAT(methodProperties(sheet), HasSubstr("--plot-method0:var(--plot-"));
  // A figure of shades has its own.
  PlotSheet shaded = sheet;
  shaded.isShaded = true;
  EXPECT_THAT(pageSvg(svgOf(shaded), shaded).text(), HasSubstr("rgb("));
}

TEST(PageSvg, OnPaperThereAreNoValuesAndTheColoursAreWhites) {
  const PlotSheet sheet = sheetOf(plotted(), PlotPlace::paper);
  EXPECT_THAT(svgOf(sheet), Not(HasSubstr("showHypertext")));
  EXPECT_THAT(svgOf(sheet), HasSubstr("rgb(26,29,33)"));
}

TEST(PageSvg, NoLabelBecomesMarkup) {
  const std::string hostile = "</title><script>x()</script>\" onload='x'\u202e";
  const PlotSheet sheet = sheetOf(plotted(hostile), PlotPlace::page);
  const std::string svg = pageSvg(svgOf(sheet), sheet).text();
  EXPECT_THAT(svg, Not(HasSubstr("<script")));
  EXPECT_THAT(svg, Not(HasSubstr("onmousemove")));
  EXPECT_THAT(svg, Not(HasSubstr("onload='")));
  EXPECT_THAT(svg, Not(HasSubstr("\u202e")));
  EXPECT_THAT(svg, HasSubstr("&lt;script&gt;"));
}

TEST(PageSvg, RefusesWhatIsNoSvg) {
  EXPECT_THROW((void)pageSvg("<svg", {}), InternalError);
  EXPECT_THROW((void)plotSymbols("no"), InternalError);
}

TEST(HtmlPlot, HasBothDrawingsALegendAndATable) {
  const study::StudyRecord record = plotted();
  DrawnPlot plot{sheetOf(record, PlotPlace::page), "", sheetOf(record, PlotPlace::phone), ""};
  plot.svg = svgOf(plot.sheet);
  plot.narrowSvg = svgOf(plot.narrow);
  const std::string html = htmlPlot(plot).text();
  EXPECT_THAT(html, HasSubstr("viewBox=\"0 0 1000 430\""));
  EXPECT_THAT(html, HasSubstr("viewBox=\"0 0 380 360\""));
  EXPECT_THAT(html, HasSubstr("<button type=\"button\" data-method=\"method"));
  EXPECT_THAT(html, HasSubstr(bandLegend));
  EXPECT_THAT(html, HasSubstr("<table class=\"values\""));
  EXPECT_THAT(html, HasSubstr("20.00"));
  // Every shape that is used is one of the page's.
  const std::string symbols = plotSymbols(plot.svg).text();
  EXPECT_THAT(symbols, HasSubstr("id=\"gpPt6\""));
  EXPECT_THAT(symbols, Not(HasSubstr("xlink")));
}

}  // namespace
}  // namespace gnomon::report
