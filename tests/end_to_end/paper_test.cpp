#include <gmock/gmock.h>

#include <cstdlib>
#include <regex>

#include "end_to_end/support/program.h"

// What a run writes for a paper, typeset where LaTeX is installed.

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

bool hasLatex() {
  return std::system("pdflatex --version > /dev/null 2>&1") == 0 &&    // NOLINT(cert-env33-c)
         std::system("kpsewhich booktabs.sty > /dev/null 2>&1") == 0;  // NOLINT(cert-env33-c)
}

class Paper : public EndToEnd {
 protected:
  void SetUp() override {
    if (!hasLatex()) {
      GTEST_SKIP() << "LaTeX is not installed: apt install texlive-latex-recommended";
    }
    EndToEnd::SetUp();
  }
  /// The log of a text that is typeset.
  [[nodiscard]] std::string typeset(const std::string& text) const {
    write("paper.tex", text);
    const int status = endOf(startCommand(
        folder(), {"pdflatex", "-interaction=nonstopmode", "-halt-on-error", "paper.tex"},
        {"HOME=" + folder().string(), "max_print_line=1000"}, file("out.txt"), file("err.txt")));
    const std::string log = read("paper.log");
    EXPECT_EQ(status, 0) << log.substr(log.size() - std::min<std::size_t>(log.size(), 2000));
    return log;
  }
};

constexpr const char* tooWide = "Overfull \\hbox";

/// docs/paper.tex has the commands; the methods that it names are enough.
TEST_F(Paper, TypesetsThePageOfTheManual) {
  const std::string text = read(GNOMON_DOCS "/paper.tex");
  ASSERT_THAT(text, HasSubstr("gnomon run scenes/figure8.toml --figures column --figures page"));
  const std::string figure8 = GNOMON_SCENES "/figure8.toml";
  const Outcome run = gnomon({"run", figure8, "--figures", "column", "--figures", "page", "--quick",
                              "--set", "study.frames=0", "--method", "onoue-2004", "--method",
                              "max-forsyth", "--method", "resampled-horizon, 32 azimuths"});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string log = typeset(text);
  EXPECT_THAT(log, HasSubstr("Output written on paper.pdf (2 pages"));
  EXPECT_THAT(log, Not(HasSubstr("Overfull")));
  EXPECT_THAT(log, Not(HasSubstr("Warning")));
  // Control: a narrower column is too narrow for its table and its figure.
  const std::string narrow = typeset(replaced(text, "columnsep=10mm", "columnsep=30mm"));
  const std::size_t first = narrow.find(tooWide);
  ASSERT_NE(first, std::string::npos);
  EXPECT_NE(narrow.find(tooWide, first + 1), std::string::npos);
}

/// Labels are text, in the table and in the macros.
TEST_F(Paper, TypesetsLabelsAsTheyAre) {
  const std::string label = R"(50 % of {a}_b & $x^2$ ~ # \\input{/etc/hostname} \"|<>)";
  const std::string study = onSphere(smallStudy()) + "label = \"" + label +
                            "\"\n[[method]]\nname = \"relief-march\"\nlabel = \"" +
                            std::string(60, 'm') + "\"\n";
  runStudy("small", study, {"--figures", "column", "--set", "study.frames=0"});
  std::string page =
      "\\documentclass{article}\\usepackage{booktabs}\n"
      "\\usepackage[textwidth=84mm]{geometry}\\parindent0pt\n"
      "\\input{out/small/numbers}\\begin{document}\\small\n\\input{out/small/table}\n";
  page += "\n\n";
  // Every macro; a paragraph could not break their words.
  static const std::regex macro(R"(\\gnomon[A-Za-z]+)");
  const std::string numbers = read("out/small/numbers.tex");
  for (std::sregex_iterator found(numbers.begin(), numbers.end(), macro), end; found != end;
       ++found) {
    page += "\\setbox0\\hbox{" + found->str() + "}\n";
  }
  const std::string log = typeset(page + "\n\\end{document}\n");
  EXPECT_THAT(log, Not(HasSubstr(tooWide)));
  EXPECT_THAT(log, Not(HasSubstr("hostname")));
}

TEST_F(EndToEnd, PaperOptionsAreOnesThatExist) {
  write("small.toml", smallStudy());
  const Outcome method = gnomon({"run", "small.toml", "--paper-method", "nosuch"});
  EXPECT_EQ(method.status, 2);
  EXPECT_THAT(method.err, HasSubstr("--paper-method: \"nosuch\" found, a method that is measured "
                                    "expected: unshadowed, max-forsyth"));
  EXPECT_EQ(gnomon({"run", "small.toml", "--figures", "poster"}).status, 2);
  EXPECT_EQ(gnomon({"run", "small.toml", "--table-column", "nosuch"}).status, 2);
  EXPECT_EQ(gnomon({"run", "small.toml", "--paper-font", "90"}).status, 2);
  EXPECT_EQ(gnomon({"run", "small.toml", "--figures", "page", "--metrics-only"}).status, 2);
  EXPECT_TRUE(filesBelow("out").empty());
  runStudy("small", smallStudy(),
           {"--figures", "page", "--paper-method", "max-forsyth", "--table-column", "iou"});
  EXPECT_THAT(read("out/small/table.tex"), HasSubstr("  Method & IoU \\\\\n"));
  EXPECT_THAT(read("out/small/table.tex"), Not(HasSubstr("unshadowed &")));
  EXPECT_THAT(read("out/small/files.txt"), HasSubstr("figures/page/error-by-"));
  EXPECT_THAT(read("out/small/table-page.tex"), HasSubstr("178 mm"));
}

}  // namespace
}  // namespace gnomon::test
