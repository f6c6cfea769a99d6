#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cstdio>
#include <filesystem>

#include "end_to_end/support/program.h"

// What a run leaves is enough to make it again.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// What another program says of a file.
std::string sha256sum(const fs::path& file) {
  std::string text(64, ' ');
  FILE* pipe = popen(("sha256sum '" + file.string() + "'").c_str(), "r");
  const std::size_t read = fread(text.data(), 1, text.size(), pipe);
  pclose(pipe);
  return read == text.size() ? text : "";
}

class Reproduction : public EndToEnd {
 protected:
  void SetUp() override {
    fs::copy(fs::path(GNOMON_OWN_METHODS) / "biased-horizon.glsl", file("mine.glsl"));
  }
  [[nodiscard]] static std::string study() {
    std::string text = replaced(smallStudy(), "elevation = 30", "elevation = [50.3, 20]");
    return replaced(text, "name = \"evening\"\n", "") +
           "\n[[method]]\nfile = \"mine.glsl\"\n[method.parameters]\nbias = 0.1\n"
           "\n[[view]]\ntype = \"atlas\"\nsamples = 17\n"
           "\n[[threshold]]\nmax = 0.9\n\n[[threshold]]\nmax = 0.8\nquick = false\n";
  }
  void runAgain(const std::string& copy, const std::string& out) const {
    const Outcome outcome = gnomon({"run", copy, "--out", out});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  void expectSame(const std::string& a, const std::string& b) const {
    const std::vector<std::string> files = filesBelow(a + "/masks");
    EXPECT_FALSE(files.empty());
    EXPECT_EQ(files, filesBelow(b + "/masks"));
    for (const std::string& name : files) {
      const auto maskIn = [&](const std::string& folder) {
        return read(fmt::format("{}/masks/{}", folder, name));
      };
      EXPECT_TRUE(maskIn(a) == maskIn(b)) << name;
    }
    const nlohmann::json x = nlohmann::json::parse(read(a + "/summary.json"));
    const nlohmann::json y = nlohmann::json::parse(read(b + "/summary.json"));
    for (const char* key : {"results", "differences", "thresholds", "status"}) {
      EXPECT_EQ(x.at(key), y.at(key)) << key;
    }
  }
};

TEST_F(Reproduction, ARunsCopyGivesTheSameRun) {
  runStudy("small", study());
  runAgain("out/small/small.toml", "again");
  expectSame("out/small", "again/small");
  EXPECT_EQ(read("out/small/small.toml"), read("again/small/small.toml"));
  // In its own folder, too.
  runAgain("out/small/small.toml", "out");
  expectSame("again/small", "out/small");
  EXPECT_EQ(read("out/small/small.toml"), read("again/small/small.toml"));
}

TEST_F(Reproduction, OptionsAreInTheCopy) {
  runStudy("small", study(),
           {"--quick", "--set", "relief.height=6.7", "--set", "truth.step=0.0625", "--method",
            "max-forsyth", "--method", "mine", "--replace", "max-forsyth=onoue-2004"});
  EXPECT_EQ(summary("small").at("panels").at(0).at("width"), 16);
  runAgain("out/small/small.toml", "again");
  expectSame("out/small", "again/small");
}

TEST_F(Reproduction, WithoutAStepTheTruthIsTheSame) {
  runStudy("small", replaced(study(), "step = 0.25", ""), {"--quick"});
  runAgain("out/small/small.toml", "again");
  expectSame("out/small", "again/small");
  EXPECT_EQ(summary("small").at("truth").at("micro_triangles"),
            summary("small", "again").at("truth").at("micro_triangles"));
}

TEST_F(Reproduction, EveryValueOfASweepHasItsCommand) {
  runStudy("small", study() + "\n[sweep]\nkey = \"relief.height\"\nvalues = [1, 6.5]\n",
           {"--method", "max-forsyth"});
  for (const char* value : {"1", "6.5"}) {
    const std::string name = std::string("small/") + value;
    const std::string command = summary(name).at("study").at("command");
    const std::string copy = "out/" + name + "/small-" + value + ".toml";
    ASSERT_EQ(command, "gnomon run " + copy);
    const Outcome outcome = gnomon({"run", copy});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    expectSame("out/" + name, std::string("out/small-") + value);
  }
}

TEST_F(Reproduction, ASweepsCopyGivesTheSameSweep) {
  runStudy(
      "small", study() + "\n[sweep]\nkey = \"relief.height\"\nvalues = [1, 6.5]\n",
      {"--quick", "--method", "mine", "--set", "bake.azimuths=6", "--set", "truth.step=0.125"});
  EXPECT_EQ(summary("small").at("study").at("copy"), "small.toml");
  runAgain("out/small/small.toml", "again");
  for (const char* value : {"/1", "/6.5"}) {
    expectSame(std::string("out/small") + value, std::string("again/small") + value);
  }
  EXPECT_EQ(read("out/small/sweep.csv"), read("again/small/sweep.csv"));
}

TEST_F(Reproduction, TheSummaryNamesEverySettingAndInput) {
  runStudy("small", study(), {"--set", "relief.height=6.7"});
  const nlohmann::json study = summary("small").at("study");
  const nlohmann::json& settings = study.at("settings");
  EXPECT_EQ(settings.at("relief").at("height"), 6.7);
  EXPECT_EQ(settings.at("relief").at("height_space"), "world");
  EXPECT_EQ(settings.at("relief").at("wrap"), "repeat");
  EXPECT_EQ(settings.at("light").at(0).at("elevation"), 50.3);
  EXPECT_EQ(settings.at("light").at(1).at("azimuth"), 20);
  EXPECT_EQ(settings.at("method").at(2).at("parameters").at("bias"), 0.1);
  EXPECT_EQ(settings.at("method").at(2).at("bake").at("azimuths"), 8);
  EXPECT_EQ(settings.at("view").at(1).at("samples"), 17);
  std::size_t found = 0;
  for (const nlohmann::json& input : study.at("inputs")) {
    const std::string name = input.at("file");
    const fs::path path = name.starts_with("shaders/")
                              ? fs::path(GNOMON_SCENES).parent_path() / name
                              : (file("out/small") / name).lexically_normal();
    EXPECT_EQ(input.at("sha256"), sha256sum(path)) << name;
    found += name == "../../small.toml" || name == "../../mine.glsl" ? 1U : 0U;
  }
  EXPECT_EQ(found, 2U);
}

TEST_F(Reproduction, AFileOfSomebodyElseStays) {
  fs::create_directories(file("out/small"));
  write("out/small/small.toml", study());
  write("small.toml", study());
  const Outcome outcome = gnomon({"run", "small.toml"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("gnomon: out/small/small.toml: a file found that no run"));
  EXPECT_EQ(read("out/small/small.toml"), study());
  EXPECT_EQ(filesBelow("out").size(), 1U);
}

}  // namespace
}  // namespace gnomon::test
