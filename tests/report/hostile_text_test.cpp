#include <gmock/gmock.h>

#include <pugixml.hpp>

#include "common/text/utf8.h"
#include "report/ci/terminal_check.h"
#include "report/json/json_values.h"
#include "report/plots/gnuplot.h"
#include "report/tables/formats/csv_format.h"
#include "report/tables/formats/markdown_format.h"
#include "report/text/latex_text.h"
#include "report/text/terminal_page.h"
#include "report/text/utf8_text.h"
#include "sample_check.h"

// What a name may do to each kind of text that it stands in.

namespace gnomon::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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
      EXPECT_TRUE(character.valid && !turnsDirection(character.code)) << written;
      EXPECT_TRUE(character.code == '\n' || !isControl(character.code)) << written;
      rest.remove_prefix(character.bytes);
    }
  }
  EXPECT_EQ(plainJson(Json{{"a", "\xff"}}, -1), "{\"a\":\"\uFFFD\"}");
  EXPECT_EQ(plainJson(Json{{"a", {1, 2.5, nullptr, "°"}}}, -1), "{\"a\":[1,2.5,null,\"°\"]}");
}

TEST(CleanSvg, IsWellFormedWhateverALabelHolds) {
  const std::string svg = cleanSvg(
      runGnuplot("set encoding utf8\nset terminal svg noenhanced\nset title " +
                 gnuplotText("]]> <&\xff\u202e\x01") + "\nplot x title " + gnuplotText("a]]>b")),
      "t]]>");
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
