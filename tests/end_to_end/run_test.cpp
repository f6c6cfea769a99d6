#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include "end_to_end/support/other_renderer.h"
#include "end_to_end/support/program.h"
#include "support/image_files.h"
#include "support/replaced.h"

// Every row follows from the files of a run alone: from a method's mask, the truth at its samples,
// the regions there, where paths cross a seam, and in an atlas what each sample counts.
// Light from a disc, from the study file to every output.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// One run that every test but the last ones reads.
class RunFolder : public SharedRuns {
 protected:
  void prepare() override {
    runStudy("small", smallStudy() + "\n[[threshold]]\nmethod = \"max-forsyth\"\nmax = 0.9\n",
             {"--set", "study.frames=5"});
  }
};

TEST_F(RunFolder, SummaryHasTheKeysThatOthersReadItBy) {
  const nlohmann::json json = summary("small");
  EXPECT_THAT(json.at("schema").get<std::string>(), HasSubstr("gnomon-summary/"));
  EXPECT_EQ(json.at("status"), "pass");
  // 32² texels at 4 micro-edges each, two triangles a cell.
  EXPECT_EQ(json.at("truth").at("micro_triangles"), 128 * 128 * 2);
  EXPECT_EQ(json.at("truth").at("step_texels"), 0.25);
  EXPECT_GT(json.at("truth").at("bvh_bytes"), 0);
  const double uncertainty = json.at("truth").at("uncertainty");
  EXPECT_GT(uncertainty, 0) << "no mesh is exact, so a half as fine one must differ somewhere";
  EXPECT_LT(uncertainty, 0.02);

  // Two methods with two answers each; all samples and seven regions.
  ASSERT_EQ(json.at("results").size(), 2U * 2U * 8U);
  ASSERT_EQ(json.at("cost").size(), 2U);
  const nlohmann::json& cost = json.at("cost").at(1);
  EXPECT_EQ(cost.at("method"), "max-forsyth");
  EXPECT_EQ(cost.at("polygons"), 4 * 4 * 2);
  EXPECT_EQ(cost.at("table_bytes"), 32 * 32 * 8);
  EXPECT_GT(cost.at("frame_ms"), 0);
  EXPECT_EQ(cost.at("still_ms"), cost.at("frame_ms")) << "none of its passes is the light's alone";
  EXPECT_EQ(json.at("cost").at(0).at("table_bytes"), 0) << "bump mapping alone reads no table";
  ASSERT_EQ(json.at("thresholds").size(), 1U);
  EXPECT_EQ(json.at("thresholds").at(0).at("passed"), true);
}

TEST_F(RunFolder, RegionsPartitionTheSamples) {
  const nlohmann::json json = summary("small");
  for (const char* method : {"unshadowed", "max-forsyth"}) {
    const nlohmann::json all = resultOf(json, method, "evening", "camera");
    for (const char* key : {"samples", "tp", "fp", "fn", "tn"}) {
      double sum = 0;
      for (const char* region :
           {"lit", "attached", "cast", "distant", "global", "beyond-terminator"}) {
        sum += resultOf(json, method, "evening", "camera", region).at(key).get<double>();
      }
      EXPECT_EQ(sum, all.at(key)) << method << ", " << key;
    }
  }
}

/// Under two lights: the rates of "confidence" are the means of the results',
/// and every axis counts each sample once.
TEST_F(RunFolder, ConfidenceAndBinsAgreeWithTheResults) {
  runStudy("lights",
           replaced(replaced(smallStudy(), "name = \"evening\"", ""), "\"small\"", "\"lights\""),
           {"--set", "light.0.elevation=[30, 50]"});
  const nlohmann::json json = summary("lights");
  ASSERT_EQ(json.at("confidence").size(), 2 * 3U) << "2 methods, all lights and each of 2";
  for (const std::string method : {"unshadowed", "max-forsyth"}) {
    double errors = 0;
    nlohmann::json samples = 0;
    double wrong = 0;
    double all = 0;
    for (const nlohmann::json& result : json.at("results")) {
      if (result.at("method") != method || result.at("region") != "all") continue;
      if (result.at("answer") != "drawn") continue;
      errors += result.at("error_rate").get<double>() / 2;
      wrong += result.at("fp").get<double>() + result.at("fn").get<double>();
      all += result.at("samples").get<double>();
    }
    for (const nlohmann::json& row : json.at("confidence")) {
      if (row.at("method") != method || row.at("light") != "all") continue;
      EXPECT_NEAR(row.at("error_rate").get<double>(), errors, 1e-12);
      if (row.at("low").is_null()) {
        EXPECT_TRUE(row.at("reason").is_string());
      } else {
        EXPECT_LE(row.at("low").get<double>(), errors);
        EXPECT_GE(row.at("high").get<double>(), errors);
      }
    }
    for (const char* axis : {"curvature_height", "elevation", "terminator", "uv_stretch"}) {
      double binned = 0;
      double wrongBinned = 0;
      for (const nlohmann::json& bin : json.at("bins")) {
        if (bin.at("method") != method || bin.at("axis") != axis) continue;
        binned += bin.at("samples").get<double>();
        wrongBinned += bin.at("fp").get<double>() + bin.at("fn").get<double>();
      }
      EXPECT_EQ(binned, all) << axis;
      EXPECT_EQ(wrongBinned, wrong) << axis;
    }
  }
  // All lights together, then each.
  ASSERT_EQ(json.at("differences").size(), 3U);
  EXPECT_EQ(json.at("differences").at(0).at("light"), "all");
  for (const nlohmann::json& difference : json.at("differences")) {
    EXPECT_EQ(difference.at("first"), "unshadowed");
    EXPECT_EQ(difference.at("second"), "max-forsyth");
    const double value = difference.at("difference");
    ASSERT_TRUE(difference.at("low").is_number()) << difference.at("reason");
    const double low = difference.at("low");
    const double high = difference.at("high");
    EXPECT_LT(low, value);
    EXPECT_GT(high, value);
    const bool sure =
        (low > 0 || high < 0) && std::abs(value) > difference.at("uncertainty").get<double>();
    EXPECT_EQ(difference.at("verdict"), !sure       ? "not distinguishable"
                                        : value < 0 ? "better"
                                                    : "worse");
  }
  EXPECT_THAT(read("out/lights/bins.csv"), HasSubstr("lights,unshadowed,camera,all,elevation,"));
}

TEST_F(RunFolder, EveryPictureThatTheSummaryNamesIsThere) {
  const nlohmann::json json = summary("small");
  int pictures = 0;
  for (const nlohmann::json& panel : json.at("panels")) {
    for (const nlohmann::json& picture : panel.at("pictures")) {
      const GreyImage image = readGrey(file("out/small") / picture.at("path").get<std::string>());
      EXPECT_EQ(image.width, panel.at("width"));
      EXPECT_EQ(image.height, panel.at("height"));
      ++pictures;
    }
  }
  EXPECT_EQ(pictures, 2 + 2 + 2) << "2 methods, truth and displaced mesh, 2 differences";
}

TEST_F(RunFolder, AMethodOfTheTruthsFileNameDoesNotReplaceIt) {
  const auto truth = mask("small", "camera_evening_truth").pixels;
  const std::string displaced = read("out/small/images/camera_evening_displaced.png");
  runStudy(
      "small", smallStudy(),
      {"--out", "others", "--set", "method.0.label=truth!", "--set", "method.1.label=displaced"});
  EXPECT_EQ(readGrey(file("others/small/masks/camera_evening_truth.png")).pixels, truth);
  EXPECT_EQ(read("others/small/images/camera_evening_displaced.png"), displaced);
}

// A run begins by removing what an earlier one wrote.
TEST_F(RunFolder, WhatTheStudyReadsIsNotRemoved) {
  const std::string mask = read("out/small/masks/camera_evening_truth.png");
  write("small.toml", smallStudy() +
                          "\n[[method]]\nmasks = \"out/small/masks\"\nlabel = \"drawn\"\n"
                          "\n[[threshold]]\nmax = 0.9\n");
  for (const char* command : {"run", "check"}) {
    const Outcome outcome = gnomon({command, "small.toml"});
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.err, HasSubstr("out/small/masks/camera_evening_truth.png: an earlier run "
                                       "wrote this file, the new one would read it and remove it"));
    EXPECT_EQ(read("out/small/masks/camera_evening_truth.png"), mask);
  }
  EXPECT_EQ(gnomon({"run", "small.toml", "--out", "other"}).status, 0);
}

TEST_F(RunFolder, AKilledRunLeavesNothingHalfWrittenAndCanBeRunAgain) {
  write("small.toml", smallStudy());
  for (const int milliseconds : {60, 180, 300}) {
    runAndKill(folder(), {"run", "small.toml", "--out", "cut"}, milliseconds);
    for (const std::string& name : filesBelow("cut")) {
      // What was being written has a hidden name of its own.
      const bool temporary = std::filesystem::path(name).filename().string().front() == '.';
      if (temporary || std::filesystem::path(name).extension() != ".png") continue;
      EXPECT_NO_THROW(readGrey(file("cut") / name)) << name << " after " << milliseconds << " ms";
    }
  }
  runStudy("small", smallStudy(), {"--out", "cut"});
  EXPECT_EQ(read("cut/small/metrics.csv"), read("out/small/metrics.csv"));
}

/// Two squares whose texture coordinates do not continue each other, bent so that they shade one
/// another, under methods that draw three meshes.
std::string study() {
  std::string text = replaced(smallStudy(), "shape = \"plane\"\nquads = [4, 4]\nsize = [32, 32]",
                              "mesh = \"bent.obj\"\nscheme = \"catmull-clark\"");
  text = replaced(text, "name = \"evening\"\n", "");
  text = replaced(text, "elevation = 30", "elevation = [20, 50]");
  return text +
         "base = { subdivisions = 3 }\n\n[[method]]\nname = \"onoue-2004\"\n"
         "\n[[method]]\nname = \"shadow-volume\"\n\n[[method]]\nname = \"shadow-map\"\n";
}

/// With an atlas after its camera.
std::string withAtlas(const std::string& text) {
  return replaced(text, "[[light]]", "[[view]]\ntype = \"atlas\"\nsamples = 9\n\n[[light]]");
}

constexpr const char* bentObj =
    "v -16 -16 9\nv 0 -16 0\nv 16 -16 9\nv -16 16 9\nv 0 16 0\nv 16 16 9\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 2/2 5/3 4/4\nf 2/1 3/2 6/3 5/4\n";

class RowsFromFiles : public SharedRuns {
 protected:
  void prepare() override {
    write("bent.obj", bentObj);
    runStudy("small", withAtlas(study()));
  }
  /// The picture of a shaded panel entry.
  struct Source {
    nlohmann::json picture;
    std::string view, light;
  };
  [[nodiscard]] std::vector<Source> shadings(const nlohmann::json& json) const {
    std::vector<Source> found;
    for (const nlohmann::json& panel : json.at("panels")) {
      for (const nlohmann::json& picture : panel.at("pictures")) {
        if (picture.at("kind") == "shaded") {
          found.push_back({picture, panel.at("view"), panel.at("light")});
        }
      }
    }
    return found;
  }
  [[nodiscard]] std::filesystem::path inRun(const nlohmann::json& path) const {
    return file("out/small") / path.get<std::string>();
  }
};

/// What a row counts.
struct MeasuredRow {
  double samples = 0, tp = 0, fp = 0, fn = 0, tn = 0;
};

/// Counts as `gnomon compare` does: where both masks have a sample. Rows of the picture are summed
/// first.
/// @param weights  one a sample, or none for 1 each
template <typename IsIn>
MeasuredRow countRow(const GreyImage& method, const GreyImage& truth,
                     const std::vector<float>& weights, const IsIn& isIn) {
  MeasuredRow sum;
  for (int y = 0; y < truth.height; ++y) {
    MeasuredRow row;
    for (int x = 0; x < truth.width; ++x) {
      const auto i = static_cast<std::size_t>(y * truth.width + x);
      if (truth.pixels[i] == 128 || method.pixels[i] == 128 || !isIn(i)) continue;
      const bool isDark = method.pixels[i] == 0;
      const bool shouldBe = truth.pixels[i] == 0;
      const double weight = weights.empty() ? 1 : static_cast<double>(weights.at(i));
      (shouldBe ? (isDark ? row.tp : row.fn) : (isDark ? row.fp : row.tn)) += weight;
      ++row.samples;
    }
    sum.samples += row.samples;
    sum.tp += row.tp;
    sum.fp += row.fp;
    sum.fn += row.fn;
    sum.tn += row.tn;
  }
  return sum;
}

TEST_F(RowsFromFiles, GiveEveryRow) {
  const nlohmann::json json = summary("small");
  std::size_t rows = 0;
  std::size_t withSamples = 0;
  for (const Source& source : shadings(json)) {
    const std::string method = source.picture.at("method");
    if (method == "truth") continue;
    const nlohmann::json& files = source.picture.at("truth");
    const GreyImage drawn = readGrey(inRun(source.picture.at("mask")));
    const GreyImage test = readGrey(inRun(source.picture.at("test_mask")));
    const GreyImage truth = readGrey(inRun(files.at("mask")));
    const std::vector<unsigned char> regions = readColours(inRun(files.at("regions")));
    const bool crosses = !files.at("seam").is_null();
    const GreyImage seam = crosses ? readGrey(inRun(files.at("seam"))) : truth;
    ASSERT_EQ(files.at("weights").is_null(), source.view == "camera");
    std::vector<float> weights;
    if (source.view != "camera") weights = readChannels(inRun(files.at("weights"))).of.at("area");
    for (const nlohmann::json& result : json.at("results")) {
      if (result.at("method") != method || result.at("view") != source.view ||
          result.at("light") != source.light) {
        continue;
      }
      const std::string region = result.at("region");
      const GreyImage& mask = result.at("answer") == "drawn" ? drawn : test;
      const MeasuredRow row = countRow(mask, truth, weights, [&](std::size_t i) {
        if (region == "all") return true;
        if (region == "seam") return crosses && seam.pixels[i] == 255;
        const nlohmann::json& colour = json.at("region_colours").at(region);
        for (std::size_t c = 0; c < 3; ++c) {
          if (regions[3 * i + c] != colour.at(c)) return false;
        }
        return true;
      });
      const std::string where =
          fmt::format("{}, {}, {}, {}", method, source.view, source.light, region);
      EXPECT_EQ(row.samples, result.at("samples")) << where;
      EXPECT_EQ(row.tp, result.at("tp")) << where;
      EXPECT_EQ(row.fp, result.at("fp")) << where;
      EXPECT_EQ(row.fn, result.at("fn")) << where;
      EXPECT_EQ(row.tn, result.at("tn")) << where;
      if (row.samples > 0) {
        EXPECT_DOUBLE_EQ((row.fp + row.fn) / (row.tp + row.fp + row.fn + row.tn),
                         result.at("error_rate"))
            << where;
        ++withSamples;
      }
      ++rows;
    }
  }
  EXPECT_EQ(rows, json.at("results").size());
  EXPECT_EQ(rows, (5U + 4U) * 2 * 2 * 8)
      << "methods (shadow volumes have no atlas), lights, answers, regions";
  EXPECT_GT(withSamples, (5U + 4U) * 2 * 4) << "else the regions are next to empty";
}

TEST_F(RowsFromFiles, MethodsThatDrawOtherMeshesHaveTruthsOfTheirOwn) {
  std::map<std::string, std::set<std::string>> truthsOf;
  for (const Source& source : shadings(summary("small"))) {
    if (source.view != "camera") continue;
    truthsOf[source.picture.at("method")].insert(source.picture.at("truth").at("mask"));
  }
  EXPECT_EQ(truthsOf.at("onoue-2004"), truthsOf.at("truth"));
  EXPECT_EQ(truthsOf.at("unshadowed"), truthsOf.at("truth"));
  EXPECT_EQ(truthsOf.at("shadow-volume"), truthsOf.at("shadow-map"));
  EXPECT_NE(truthsOf.at("shadow-volume"), truthsOf.at("truth"));
  EXPECT_NE(truthsOf.at("max-forsyth"), truthsOf.at("truth"));
  EXPECT_NE(truthsOf.at("max-forsyth"), truthsOf.at("shadow-volume"));
  for (const auto& [method, files] : truthsOf) EXPECT_EQ(files.size(), 2U) << "a light each";
  // They differ in more than their names: the standard base's truth does not give a rival's rows.
  EXPECT_NE(read("out/small/" + *truthsOf.at("shadow-map").begin()),
            read("out/small/" + *truthsOf.at("truth").begin()));
}

TEST_F(RowsFromFiles, AnAtlasShowsAllMethodsTheSameSamples) {
  std::set<std::string> files;
  for (const Source& source : shadings(summary("small"))) {
    if (source.view == "atlas") files.insert(source.picture.at("truth").at("mask"));
  }
  EXPECT_EQ(files.size(), 2U) << "one a light";
}

class SoftLight : public SharedRuns {
 protected:
  void prepare() override {
    runStudy("small", soft("\n[[method]]\nname = \"max-forsyth\"\ndisc = true\n"));
  }
  static std::string soft(const std::string& more = "") {
    return replaced(smallStudy(), "elevation = 30\n", "elevation = 30\nradius = 4\n") + more;
  }
  [[nodiscard]] nlohmann::json row(const std::string& label,
                                   const std::string& answer = "drawn") const {
    return resultOf(summary("small"), label, "evening", "camera", "all", answer);
  }
};

TEST_F(SoftLight, OfRadiusZeroIsAPointToTheByte) {
  runStudy("point", replaced(smallStudy(), "\"small\"", "\"point\""));
  const std::string metrics = read("out/point/metrics.csv");
  const std::string truth = read("out/point/masks/camera_evening_truth.png");
  EXPECT_THAT(metrics, Not(HasSubstr("penumbra")));
  runStudy("point", read("point.toml"), {"--set", "light.0.radius=0"});
  EXPECT_EQ(read("out/point/metrics.csv"), metrics);
  EXPECT_EQ(read("out/point/masks/camera_evening_truth.png"), truth);
}

TEST_F(SoftLight, IsMeasuredByTheShareThatIsSeen) {
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
  EXPECT_THAT(read("out/small/metrics.csv"), HasSubstr("penumbra_width_ratio"));
}

TEST_F(SoftLight, LeavesMasksThatCompareReads) {
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
  runStudy("given", replaced(soft("\n[[method]]\nmasks = \"right\"\n"), "\"small\"", "\"given\""));
  EXPECT_LT(resultOf(summary("given"), "right", "evening", "camera").at("mae"), 1e-5)
      << "half a step of 16 bits";
}

}  // namespace
}  // namespace gnomon::test
