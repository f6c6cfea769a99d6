#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "end_to_end/support/lasting_files.h"
#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* heights = R"(
[[claim]]
text = "A table knows shadows"
source = "a test"
less = "max-forsyth"
than = "unshadowed"

[[threshold]]
max = 0.9

[sweep]
key = "relief.height"
values = [1, 2, 3, 4, 6]
)";

/// A study and a sweep: six cases, of which each of three shards has two.
class Shards : public EndToEnd {
 protected:
  Shards() {
    write("small.toml", smallStudy() + heights);
    write("other.toml", test::replaced(smallStudy(), "\"small\"", "\"other\""));
  }

  [[nodiscard]] Outcome run(std::vector<std::string> options,
                            const std::vector<std::string>& environment = {}) const {
    options.insert(options.begin(), {"run", "other.toml", "small.toml"});
    return gnomon(options, environment);
  }
  void expectRun(const std::vector<std::string>& options,
                 const std::vector<std::string>& environment = {}) const {
    const Outcome outcome = run(options, environment);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  [[nodiscard]] Outcome merge(std::vector<std::string> shards) const {
    shards.insert(shards.begin(), "merge");
    return gnomon(shards, {"__EGL_VENDOR_LIBRARY_DIRS=/nowhere", "EGL_PLATFORM=none"});
  }
  void expectRefusal(const std::vector<std::string>& shards, const std::string& what) const {
    const Outcome outcome = merge(shards);
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.err, HasSubstr("gnomon: " + what));
    EXPECT_FALSE(fs::exists(file("out")));
  }
  /// What the run without shards leaves in `out`, moved to `whole`.
  void runWhole(const std::vector<std::string>& options) const {
    expectRun(options);
    fs::rename(file("out"), file("whole"));
  }
};

/// Of options and of the environment, on a machine without OpenGL: every byte is the same.
TEST_F(Shards, FiguresAloneAreTheSameToTheByteAndNothingElseIsMerged) {
  runWhole({"--metrics-only"});
  expectRun({"--metrics-only", "--out", "s1"}, {"TEST_SHARD_INDEX=0", "TEST_TOTAL_SHARDS=3"});
  expectRun({"--metrics-only", "--shard", "2/3", "--out", "s2"},
            {"TEST_SHARD_INDEX=0", "TEST_TOTAL_SHARDS=3"});
  expectRun({"--out", "s3", "--metrics-only"},
            {"SLURM_ARRAY_TASK_ID=12", "SLURM_ARRAY_TASK_MIN=10", "SLURM_ARRAY_TASK_COUNT=3"});
  EXPECT_TRUE(fs::exists(file("s1/other/summary.json")));
  EXPECT_TRUE(fs::exists(file("s1/small/1/summary.json")));
  EXPECT_FALSE(fs::exists(file("s1/small/2")));
  EXPECT_FALSE(fs::exists(file("s1/ranking.json")));

  expectRefusal({"s3", "s1"},
                "shard 2/3 is missing: gnomon run other.toml small.toml --metrics-only --out "
                "shard-2-of-3 --shard 2/3");
  fs::copy(file("s2"), file("twin"), fs::copy_options::recursive);
  expectRefusal({"s1", "s2", "s3", "twin"}, "twin: shard 2/3 is there twice, in s2 too");
  expectRefusal({"s1", "s2", "nowhere"}, "nowhere: no shard.json found");
  EXPECT_EQ(merge({"s1", "s2", "s3", "--out", "s1"}).status, 2);
  const std::string text = read("twin/shard.json");
  const auto expectForeign = [&](const std::string& from, const std::string& to,
                                 const std::string& what) {
    write("twin/shard.json", test::replaced(text, from, to));
    expectRefusal({"s1", "twin", "s3"}, what);
  };
  expectForeign("\"of\": 3", "\"of\": 4", "twin: shard 2/4 is one of 4 shards, of 3");
  expectForeign("\"gnomon_version\": \"", "\"gnomon_version\": \"9.",
                "twin: shard 2/3 is by Gnomon 9.");
  expectForeign("\"--metrics-only\"", "\"--quick\"",
                "twin: shard 2/3 is of `gnomon run other.toml small.toml --quick`, of `gnomon run "
                "other.toml small.toml --metrics-only`");
  const std::string study = read("small.toml");
  write("small.toml", "# a remark\n" + study);
  expectRefusal({"s1", "s2", "s3"}, "s1: shard 1/3 is of another text of small.toml: gnomon run");
  write("small.toml", study);

  const Outcome outcome = merge({"s2", "s3", "s1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::vector<std::string> files = filesBelow("whole");
  EXPECT_GE(files.size(), 9U);
  EXPECT_EQ(files, filesBelow("out"));
  for (const std::string& name : files) {
    EXPECT_TRUE(read("whole/" + name) == read("out/" + name)) << name;
  }
}

/// Pages and pictures differ in what tells of times alone.
TEST_F(Shards, ReportsAreThoseOfTheRunWithoutThem) {
  runWhole({"--quick"});
  for (const char* shard : {"1", "2"}) {
    expectRun({"--quick", "--shard", std::string(shard) + "/2", "--out", std::string("s") + shard});
  }
  const Outcome outcome = merge({"s1", "s2"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Report: out/ranking.html"));
  const std::vector<std::string> files = filesBelow("whole");
  EXPECT_GT(files.size(), 150U);
  EXPECT_EQ(files, filesBelow("out"));
  for (const std::string& name : files) {
    const bool same = lasting(name, read("whole/" + name)) == lasting(name, read("out/" + name));
    EXPECT_TRUE(same) << name;
  }
}

TEST_F(Shards, MoreShardsThanCasesLeaveSomeEmpty) {
  std::vector<std::string> shards;
  for (int i = 1; i <= 8; ++i) {
    shards.push_back("s" + std::to_string(i));
    expectRun(
        {"--quick", "--metrics-only", "--shard", std::to_string(i) + "/8", "--out", shards.back()});
  }
  const Outcome outcome = merge(shards);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST_F(Shards, AWrongOptionOrAStudyFromAPipeIsRefusedAndWritesNothing) {
  const Outcome wrong = run({"--shard", "4/3", "--out", "s"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("I/N expected"));
  const Outcome piped = gnomon({"run", "/dev/stdin", "--shard", "1/2", "--out", "s"});
  EXPECT_EQ(piped.status, 2);
  EXPECT_THAT(piped.err, HasSubstr("the study /dev/stdin is a stream"));
  EXPECT_FALSE(fs::exists(file("s")));
}

TEST_F(Shards, ACaseThatFailsDoesNotKeepTheOthersFromBeingMeasuredButIsNotMerged) {
  write("small.toml", smallStudy() + "[sweep]\nkey = \"truth.step\"\nvalues = [0.25, 100, 0.5]\n");
  const Outcome outcome =
      gnomon({"run", "small.toml", "--metrics-only", "--shard", "1/1", "--out", "s1"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("small.toml: small/100: truth.step"));
  EXPECT_TRUE(fs::exists(file("s1/small/0.5/summary.json")));
  expectRefusal({"s1"}, "s1: no shard.json found");
}

/// The script of a cluster's tasks, with programs that say how they are called in the place of
/// Gnomon and of Slurm's.
TEST_F(Shards, ATaskOfAClusterRunsItsShardAndIsStartedAgainWhenItIsKilled) {
  write("gnomon", "#!/bin/sh\necho \"$@\"\nexit $STATUS\n");
  write("scontrol", "#!/bin/sh\necho scontrol \"$@\"\n");
  for (const char* name : {"gnomon", "scontrol"}) {
    fs::permissions(file(name), fs::perms::owner_all);
  }
  const auto task = [&](std::vector<std::string> environment) {
    environment.push_back("PATH=" + folder().string() + ":/usr/bin:/bin");
    environment.push_back("SLURM_ARRAY_JOB_ID=9");
    const int process = startCommand(folder(), {"sh", GNOMON_SBATCH, "small.toml", "--quick"},
                                     environment, file("told"), file("error"));
    const int status = endOf(process);
    return std::pair(status, read("told"));
  };
  const std::string call = "--threads 2 run small.toml --quick --shard 7/64 --out shards/7\n";
  EXPECT_EQ(task({"SLURM_ARRAY_TASK_ID=7", "SLURM_ARRAY_TASK_COUNT=64", "STATUS=3"}),
            std::pair(3, call));
  // A part of an array is of the whole's number, and a task that was killed is queued again.
  EXPECT_EQ(
      task({"SLURM_ARRAY_TASK_ID=7", "SLURM_ARRAY_TASK_COUNT=2", "GNOMON_SHARDS=64", "STATUS=137"}),
      std::pair(0, call + "scontrol requeue 9_7\n"));
  EXPECT_EQ(task({"SLURM_ARRAY_TASK_ID=7", "SLURM_ARRAY_TASK_COUNT=64", "STATUS=137",
                  "SLURM_RESTART_COUNT=3"}),
            std::pair(137, call));
}

}  // namespace
}  // namespace gnomon::test
