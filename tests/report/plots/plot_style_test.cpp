#include "report/plots/line_plot.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "render/method.h"
#include "report/plots/gnuplot.h"
#include "report/sample_record.h"

namespace gnomon::report {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::SizeIs;

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

// ---- colours as an eye sees them

/// The linear light of "#rrggbb".
Triple lightOf(std::string_view colour) {
  Triple light{};
  for (std::size_t i = 0; i < 3; ++i) {
    const int byte = std::stoi(std::string(colour.substr(1 + 2 * i, 2)), nullptr, 16);
    const double share = byte / 255.0;
    light.at(i) = share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
  }
  return light;
}

Triple seenBy(const Matrix& matrix, const Triple& light) {
  Triple result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) result.at(i) += matrix.at(i).at(j) * light.at(j);
    result.at(i) = std::clamp(result.at(i), 0.0, 1.0);
  }
  return result;
}

/// CIELAB of linear sRGB, white D65.
Triple labOf(const Triple& light) {
  const Matrix toXyz = {{{0.4124564, 0.3575761, 0.1804375},
                         {0.2126729, 0.7151522, 0.0721750},
                         {0.0193339, 0.1191920, 0.9503041}}};
  const Triple white = {0.95047, 1, 1.08883};
  const Triple xyz = [&] {
    Triple sum{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) sum.at(i) += toXyz.at(i).at(j) * light.at(j);
    }
    return sum;
  }();
  const auto root = [](double t) {
    constexpr double edge = 6.0 / 29;
    return t > edge * edge * edge ? std::cbrt(t) : t / (3 * edge * edge) + 4.0 / 29;
  };
  const double x = root(xyz[0] / white[0]);
  const double y = root(xyz[1] / white[1]);
  const double z = root(xyz[2] / white[2]);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// Machado, Oliveira & Fernandes 2009, table of severity 1.0, on linear light.
const std::map<std::string, Matrix> visions = {
    {"full", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
    {"protanopia",
     {{{0.152286, 1.052583, -0.204868},
       {0.114503, 0.786281, 0.099216},
       {-0.003882, -0.048116, 1.051998}}}},
    {"deuteranopia",
     {{{0.367322, 0.860646, -0.227968},
       {0.280085, 0.672501, 0.047413},
       {-0.011820, 0.042940, 0.968881}}}},
    {"tritanopia",
     {{{1.255528, -0.076749, -0.178779},
       {-0.078411, 0.930809, 0.147602},
       {0.004733, 0.691367, 0.303900}}}},
};

double distance(std::string_view a, std::string_view b, const Matrix& vision) {
  const Triple p = labOf(seenBy(vision, lightOf(a)));
  const Triple q = labOf(seenBy(vision, lightOf(b)));
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

/// WCAG 2.
double contrast(std::string_view a, std::string_view b) {
  const auto luminance = [](std::string_view colour) {
    const Triple light = lightOf(colour);
    return 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2];
  };
  const auto [dark, bright] = std::minmax({luminance(a), luminance(b)});
  return (bright + 0.05) / (dark + 0.05);
}

TEST(PlotStyle, TheSimulationsThemselvesAreRight) {
  // White is white to every eye; red and green of one luminance are alike to a deuteranope.
  for (const auto& [name, matrix] : visions) {
    EXPECT_NEAR(labOf(seenBy(matrix, lightOf("#ffffff")))[0], 100, 0.1) << name;
  }
  EXPECT_NEAR(labOf(lightOf("#ff0000"))[0], 53.24, 0.05);
  EXPECT_NEAR(labOf(lightOf("#ff0000"))[1], 80.09, 0.1);
  EXPECT_NEAR(contrast("#ffffff", "#000000"), 21, 1e-9);
  EXPECT_LT(distance("#c04040", "#706a20", visions.at("deuteranopia")), 20);
  EXPECT_GT(distance("#c04040", "#706a20", visions.at("full")), 50);
}

TEST(PlotStyle, EveryEyeTellsTheFamiliesApart) {
  const auto& all = familyColours;
  for (const auto& [name, vision] : visions) {
    for (std::size_t a = 0; a < all.size(); ++a) {
      for (std::size_t b = a + 1; b < all.size(); ++b) {
        const std::string pair = fmt::format("{}: {} and {}", name, all[a].name, all[b].name);
        EXPECT_GE(distance(all[a].onWhite, all[b].onWhite, vision), 20) << pair << " on white";
        EXPECT_GE(distance(all[a].onDark, all[b].onDark, vision), 20) << pair << " on dark";
      }
    }
  }
}

TEST(PlotStyle, ColoursStandOutFromTheirPage) {
  for (const PlotColour& colours : familyColours) {
    EXPECT_GE(contrast(colours.onWhite, "#ffffff"), 3) << colours.name;
    EXPECT_GE(contrast(colours.onDark, "#14171b"), 3) << colours.name;
  }
}

/// gnuplot's own spellings of a colour are those of the style sheet.
TEST(PlotStyle, TakesTheColoursOfADarkPage) {
  const std::string script = fmt::format(
      "set terminal svg background '#ffffff'\nset xlabel 'x' textcolor rgb '{0}'\n"
      "plot [0:1] x with linespoints lc rgb '{1}', 1 with filledcurves y1=0 fc rgb '{2}'\n",
      inkColour, familyColours[1].onWhite, bandColour);
  const std::string svg = drawByGnuplot({script}).front();
  std::size_t found = 0;
  static const std::regex rule(R"re(\[(?:stroke|color|fill)="[^"]*"\])re");
  const std::string& style = darkStyle();
  for (std::sregex_iterator at(style.begin(), style.end(), rule), end; at != end; ++at) {
    std::string selector = at->str().substr(1, at->str().size() - 2);
    std::string quoted = std::regex_replace(selector, std::regex("\""), "'");
    quoted.replace(quoted.find('='), 1, " = ");
    for (const std::string& spelling :
         {selector, std::regex_replace(selector, std::regex("\""), "'"), quoted}) {
      found += svg.find(spelling) == std::string::npos ? 0U : 1U;
    }
  }
  EXPECT_GE(found, 5U) << "background, text, line, symbol and area";
}

// ---- methods

TEST(PlotStyle, EveryFamilyThatAFileCanNameHasAColour) {
  for (const std::string_view family : render::methodFamilies) {
    EXPECT_THAT(familyColours, Contains(::testing::Field(&PlotColour::name, family)));
  }
}

TEST(PlotStyle, NoTwoShippedMethodsLookTheSame) {
  std::map<std::pair<std::string, int>, std::string> seen;
  for (const std::string& name : render::methodNames(render::shaderFolder())) {
    const render::Method method =
        render::readMethod(render::methodFile(render::shaderFolder(), name));
    EXPECT_FALSE(method.mark.family.empty()) << name;
    const MethodStyle style = methodStyle(name, name, method.mark);
    EXPECT_EQ(style.dash, 1) << name;
    const auto [place, isNew] = seen.emplace(std::pair(style.family, style.point), name);
    EXPECT_TRUE(isNew) << name << " looks like " << place->second;
  }
  EXPECT_GE(seen.size(), 20U);
}

TEST(PlotStyle, VariantsKeepTheColourAndDifferInSymbolAndDashes) {
  const render::MethodMark mark = {"ours", "square"};
  const MethodStyle plain = methodStyle("resampled-horizon", "resampled-horizon", mark);
  EXPECT_EQ(plain, (MethodStyle{"ours", 5, 1}));
  std::set<std::pair<int, int>> looks = {{plain.point, plain.dash}};
  for (const char* label : {"resampled-horizon, 8 azimuths", "resampled-horizon, 16 azimuths",
                            "resampled-horizon, 32 azimuths", "resampled-horizon + disc"}) {
    const MethodStyle variant = methodStyle("resampled-horizon", label, mark);
    EXPECT_EQ(variant.family, "ours");
    EXPECT_NE(variant.dash, 1) << label;
    looks.emplace(variant.point, variant.dash);
  }
  EXPECT_THAT(looks, SizeIs(5));
}

TEST(PlotStyle, NoTwoMethodsOfAPlotLookTheSame) {
  study::StudyMeans study;
  std::vector<std::string> shown;
  for (int i = 0; i < 7; ++i) {
    // Variants, whose looks follow from a hash of their labels: some are alike.
    study.methods.push_back({fmt::format("m, {}", i), "m", 0.01, {}, {}, {}});
    study.methods.back().mark = {"ours", "square"};
    shown.push_back(study.methods.back().label);
  }
  const MethodStyles styles(study, shown);
  std::set<std::string> symbols;
  std::set<std::string> dashes;
  for (const std::string& label : shown) {
    const std::string style = styles.of(label);
    symbols.insert(style.substr(style.find(" pt "), 6));
    dashes.insert(style.substr(style.find(" dt ")));
  }
  EXPECT_THAT(symbols, SizeIs(6)) << "all that gnuplot has outlined";
  EXPECT_THAT(dashes, SizeIs(5));
  // Alone, a method looks as it always does.
  const std::string own = styleClause(methodStyle("m", "m, 3", {"ours", "square"}));
  EXPECT_EQ(MethodStyles(study, {"m, 3"}).of("m, 3"), own);
}

/// Fixed here, since a report of another day must look the same.
TEST(PlotStyle, OfAnOwnFileFollowFromItsName) {
  EXPECT_EQ(methodStyle("biased", "biased", {}), (MethodStyle{"own", 15, 1}));
  EXPECT_EQ(methodStyle("mine", "mine", {"march", "star"}), (MethodStyle{"march", 3, 1}));
}

// ---- which are plotted

study::StudyMeans studyOf(const std::vector<std::string>& labels) {
  study::StudyMeans study;
  double error = 0;
  for (const std::string& label : labels) {
    error += 0.01;
    study.methods.push_back({label, label, error, 0.0, error, 0.0, {error}});
  }
  return study;
}

TEST(PlottedMethods, AreTheFlatMapTheClaimedMethodAndTheFirstOfTheRanking) {
  study::StudyMeans study = studyOf(
      {"a", "b", "c", "d", "e", "f", "g", "claimed", "h", "i", "max-forsyth", "unshadowed"});
  study.claims = {{"x", "", study::Verdict::held, ""}};
  study.claims[0].methods = {"unshadowed", "max-forsyth", "claimed"};
  EXPECT_THAT(plottedMethods(study),
              ElementsAre("a", "b", "c", "d", "e", "f", "claimed", "max-forsyth"));
  // Those that are asked for, if the study has one of them.
  EXPECT_THAT(plottedMethods(study, {"g", "nosuch", "a"}), ElementsAre("g", "a"));
  EXPECT_EQ(plottedMethods(study, {"nosuch"}), plottedMethods(study));
}

TEST(PlottedMethods, HaveTheBestEntryOfEachMethodBeforeAnyOther) {
  study::StudyMeans study = studyOf({"a", "a 2", "a 3", "b", "c", "d", "e", "f", "g", "h"});
  for (std::size_t i : {1U, 2U}) study.methods[i].name = "a";
  EXPECT_THAT(plottedMethods(study), ElementsAre("a", "b", "c", "d", "e", "f", "g", "h"));
  study.methods.resize(5);
  EXPECT_THAT(plottedMethods(study), ElementsAre("a", "a 2", "a 3", "b", "c"));
}

TEST(PlottedMethods, OfFewMethodsAreAll) {
  EXPECT_THAT(plottedMethods(studyOf({"b", "a"})), ElementsAre("b", "a"));
  EXPECT_THAT(plottedMethods(study::StudyMeans{}), SizeIs(0));
}

}  // namespace
}  // namespace gnomon::report
