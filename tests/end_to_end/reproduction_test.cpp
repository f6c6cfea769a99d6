#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "end_to_end/support/lasting_files.h"
#include "end_to_end/support/program.h"
#include "model/saved_study.h"
#include "study/spec/study_file.h"

// What a run leaves is enough to make it again.
// A saved state of the viewer, run: the same figures and masks as the study run with the state's
// settings.

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

class Repetition : public EndToEnd {
 protected:
  /// On a sphere, where most axes have several bins and so a plot; two views, so that both kinds
  /// are compared, and both lights of a sweep.
  [[nodiscard]] static std::string study() {
    std::string text = replaced(onSphere(smallStudy()), "elevation = 30", "elevation = [50, 20]");
    return replaced(text, "name = \"evening\"\n", "") +
           "\n[[method]]\nname = \"onoue-2004\"\n\n[[view]]\ntype = \"atlas\"\nsamples = 17\n";
  }
  /// The files that must not depend on the run: all but those that tell times.
  [[nodiscard]] std::vector<std::string> lastingFiles(const std::string& out) const {
    std::vector<std::string> files = filesBelow(out);
    std::erase_if(files, [](const std::string& name) {
      return name == "small/summary.json" || name == "small/report.html" ||
             name == "small/table.csv" || name == "small/table.md";
    });
    return files;
  }
};

/// The list of docs/summary.md, "What may differ between two runs": all else is the same.
TEST_F(Repetition, TheWholeFolderIsTheSameButForWhatTheManualLists) {
  write("small.toml", study() + "\n[[threshold]]\nmax = 0.9\n");
  const auto run = [&](const std::string& out, std::vector<std::string> options, const char* zone) {
    options.insert(options.begin(), {"run", "small.toml", "--figures", "page", "--out", out});
    const Outcome outcome =
        gnomon(options, {"GNOMON_CACHE=" + file("kept").string(), std::string("TZ=") + zone});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  };
  run("none", {"--no-cache"}, "UTC");
  run("empty", {"--threads", "1"}, "Asia/Kolkata");
  run("filled", {"--threads", "3"}, "America/St_Johns");
  const std::vector<std::string> files = filesBelow("none");
  EXPECT_GT(files.size(), 40U);
  for (const char* other : {"empty", "filled"}) {
    EXPECT_EQ(files, filesBelow(other));
    for (const std::string& name : files) {
      const bool same = lasting(name, read("none/" + name)) ==
                        lasting(name, read(std::string(other) + "/" + name));
      EXPECT_TRUE(same) << other << ": " << name;
    }
  }
}

TEST_F(Repetition, BesideOtherStudiesAStudyIsTheSame) {
  runStudy("small", study(), {"--out", "alone"});
  write("other.toml",
        replaced(replaced(study(), "\"small\"", "\"other\""), "radius = 4", "radius = 6"));
  const Outcome outcome = gnomon({"run", "other.toml", "small.toml", "--out", "both"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const std::string& name : lastingFiles("alone")) {
    const bool same = read("alone/" + name) == read("both/" + name);
    EXPECT_TRUE(same) << name;
  }
  EXPECT_NE(read("both/other/metrics.csv"), read("both/small/metrics.csv"));
}

/// Makes the C library choose the mathematical functions of a processor without AVX2 and FMA, whose
/// results differ in the last bit.
constexpr const char* plainProcessor = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4";

class Processors : public EndToEnd {
 protected:
  /// What another program computes with the C library's functions.
  [[nodiscard]] std::string sinesWith(const char* variable) const {
    const std::string sines =
        "BEGIN { for (i = 1; i < 200000; ++i) s += sin(i / 7) * exp(-i / 1e5); printf \"%.17g\", s "
        "}";
    const int process =
        startCommand(folder(), {"awk", sines}, {variable}, file("sines"), "/dev/null");
    EXPECT_EQ(endOf(process), 0);
    return read("sines");
  }
};

/// The one kind of result that processors share (docs/many-machines.md) is the same with either.
/// The vectors of the search itself are those of tests/horizon/horizon_targets_test.
TEST_F(Processors, BakeTheSameTables) {
  if (sinesWith("NOTHING=1") == sinesWith(plainProcessor)) {
    GTEST_SKIP() << "this machine's C library has one form of its functions";
  }
  const std::string scenes = GNOMON_SCENES;
  for (const char* scene : {"figure8", "dunes", "spot-cells"}) {
    const std::string study = scenes + "/" + scene + ".toml";
    ASSERT_EQ(gnomon({"bake", study, "--out", "usual"}).status, 0);
    ASSERT_EQ(gnomon({"bake", study, "--out", "plain"}, {plainProcessor}).status, 0);
    const std::string tables = std::string("/") + scene + "/tables.exr";
    EXPECT_GT(read("usual" + tables).size(), 1000U);
    EXPECT_TRUE(read("usual" + tables) == read("plain" + tables)) << scene;
  }
}

}  // namespace
}  // namespace gnomon::test
