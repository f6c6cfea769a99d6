#include "report/plots/method_styles.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "render/method.h"
#include "report/highlights.h"
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

std::vector<FamilyColours> allColours() {
  std::vector<FamilyColours> all(familyColours.begin(), familyColours.end());
  all.push_back(otherMethods);
  return all;
}

TEST(MethodStyles, TheSimulationsThemselvesAreRight) {
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

TEST(MethodStyles, EveryEyeTellsTheFamiliesApart) {
  const std::vector<FamilyColours> all = allColours();
  for (const auto& [name, vision] : visions) {
    for (std::size_t a = 0; a < all.size(); ++a) {
      for (std::size_t b = a + 1; b < all.size(); ++b) {
        const std::string pair = fmt::format("{}: {} and {}", name, all[a].family, all[b].family);
        EXPECT_GE(distance(all[a].onWhite, all[b].onWhite, vision), 20) << pair << " on white";
        EXPECT_GE(distance(all[a].onDark, all[b].onDark, vision), 20) << pair << " on dark";
      }
    }
  }
}

TEST(MethodStyles, ColoursStandOutFromTheirPage) {
  for (const FamilyColours& colours : allColours()) {
    EXPECT_GE(contrast(colours.onWhite, "#ffffff"), 3) << colours.family;
    EXPECT_GE(contrast(colours.onDark, "#14171b"), 3) << colours.family;
  }
}

// ---- methods

TEST(MethodStyles, EveryFamilyThatAFileCanNameHasAColour) {
  for (const std::string_view family : render::methodFamilies) {
    EXPECT_THAT(familyColours,
                Contains(::testing::Field(&FamilyColours::family, std::string(family))));
  }
}

TEST(MethodStyles, NoTwoShippedMethodsLookTheSame) {
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

TEST(MethodStyles, VariantsKeepTheColourAndDifferInSymbolAndDashes) {
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

/// Fixed here, since a report of another day must look the same.
TEST(MethodStyles, OfAnOwnFileFollowFromItsName) {
  EXPECT_EQ(methodStyle("biased", "biased", {}), (MethodStyle{"own", 15, 1}));
  EXPECT_EQ(methodStyle("mine", "mine", {"march", "star"}), (MethodStyle{"march", 3, 1}));
}

// ---- highlights

study::StudyMeans studyOf(const std::vector<std::string>& labels) {
  study::StudyMeans study;
  double error = 0;
  for (const std::string& label : labels) {
    error += 0.01;
    study.methods.push_back({label, label, error, 0.0, error, 0.0, {error}});
  }
  return study;
}

TEST(Highlights, AreTheFlatMapTheClaimedMethodAndTheFirstOfTheRanking) {
  study::StudyMeans study = studyOf(
      {"a", "b", "c", "d", "e", "f", "g", "claimed", "h", "i", "max-forsyth", "unshadowed"});
  study.claims = {{"x", "", study::Verdict::held, ""}};
  study.claims[0].methods = {"unshadowed", "max-forsyth", "claimed"};
  EXPECT_THAT(highlights(study),
              ElementsAre("a", "b", "c", "d", "e", "f", "claimed", "max-forsyth"));
  const MethodStyles styles(study);
  EXPECT_TRUE(styles.isHighlighted("max-forsyth"));
  EXPECT_FALSE(styles.isHighlighted("g"));
  // Grey first, so that it lies below; a grey method keeps its symbol.
  EXPECT_THAT(styles.drawnOrder({"a", "g", "b"}), ElementsAre("g", "a", "b"));
  const std::vector<PlotColour> colours = styles.colours();
  EXPECT_EQ(colours.at(0).onWhite, familyColours.back().onWhite);
  EXPECT_EQ(colours.at(6).onWhite, otherMethods.onWhite);
}

TEST(Highlights, HaveTheBestEntryOfEachMethodBeforeAnyOther) {
  study::StudyMeans study = studyOf({"a", "a 2", "a 3", "b", "c", "d", "e", "f", "g", "h"});
  for (std::size_t i : {1U, 2U}) study.methods[i].name = "a";
  EXPECT_THAT(highlights(study), ElementsAre("a", "b", "c", "d", "e", "f", "g", "h"));
  study.methods.resize(5);
  EXPECT_THAT(highlights(study), ElementsAre("a", "a 2", "a 3", "b", "c"));
}

TEST(Highlights, OfFewMethodsAreAll) {
  EXPECT_THAT(highlights(studyOf({"b", "a"})), ElementsAre("b", "a"));
  EXPECT_THAT(highlights(study::StudyMeans{}), SizeIs(0));
}

}  // namespace
}  // namespace gnomon::report
