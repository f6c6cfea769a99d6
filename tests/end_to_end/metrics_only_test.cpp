// Sweeps of several keys, the long table, and runs that write figures alone.

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

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

TEST_F(MetricsOnly, HasTheFiguresOfTheFullRun) {
  const std::string study = replaced(gridStudy(), "frames = 0", "frames = 5");
  runStudy("small", study);
  runStudy("small", study, {"--metrics-only", "--out", "figures"});
  EXPECT_EQ(read("out/small/cases.csv"), read("figures/small/cases.csv"));
  nlohmann::json full = summary("small");
  const nlohmann::json figures = summary("small", "figures");
  for (nlohmann::json& row : full.at("results")) row["frame_ms"] = nullptr;
  for (const char* key : {"keys", "results", "status", "notices"}) {
    EXPECT_EQ(full.at(key), figures.at(key)) << key;
  }
  EXPECT_TRUE(figures.at("steps").at(0).at("summary").is_null());
}

TEST_F(MetricsOnly, ItsCopyGivesItAgain) {
  runStudy("small", gridStudy(), {"--metrics-only", "--quick", "--method", "max-forsyth"});
  const Outcome again = gnomon({"run", "out/small/small.toml", "--metrics-only", "--out", "again"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(read("out/small/cases.csv"), read("again/small/cases.csv"));
}

TEST_F(MetricsOnly, RemovesWhatAFullRunLeft) {
  runStudy("small", gridStudy());
  EXPECT_FALSE(read("out/small/height-6_azimuths-8/summary.json").empty());
  runStudy("small", gridStudy(), {"--metrics-only"});
  EXPECT_EQ(filesBelow("out").size(), 4U);
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

TEST_F(MetricsOnly, JudgesReferencesOfEveryCase) {
  // Without any gate a check does not pass.
  write("small.toml", gridStudy() + "\n[[threshold]]\nmethod = \"max-forsyth\"\nmax = 0.9\n");
  const std::vector<std::string> check = {"check", "small.toml", "--metrics-only", "--baseline",
                                          "ref"};
  std::vector<std::string> update = check;
  update.insert(update.end(), {"--update-baseline", "--reason", "a test"});
  const Outcome written = gnomon(update);
  EXPECT_EQ(written.status, 0) << written.err;
  EXPECT_THAT(read("ref/small.json"), HasSubstr("small/height-6_azimuths-8"));
  EXPECT_EQ(gnomon(check).status, 0);
}

// ---- the long table

TEST_F(MetricsOnly, TheLongTableHasTheMetricsOfEveryStep) {
  runStudy("small", gridStudy());
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

TEST_F(MetricsOnly, AFullSweepOfTwoKeysHasPlotsAndTables) {
  runStudy("small", replaced(replaced(gridStudy(), "elevation = 30", "elevation = [50, 20]"),
                             "name = \"evening\"\n", ""));
  for (const char* plot : {"sweep_1", "sweep_2", "sweep_lights_1", "sweep_lights_2"}) {
    EXPECT_THAT(read("out/small/plots/" + std::string(plot) + ".svg"), HasSubstr("</svg>")) << plot;
  }
  EXPECT_THAT(read("out/small/table.tex"), HasSubstr("height & azimuths & unshadowed"));
  const std::string page = read("out/small/report.html");
  EXPECT_THAT(page, HasSubstr("<a href=\"height-6_azimuths-8/report.html\">"));
  EXPECT_THAT(page, Not(HasSubstr("so that no plot shows them")));
}

TEST_F(MetricsOnly, FrameTimesCanBeLeftOut) {
  runStudy("small", smallStudy());
  const nlohmann::json json = summary("small");
  for (const nlohmann::json& cost : json.at("cost")) EXPECT_TRUE(cost.at("frame_ms").is_null());
  for (const nlohmann::json& timing : json.at("timings")) {
    EXPECT_NE(timing.at("stage"), "frame times");
  }
  EXPECT_THAT(read("out/small/report.html"), HasSubstr(">not timed</td>"));
  EXPECT_THAT(read("out/small/table.tex"), HasSubstr("No frame was timed."));
  EXPECT_THAT(read("out/small/table.csv"), HasSubstr(",\n"));
}

}  // namespace
}  // namespace gnomon::test
