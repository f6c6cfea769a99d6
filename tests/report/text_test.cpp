#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <limits>
#include <set>
#include <string>
#include <type_traits>

#include "common/error.h"
#include "common/text.h"
#include "report/json/json_values.h"
#include "report/plots/gnuplot.h"
#include "report/tables/cost_table.h"
#include "report/tables/latex_table.h"
#include "report/tables/table.h"
#include "report/terminal_page.h"
#include "report/terminal_report.h"
#include "report/text/html.h"
#include "report/text/number_text.h"
#include "sample_check.h"
#include "truth/region.h"

// What a name may do to each kind of text that it stands in.

namespace gnomon::report {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(Glossary, ExplainsEachTermOnceInASentenceOrTwo) {
  std::set<std::string_view> names;
  for (const Term& term : glossary()) {
    EXPECT_TRUE(names.insert(term.name).second) << term.name;
    EXPECT_TRUE(term.meaning.ends_with('.')) << term.name;
    EXPECT_LT(term.meaning.size(), 280U) << term.name;
    EXPECT_EQ(glossary()[findTerm(term.name).value()].name, term.name);
  }
}

TEST(Glossary, HasEveryRegionAndTheReferenceOfCosts) {
  for (const std::string& region : truth::allRegions({})) EXPECT_TRUE(findTerm(region)) << region;
  EXPECT_TRUE(findTerm("all"));
  EXPECT_TRUE(findTerm("To " + std::string(costReference)));
  EXPECT_EQ(findTerm("≈"), findTerm("not distinguishable"));
  EXPECT_FALSE(findTerm("no such word"));
}

TEST(TermsHtml, ListsTheWordsThatAPageUsesAndNoOther) {
  const Html page = htmlTerm("IoU") + htmlHeading("Method") + htmlTerm("truth", "the <right> one");
  EXPECT_THAT(page.text(), HasSubstr(">the &lt;right&gt; one</button>"));
  EXPECT_THAT(page.text(), HasSubstr("</button>Method<button"));
  const std::string list = htmlGlossary(page).text();
  EXPECT_THAT(list, HasSubstr("<dt>IoU</dt>"));
  EXPECT_THAT(list, HasSubstr("<dt>truth</dt>"));
  EXPECT_THAT(list, Not(HasSubstr("<dt>BER</dt>")));
  EXPECT_TRUE(htmlGlossary(htmlHeading("Method")).empty());
  EXPECT_THROW(htmlTerm("no such word"), InternalError);
}

// Text that nobody escaped is no HTML: to put it into a page does not compile.
static_assert(!std::is_constructible_v<Html, std::string>);
static_assert(!std::is_constructible_v<Html, const char*>);
static_assert(!std::is_convertible_v<std::string, HtmlLiteral>);
static_assert(!std::is_assignable_v<Html&, std::string>);

TEST(EscapeHtml, LeavesUtf8AndShowsWhereElseWas) {
  EXPECT_EQ(escapeHtml("30° ≥ κ").text(), "30° ≥ κ");
  EXPECT_EQ(escapeHtml(std::string("a\0b\x1b\tc\n", 7)).text(), "a\uFFFDb\uFFFD\tc\n");
  EXPECT_EQ(escapeHtml("\xff|\xc3(|\u202e|\xc2\x85").text(), "\uFFFD|\uFFFD(|\uFFFD|\uFFFD");
  EXPECT_EQ(escapeHtml("<a href='x' title=\"y\">&").text(),
            "&lt;a href=&#39;x&#39; title=&quot;y&quot;&gt;&amp;");
}

TEST(Html, EscapesTextOfAPatternAndLeavesHtmlAsItIs) {
  const std::string name = "<b> & \"c\"";
  const Html inner = html("<i>{}</i>", name);
  EXPECT_EQ(inner.text(), "<i>&lt;b&gt; &amp; &quot;c&quot;</i>");
  EXPECT_EQ(html("<p title=\"{1}\">{0}</p>", inner, name).text(),
            "<p title=\"&lt;b&gt; &amp; &quot;c&quot;\">" + inner.text() + "</p>");
  EXPECT_EQ(html("{:.2f} {}", 1.005, 7U).text(), "1.00 7");
  EXPECT_EQ((inner + html("{{}}")).text(), inner.text() + "{}");
  EXPECT_EQ(htmlLiteral("<a>{}").text(), "<a>{}");
  EXPECT_TRUE(Html().empty());
}

TEST(Html, APicturesAddressIsItsBytes) {
  EXPECT_EQ(pictureAddress("image/png", "<&>").text(), "data:image/png;base64,PCY+");
}

TEST(EscapeLatex, EscapesEachOfItsOwn) {
  EXPECT_EQ(escapeLatex("\\ & % $ # _ { } ~ ^"),
            "\\textbackslash{} \\& \\% \\$ \\# \\_ \\{ \\} \\textasciitilde{} "
            "\\textasciicircum{}");
  EXPECT_EQ(escapeLatex("30° – é 影\n"), "30$^\\circ$ -- é 影 ");
}

TEST(EscapeLatex, NeedsNoEncodingOfItsOwn) {
  EXPECT_EQ(escapeLatex("\"a\"|b"), "\\char34{}a\\char34{}\\textbar{}b");
}

TEST(BreakableParts, EndBehindSpacesHyphensAndTheirLike) {
  EXPECT_THAT(breakableParts("sloan-cohen, 32 azimuths"),
              ElementsAre("sloan-", "cohen, ", "32 ", "azimuths"));
  EXPECT_THAT(breakableParts("a/b_c:--d"), ElementsAre("a/", "b_", "c:--", "d"));
  EXPECT_THAT(breakableParts("-x"), ElementsAre("-", "x"));
  EXPECT_THAT(breakableParts(""), IsEmpty());
}

/// The widths that TeX tells of cmr9, in units of its 9 points: its characters are wider for their
/// size than those of cmr10 and of Times.
TEST(LatexWidth, BoundsComputerModern) {
  EXPECT_GE(latexWidth("resampled-horizon"), 73.586 / 9);
  EXPECT_GE(latexWidth("10.25–12.61"), 46.764 / 9);
  EXPECT_GE(latexWidth("Memory"), 33.426 / 9);
  EXPECT_GE(latexWidth("a a"), 12.334 / 9);
  EXPECT_GE(latexWidth("mW…"), (7.709 + 9.506 + 12.334) / 9);
  EXPECT_LE(latexWidth("resampled-horizon"), 1.15 * 73.586 / 9);
}

TEST(NumberText, PercentHasTwoDecimals) {
  EXPECT_EQ(percentText(0.098), "9.80");
  EXPECT_EQ(percentText(1.0), "100.00");
  EXPECT_EQ(percentText(0.00005), "0.01");
}

TEST(NumberText, OnlyZeroReadsAsZero) {
  EXPECT_EQ(percentText(0.0), "0.00");
  EXPECT_EQ(percentText(0.00004), "<0.01");
  EXPECT_EQ(percentText(1e-300), "<0.01");
}

TEST(NumberText, OnlyAllReadsAsAll) {
  EXPECT_EQ(percentText(0.99996), ">99.99");
  EXPECT_EQ(percentText(0.9999), "99.99");
  EXPECT_EQ(correlationText(1.0), "1.000");
  EXPECT_EQ(correlationText(0.99951), ">0.999");
  EXPECT_EQ(correlationText(0.9994), "0.999");
  EXPECT_EQ(correlationText(-0.99951), "<−0.999");
  EXPECT_EQ(correlationText(-1.0), "−1.000");
  EXPECT_EQ(correlationText(-0.25), "−0.250");
  EXPECT_EQ(correlationText(-1e-9), "0.000");
}

TEST(NumberText, SignsShares) {
  EXPECT_EQ(signedPercent(0.0123), "+1.23");
  EXPECT_EQ(signedPercent(-0.0123), "−1.23");
  EXPECT_EQ(signedPercent(0), "0.00");
  EXPECT_EQ(signedPercent(-1e-6), "−<0.01");
}

TEST(NumberText, RatiosHaveTwoDecimals) {
  EXPECT_EQ(ratioText(1.0), "1.00");
  EXPECT_EQ(ratioText(12.346), "12.35");
  EXPECT_EQ(ratioText(0.0), "0.00");
  EXPECT_EQ(ratioText(0.004), "<0.01");
  EXPECT_THROW(ratioText(std::numeric_limits<double>::infinity()), InternalError);
}

TEST(NumberText, UndefinedIsADash) {
  EXPECT_EQ(ratioText(std::nullopt), "–");
  EXPECT_EQ(percentText(std::nullopt), "–");
  EXPECT_EQ(correlationText(std::nullopt), "–");
}

TEST(NumberText, NotFiniteIsAnError) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_THROW(percentText(nan), InternalError);
  EXPECT_THROW(exactText(infinite), InternalError);
  EXPECT_THROW(requireFinite(-infinite, "x"), InternalError);
  EXPECT_EQ(requireFinite(-1.5, "x"), -1.5);
}

TEST(NumberText, ThousandsAreApart) {
  EXPECT_EQ(groupedText(0), "0");
  EXPECT_EQ(groupedText(999), "999");
  EXPECT_EQ(groupedText(1000), "1\u202f000");
  EXPECT_EQ(groupedText(33'554'432), "33\u202f554\u202f432");
}

TEST(TextWidth, CountsTerminalColumns) {
  EXPECT_EQ(displayWidth(""), 0U);
  EXPECT_EQ(displayWidth("shadow"), 6U);
  EXPECT_EQ(displayWidth("κ ≥ 30°"), 7U);
  EXPECT_EQ(displayWidth("影"), 2U);       // wide
  EXPECT_EQ(displayWidth("e\u0301"), 1U);  // e and a combining accent
}

TEST(TextWidth, FitsExactly) {
  EXPECT_EQ(fitLeft("ab", 4), "ab  ");
  EXPECT_EQ(fitRight("ab", 4), "  ab");
  EXPECT_EQ(fitLeft("abcd", 4), "abcd");
  EXPECT_EQ(fitLeft("abcde", 4), "abc…");
  EXPECT_EQ(fitLeft("30° sun", 4), "30°…");
  EXPECT_EQ(fitRight("–", 3), "  –");
  EXPECT_EQ(fitLeft("影影影", 4), "影… ");
  EXPECT_EQ(fitLeft("ab", 0), "");
  EXPECT_EQ(fitLeft("ab", 1), "…");
}

TEST(TextWidth, NothingCanMoveTheCursor) {
  EXPECT_EQ(fitLeft("a\x1b[2Jb", 6), "a?[2Jb");
  EXPECT_EQ(fitLeft("a\nb", 3), "a?b");
  EXPECT_EQ(fitLeft(std::string("a\0b", 3), 3), "a?b");
  EXPECT_EQ(fitLeft("a\xff", 2), "a\uFFFD");
  EXPECT_EQ(fitLeft("a\xe2\x82", 4), "a\uFFFD\uFFFD ");  // cut within a character
}

TEST(TextWidth, WrapsAtSpaces) {
  using Wrapped = std::vector<std::string>;
  EXPECT_EQ(wrapText("one two three", 7), (Wrapped{"one two", "three"}));
  EXPECT_EQ(wrapText("one two three", 6), (Wrapped{"one", "two", "three"}));
  EXPECT_EQ(wrapText("  much   space ", 20), (Wrapped{"much space"}));
  EXPECT_EQ(wrapText("unbreakable", 4), (Wrapped{"unbr", "eaka", "ble"}));
  EXPECT_EQ(wrapText("a unbreakable", 4), (Wrapped{"a", "unbr", "eaka", "ble"}));
  EXPECT_EQ(wrapText("", 4), Wrapped{});
  EXPECT_EQ(wrapText("   ", 4), Wrapped{});
}

/// A line of a CSV file that holds these texts.
std::string csvLine(const std::vector<std::string>& texts) {
  Table table{.kind = "test", .columns = {}};
  Row row;
  for (const std::string& text : texts) {
    table.columns.push_back({"c"});
    row.cells.push_back(textCell(text));
  }
  table.rows.push_back(row);
  const std::string csv = csvTable(table);
  return csv.substr(csv.find('\n') + 1);
}

TEST(CsvTable, MakesTextOfWhatASpreadsheetWouldCompute) {
  EXPECT_EQ(csvLine({"=1+1", "+x", "-x", "@x", "＝x", "a=b"}), "'=1+1,'+x,'-x,'@x,'＝x,a=b\n");
  EXPECT_EQ(csvLine({"\t=1", "\r=1", "=\"a\",b"}), "'\t=1,\"'\r=1\",\"'=\"\"a\"\",b\"\n");
}

TEST(CsvTable, LeavesNumbersNumbers) {
  EXPECT_EQ(csvLine({"-0.5", "-1e-05", "0", "", "-5 %"}), "-0.5,-1e-05,0,,'-5 %\n");
}

TEST(CsvTable, HoldsUtf8Alone) {
  EXPECT_EQ(csvLine({"\xff=1", "a\x1b[2J\u202e"}), "\uFFFD=1,a\uFFFD[2J\uFFFD\n");
}

TEST(EscapeLatex, KeepsARowsBeginningFromTheRowBefore) {
  EXPECT_EQ(escapeLatex("[2pt] x"), "{[}2pt] x");
  EXPECT_EQ(escapeLatex("*x"), "{*}x");
  EXPECT_EQ(escapeLatex("  [x]"), "{[}x]");
  EXPECT_EQ(escapeLatex("a [x] *"), "a [x] *");
  EXPECT_EQ(escapeLatex(""), "");
  EXPECT_EQ(escapeLatex("   "), "   ");
}

TEST(EscapeLatex, HoldsWhatLatexKnows) {
  EXPECT_EQ(escapeLatex("a\nb\x1b[0m\xff\u202e"), "a b [0m??");
  EXPECT_EQ(escapeLatex("--fast"), "-{}-{}fast") << "no dash of another kind";
}

TEST(EscapeMarkdown, LeavesNothingThatMarksUpOrNotifies) {
  EXPECT_EQ(escapeMarkdown("a|b\nc"), "a\\|b c") << "a row stays a row";
  EXPECT_EQ(escapeMarkdown("*a* _b_ `c` [d](e)"), "\\*a\\* \\_b\\_ \\`c\\` \\[d\\]\\(e\\)");
  EXPECT_EQ(escapeMarkdown("<img src=x>&lt;"), "\\<img src=x\\>\\&lt;");
  EXPECT_EQ(escapeMarkdown("@team #12 \\"), "@<!-- -->team #<!-- -->12 \\\\");
  EXPECT_EQ(escapeMarkdown("κ ≥ 30°\x1b[0m\xff"), "κ ≥ 30° \\[0m\uFFFD");
}

TEST(PlainJson, ReadsBackAsTheSameString) {
  for (const char* text :
       {"\x1b[2J", "\u202epass", "##[error]x", "a\u2028b\xc2\x9b", "]]>", "κ ##"}) {
    const std::string written = plainJson(Json{{"label", text}}, 2);
    EXPECT_EQ(Json::parse(written).at("label"), text);
    EXPECT_THAT(written, Not(HasSubstr("##[")));
    for (std::string_view rest = written; !rest.empty();) {
      const Utf8Character character = firstCharacter(rest);
      EXPECT_TRUE(character.valid && !reversesText(character.code)) << written;
      EXPECT_TRUE(character.code == '\n' || !isControl(character.code)) << written;
      rest.remove_prefix(character.bytes);
    }
  }
  EXPECT_EQ(plainJson(Json{{"a", "\xff"}}, -1), "{\"a\":\"\uFFFD\"}");
  EXPECT_EQ(plainJson(Json{{"a", {1, 2.5, nullptr, "°"}}}, -1), "{\"a\":[1,2.5,null,\"°\"]}");
}

TEST(StyledSvg, IsWellFormedWhateverALabelHolds) {
  const std::string svg = styledSvg(
      runGnuplot("set encoding utf8\nset terminal svg noenhanced\nset title " +
                 gnuplotText("]]> <&\xff\u202e\x01") + "\nplot x title " + gnuplotText("a]]>b")),
      "t]]>", "");
  EXPECT_THAT(svg, Not(HasSubstr("]]>")));
  EXPECT_EQ(xmlText(svg), svg);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg.c_str()));
  EXPECT_THAT(svg, HasSubstr("]]&gt; &lt;&amp;"));
}

TEST(RunGnuplot, HearsNothingOfTheUsersVariables) {
  const std::string script =
      "set print '-'\nprint GPVAL_TERM, system('echo "
      "\"$GNUTERM|$GDFONTPATH|$FONTCONFIG_FILE|$LANG\"')";
  const std::string before = runGnuplot(script);
  EXPECT_THAT(before, HasSubstr("|||"));
  const std::vector<const char*> names = {"GNUTERM", "GDFONTPATH", "FONTCONFIG_FILE", "LANG"};
  for (const char* name : names) setenv(name, "nonsense", 1);
  const std::string during = runGnuplot(script);
  for (const char* name : names) unsetenv(name);
  EXPECT_EQ(during, before);
}

TEST(TerminalPage, KeepsItsOwnStylesAlone) {
  TerminalPage plain(false);
  plain.line("a\x1b[31mb\nc\u202e\xff");
  EXPECT_EQ(plain.text(), "a?[31mb?c\uFFFD\uFFFD\n");
  TerminalPage coloured(true);
  coloured.line("a\x1b[2J\x1b[1" + coloured.styled("b\x1b[31mc", "32") + "\x1b]0;title\x07");
  EXPECT_EQ(coloured.text(), "a?[2J?[1\x1b[32mb?[31mc\x1b[0m?]0;title?\n");
}

TEST(CheckTable, HasTheCommandOnOneLine) {
  study::CheckRecord check = test::sampleCheck();
  check.command = "gnomon check 'a\n::error::x\x1b[1m'";
  for (const bool colours : {false, true}) {
    EXPECT_THAT(checkTable(check, colours), HasSubstr("gnomon check 'a?::error::x?[1m'\n"));
  }
}

}  // namespace
}  // namespace gnomon::report
