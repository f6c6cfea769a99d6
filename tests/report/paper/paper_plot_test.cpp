#include "report/paper/paper_plot.h"

#include <gmock/gmock.h>
#include <unistd.h>

namespace gnomon::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

PlotSheet sheet() {
  PlotSheet made;
  made.name = "errors";
  made.commands =
      "$a << EOD\n0 1\n1 -2\nEOD\n"
      "set lmargin at screen 0.4\nset key outside right\nset xtics font ',3'\n"
      "set xlabel 'a_b & 50 % {x} $y$' font ',3'\nset ylabel '\\input{x}'\n"
      "plot $a using 1:2 with linespoints pt 7 dt 2 lc rgb '#0072b2' title 'first', \\\n"
      "  $a using 1:(0):(0):2 with vectors heads size graph 0.01,90 notitle, \\\n"
      "  $a using 1:2 with filledcurves y1=0 fc rgb '#c8c8c8' title 'the second'\n";
  return made;
}

PaperFigure figure(PaperWidth width = PaperWidth::column) {
  return paperFigure(sheet(), width, 9).value();
}

TEST(PaperFigure, HasItsLegendBelowAndOneSizeOfText) {
  const std::string& commands = figure().commands;
  const std::size_t plot = commands.find("plot $a");
  ASSERT_NE(plot, std::string::npos);
  EXPECT_GT(commands.find("set key at screen"), commands.find("set key outside right"));
  EXPECT_LT(commands.find("set key at screen"), plot);
  EXPECT_GT(commands.find("set lmargin\n"), commands.find("set lmargin at screen"));
  EXPECT_GT(commands.find("set xtics font ',9'"), commands.find("set xtics font ',3'"));
  EXPECT_THAT(paperFigure(sheet(), PaperWidth::column, 7.5)->commands,
              HasSubstr("set ylabel font ',7.5'"));
  EXPECT_THAT(commands, Not(HasSubstr("x2tics"))) << "the page has no upper axis";
  EXPECT_EQ(figure().width, 84);
  EXPECT_EQ(figure(PaperWidth::page).width, 178);
}

/// One line of a legend a method, where labels are as long as a column is wide; longer
/// ones are cut.
TEST(PaperFigure, IsAsHighAsItsLegendNeeds) {
  PlotSheet longer = sheet();
  const std::string label(40, 'm');
  for (const char* title : {"first", "the second"}) {
    longer.commands.replace(longer.commands.find(title), std::string(title).size(), label);
  }
  const double line = 1.3 * 9 / pointsOfMillimetre;
  const PaperFigure higher = paperFigure(longer, PaperWidth::column, 9).value();
  EXPECT_NEAR(higher.height - figure().height, line, 1e-9);
  EXPECT_THAT(higher.commands, HasSubstr("mmm…'"));
  EXPECT_THAT(higher.commands, Not(HasSubstr(label)));
  EXPECT_THAT(paperFigure(longer, PaperWidth::page, 9)->commands, HasSubstr(label));
}

TEST(PaperFigure, IsTheFirstPanelOfSeveral) {
  PlotSheet panels = sheet();
  panels.commands = "set multiplot\n" + panels.commands + "unset key\nplot x\nunset multiplot\n";
  const PaperFigure first = paperFigure(panels, PaperWidth::column, 9).value();
  EXPECT_EQ(first.commands, figure().commands);
  panels.isForPaper = false;
  EXPECT_FALSE(paperFigure(panels, PaperWidth::column, 9));
  PlotSheet bare = sheet();
  bare.commands = "plot x notitle\n";
  EXPECT_FALSE(paperFigure(bare, PaperWidth::column, 9)) << "no legend";
}

TEST(PaperPdfs, AreOfTheirWidthAndTheSameBytes) {
  const std::string pdf = paperPdfs({figure()}).front();
  EXPECT_THAT(pdf, HasSubstr("/CreationDate (D:19700101000000"));
  // 84 and 178 mm are 238.1 and 504.6 of PDF's points.
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [ 0 0 238 "));
  EXPECT_THAT(paperPdfs({figure(PaperWidth::page)}).front(), HasSubstr("/MediaBox [ 0 0 504 "));
  ::sleep(1);  // what a date would tell apart
  EXPECT_EQ(paperPdfs({figure(PaperWidth::page), figure()}).back(), pdf);
  EXPECT_TRUE(paperPdfs({}).empty());
}

}  // namespace
}  // namespace gnomon::report
