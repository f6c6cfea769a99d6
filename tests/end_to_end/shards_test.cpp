#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "end_to_end/support/lasting_files.h"
#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* heights = R"(
[[claim]]
text = "Shadows matter"
source = "a test"
less = "max-forsyth"
than = "unshadowed"

[sweep]
key = "relief.height"
values = [1, 2, 3, 4, 6]
)";

constexpr const char* otherClaim = R"(
[[claim]]
text = "Shadows matter here"
source = "a test"
less = "max-forsyth"
than = "unshadowed"

[[threshold]]
max = 0.9
)";

/// A study and a sweep: six cases.
class Shards : public EndToEnd {
 protected:
  Shards() {
    write("small.toml", smallStudy() + heights);
    write("other.toml", test::replaced(smallStudy(), "\"small\"", "\"other\"") + otherClaim);
  }

  [[nodiscard]] Outcome run(std::vector<std::string> options,
                            const std::vector<std::string>& environment = {}) const {
    options.insert(options.begin(), {"run", "other.toml", "small.toml"});
    return gnomon(options, environment);
  }
  [[nodiscard]] Outcome runShard(int index, int count, const std::vector<std::string>& more = {},
                                 const std::vector<std::string>& environment = {}) const {
    const std::string number = std::to_string(index);
    std::vector<std::string> options = {"--shard", number + "/" + std::to_string(count), "--out",
                                        "s" + number};
    options.insert(options.end(), more.begin(), more.end());
    return run(options, environment);
  }
  void runThree(const std::vector<std::string>& more = {}) const {
    for (int i = 1; i <= 3; ++i) {
      const Outcome outcome = runShard(i, 3, more);
      ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
  }
  [[nodiscard]] Outcome merge(std::vector<std::string> shards) const {
    shards.insert(shards.begin(), "merge");
    return gnomon(shards);
  }

  /// What the run without shards leaves in `out`, moved to `whole`; then nothing is in `out`.
  void runWhole(const std::vector<std::string>& more = {}) const {
    const Outcome outcome = run(more);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    fs::rename(file("out"), file("whole"));
  }
  /// That all files are the same in `whole` and `out`, but for what tells of times.
  void expectMerged() const {
    const std::vector<std::string> files = filesBelow("whole");
    EXPECT_GT(files.size(), 150U);
    EXPECT_EQ(files, filesBelow("out"));
    for (const std::string& name : files) {
      const bool same = lasting(name, read("whole/" + name)) == lasting(name, read("out/" + name));
      EXPECT_TRUE(same) << name;
    }
  }
  [[nodiscard]] nlohmann::json manifest(const std::string& shard) const {
    return nlohmann::json::parse(read(shard + "/shard.json"));
  }
  /// When a case was measured.
  [[nodiscard]] fs::file_time_type timeOf(const std::string& name) const {
    return fs::last_write_time(file(name));
  }
};

TEST_F(Shards, MergedInAnyOrderAreTheRunWithoutThem) {
  runWhole();
  runThree();
  const Outcome outcome = merge({"s3", "s1", "s2"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  expectMerged();
  // The command is that of the run without shards.
  const auto command = [&](const std::string& name) {
    return nlohmann::json::parse(read(name)).at("study").at("command");
  };
  EXPECT_EQ(command("out/other/summary.json"), command("whole/other/summary.json"));
  EXPECT_EQ(command("out/small/3/summary.json"), command("whole/small/3/summary.json"));
  // And what it printed is the tables and the ranking.
  EXPECT_THAT(outcome.out, HasSubstr("Report: out/ranking.html"));
}

/// Without times every byte is the same.
TEST_F(Shards, FiguresAloneAreTheSameToTheByte) {
  runWhole({"--metrics-only"});
  runThree({"--metrics-only"});
  const Outcome outcome = merge({"s2", "s3", "s1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::vector<std::string> files = filesBelow("whole");
  EXPECT_GE(files.size(), 9U);
  EXPECT_EQ(files, filesBelow("out"));
  for (const std::string& name : files) {
    EXPECT_TRUE(read("whole/" + name) == read("out/" + name)) << name;
  }
}

TEST_F(Shards, MergeNeedsNoOpenGl) {
  runThree();
  const Outcome without = gnomon({"merge", "s1", "s2", "s3"},
                                 {"__EGL_VENDOR_LIBRARY_DIRS=/nowhere", "EGL_PLATFORM=none"});
  EXPECT_EQ(without.status, 0) << without.err;
}

TEST_F(Shards, PartTheCasesAmongThem) {
  runThree();
  std::vector<std::string> names;
  for (const char* shard : {"s1", "s2", "s3"}) {
    const nlohmann::json json = manifest(shard);
    EXPECT_EQ(json.at("schema"), "gnomon-shard/1");
    EXPECT_EQ(json.at("whole"), true);
    EXPECT_EQ(json.at("cases").size(), 2U);
    for (const auto& one : json.at("cases")) {
      names.push_back(one.at("name"));
      EXPECT_EQ(one.at("sha256").get<std::string>().size(), 64U);
      EXPECT_TRUE(fs::exists(file(std::string(shard) + "/" + names.back() + "/summary.json")));
    }
    // Nothing of the others, and nothing that is over several cases.
    const auto files = filesBelow(shard);
    EXPECT_EQ(std::count_if(files.begin(), files.end(),
                            [](const auto& name) { return name.ends_with("summary.json"); }),
              2);
    EXPECT_FALSE(fs::exists(file(std::string(shard) + "/ranking.json")));
  }
  EXPECT_EQ(names, (std::vector<std::string>{"other", "small/1", "small/2", "small/3", "small/4",
                                             "small/6"}));
}

TEST_F(Shards, TheEnvironmentSaysWhich) {
  const Outcome slurm =
      run({"--out", "slurm"},
          {"SLURM_ARRAY_TASK_ID=12", "SLURM_ARRAY_TASK_MIN=10", "SLURM_ARRAY_TASK_COUNT=3"});
  EXPECT_EQ(slurm.status, 0) << slurm.err;
  EXPECT_EQ(manifest("slurm").at("shard"), 3);
  const Outcome tests = run({"--out", "tests"}, {"TEST_SHARD_INDEX=0", "TEST_TOTAL_SHARDS=3"});
  EXPECT_EQ(tests.status, 0) << tests.err;
  EXPECT_EQ(manifest("tests").at("shard"), 1);
  // The option comes first, and makes of these three a whole.
  const Outcome option =
      run({"--out", "option", "--shard", "2/3"}, {"TEST_SHARD_INDEX=0", "TEST_TOTAL_SHARDS=3"});
  EXPECT_EQ(option.status, 0) << option.err;
  EXPECT_EQ(merge({"slurm", "tests", "option"}).status, 0);
}

TEST_F(Shards, AWrongOptionIsRefusedAndWritesNothing) {
  for (const char* shard : {"0/3", "4/3", "1", "a/b"}) {
    const Outcome outcome = run({"--shard", shard, "--out", "s"});
    EXPECT_EQ(outcome.status, 2) << shard;
    EXPECT_THAT(outcome.err, HasSubstr("I/N expected"));
  }
  EXPECT_FALSE(fs::exists(file("s")));
}

TEST_F(Shards, MoreShardsThanCasesLeaveSomeEmpty) {
  for (int i = 1; i <= 8; ++i) ASSERT_EQ(runShard(i, 8, {"--quick"}).status, 0);
  EXPECT_EQ(manifest("s8").at("cases").size(), 0U);
  const Outcome outcome = merge({"s1", "s2", "s3", "s4", "s5", "s6", "s7", "s8"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST_F(Shards, AShardThatIsKilledGoesOn) {
  const std::vector<std::string> words = {"run", "other.toml", "small.toml", "--shard",
                                          "2/2", "--out",      "s2"};
  ASSERT_EQ(runShard(1, 2).status, 0);
  const bool isKilled = runAndKillWhen(folder(), words, {},
                                       [&] { return fs::exists(file("s2/small/4/case.record")); });
  ASSERT_TRUE(isKilled);
  const Outcome early = merge({"s1", "s2"});
  EXPECT_EQ(early.status, 3);
  EXPECT_THAT(early.err, HasSubstr("s2: shard 2/2 is not whole: "));
  EXPECT_THAT(early.err, HasSubstr("\n  gnomon run other.toml small.toml --out s2 --shard 2/2\n"));
  EXPECT_FALSE(fs::exists(file("out")));
  ASSERT_TRUE(fs::exists(file("s2/small/3/summary.json")));
  const auto before = timeOf("s2/small/3/case.record");
  const Outcome again = gnomon(words);
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(timeOf("s2/small/3/case.record"), before);
  EXPECT_THAT(again.out, Not(HasSubstr("small/3\n")));
  EXPECT_THAT(again.out, HasSubstr("small/6\n"));
  runWhole();
  ASSERT_EQ(merge({"s2", "s1"}).status, 0);
  expectMerged();
}

TEST_F(Shards, AWholeShardIsNotDoneAgainUnlessItIsAskedForOtherThings) {
  ASSERT_EQ(runShard(1, 3).status, 0);
  const auto before = timeOf("s1/other/summary.json");
  // Without any driver: nothing is left to measure.
  const Outcome again = runShard(1, 3, {}, {"__EGL_VENDOR_LIBRARY_DIRS=/nowhere"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(timeOf("s1/other/summary.json"), before);
  ASSERT_EQ(runShard(1, 3, {"--quick"}).status, 0);
  EXPECT_NE(timeOf("s1/other/summary.json"), before);
  const Outcome another = run({"--shard", "2/3", "--out", "s1"});
  EXPECT_EQ(another.status, 3);
  EXPECT_THAT(another.err, HasSubstr("s1: holds shard 1/3"));
  EXPECT_TRUE(fs::exists(file("s1/other/summary.json")));
}

TEST_F(Shards, ADamagedCaseIsDoneAgain) {
  runThree();
  const std::string picture = "s1/other/masks/camera_evening_max-forsyth.png";
  std::string bytes = read(picture);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  write(picture, bytes);
  const Outcome damaged = merge({"s1", "s2", "s3"});
  EXPECT_EQ(damaged.status, 3);
  EXPECT_THAT(damaged.err, HasSubstr("s1: shard 1/3 is not whole: 1 of its 2 cases are missing or "
                                     "damaged, the first is other"));
  ASSERT_EQ(runShard(1, 3).status, 0);
  EXPECT_EQ(merge({"s1", "s2", "s3"}).status, 0);
}

TEST_F(Shards, WhatIsMissingDoubledOrForeignIsNamedWithTheCommandThatMendsIt) {
  runThree();
  const auto expectRefusal = [&](const std::vector<std::string>& shards, const std::string& what,
                                 const std::string& command) {
    const Outcome outcome = merge(shards);
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.err, HasSubstr("gnomon: " + what));
    EXPECT_THAT(outcome.err, HasSubstr("\n  " + command + "\n"));
    EXPECT_FALSE(fs::exists(file("out")));
  };
  expectRefusal({"s3", "s1"}, "shard 2/3 is missing",
                "gnomon run other.toml small.toml --out shard-2-of-3 --shard 2/3");
  fs::copy(file("s2"), file("twin"), fs::copy_options::recursive);
  expectRefusal({"s1", "s2", "s3", "twin"}, "twin: shard 2/3 is there twice, in s2 too",
                "gnomon merge s1 s2 s3 --out out");
  ASSERT_EQ(run({"--shard", "2/3", "--out", "foreign", "--set", "bake.azimuths=16"}).status, 0);
  expectRefusal({"s1", "foreign", "s3"},
                "foreign: shard 2/3 is of `gnomon run other.toml small.toml --set "
                "bake.azimuths=16`, of `gnomon run other.toml small.toml` expected",
                "gnomon run other.toml small.toml --out foreign --shard 2/3");
  ASSERT_EQ(run({"--shard", "2/4", "--out", "quarter"}).status, 0);
  expectRefusal({"s1", "s2", "quarter", "s3"}, "quarter: shard 2/4 is one of 4 shards, of 3",
                "gnomon merge s1 s2 s3 --out out");
  expectRefusal({"s1", "s2"}, "shard 3/3 is missing",
                "gnomon run other.toml small.toml --out shard-3-of-3 --shard 3/3");
  const Outcome none = merge({"s1", "s2", "s3", "nowhere"});
  EXPECT_EQ(none.status, 3);
  EXPECT_THAT(none.err, HasSubstr("nowhere: no shard.json found"));
  EXPECT_EQ(merge({"s1", "s2", "s3", "--out", "s1"}).status, 2);
}

TEST_F(Shards, AnotherVersionOrAnotherTextOfAStudyIsForeign) {
  runThree();
  const std::string text = read("s2/shard.json");
  const std::string commit = manifest("s2").at("gnomon_version");
  write("s2/shard.json", test::replaced(text, "\"gnomon_version\": \"" + commit,
                                        "\"gnomon_version\": \"9." + commit));
  const Outcome version = merge({"s1", "s2", "s3"});
  EXPECT_EQ(version.status, 3);
  EXPECT_THAT(version.err, HasSubstr("s2: shard 2/3 was made by Gnomon 9."));
  write("s2/shard.json", text);
  write("small.toml", "# a remark\n" + smallStudy() + heights);
  const Outcome changed = merge({"s1", "s2", "s3"});
  EXPECT_EQ(changed.status, 3);
  EXPECT_THAT(changed.err,
              HasSubstr("s1: shard 1/3 was made of another text of small.toml\n  gnomon run"));
}

/// The text of the manual's page, from a line on to the end of its block.
std::string exampleOf(const std::string& begin) {
  std::ifstream page(std::string(GNOMON_DOCS) + "/many-machines.md");
  std::ostringstream text;
  text << page.rdbuf();
  const std::size_t at = text.str().find(begin);
  EXPECT_NE(at, std::string::npos) << begin;
  if (at == std::string::npos) return {};
  return text.str().substr(at, text.str().find("\n```", at) + 1 - at);
}

std::string allReplaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// The manual's examples are run as they stand, but for the study.
class ShardExamples : public Shards {
 protected:
  void expectRuns(const std::string& script) const {
    const std::string programs = fs::path(GNOMON_PROGRAM).parent_path().string();
    write("script", "set -eu\nPATH=" + programs + ":$PATH\n" + script);
    const int process = startCommand(folder(), {"sh", "script"}, {}, file("told"), file("error"));
    EXPECT_EQ(endOf(process), 0) << read("error");
    EXPECT_TRUE(fs::exists(file("out/small/summary.json")));
    EXPECT_TRUE(fs::exists(file("out/small/6/summary.json")));
  }
};

TEST_F(ShardExamples, OfGnuParallel) {
  if (std::system("parallel --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no GNU parallel";
  fs::copy(file("small.toml"), file("study.toml"));
  expectRuns(exampleOf("seq 3 | parallel"));
}

TEST_F(ShardExamples, OfAGitHubMatrix) {
  const std::string matrix = exampleOf("name: sweep\n");
  EXPECT_THAT(matrix, HasSubstr("shard: [1, 2, 3, 4]"));
  std::istringstream lines(matrix);
  std::string script, merge;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find("run: ./gnomon ");
    if (at == std::string::npos) continue;
    const std::string command =
        allReplaced(line.substr(at + 7), "scenes/height-sweep.toml", "small.toml") + "\n";
    // One job a shard, as the runner does.
    for (const char* shard : {"1", "2", "3", "4"}) {
      const std::string job = allReplaced(command, "${{ matrix.shard }}", shard);
      if (job != command) script += job;
      if (job == command) merge = job;
    }
  }
  EXPECT_EQ(std::count(script.begin(), script.end(), '\n'), 4);
  expectRuns(script + merge);
}

TEST_F(Shards, AStudyFromAPipeIsRefused) {
  const Outcome outcome = gnomon({"run", "/dev/stdin", "--shard", "1/2"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("the study /dev/stdin is a stream"));
}

TEST_F(Shards, ACaseThatFailsDoesNotKeepTheOthersFromBeingMeasured) {
  write("small.toml", smallStudy() + "[sweep]\nkey = \"truth.step\"\nvalues = [0.25, 100, 0.5]\n");
  const Outcome outcome = gnomon({"run", "small.toml", "--shard", "1/1", "--out", "s1"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("small.toml: small/100: truth.step"));
  EXPECT_EQ(manifest("s1").at("whole"), false);
  EXPECT_EQ(manifest("s1").at("cases").at(2).at("whole"), true);
}

}  // namespace
}  // namespace gnomon::test
