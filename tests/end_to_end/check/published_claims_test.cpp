#include <gmock/gmock.h>

#include <array>

#include "end_to_end/support/program.h"

// The orderings and lengths that Onoue, Max & Nishita 2004 state in §4 with Figures 4 and 5:
// accounting for curvature makes shadows more accurate, and the more so the larger the curvature.

namespace gnomon::test {
namespace {

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

TEST_F(PublishedClaims, HoldInAPreview) {
  runSpheres({"--quick"});
  expectOrderings();
  EXPECT_EQ(verdicts("sphere-columns"), sphereVerdicts);
}

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

}  // namespace
}  // namespace gnomon::test
