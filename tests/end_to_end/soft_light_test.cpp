#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <regex>

#include "end_to_end/support/program.h"
#include "support/image_files.h"
#include "support/replaced.h"

// Light from a disc, from the study file to every output.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class SoftLight : public EndToEnd {
 protected:
  static std::string soft(const std::string& more = "") {
    return replaced(smallStudy(), "elevation = 30\n", "elevation = 30\nradius = 4\n") + more;
  }
  [[nodiscard]] nlohmann::json row(const std::string& label,
                                   const std::string& answer = "drawn") const {
    const nlohmann::json all = summary("small");
    for (const nlohmann::json& result : all.at("results")) {
      if (result.at("method") == label && result.at("answer") == answer &&
          result.at("region") == "all" && result.at("view") == "camera") {
        return result;
      }
    }
    throw std::runtime_error("no row of " + label);
  }
};

TEST_F(SoftLight, OfRadiusZeroIsAPointToTheByte) {
  runStudy("small", smallStudy());
  const std::string metrics = read("out/small/metrics.csv");
  const std::string truth = read("out/small/masks/camera_evening_truth.png");
  EXPECT_THAT(metrics, Not(HasSubstr("penumbra")));
  runStudy("small", replaced(smallStudy(), "elevation = 30\n", "elevation = 30\nradius = 0\n"));
  EXPECT_EQ(read("out/small/metrics.csv"), metrics);
  EXPECT_EQ(read("out/small/masks/camera_evening_truth.png"), truth);
}

TEST_F(SoftLight, IsMeasuredByTheShareThatIsSeen) {
  runStudy("small", soft("\n[[method]]\nname = \"max-forsyth\"\ndisc = true\n"));
  for (const std::string method : {"unshadowed", "max-forsyth", "max-forsyth + disc"}) {
    const nlohmann::json found = row(method);
    EXPECT_EQ(found.at("mae"), found.at("error_rate"));
    const auto number = [&](const char* key) { return found.at(key).get<double>(); };
    EXPECT_NEAR(number("false_shadow") + number("false_light"), number("mae"), 1e-12);
    EXPECT_NEAR(number("tp") + number("fp") + number("fn") + number("tn"), number("samples"), 1e-6);
    EXPECT_GE(number("rmse"), number("mae"));
  }
  EXPECT_LT(row("max-forsyth + disc").at("mae"), row("max-forsyth").at("mae"));
  EXPECT_EQ(row("max-forsyth").at("penumbra_iou"), 0) << "a hard answer has none";
  EXPECT_GT(row("max-forsyth + disc").at("penumbra_iou"), 0);
  const nlohmann::json flip = summary("small").at("truth").at("flips").at(0);
  EXPECT_EQ(flip.at("flip_rate"), flip.at("shares").at("mae"));
  EXPECT_GE(flip.at("percentile_99"), 0);
  EXPECT_GE(flip.at("percentile_99_9"), flip.at("percentile_99"));
  EXPECT_GT(flip.at("percentile_99_9"), flip.at("flip_rate")) << "far more than the mean";
  EXPECT_LE(std::abs(flip.at("brightening").get<double>()), flip.at("flip_rate").get<double>());
  EXPECT_THAT(read("out/small/report.html"), HasSubstr("A single sample may be off by far more"));
  // The terminal breaks lines.
  const std::string terminal =
      std::regex_replace(gnomon({"run", "small.toml"}).out, std::regex("\\s+"), " ");
  EXPECT_THAT(terminal, HasSubstr("A single sample may be off by far more: 99.9 % of them"));
  EXPECT_THAT(read("out/small/metrics.csv"), HasSubstr("penumbra_width_ratio"));
  EXPECT_THAT(read("out/small/report.html"), HasSubstr("The lights are discs"));
}

TEST_F(SoftLight, LeavesMasksThatCompareReads) {
  runStudy("small", soft("\n[[method]]\nname = \"max-forsyth\"\ndisc = true\n"));
  const std::string mine = "out/small/masks/camera_evening_max-forsyth-disc.png";
  const std::string truth = "out/small/masks/camera_evening_truth.png";
  const auto figures = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"compare", mine, truth, "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = gnomon(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  };
  const nlohmann::json found = figures({"--difference", "difference.png"});
  const nlohmann::json own = row("max-forsyth + disc");
  EXPECT_EQ(found.at("shares"), true);
  EXPECT_EQ(found.at("samples"), own.at("samples"));
  for (const char* key : {"error_rate", "mae", "rmse", "umbra_iou", "penumbra_iou", "iou"}) {
    EXPECT_NEAR(found.at(key).get<double>(), own.at(key).get<double>(), 2e-5) << key;
  }
  EXPECT_EQ(found.at("assd"), own.at("assd")) << "of the cuts";
  EXPECT_TRUE(fs::exists(file("difference.png")));
  const nlohmann::json cut = figures({"--binarise", "0.5"});
  EXPECT_FALSE(cut.contains("shares"));
  EXPECT_GT(cut.at("truth").at("binarised"), 0);
  EXPECT_EQ(cut.at("samples"), own.at("samples"));
  EXPECT_EQ(cut.at("assd"), own.at("assd"));
  EXPECT_EQ(gnomon({"compare", mine, truth, "--max", "mae=1e-6"}).status, 1);
}

TEST_F(SoftLight, TakesTheSharesOfOtherPrograms) {
  write("small.toml", soft());
  ASSERT_EQ(gnomon({"export", "small.toml"}).status, 0);
  EXPECT_TRUE(fs::exists(file("out/small/export/shares/camera_evening_truth.exr")));
  fs::rename(file("out/small/export/masks"), file("right"));
  runStudy("small", soft("\n[[method]]\nmasks = \"right\"\n"));
  EXPECT_LT(row("right").at("mae"), 1e-5) << "half a step of 16 bits";
}

}  // namespace
}  // namespace gnomon::test
