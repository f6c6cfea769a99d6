#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "end_to_end/support/program.h"

// What must come out badly does, and the figures are those of the masks: a measurement that cannot
// tell a bad method from a good one measures nothing.

namespace gnomon::test {
namespace {

/// tp, fp, fn, tn of two masks, each sample with its weight.
struct Cells {
  double tp = 0, fp = 0, fn = 0, tn = 0;
  [[nodiscard]] double all() const { return tp + fp + fn + tn; }
  [[nodiscard]] double errorRate() const { return (fp + fn) / all(); }
};

template <typename Weight>
Cells count(const GreyImage& candidate, const GreyImage& truth, const Weight& weight) {
  EXPECT_EQ(candidate.width, truth.width);
  EXPECT_EQ(candidate.height, truth.height);
  Cells cells;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    EXPECT_EQ(candidate.pixels[i] == 128, truth.pixels[i] == 128) << "the same samples";
    if (truth.pixels[i] == 128) continue;
    const bool shadow = candidate.pixels[i] == 0;
    const bool shadowInTruth = truth.pixels[i] == 0;
    double& cell =
        shadow ? (shadowInTruth ? cells.tp : cells.fp) : (shadowInTruth ? cells.fn : cells.tn);
    cell += weight(i);
  }
  return cells;
}

Cells count(const GreyImage& candidate, const GreyImage& truth) {
  return count(candidate, truth, [](std::size_t) { return 1.0; });
}

/// The middles of all sides between a lit and a shadowed pixel, columns and rows.
std::vector<std::array<double, 2>> sidesOf(const GreyImage& mask) {
  std::vector<std::array<double, 2>> sides;
  const auto at = [&](int x, int y) {
    return mask.pixels[static_cast<std::size_t>(y * mask.width + x)];
  };
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      const int here = at(x, y);
      if (here == 128) continue;
      if (x + 1 < mask.width && at(x + 1, y) == 255 - here) sides.push_back({x + 0.5, y + 0.0});
      if (y + 1 < mask.height && at(x, y + 1) == 255 - here) sides.push_back({x + 0.0, y + 0.5});
    }
  }
  return sides;
}

/// Sum of the distances from each side to the nearest of the others, and how many exceed 2.
struct Gaps {
  double sum = 0;
  double far = 0;
};

Gaps gapsBetween(const std::vector<std::array<double, 2>>& from,
                 const std::vector<std::array<double, 2>>& to, double step) {
  Gaps gaps;
  for (const auto& a : from) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& b : to) {
      const double x = a[0] - b[0];
      const double y = a[1] - b[1];
      least = std::min(least, x * x + y * y);
    }
    gaps.sum += step * std::sqrt(least);
    gaps.far += step * std::sqrt(least) > 2 + 1e-9 ? 1 : 0;
  }
  return gaps;
}

class Controls : public EndToEnd {
 protected:
  void runSphere(const std::vector<std::string>& tested,
                 const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"run", GNOMON_SCENES "/sphere-columns.toml", "--quick"};
    for (const std::string& method : tested)
      arguments.insert(arguments.end(), {"--method", method});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = gnomon(arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    summary_ = summary("sphere-columns");
  }
  [[nodiscard]] GreyImage sphereMask(const std::string& view, int elevation,
                                     const std::string& method, int azimuth = 20) const {
    return mask("sphere-columns", view + "_elevation-" + std::to_string(elevation) + "-azimuth-" +
                                      std::to_string(azimuth) + "_" + method);
  }
  [[nodiscard]] nlohmann::json result(const std::string& view, int elevation,
                                      const std::string& method) const {
    return resultOf(summary_, method, "elevation " + std::to_string(elevation) + "° azimuth 20°",
                    view);
  }
  static constexpr std::array elevations = {60, 45, 30, 20};
  const std::vector<std::string> methods = {"unshadowed", "max-forsyth", "onoue-2004"};
  nlohmann::json summary_;
};

TEST_F(Controls, BumpMappingWithoutShadowsIsClearlyWorse) {
  runSphere(methods);
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

TEST_F(Controls, TheFiguresAreThoseOfTheMasks) {
  runSphere(methods);
  for (const int elevation : elevations) {
    for (const std::string& method : methods) {
      const Cells cells =
          count(sphereMask("camera", elevation, method), sphereMask("camera", elevation, "truth"));
      const nlohmann::json reported = result("camera", elevation, method);
      EXPECT_EQ(reported.at("samples"), cells.all());
      EXPECT_EQ(reported.at("tp"), cells.tp);
      EXPECT_EQ(reported.at("fp"), cells.fp);
      EXPECT_EQ(reported.at("fn"), cells.fn);
      EXPECT_EQ(reported.at("tn"), cells.tn);
      const double n = cells.all();
      const std::map<std::string, double> expected = {
          {"error_rate", cells.errorRate()},
          {"false_shadow", cells.fp / n},
          {"false_light", cells.fn / n},
          {"prevalence", (cells.tp + cells.fn) / n},
          {"fpr", cells.fp / (cells.fp + cells.tn)},
          {"fnr", cells.fn / (cells.fn + cells.tp)},
          {"ber", (cells.fp / (cells.fp + cells.tn) + cells.fn / (cells.fn + cells.tp)) / 2},
          {"iou", cells.tp / (cells.tp + cells.fp + cells.fn)},
          {"f1", 2 * cells.tp / (2 * cells.tp + cells.fp + cells.fn)},
          {"mcc", (cells.tp * cells.tn - cells.fp * cells.fn) /
                      std::sqrt((cells.tp + cells.fp) * (cells.tp + cells.fn) *
                                (cells.tn + cells.fp) * (cells.tn + cells.fn))}};
      for (const auto& [name, value] : expected) {
        EXPECT_NEAR(reported.at(name).get<double>(), value, 1e-13) << method << ", " << name;
      }
    }
  }
}

TEST_F(Controls, BoundariesAreThoseOfTheMasks) {
  runSphere({"onoue-2004"}, {"--set", "light.0.elevation=30"});
  for (const std::string view : {"camera", "atlas"}) {
    const auto truth = sidesOf(sphereMask(view, 30, "truth"));
    const auto candidate = sidesOf(sphereMask(view, 30, "onoue-2004"));
    // In pixels, and in texels: the atlas shows all 128 of them.
    const double step = view == "camera" ? 1 : 128.0 / sphereMask(view, 30, "truth").width;
    const Gaps there = gapsBetween(candidate, truth, step);
    const Gaps back = gapsBetween(truth, candidate, step);
    const auto sides = static_cast<double>(truth.size() + candidate.size());
    const nlohmann::json reported = result(view, 30, "onoue-2004");
    EXPECT_NEAR(reported.at("assd").get<double>(), (there.sum + back.sum) / sides, 1e-9) << view;
    EXPECT_NEAR(reported.at("surface_dice_2").get<double>(), 1 - (there.far + back.far) / sides,
                1e-9)
        << view;
    EXPECT_LT(reported.at("boundary_iou_1"), reported.at("boundary_iou_4")) << view;
  }
}

TEST_F(Controls, AnAtlasIsWeightedByArea) {
  runSphere(methods);
  // On the sphere a sample's area is proportional to the cosine of its latitude, and the rows of
  // the atlas are evenly spaced in it: 128 texels at 0.015 radians.
  const GreyImage truth = sphereMask("atlas", 30, "truth");
  const auto cosine = [&](std::size_t i) {
    const double row = static_cast<double>(i / static_cast<std::size_t>(truth.width)) + 0.5;
    return std::cos(1.92 * (row / truth.height - 0.5));
  };
  for (const std::string& method : methods) {
    const GreyImage candidate = sphereMask("atlas", 30, method);
    const double reported = result("atlas", 30, method).at("error_rate");
    // The built-in sphere's parametrisation is even to Δ² / 12 of its faces' angle, 8e-5.
    EXPECT_NEAR(reported, count(candidate, truth, cosine).errorRate(), 1e-4 * reported) << method;
    EXPECT_GT(std::abs(reported - count(candidate, truth).errorRate()), 1e-3 * reported)
        << method << ": without weights the figure is another";
  }
}

TEST_F(Controls, AMaskUnderALightTurnedBy30DegreesIsAtLeastTwiceAsWrong) {
  runSphere({"onoue-2004"}, {"--set", "light.0.azimuth=[20, 50]"});
  for (const int elevation : elevations) {
    const GreyImage truth = sphereMask("camera", elevation, "truth");
    const GreyImage turnedTruth = sphereMask("camera", elevation, "truth", 50);
    const GreyImage own = sphereMask("camera", elevation, "onoue-2004");
    const GreyImage turned = sphereMask("camera", elevation, "onoue-2004", 50);
    EXPECT_GT(count(turned, truth).errorRate(), 2 * count(own, truth).errorRate()) << elevation;
    EXPECT_GT(count(own, turnedTruth).errorRate(), 2 * count(turned, turnedTruth).errorRate())
        << elevation;
  }
}

}  // namespace
}  // namespace gnomon::test
