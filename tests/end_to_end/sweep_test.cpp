#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "end_to_end/support/program.h"

// Sweeps of several keys, the long table, and runs that write figures alone.

namespace gnomon::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* sweptHeights = R"(
[sweep]
key = "relief.height"
values = [1, 6]
axis = "height, world units"
)";

constexpr const char* claim = R"(
[[claim]]
text = "Shadows matter"
source = "a test"
less = "max-forsyth"
than = "unshadowed"
)";

std::string sweepStudy() {
  return smallStudy() + claim + sweptHeights;
}

class SweepRun : public EndToEnd {};

TEST_F(SweepRun, EveryStepIsTheRunThatAnOverrideGives) {
  runStudy("small", sweepStudy());
  for (const char* height : {"1", "6"}) {
    runStudy("small", smallStudy(),
             {"--set", std::string("relief.height=") + height, "--out",
              std::string("single-") + height});
    const nlohmann::json step = summary(std::string("small/") + height);
    const nlohmann::json single = summary("small", std::string("single-") + height);
    EXPECT_EQ(step.at("results"), single.at("results"));
    const std::string mask = "/masks/camera_evening_max-forsyth.png";
    EXPECT_EQ(read(std::string("out/small/") + height + mask),
              read(std::string("single-") + height + "/small" + mask));
  }
  const nlohmann::json json = summary("small");
  EXPECT_EQ(json.at("schema"), "gnomon-sweep/3");
  EXPECT_EQ(json.at("keys").at(0).at("axis"), "height, world units");
  ASSERT_EQ(json.at("results").size(), 4U);
  for (const nlohmann::json& row : json.at("results")) {
    const nlohmann::json step = summary(row.at("case") == 1 ? "small/1" : "small/6");
    // One light and one view: the mean is the result.
    const nlohmann::json result = resultOf(step, row.at("method"), "evening", "camera");
    for (const char* figure : {"error_rate", "false_shadow", "false_light"}) {
      EXPECT_EQ(row.at(figure), result.at(figure));
    }
    EXPECT_EQ(row.at("uncertainty"), step.at("truth").at("flips").at(0).at("flip_rate"));
  }
  EXPECT_EQ(summary("small/6").at("claims").at(0).at("verdict"), "held");
  EXPECT_EQ(json.at("claims").at(0).at("verdict"), "not distinguishable") << "as of a low relief";
  EXPECT_THAT(read("out/small/sweep.csv"), HasSubstr("\n6,max-forsyth,"));
  EXPECT_THAT(read("out/small/plots/sweep.svg"), HasSubstr("height, world units"));
  EXPECT_THAT(read("out/small/report.html"), HasSubstr("<figure class=\"plot"));
}

TEST_F(SweepRun, OneGateThatFailsAtOneValueFailsTheCheck) {
  const auto errorAt = [&](const char* height) {
    return resultOf(summary(std::string("small/") + height), "unshadowed", "evening", "camera")
        .at("error_rate")
        .get<double>();
  };
  runStudy("small", sweepStudy());
  ASSERT_GT(errorAt("6"), 1.2 * errorAt("1"));
  const auto checkWith = [&](double limit) {
    write("small.toml", sweepStudy() + "\n[[threshold]]\nmethod = \"unshadowed\"\nmax = " +
                            nlohmann::json(limit).dump() + "\n");
    return gnomon({"check", "small.toml"});
  };
  EXPECT_EQ(checkWith(1.01 * errorAt("6")).status, 0);
  const Outcome failed = checkWith(1.01 * errorAt("1"));
  EXPECT_EQ(failed.status, 1) << failed.err;
  EXPECT_THAT(failed.out, HasSubstr(", camera, evening, at 6: 0."));
  EXPECT_EQ(summary("small").at("status"), "fail");
  EXPECT_EQ(summary("small/1").at("status"), "pass");
  EXPECT_EQ(summary("small/6").at("status"), "fail");
}

TEST_F(SweepRun, BakesTheTablesOfEveryValue) {
  write("small.toml", smallStudy() + "\n[sweep]\nkey = \"bake.radius\"\nvalues = [4, 8]\n");
  const Outcome outcome = gnomon({"bake", "small.toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(read("out/small/4/tables.exr"), read("out/small/8/tables.exr"));
}

TEST_F(SweepRun, WithoutGnuplotNothingIsRun) {
  write("small.toml", sweepStudy());
  const Outcome outcome = gnomon({"run", "small.toml"}, {"PATH=/nowhere"});
  EXPECT_EQ(outcome.status, 4);
  EXPECT_THAT(outcome.err, HasSubstr("gnomon: gnuplot: cannot be started"));
  EXPECT_TRUE(filesBelow("out").empty());
}

using Row = std::map<std::string, std::string>;

/// A CSV without quoted cells.
std::vector<Row> rowsOf(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  const auto cellsOf = [](const std::string& text) {
    std::vector<std::string> cells(1);
    for (const char c : text) {
      if (c == ',') {
        cells.emplace_back();
      } else {
        cells.back() += c;
      }
    }
    return cells;
  };
  std::getline(lines, line);
  const std::vector<std::string> heads = cellsOf(line);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = cellsOf(line);
    EXPECT_EQ(cells.size(), heads.size()) << line;
    Row row;
    for (std::size_t i = 0; i < cells.size(); ++i) row[heads.at(i)] = cells[i];
    rows.push_back(std::move(row));
  }
  return rows;
}

constexpr const char* twoKeys = R"(
[[sweep]]
key = "relief.height"
values = [1, 6]

[[sweep]]
key = "bake.azimuths"
values = "4:8:4"
)";

std::string gridStudy() {
  return replaced(smallStudy(), "step = 0.25", "step = 0.5") + twoKeys;
}

class MetricsOnly : public EndToEnd {};

TEST_F(MetricsOnly, TwoRunsLeaveTheSameBytes) {
  runStudy("small", gridStudy(), {"--metrics-only", "--out", "one"});
  // On one thread, without any cache, over what the first run left, and in another folder.
  runStudy("small", gridStudy(),
           {"--metrics-only", "--out", "two", "--threads", "1", "--no-cache"});
  runStudy("small", gridStudy(), {"--metrics-only", "--out", "two"});
  EXPECT_THAT(filesBelow("one"), ElementsAre("small/cases.csv", "small/files.txt",
                                             "small/small.toml", "small/summary.json"));
  EXPECT_EQ(filesBelow("one"), filesBelow("two"));
  for (const std::string& name : filesBelow("one")) {
    EXPECT_EQ(read("one/" + name), read("two/" + name)) << name;
  }
}

TEST_F(MetricsOnly, ASingleStudyLeavesTheSameBytesToo) {
  const std::string study = replaced(smallStudy(), "frames = 0", "frames = 5");
  runStudy("small", study, {"--metrics-only", "--out", "one"});
  runStudy("small", study, {"--metrics-only", "--out", "two", "--threads", "1"});
  EXPECT_THAT(filesBelow("one"), ElementsAre("small/cases.csv", "small/files.txt",
                                             "small/small.toml", "small/summary.json"));
  for (const std::string& name : filesBelow("one")) {
    EXPECT_EQ(read("one/" + name), read("two/" + name)) << name;
  }
  const nlohmann::json json = summary("small", "one");
  EXPECT_TRUE(json.at("timings").empty());
  EXPECT_TRUE(json.at("truth").at("bvh_bytes").is_null());
  EXPECT_TRUE(json.at("cost").at(1).at("frame_ms").is_null());
  EXPECT_GT(json.at("cost").at(1).at("table_bytes"), 0);
  EXPECT_EQ(json.at("study").at("command"), "gnomon run small.toml --metrics-only");
}

TEST_F(MetricsOnly, NeedsNoGnuplot) {
  write("small.toml", gridStudy());
  const Outcome outcome = gnomon({"run", "small.toml", "--metrics-only"}, {"PATH=/nowhere"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Figures: out/small/cases.csv"));
}

TEST_F(MetricsOnly, AChecksFaultsAreInTheSummary) {
  write("small.toml", gridStudy() + "\n[[threshold]]\nmethod = \"unshadowed\"\nmax = 0.02\n");
  const Outcome outcome = gnomon({"check", "small.toml", "--metrics-only"});
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(", at height-6_azimuths-8: 0."));
  const nlohmann::json json = summary("small");
  EXPECT_EQ(json.at("status"), "fail");
  ASSERT_FALSE(json.at("faults").empty());
  for (const nlohmann::json& fault : json.at("faults")) {
    const auto number = fault.at("case").get<std::size_t>();
    EXPECT_EQ(json.at("steps").at(number - 1).at("status"), "fail");
  }
  const Outcome pictures =
      gnomon({"check", "small.toml", "--metrics-only", "--baseline", "ref", "--update-baseline",
              "--reason", "a test", "--baseline-pictures"});
  EXPECT_EQ(pictures.status, 2);
  EXPECT_THAT(pictures.err, HasSubstr("--baseline-pictures: a run with pictures expected"));
}

// ---- the long table

TEST_F(MetricsOnly, TheLongTableHasTheMetricsOfEveryStep) {
  runStudy("small", replaced(gridStudy(), "frames = 0", "frames = 5"));
  const std::vector<Row> rows = rowsOf(read("out/small/cases.csv"));
  EXPECT_THAT(read("out/small/cases.csv"),
              ::testing::StartsWith("case,relief.height,bake.azimuths,method,view,light,answer,"
                                    "region,metric,value,low,high,uncertainty,unit\n"));
  const nlohmann::json sweep = summary("small");
  ASSERT_EQ(sweep.at("steps").size(), 4U);
  std::size_t found = 0;
  for (const nlohmann::json& step : sweep.at("steps")) {
    const std::string name = step.at("name");
    const nlohmann::json one = summary("small/" + name);
    for (const Row& metrics : rowsOf(read("out/small/" + name + "/metrics.csv"))) {
      const bool isDrawn = metrics.at("answer") == "drawn";
      for (const auto& [metric, value] : metrics) {
        const bool isColumn = metric == "study" || metric == "method" || metric == "light" ||
                              metric == "view" || metric == "answer" || metric == "region" ||
                              metric == "samples" || metric.size() == 2;
        const bool isError =
            metric == "error_rate" || metric == "false_shadow" || metric == "false_light";
        const bool isTold = isDrawn || (metrics.at("region") == "all" && isError);
        // f1 has two letters too, as the counts have.
        if ((isColumn && metric != "f1") || !isTold || value.empty()) continue;
        const auto row =
            std::find_if(rows.begin(), rows.end(), [&, &metric = metric](const Row& other) {
              return other.at("case") == std::to_string(step.at("case").get<int>()) &&
                     other.at("metric") == metric && other.at("method") == metrics.at("method") &&
                     other.at("view") == metrics.at("view") &&
                     other.at("light") == metrics.at("light") &&
                     other.at("answer") == metrics.at("answer") &&
                     other.at("region") == metrics.at("region");
            });
        ASSERT_NE(row, rows.end()) << name << ' ' << metric;
        EXPECT_EQ(row->at("value"), value);
        EXPECT_EQ(row->at("relief.height"), std::to_string(step.at("values").at(0).get<int>()));
        EXPECT_EQ(row->at("bake.azimuths"), std::to_string(step.at("values").at(1).get<int>()));
        const bool isScore = isDrawn && metric == "error_rate" && metrics.at("region") == "all";
        if (isScore) {
          EXPECT_EQ(nlohmann::json::parse(row->at("uncertainty")),
                    one.at("truth").at("flips").at(0).at("flip_rate"));
        }
        if (!isScore) {
          EXPECT_TRUE(row->at("low").empty());
        }
        EXPECT_EQ(row->at("unit"), metric == "mcc"                        ? "correlation"
                                   : metric == "assd" || metric == "hd95" ? "pixels"
                                   : metric == "shadow_runs"              ? "count"
                                   : metric.starts_with("shadow_length")  ? "ratio"
                                                                          : "share");
        ++found;
      }
    }
  }
  EXPECT_EQ(found, rows.size()) << "and nothing else";
  EXPECT_GT(found, 100U);
  // Without pictures the figures are the same.
  runStudy("small", replaced(gridStudy(), "frames = 0", "frames = 5"),
           {"--metrics-only", "--out", "figures"});
  EXPECT_EQ(read("out/small/cases.csv"), read("figures/small/cases.csv"));
  nlohmann::json full = sweep;
  for (nlohmann::json& row : full.at("results")) row["frame_ms"] = nullptr;
  for (const char* key : {"keys", "results", "status", "notices"}) {
    EXPECT_EQ(full.at(key), summary("small", "figures").at(key)) << key;
  }
}

TEST_F(MetricsOnly, TheLongTableHasTheIntervals) {
  const std::string study =
      replaced(replaced(gridStudy(), "width = 64", "width = 256"), "height = 64", "height = 256");
  runStudy("small", study, {"--metrics-only"});
  const nlohmann::json sweep = summary("small");
  std::size_t intervals = 0;
  for (const Row& row : rowsOf(read("out/small/cases.csv"))) {
    if (row.at("low").empty()) continue;
    ++intervals;
    EXPECT_LE(std::stod(row.at("low")), std::stod(row.at("value")));
    EXPECT_GE(std::stod(row.at("high")), std::stod(row.at("value")));
    for (const nlohmann::json& result : sweep.at("results")) {
      if (result.at("method") != row.at("method") ||
          std::to_string(result.at("case").get<int>()) != row.at("case")) {
        continue;
      }
      // One view and one light: its interval is that of the mean.
      EXPECT_EQ(nlohmann::json(result.at("low")).dump(), row.at("low"));
    }
  }
  EXPECT_EQ(intervals, 8U) << "four cases of two methods";
}

}  // namespace
}  // namespace gnomon::test
