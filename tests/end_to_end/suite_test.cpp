#include <gmock/gmock.h>

#include "end_to_end/support/program.h"
#include "end_to_end/support/suite_scenes.h"

// Statistics over the scenes of a suite, by a run and from what runs have left.

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class SuiteRuns : public SuiteScenes {
 protected:
  /// Twenty small scenes of other heights and lights.
  std::vector<std::string> writeScenes() const {
    std::vector<std::string> files;
    for (int i = 0; i < 20; ++i) {
      const std::string name = fmt::format("scene-{:02}", i);
      std::string text = ofSuite(name, "suite-t");
      text = replaced(text, "height = 4\n", fmt::format("height = {}\n", 2 + i % 5));
      text = replaced(text, "elevation = 30", fmt::format("elevation = {}", 20 + 2 * i));
      write(name + ".toml", text);
      files.push_back(name + ".toml");
    }
    return files;
  }
  [[nodiscard]] nlohmann::json statistics(const std::string& folder) const {
    auto json = nlohmann::json::parse(read(folder + "/suite.json"));
    json.erase("command");
    for (nlohmann::json& scene : json["scenes"]) scene.erase("report");
    return json;
  }
};

TEST_F(SuiteRuns, OfTwentyScenesEndWithStatisticsThatTheirFilesGiveAgain) {
  std::vector<std::string> arguments = {"run"};
  const std::vector<std::string> files = writeScenes();
  arguments.insert(arguments.end(), files.begin(), files.end());
  arguments.insert(arguments.end(), {"--quick", "--set", "study.frames=1"});
  const Outcome outcome = gnomon(arguments);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Over the scenes: out/suite.html"));
  const nlohmann::json json = statistics("out");
  EXPECT_EQ(json["suite"], "suite-t");
  EXPECT_EQ(json["scenes"].size(), 20U);
  ASSERT_EQ(json["pairs"].size(), 1U);
  EXPECT_EQ(json["methods"][0]["label"], "max-forsyth");
  EXPECT_EQ(json["pairs"][0]["verdict"], "better");
  // The mean is that of the ranking.
  const auto ranking = nlohmann::json::parse(read("out/ranking.json"));
  EXPECT_NEAR(json["methods"][0]["mean"].get<double>(),
              ranking["methods"][0]["mean_error_rate"].get<double>(), 1e-15);
  EXPECT_THAT(read("out/ranking.txt"), HasSubstr("suite.html"));
  EXPECT_THAT(read("out/suite.html"), HasSubstr("href=\"scene-"));

  ASSERT_EQ(gnomon({"gather", "out", "--out", "gathered"}).status, 0);
  EXPECT_EQ(statistics("gathered"), json);
  EXPECT_EQ(read("gathered/suite.csv"), read("out/suite.csv"));
  EXPECT_EQ(read("gathered/suite.md"), read("out/suite.md"));
  EXPECT_THAT(read("gathered/suite.html"), HasSubstr("href=\"../out/scene-"));

  // The next run of one of them removes what tells of it.
  ASSERT_EQ(gnomon({"run", "scene-00.toml", "--quick"}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(file("out/suite.html")));
  EXPECT_FALSE(std::filesystem::exists(file("out/plots/suite-errors.svg")));
}

class Gather : public SuiteScenes {
 protected:
  void SetUp() override {
    write("drawn.toml", ofSuite("drawn", "suite-t"));
    ASSERT_EQ(gnomon({"run", "drawn.toml", "--quick"}).status, 0);
  }
  void expectRefused(const std::vector<std::string>& folders, const std::string& message) const {
    std::vector<std::string> arguments = {"gather", "--out", "refused"};
    arguments.insert(arguments.end(), folders.begin(), folders.end());
    const Outcome outcome = gnomon(arguments);
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(file("refused/suite.json")));
  }
};

TEST_F(Gather, TakesScenesOfSeveralFolders) {
  copyScenes("out/drawn", "all", 24);
  std::filesystem::create_directories(file("rest"));
  for (const char* scene : {"scene-03", "scene-11"}) {
    std::filesystem::rename(file("all") / scene, file("rest") / scene);
  }
  ASSERT_EQ(gnomon({"gather", "rest", "all", "--out", "parts"}).status, 0);
  const auto json = nlohmann::json::parse(read("parts/suite.json"));
  EXPECT_EQ(json["scenes"].size(), 24U);
  EXPECT_EQ(json["command"], "gnomon gather rest all --out parts");
}

TEST_F(Gather, OfSoftScenesGathersTheirMae) {
  write("soft.toml", replaced(replaced(ofSuite("soft", "suite-s"), "elevation = 30\n",
                                       "elevation = 30\nradius = 4\n"),
                              "name = \"max-forsyth\"", "name = \"max-forsyth\"\ndisc = true"));
  ASSERT_EQ(gnomon({"run", "soft.toml", "--quick", "--metrics-only"}).status, 0);
  std::filesystem::create_directories(file("scenes"));
  const auto summary = nlohmann::json::parse(read("out/soft/summary.json"));
  for (int i = 0; i < 20; ++i) {
    nlohmann::json scene = summary;
    const std::string name = fmt::format("scene-{:02}", i);
    scene["study"]["name"] = name;
    std::filesystem::create_directories(file("scenes/" + name));
    write("scenes/" + name + "/summary.json", scene.dump());
  }
  ASSERT_EQ(gnomon({"gather", "scenes", "--out", "soft"}).status, 0);
  const auto json = nlohmann::json::parse(read("soft/suite.json"));
  EXPECT_EQ(json["statistic"], "mae");
  EXPECT_THAT(read("soft/suite.html"), HasSubstr("the mean of |ΔV| (mae)"));
  for (const nlohmann::json& method : json["methods"]) {
    const auto row = resultOf(summary, method["label"], "evening", "camera");
    EXPECT_NEAR(method["mean"].get<double>(), row.at("mae").get<double>(), 1e-12);
    EXPECT_EQ(row.at("mae"), row.at("error_rate"));
  }
}

TEST_F(Gather, ComparesRankings) {
  copyScenes("out/drawn", "scenes", 20);
  ASSERT_EQ(gnomon({"gather", "scenes", "--out", "first"}).status, 0);
  const Outcome same =
      gnomon({"gather", "scenes", "--out", "second", "--against", "first/suite.json"});
  ASSERT_EQ(same.status, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("Kendall's τ-b 1.000 over 2 methods; 0 of 1 pairs in another"));
  // The other way about.
  auto json = nlohmann::json::parse(read("first/suite.json"));
  std::swap(json["methods"][0]["mean"], json["methods"][1]["mean"]);
  write("first/suite.json", json.dump());
  const Outcome other =
      gnomon({"gather", "scenes", "--out", "third", "--against", "first/suite.json"});
  EXPECT_THAT(other.out, HasSubstr("Kendall's τ-b -1.000 over 2 methods; 1 of 1 pairs in another"));
  EXPECT_THAT(other.out, HasSubstr("before unshadowed here, behind it there"));
  // What the ranking is compared with stays.
  const std::string before = read("first/suite.json");
  const Outcome onItself =
      gnomon({"gather", "scenes", "--out", "first", "--against", "first/suite.json"});
  EXPECT_EQ(onItself.status, 3);
  EXPECT_THAT(onItself.err, HasSubstr("first/suite.json: an earlier run wrote this file"));
  EXPECT_EQ(read("first/suite.json"), before);
}

TEST_F(Gather, ChoosesTheSettingsOfScenesOfTrain) {
  write("methods.toml", "[[method]]\nname = \"max-forsyth\"\nvary = { \"bake.azimuths\" = [8] }\n");
  copyScenes("out/drawn", "train", 20);
  const std::vector<std::string> choose = {"gather",    "train",        "--out",    "statistics",
                                           "--methods", "methods.toml", "--choose", "chosen.toml"};
  const Outcome refused = gnomon(choose);
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, HasSubstr("\"max-forsyth, azimuths 8\" not found among the methods"));
  EXPECT_FALSE(std::filesystem::exists(file("statistics/suite.json")));
  for (int i = 0; i < 20; ++i) {
    const std::string path = fmt::format("train/scene-{:02}/summary.json", i);
    auto scene = nlohmann::json::parse(read(path));
    const auto rename = [](nlohmann::json& text) {
      if (text == "unshadowed") text = "max-forsyth, azimuths 8";
    };
    for (auto& row : scene["results"]) rename(row["method"]);
    for (auto& method : scene["methods"]) rename(method["label"]);
    write(path, scene.dump());
  }
  std::vector<std::string> onItself = choose;
  onItself.back() = "methods.toml";
  EXPECT_EQ(gnomon(onItself).status, 2);
  EXPECT_THAT(read("methods.toml"), HasSubstr("vary"));
  const Outcome outcome = gnomon(choose);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Chosen settings: chosen.toml"));
  // One of both has the smaller mean; the text names it.
  EXPECT_THAT(read("chosen.toml"), HasSubstr("# max-forsyth, bake.azimuths: as declared "));
  EXPECT_EQ(gnomon({"suite", "--seed", "1", "--scenes", "1", "--methods", "methods.toml",
                    "--settings", "chosen.toml"})
                .status,
            0);
}

TEST_F(Gather, RefusesWhatIsNoSuite) {
  copyScenes("out/drawn", "few", 19);
  expectRefused({"few"}, "few: 19 finished scenes of a suite found, 20 or more expected");
  expectRefused({"nowhere"}, "nowhere: cannot be read");
  copyScenes("out/drawn", "other", 19, "suite-u");
  for (int i = 0; i < 19; ++i) {
    const std::string path = fmt::format("other/scene-{:02}/summary.json", i);
    write(path, replaced(read(path), "\"scene-", "\"other-"));
  }
  expectRefused({"few", "other"},
                "few: scenes of \"suite-t\" and \"suite-u\" found, of one suite expected");
  copyScenes("out/drawn", "again", 1);
  expectRefused({"few", "again"},
                "again/scene-00: \"scene-00\" found, which few/scene-00 holds too");
  write("few/scene-04/summary.json",
        replaced(read("few/scene-04/summary.json"), "\"flip_rate\":", "\"flips\":"));
  expectRefused({"few"}, "few/scene-04/summary.json: truth.flips.0.flip_rate: missing, a number");
  write("few/scene-04/summary.json", "{");
  expectRefused({"few"}, "few/scene-04/summary.json:1: no JSON");
}

class RankingOverStudies : public EndToEnd {
 protected:
  /// The small study under the name, with relief of some height.
  void writeStudy(const std::string& name, const std::string& height) const {
    write(name + ".toml", replaced(replaced(smallStudy(), "\"small\"", "\"" + name + "\""),
                                   "height = 4\n", "height = " + height + "\n"));
  }
  [[nodiscard]] double errorIn(const std::string& study, const std::string& method) const {
    return resultOf(summary(study), method, "evening", "camera").at("error_rate");
  }
  [[nodiscard]] nlohmann::json ranking() const {
    return nlohmann::json::parse(read("out/ranking.json"));
  }
};

TEST_F(RankingOverStudies, HoldsTheMeansOfTheStudies) {
  writeStudy("low", "2");
  writeStudy("high", "6");
  // One that asks to be left out.
  writeStudy("apart", "3");
  write("apart.toml", replaced(read("apart.toml"), "[study]\n", "[study]\nranked = false\n"));
  const Outcome outcome = gnomon({"run", "low.toml", "apart.toml", "high.toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(read("out/ranking.csv"), Not(HasSubstr("apart")));
  const nlohmann::json methods = ranking().at("methods");
  ASSERT_EQ(methods.size(), 2U);
  for (const nlohmann::json& method : methods) {
    const std::string label = method.at("label");
    const double low = errorIn("low", label);
    const double high = errorIn("high", label);
    EXPECT_DOUBLE_EQ(method.at("mean_error_rate"), (low + high) / 2);
    EXPECT_DOUBLE_EQ(method.at("worst_error_rate"), std::max(low, high));
    EXPECT_EQ(method.at("worst_study"), high > low ? "high" : "low");
    EXPECT_EQ(method.at("studies"), 2);
  }
  EXPECT_EQ(methods.at(0).at("label"), "max-forsyth");
  EXPECT_THAT(outcome.out, HasSubstr("Methods over 2 studies"));
  EXPECT_THAT(read("out/ranking.html"), HasSubstr("href=\"low/report.html\""));
  EXPECT_THAT(read("out/ranking.csv"), HasSubstr("\nhigh,max-forsyth,"));
}

TEST_F(RankingOverStudies, OneStudyHasNone) {
  writeStudy("low", "2");
  writeStudy("apart", "3");
  write("apart.toml", replaced(read("apart.toml"), "[study]\n", "[study]\nranked = false\n"));
  ASSERT_EQ(gnomon({"run", "low.toml", "apart.toml"}).status, 0);
  EXPECT_TRUE(std::filesystem::exists(file("out/apart/summary.json")));
  EXPECT_FALSE(std::filesystem::exists(file("out/ranking.csv")));
}

}  // namespace
}  // namespace gnomon::test
