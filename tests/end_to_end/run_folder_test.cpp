#include <gmock/gmock.h>

#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class RunFolder : public EndToEnd {};

TEST_F(RunFolder, SummaryHasTheKeysThatOthersReadItBy) {
  runStudy("small", smallStudy() + "\n[[threshold]]\nmethod = \"max-forsyth\"\nmax = 0.9\n",
           {"--set", "study.frames=5"});
  const nlohmann::json json = summary("small");
  EXPECT_THAT(json.at("schema").get<std::string>(), HasSubstr("gnomon-summary/"));
  EXPECT_EQ(json.at("status"), "pass");
  EXPECT_EQ(json.at("study").at("name"), "small");
  EXPECT_EQ(json.at("study").at("title"), "Columns on a plane");
  for (const char* key : {"gl_renderer", "gl_version", "embree_version", "opensubdiv_version",
                          "cpu", "commit", "gnomon_version"}) {
    EXPECT_TRUE(json.at("environment").at(key).is_string()) << key;
  }
  // 32² texels at 4 micro-edges each, two triangles a cell.
  EXPECT_EQ(json.at("truth").at("micro_triangles"), 128 * 128 * 2);
  EXPECT_EQ(json.at("truth").at("step_texels"), 0.25);
  EXPECT_GT(json.at("truth").at("bvh_bytes"), 0);
  const double uncertainty = json.at("truth").at("uncertainty");
  EXPECT_GT(uncertainty, 0) << "no mesh is exact, so a half as fine one must differ somewhere";
  EXPECT_LT(uncertainty, 0.02);

  // Two methods with two answers each; all samples and seven regions.
  ASSERT_EQ(json.at("results").size(), 2U * 2U * 8U);
  for (const nlohmann::json& result : json.at("results")) {
    for (const char* key :
         {"method", "light", "view", "answer",     "region",       "samples",     "tp",
          "fp",     "fn",    "tn",   "error_rate", "false_shadow", "false_light", "fpr",
          "fnr",    "ber",   "iou",  "f1",         "mcc",          "prevalence"}) {
      EXPECT_TRUE(result.contains(key)) << key;
      EXPECT_TRUE(!result.at(key).is_null() || result.at("undefined").at(key).is_string()) << key;
    }
  }
  ASSERT_EQ(json.at("cost").size(), 2U);
  const nlohmann::json& cost = json.at("cost").at(1);
  EXPECT_EQ(cost.at("method"), "max-forsyth");
  EXPECT_EQ(cost.at("polygons"), 4 * 4 * 2);
  EXPECT_EQ(cost.at("table_bytes"), 32 * 32 * 8);
  EXPECT_GT(cost.at("frame_ms"), 0);
  EXPECT_EQ(cost.at("still_ms"), cost.at("frame_ms")) << "none of its passes is the light's alone";
  EXPECT_EQ(json.at("cost").at(0).at("table_bytes"), 0) << "bump mapping alone reads no table";
  EXPECT_FALSE(json.at("timings").empty());
  for (const nlohmann::json& timing : json.at("timings")) {
    EXPECT_GE(timing.at("seconds"), 0);
    EXPECT_TRUE(timing.at("stage").is_string());
  }
  ASSERT_EQ(json.at("thresholds").size(), 1U);
  EXPECT_EQ(json.at("thresholds").at(0).at("passed"), true);
}

TEST_F(RunFolder, RegionsPartitionTheSamples) {
  runStudy("small", smallStudy());
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
  runStudy("small", replaced(smallStudy(), "name = \"evening\"", ""),
           {"--set", "light.0.elevation=[30, 50]"});
  const nlohmann::json json = summary("small");
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
  EXPECT_THAT(read("out/small/bins.csv"), HasSubstr("small,unshadowed,camera,all,elevation,"));
}

TEST_F(RunFolder, ReportStandsAlone) {
  runStudy("small", smallStudy());
  const std::string report = read("out/small/report.html");
  EXPECT_THAT(report, HasSubstr("Columns on a plane"));
  EXPECT_THAT(report, HasSubstr("data:image/png;base64,"));
  for (const char* fetch : {"src=\"http", "href=\"http", "url(http", "@import", "<link"}) {
    EXPECT_THAT(report, Not(HasSubstr(fetch)));
  }
}

TEST_F(RunFolder, EveryPictureThatTheSummaryNamesIsThere) {
  runStudy("small", smallStudy());
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
  runStudy("small", smallStudy());
  const auto truth = mask("small", "camera_evening_truth").pixels;
  const std::string displaced = read("out/small/images/camera_evening_displaced.png");
  runStudy("small", smallStudy(),
           {"--set", "method.0.label=truth!", "--set", "method.1.label=displaced"});
  EXPECT_EQ(mask("small", "camera_evening_truth").pixels, truth);
  EXPECT_EQ(read("out/small/images/camera_evening_displaced.png"), displaced);
}

// A run begins by removing what an earlier one wrote.
TEST_F(RunFolder, WhatTheStudyReadsIsNotRemoved) {
  runStudy("small", smallStudy());
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
  runStudy("small", smallStudy(), {"--out", "whole"});
  for (const int milliseconds : {60, 120, 180, 240, 300}) {
    runAndKill(folder(), {"run", "small.toml", "--out", "cut"}, milliseconds);
    for (const std::string& name : filesBelow("cut")) {
      // What was being written has a hidden name of its own.
      const bool temporary = std::filesystem::path(name).filename().string().front() == '.';
      if (temporary || std::filesystem::path(name).extension() != ".png") continue;
      EXPECT_NO_THROW(readGrey(file("cut") / name)) << name << " after " << milliseconds << " ms";
    }
  }
  runStudy("small", smallStudy(), {"--out", "cut"});
  EXPECT_EQ(read("cut/small/metrics.csv"), read("whole/small/metrics.csv"));
}

}  // namespace
}  // namespace gnomon::test
