#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "end_to_end/support/program.h"

// The orderings and lengths that Onoue, Max & Nishita 2004 state in §4 with Figures 4 and 5:
// accounting for curvature makes shadows more accurate, and the more so the larger the curvature.
// What must come out badly does, and the figures are those of the masks: a measurement that cannot
// tell a bad method from a good one measures nothing.
// What a run writes for a paper, typeset where LaTeX is installed.

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A run of studies with the methods alone that the claims are about.
std::vector<std::string> runClaimed(const std::vector<std::string>& studies,
                                    const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"run"};
  arguments.insert(arguments.end(), studies.begin(), studies.end());
  for (const char* method : {"unshadowed", "max-forsyth", "onoue-2004"}) {
    arguments.insert(arguments.end(), {"--method", method});
  }
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

class PublishedClaims : public EndToEnd {
 protected:
  void runSpheres(const std::vector<std::string>& more = {}) const {
    const Outcome outcome = gnomon(runClaimed(
        {GNOMON_SCENES "/sphere-columns.toml", GNOMON_SCENES "/sphere-columns-flat.toml"}, more));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  /// Error of the flat horizon map minus that of the curvature-aware one, a value for each view and
  /// light.
  [[nodiscard]] std::vector<double> gains(const std::string& study) const {
    const nlohmann::json json = summary(study);
    std::vector<double> result;
    for (const char* view : {"atlas", "camera"}) {
      for (const int elevation : {60, 45, 30, 20}) {
        const std::string light = "elevation " + std::to_string(elevation) + "° azimuth 20°";
        const double flat = resultOf(json, "max-forsyth", light, view).at("error_rate");
        const double curved = resultOf(json, "onoue-2004", light, view).at("error_rate");
        result.push_back(flat - curved);
      }
    }
    return result;
  }
  static double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }
  [[nodiscard]] double uncertainty(const std::string& study) const {
    return summary(study).at("truth").at("uncertainty");
  }
  void expectOrderings() const {
    for (const double gain : gains("sphere-columns")) {
      EXPECT_GT(gain, uncertainty("sphere-columns"));
    }
    EXPECT_GT(mean(gains("sphere-columns")) - mean(gains("sphere-columns-flat")),
              uncertainty("sphere-columns") + uncertainty("sphere-columns-flat"));
  }
  [[nodiscard]] std::vector<std::string> verdicts(const std::string& study) const {
    const nlohmann::json json = summary(study);
    std::vector<std::string> result;
    for (const nlohmann::json& claim : json.at("claims")) {
      result.push_back(claim.at("verdict"));
    }
    return result;
  }
};

/// Beyond the terminator both methods err alike where the light stands at 60°: no order is found.
/// The control holds for all cases together. The flat horizon map is wrong half as often as no
/// shadows at all, but elsewhere: in one view, under 30°, the interval of the difference holds 0.
const std::vector<std::string> sphereVerdicts = {"held", "held", "not distinguishable", "held"};

TEST_F(PublishedClaims, HoldAtFullSizeWithATruthToATenthOfAPercent) {
  runSpheres();
  expectOrderings();
  EXPECT_LT(uncertainty("sphere-columns"), 0.002);
  EXPECT_LT(uncertainty("sphere-columns-flat"), 0.002);
  EXPECT_GT(uncertainty("sphere-columns"), 0);
  EXPECT_EQ(verdicts("sphere-columns"), sphereVerdicts);
  EXPECT_EQ(verdicts("sphere-columns-flat"), (std::vector<std::string>{"held", "held"}));
}

TEST_F(PublishedClaims, FigureEightHasThePapersCounts) {
  const Outcome outcome = gnomon({"run", GNOMON_SCENES "/figure8.toml", "--quick"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  // 77,760 polygons of the displacement-mapped object, 960 of the bump-mapped one.
  const nlohmann::json json = summary("figure8");
  int displaced = 0;
  for (const nlohmann::json& cost : json.at("cost")) {
    const std::string method = cost.at("method");
    if (method.ends_with(", fine")) {  // 16 × 16 pieces instead of 9 × 9
      EXPECT_EQ(cost.at("polygons"), 960 * 16 * 16) << method;
      continue;
    }
    // Ours have 4 × 4 pieces for the camera, and where the light sees a mesh 9 × 9 for it.
    if (method == "surface-march" || method.starts_with("two-scales")) {
      const int light = method == "surface-march" ? 0 : 9 * 9;
      EXPECT_EQ(cost.at("polygons"), 960 * (4 * 4 + light)) << method;
      continue;
    }
    const bool geometry = method == "shadow-volume" || method == "shadow-map";
    displaced += geometry ? 1 : 0;
    EXPECT_EQ(cost.at("polygons"), geometry ? 77760 : 960) << method;
  }
  EXPECT_EQ(displaced, 2);
  EXPECT_GT(json.at("cost").size(), 10U);
  EXPECT_EQ(verdicts("figure8"), (std::vector<std::string>{"held", "held", "held", "held"}));
}

/// tp, fp, fn, tn of two masks.
struct Cells {
  double tp = 0, fp = 0, fn = 0, tn = 0;
  [[nodiscard]] double all() const { return tp + fp + fn + tn; }
  [[nodiscard]] double errorRate() const { return (fp + fn) / all(); }
};

Cells count(const GreyImage& candidate, const GreyImage& truth) {
  EXPECT_EQ(candidate.pixels.size(), truth.pixels.size());
  Cells cells;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    EXPECT_EQ(candidate.pixels[i] == 128, truth.pixels[i] == 128) << "the same samples";
    if (truth.pixels[i] == 128) continue;
    const bool shadow = candidate.pixels[i] == 0;
    const bool shadowInTruth = truth.pixels[i] == 0;
    (shadow ? (shadowInTruth ? cells.tp : cells.fp) : (shadowInTruth ? cells.fn : cells.tn)) += 1;
  }
  return cells;
}

class Controls : public SharedRuns {
 protected:
  void prepare() override { runSphere(methods); }
  void runSphere(const std::vector<std::string>& tested,
                 const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"run", GNOMON_SCENES "/sphere-columns.toml", "--quick"};
    for (const std::string& method : tested)
      arguments.insert(arguments.end(), {"--method", method});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = gnomon(arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  [[nodiscard]] GreyImage sphereMask(const std::string& view, int elevation,
                                     const std::string& method, int azimuth = 20,
                                     const std::string& out = "out") const {
    return readGrey(file(out + "/sphere-columns/masks/" + view + "_elevation-" +
                         std::to_string(elevation) + "-azimuth-" + std::to_string(azimuth) + "_" +
                         method + ".png"));
  }
  [[nodiscard]] nlohmann::json result(const std::string& view, int elevation,
                                      const std::string& method) const {
    return resultOf(summary("sphere-columns"), method,
                    "elevation " + std::to_string(elevation) + "° azimuth 20°", view);
  }
  static constexpr std::array elevations = {60, 45, 30, 20};
  const std::vector<std::string> methods = {"unshadowed", "max-forsyth", "onoue-2004"};
};

TEST_F(Controls, BumpMappingWithoutShadowsIsClearlyWorse) {
  for (const char* view : {"camera", "atlas"}) {
    for (const int elevation : elevations) {
      const double none = result(view, elevation, "unshadowed").at("error_rate");
      const double flat = result(view, elevation, "max-forsyth").at("error_rate");
      EXPECT_GT(none, 1.2 * flat) << view << ", " << elevation << "°";
      // Bump mapping shadows nothing but slopes, so all that it misses is light that should not be.
      EXPECT_GT(result(view, elevation, "unshadowed").at("false_light"), 0.95 * none);
    }
  }
}

TEST_F(Controls, AMaskUnderALightTurnedBy30DegreesIsAtLeastTwiceAsWrong) {
  runSphere({"onoue-2004"}, {"--set", "light.0.azimuth=[20, 50]", "--out", "turned"});
  for (const int elevation : elevations) {
    const GreyImage truth = sphereMask("camera", elevation, "truth", 20, "turned");
    const GreyImage turnedTruth = sphereMask("camera", elevation, "truth", 50, "turned");
    const GreyImage own = sphereMask("camera", elevation, "onoue-2004", 20, "turned");
    const GreyImage turned = sphereMask("camera", elevation, "onoue-2004", 50, "turned");
    EXPECT_GT(count(turned, truth).errorRate(), 2 * count(own, truth).errorRate()) << elevation;
    EXPECT_GT(count(own, turnedTruth).errorRate(), 2 * count(turned, turnedTruth).errorRate())
        << elevation;
  }
}

/// Reptile skin on a sphere cap whose error grows toward the terminator, drawn sixteen times.
constexpr const char* redrawn = R"(
[study]
name = "redrawn"
title = "Bumps drawn anew"
source = "a test"
frames = 0
[surface]
shape = "sphere"
curvature = 0.015
size = [128, 128]
quads = [64, 64]

[relief]
pattern = "cells"
texels = [256, 256]
period = 16
height = 4
height_space = "texture"

[truth]
step = 0.25

[[view]]
type = "camera"
width = 256
height = 256
eye = [0, -150, 260]
target = [0, 0, 46]
up = [0, 1, 0]
fov = 26

[[light]]
azimuth = 20
elevation = [45, 30]

[[method]]
name = "max-forsyth"

[[method]]
name = "onoue-2004"

[sweep]
key = "relief.seed"
values = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16]
)";

/// What one figure and its interval are over all draws.
class Draws {
 public:
  void add(const nlohmann::json& row, const char* figure) {
    ASSERT_TRUE(row.at("low").is_number()) << row.at("reason");
    values_.push_back(row.at(figure));
    halfWidths_ += (row.at("high").get<double>() - row.at("low").get<double>()) / 2;
  }
  /// The mean half-width of the intervals over 1.96 standard deviations of the figure.
  [[nodiscard]] double relativeWidth() const {
    const auto count = static_cast<double>(values_.size());
    double mean = 0;
    for (const double value : values_) mean += value / count;
    double squares = 0;
    for (const double value : values_) squares += (value - mean) * (value - mean);
    return halfWidths_ / count / (1.96 * std::sqrt(squares / (count - 1)));
  }

 private:
  std::vector<double> values_;
  double halfWidths_ = 0;
};

class RedrawnBumps : public EndToEnd {};

/// An interval speaks of other draws of the bumps: so draw them. Sixteen draws tell a standard
/// deviation to a fifth.
TEST_F(RedrawnBumps, VaryAsTheIntervalsSay) {
  runStudy("redrawn", redrawn);
  Draws flat;
  Draws curved;
  Draws difference;
  for (int seed = 1; seed <= 16; ++seed) {
    const nlohmann::json json = summary("redrawn/" + std::to_string(seed));
    for (const nlohmann::json& row : json.at("confidence")) {
      if (row.at("light") != "all") continue;
      (row.at("method") == "max-forsyth" ? flat : curved).add(row, "error_rate");
    }
    difference.add(json.at("differences").at(0), "difference");
  }
  for (const Draws* draws : {&flat, &curved, &difference}) {
    EXPECT_GT(draws->relativeWidth(), 1 / 1.5);
    EXPECT_LT(draws->relativeWidth(), 1.5);
  }
}

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
