#include <gmock/gmock.h>

#include <limits>

#include "common/error.h"
#include "report/page/html_page.h"
#include "report/tables/latex_table.h"
#include "report/tables/table.h"
#include "report/terminal_page.h"
#include "support/lines.h"

// One table in every format.

namespace gnomon::report {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// Three rows: a figure of each kind; a name that every format must escape, and nothing known of
/// it; a name of wide letters that stands apart.
Table sample() {
  Table table{.kind = "sample",
              .label = "a/b",
              .title = "Title of <it>",
              .caption = "In 100 %.",
              .columns = {{"", "rank", Quantity::rank},
                          {"Method", "method", Quantity::name},
                          {"Error", "error_rate", Quantity::percent},
                          {"95 %", "", Quantity::interval},
                          {"Memory", "bytes", Quantity::megabytes, onPaper | asData, "MB"},
                          {"", "same", Quantity::exact, asData}},
              .apart = "Not in every case:"};
  Cell error = valueCell(0.125);
  error.emphasis = Emphasis::strong;
  table.rows = {
      {{valueCell(1), textCell("plain"), error, intervalCell(compare::Interval{-0.001, 0.25}),
        valueCell(2'500'000), flagCell(false)}},
      {{valueCell(2), textCell("a|b_& <c>"), valueCell({}, "no \"samples\""),
        intervalCell({}, "too few"), valueCell({}), flagCell(true)},
       " ≈"},
      {{valueCell({}), textCell("影の長さ"), valueCell(0.00001), intervalCell({}), valueCell(1e6),
        flagCell(false)},
       "",
       "in 1 of 2 cases",
       true}};
  table.rows[2].cells[2].mark = "*";
  return table;
}

TEST(TerminalFormat, AlignsTextsAndFigures) {
  EXPECT_THAT(test::linesOf(terminalTable(sample())),
              ElementsAre("     Method     Error             95 %",
                          "  1  plain      12.50   −0.10 to 25.00",
                          "  2  a|b_& <c>      –                – ≈",
                          "  Not in every case:",  //
                          "  –  影の長さ  <0.01*                –", "     in 1 of 2 cases"));
}

TEST(TableFormats, PrintNotesBelowTheTable) {
  Table table = sample();
  table.notes = {"? No <interval>: too few."};
  EXPECT_TRUE(terminalTable(table).ends_with("\n  ? No <interval>: too few.\n"));
  EXPECT_TRUE(markdownTable(table).ends_with("- ? No \\<interval\\>: too few.\n"));
  EXPECT_TRUE(htmlTable(table).text().ends_with(
      "</table></div>\n<p class=\"note\">? No &lt;interval&gt;: too few.</p>\n"));
  EXPECT_THAT(latexTabular(table), HasSubstr("\n% ? No <interval>: too few.\n"));
  EXPECT_EQ(csvTable(table), csvTable(sample())) << "for people alone";
}

TEST(TerminalFormat, TagsHaveColoursWhereTheyAreWanted) {
  Table table{.kind = "sample", .columns = {{"Verdict"}}};
  table.rows = {{{textCell("fail")}}};
  table.rows[0].cells[0].emphasis = Emphasis::bad;
  TerminalPage page(true);
  appendTable(page, table);
  EXPECT_THAT(page.text(), HasSubstr("\x1b[31mfail"));
  EXPECT_THAT(terminalTable(table), Not(HasSubstr("\x1b")));
}

TEST(TerminalFormat, CutsTheWidestTextUntilARowFits) {
  Table table = sample();
  table.columns.push_back({"Worst on"});
  for (Row& row : table.rows) row.cells.push_back(textCell(std::string(90, 's')));
  table.rows[0].cells[1] = textCell(std::string(90, 'm'));
  for (const std::string& line : test::linesOf(terminalTable(table))) {
    EXPECT_LE(displayWidth(line), 100U) << line;
  }
  EXPECT_THAT(terminalTable(table),
              AllOf(HasSubstr("mmm…"), HasSubstr("sss…"), HasSubstr("12.50")));
}

TEST(TerminalFormat, FiguresThatDoNotFitFollowInBlocksWithTheirNames) {
  Table table{.kind = "sample", .columns = {{"Method", "", Quantity::name}}};
  Row row{{textCell(std::string(80, 'm'))}};
  for (int i = 0; i < 30; ++i) {
    table.columns.push_back({std::to_string(i), "", Quantity::percent});
    row.cells.push_back(valueCell(0.01 * i));
  }
  table.rows = {row};
  const std::vector<std::string> lines = test::linesOf(terminalTable(table));
  // 98 columns less 30 of names have 9 figures of 7 columns each.
  ASSERT_EQ(lines.size(), 4U * 3 - 1);
  std::size_t names = 0;
  for (const std::string& line : lines) {
    EXPECT_LE(displayWidth(line), 100U) << line;
    names += line.find("mmm") == std::string::npos ? 0 : 1;
  }
  EXPECT_EQ(names, 4U);
  for (const Cell& cell : row.cells) {
    if (cell.value) {
      EXPECT_THAT(terminalTable(table), HasSubstr(" " + cellText(Quantity::percent, cell)));
    }
  }
}

TEST(HtmlFormat, EscapesAndSaysWhyThereIsNothing) {
  const std::string html = htmlTable(sample()).text();
  EXPECT_THAT(
      html,
      AllOf(
          HasSubstr("<table class=\"sample\">"),
          HasSubstr(
              "<th><span class=\"unseen\">rank</span></th><th>Method</th><th class=\"n\"><button "),
          HasSubstr("<td class=\"rank\">1</td><td class=\"method\">plain</td>"
                    "<td class=\"n\"><b>12.50</b></td>"),
          HasSubstr("<td class=\"method\">a|b_&amp; &lt;c&gt; ≈</td>"
                    "<td class=\"n\" title=\"no &quot;samples&quot;\">–</td>"
                    "<td class=\"n\" title=\"too few\">–</td>"),
          HasSubstr("影の長さ<small class=\"same\">in 1 of 2 cases</small>"),
          HasSubstr("&lt;0.01*</td>")));
  EXPECT_THAT(html, Not(HasSubstr("MB"))) << "a column for paper";
}

TEST(CsvFormat, HoldsExactNumbersAndEmptyCells) {
  EXPECT_THAT(test::linesOf(csvTable(sample())),
              ElementsAre("rank,method,error_rate,low,high,bytes,same",
                          "1,plain,0.125,-0.001,0.25,2500000,0",  //
                          "2,a|b_& <c>,,,,,1",                    //
                          ",影の長さ,1e-05,,,1000000,0"));
}

/// 200 points of 10: headings break first, then names, and numbers never.
TEST(LatexFormat, BreaksHeadingsThenNamesUntilItFits) {
  Table table{.kind = "sample",
              .columns = {{"Method", "", Quantity::name},
                          {"False shadow", "", Quantity::percent},
                          {"False light", "", Quantity::percent},
                          {"95 %", "", Quantity::interval}}};
  const auto rowOf = [](const std::string& name) {
    return Row{{textCell(name), valueCell(0.5), valueCell(0.25),
                intervalCell(compare::Interval{0.1, 0.2})}};
  };
  table.rows = {rowOf("short-name")};
  const TabularRoom room{inColumn, 200, 10};
  EXPECT_THAT(latexTabular(table, room),
              HasSubstr("   & False  & False  &  \\\\\n  Method & shadow & light & 95 \\% \\\\\n"));
  EXPECT_THAT(latexTabular(table, room), HasSubstr("  short-name & 50.00 & 25.00 & 10.00--20.00"));
  EXPECT_TRUE(fitsTabular(table, room));
  table.rows.push_back(rowOf("a_long/name-with-parts, and-an" + std::string(30, 'm')));
  const std::string broken = latexTabular(table, room);
  EXPECT_THAT(broken, HasSubstr("{@{}p{"));
  EXPECT_THAT(broken,
              HasSubstr("em a\\_\\allowbreak{}long/\\allowbreak{}name-with-parts, and-anm"));
  EXPECT_THAT(broken, HasSubstr("m\\dots{} & 50.00 &")) << "a part that is wider than its column";
  EXPECT_TRUE(fitsTabular(table, room));
  for (int i = 0; i < 9; ++i) {
    table.columns.push_back({"n", "", Quantity::percent});
    for (Row& row : table.rows) row.cells.push_back(valueCell(0.5));
  }
  EXPECT_FALSE(fitsTabular(table, room)) << "numbers stay whole";
}

TEST(LatexFormat, AnIntervalWithASignKeepsItsWord) {
  Table table{.kind = "sample",
              .columns = {{"a", "", Quantity::name}, {"95 %", "", Quantity::interval}}};
  table.rows = {{{textCell("x"), intervalCell(compare::Interval{-0.01, 0.02})}}};
  EXPECT_THAT(latexTabular(table), HasSubstr("x & $-$1.00 to 2.00"));
  EXPECT_THAT(latexTabular(table, {onPaper, 500, 9}), HasSubstr("to"));
}

TEST(MarkdownFormat, IsATableOfGitHub) {
  EXPECT_EQ(markdownTable(sample()),
            "**Title of \\<it\\>**. In 100 %.\n\n"
            "|  | Method | Error | 95 % | Memory, MB |\n"
            "| --- | --- | --: | --: | --: |\n"
            "| 1 | plain | **12.50** | −0.10 to 25.00 | 2.50 |\n"
            "| 2 | a\\|b\\_\\& \\<c\\> ≈ | – | – | – |\n"
            "| – | 影の長さ | \\<0.01\\* | – | 1.00 |\n"
            "\n- 影の長さ: in 1 of 2 cases.\n");
}

TEST(TableFormats, EachPrintsAnyTableOrRefusesIt) {
  Table broken = sample();
  broken.rows[0].cells[2].value = std::numeric_limits<double>::quiet_NaN();
  Table ragged = sample();
  ragged.rows[1].cells.pop_back();
  Table empty{.kind = "empty", .columns = {{"Method", "method", Quantity::name}}};
  std::size_t files = 0;
  for (const TableFormat& format : tableFormats()) {
    EXPECT_THAT(format.print(sample()), HasSubstr("影の長さ")) << format.name;
    EXPECT_THAT(format.print(empty), ::testing::ContainsRegex("[Mm]ethod")) << format.name;
    EXPECT_THROW((void)format.print(broken), InternalError) << format.name;
    EXPECT_THROW((void)format.print(ragged), InternalError) << format.name;
    files += format.isFile ? 1 : 0;
  }
  EXPECT_EQ(files, 2U);
}

const ErrorBar whole{0.04, 0.01, 0.03, 0.005, compare::Interval{0.02, 0.08}, 0.1};

TEST(ErrorBar, StandsToScale) {
  const std::string svg = htmlErrorBar(whole).text();
  EXPECT_THAT(svg, HasSubstr("class=\"shadow\" x=\"0.00\" y=\"4\" width=\"100.00\""));
  EXPECT_THAT(svg, HasSubstr("class=\"light\" x=\"100.00\" y=\"4\" width=\"300.00\""));
  EXPECT_THAT(svg, HasSubstr("class=\"truth\" x=\"350.00\" y=\"1\" width=\"100.00\""));
  EXPECT_THAT(svg, HasSubstr("<line x1=\"200.00\" x2=\"800.00\""));
}

TEST(ErrorBar, LeavesOutWhatIsNotKnown) {
  ErrorBar bar = whole;
  bar.interval.reset();
  bar.uncertainty.reset();
  EXPECT_THAT(htmlErrorBar(bar).text(), Not(HasSubstr("<line")));
  EXPECT_THAT(htmlErrorBar(bar).text(), Not(HasSubstr("truth")));
  bar.scale = 0;
  EXPECT_TRUE(htmlErrorBar(bar).empty());
}

}  // namespace
}  // namespace gnomon::report
