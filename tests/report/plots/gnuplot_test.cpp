#include "report/plots/gnuplot.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <future>

#include "common/error.h"
#include "support/error_messages.h"

namespace gnomon::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// What gnuplot prints for a string expression.
std::string printed(const std::string& expression) {
  return runGnuplot("set print '-'\nprint " + expression + "\n");
}

TEST(Gnuplot, GivesWhatTheScriptWrites) {
  EXPECT_EQ(printed("1 + 2"), "3\n");
  EXPECT_EQ(runGnuplot(""), "");
}

TEST(Gnuplot, TakesAScriptThatIsLongerThanAnyPipe) {
  const std::string comment(1'000'000, '#');
  EXPECT_EQ(runGnuplot(comment + "\nset print '-'\nprint 7\n"), "7\n");
  EXPECT_EQ(printed("system(\"head -c 300000 /dev/zero | tr '\\\\0' x\")").size(), 300'001U);
}

TEST(Gnuplot, ErrorsAreOneLine) {
  EXPECT_THAT(messageOf<InternalError>([] { (void)runGnuplot("plot nosuch$(\n"); }),
              StartsWith("gnuplot: "));
  EXPECT_THAT(messageOf<InternalError>([] { (void)runGnuplot("set nosuch\n"); }),
              StartsWith("gnuplot: "));
}

TEST(Gnuplot, WithoutTheTerminalThatDrawsIsAnError) {
  // gnuplot 5 fails, gnuplot 6 warns and draws nothing.
  for (const auto objects : {PdfObjects::compressed, PdfObjects::plain}) {
    EXPECT_THAT(messageOf<InternalError>([&] {
                  (void)drawByGnuplot({"set terminal nosuch\nplot x\n"}, {"", objects});
                }),
                StartsWith("gnuplot: "));
  }
}

/// An SVG of a line, with a title.
std::string lineScript(const std::string& title) {
  return "set terminal svg\nset title '" + title + "'\nplot x notitle\n";
}

/// It, drawn. The last colour of one SVG reaches into the next: the same is drawn before.
std::string lineDrawn(const std::string& title) {
  const std::string before = "set terminal svg\nset output '/dev/null'\nplot x\nunset output\n";
  return drawByGnuplot({lineScript(title)}, {before}).front();
}

TEST(Gnuplot, DrawsTheSameAfterOtherScripts) {
  const std::string first = lineDrawn("A");
  (void)drawByGnuplot({"set terminal svg\nset logscale y\nset xrange [1:7]\nplot x**2\n",
                       "set terminal pdfcairo\nplot x\n"});
  EXPECT_NE(lineDrawn("B"), first);
  EXPECT_EQ(lineDrawn("A"), first);
  EXPECT_THAT(first, HasSubstr("</svg>"));
}

TEST(Gnuplot, DrawsOnAfterAScriptThatItRefuses) {
  const std::string before = lineDrawn("A");
  EXPECT_THAT(messageOf<InternalError>([] { (void)drawByGnuplot({"set nosuch\n"}); }),
              StartsWith("gnuplot: "));
  EXPECT_EQ(lineDrawn("A"), before);
}

TEST(Gnuplot, AShorterDrawingKeepsNothingOfALonger) {
  const std::string empty = "set terminal svg\nunset border\nunset tics\nplot [0:1] [0:1] 2\n";
  const std::string alone = drawByGnuplot({empty}).front();
  const std::vector<std::string> both = drawByGnuplot({lineScript("long"), empty});
  ASSERT_GT(both[0].size(), both[1].size());
  EXPECT_EQ(both[1].size(), alone.size());
  EXPECT_THAT(both[1], Not(HasSubstr("long")));
}

TEST(Gnuplot, DrawsForSeveralThreadsAtOnce) {
  std::vector<std::string> expected;
  for (int i = 0; i < 8; ++i) {
    expected.push_back(lineDrawn(std::to_string(i)));
  }
  std::vector<std::future<std::string>> drawn;
  for (int i = 0; i < 8; ++i) {
    drawn.push_back(std::async(std::launch::async, [i] { return lineDrawn(std::to_string(i)); }));
  }
  for (std::size_t i = 0; i < drawn.size(); ++i) EXPECT_TRUE(drawn[i].get() == expected[i]) << i;
}

TEST(Gnuplot, ThatEndsIsReplaced) {
  EXPECT_THAT(messageOf<InternalError>([] { (void)drawByGnuplot({"exit gnuplot\n"}); }),
              StartsWith("gnuplot: "));
  EXPECT_FALSE(lineDrawn("A").empty());
  EXPECT_THAT(
      messageOf<InternalError>([] { (void)drawByGnuplot({"x = system('kill -9 $PPID')\n"}); }),
      HasSubstr("Killed"));
  EXPECT_FALSE(lineDrawn("A").empty());
}

TEST(Gnuplot, ThatIsMissingIsNamed) {
  const char* before = std::getenv("PATH");
  const std::string path = before == nullptr ? "" : before;
  ::setenv("PATH", "/nowhere", 1);
  const std::string message = messageOf<InternalError>([] { (void)runGnuplot(""); });
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(message, HasSubstr("gnuplot-nox"));
}

TEST(Gnuplot, TextIsTextWhateverItHolds) {
  for (const std::string text : {"its", "a \"b\" \\n `date` $x @y", "{/Bold x}_1^2 & <é> 影", ""}) {
    EXPECT_EQ(printed(gnuplotText(text)), text + "\n");
  }
  EXPECT_EQ(printed(gnuplotText("'it's'")), "’it’s’\n");
  EXPECT_EQ(printed(gnuplotText("two\nlines\x1b[1m")), "two lines [1m\n");
}

TEST(Gnuplot, SvgBearsOurTitleAndNoVersion) {
  const std::string svg = styledSvg(runGnuplot("set terminal svg\nplot x\n"), "A & <b>", "g{}");
  EXPECT_THAT(svg, HasSubstr("<title>A &amp; &lt;b&gt;</title><style>g{}</style>"));
  EXPECT_THAT(svg, Not(HasSubstr("Produced by")));
  EXPECT_THAT(svg, Not(HasSubstr("desc>")));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THROW((void)styledSvg("<svg></svg>", "t", ""), InternalError);
}

}  // namespace
}  // namespace gnomon::report
