#include "report/plots/gnuplot.h"

#include <gmock/gmock.h>

#include <cstdlib>

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
  const std::string svg = cleanSvg(runGnuplot("set terminal svg\nplot x\n"), "A & <b>");
  EXPECT_THAT(svg, HasSubstr("<title>A &amp; &lt;b&gt;</title>"));
  EXPECT_THAT(svg, Not(HasSubstr("Produced by")));
  EXPECT_THAT(svg, Not(HasSubstr("desc>")));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THROW((void)cleanSvg("<svg></svg>", "t"), InternalError);
}

}  // namespace
}  // namespace gnomon::report
