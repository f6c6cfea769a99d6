#include "cli/commands/shards.h"

#include "common/error.h"
#include "support/error_messages.h"
#include "support/scoped_variable.h"
#include "support/temporary_folder.h"

namespace gnomon::cli {
namespace {

using test::ScopedVariable;
using ::testing::HasSubstr;

TEST(Shard, IsReadAndWritten) {
  EXPECT_EQ(parseShard("2/16"), (Shard{2, 16}));
  EXPECT_EQ(parseShard("1/1"), (Shard{1, 1}));
  EXPECT_EQ(shardText({2, 16}), "2/16");
}

TEST(Shard, HasAsManyCasesAsTheOthersToOneAndAllHaveEachOnce) {
  for (const std::size_t count : {0, 1, 5, 6, 1000}) {
    std::size_t next = 0;
    for (int i = 1; i <= 6; ++i) {
      const CaseRange cases = casesOf({i, 6}, count);
      EXPECT_EQ(cases.begin, next);
      EXPECT_GE(cases.end - cases.begin, count / 6);
      EXPECT_LE(cases.end - cases.begin, count / 6 + 1);
      next = cases.end;
    }
    EXPECT_EQ(next, count);
  }
}

TEST(Shard, IsNoPartOfTheCommandThatAllShare) {
  const Arguments words = {"run", "a.toml", "--shard", "1/3", "--set", "x=1", "--shard=2/3"};
  EXPECT_EQ(withoutOption(words, "--shard"), (Arguments{"run", "a.toml", "--set", "x=1"}));
  EXPECT_EQ(withoutOption(words, "--out"), words);
}

TEST(Shard, AnythingElseIsRefused) {
  for (const char* text : {"", "2", "/", "0/3", "4/3", "-1/3", "1/0", "1/3x", " 1/3", "1/3/5",
                           "1.5/3", "1/99999999999", "1/100001", "a/b"}) {
    EXPECT_THAT(messageOf<UsageError>([&] { (void)parseShard(text); }),
                HasSubstr("I/N expected with 1 ≤ I ≤ N"))
        << text;
  }
}

/// An environment that asks for no shard, whatever runs this test.
class ShardOfEnvironment : public TemporaryFolder {
 private:
  ScopedVariable id_{"SLURM_ARRAY_TASK_ID", nullptr}, count_{"SLURM_ARRAY_TASK_COUNT", nullptr},
      min_{"SLURM_ARRAY_TASK_MIN", nullptr}, step_{"SLURM_ARRAY_TASK_STEP", nullptr},
      index_{"TEST_SHARD_INDEX", nullptr}, total_{"TEST_TOTAL_SHARDS", nullptr},
      status_{"TEST_SHARD_STATUS_FILE", nullptr};
};

TEST_F(ShardOfEnvironment, NothingAsksForNone) {
  EXPECT_EQ(shardOfEnvironment(), std::nullopt);
}

TEST_F(ShardOfEnvironment, AnArrayOfSlurm) {
  const ScopedVariable count("SLURM_ARRAY_TASK_COUNT", "4");
  const ScopedVariable id("SLURM_ARRAY_TASK_ID", "3");
  EXPECT_EQ(shardOfEnvironment(), (Shard{3, 4}));
  const ScopedVariable min("SLURM_ARRAY_TASK_MIN", "0");
  EXPECT_EQ(shardOfEnvironment(), (Shard{4, 4}));
  const ScopedVariable far("SLURM_ARRAY_TASK_ID", "15");
  const ScopedVariable from("SLURM_ARRAY_TASK_MIN", "5");
  const ScopedVariable step("SLURM_ARRAY_TASK_STEP", "10");
  EXPECT_EQ(shardOfEnvironment(), (Shard{2, 4}));
}

TEST_F(ShardOfEnvironment, AnUnevenArrayIsRefused) {
  const ScopedVariable count("SLURM_ARRAY_TASK_COUNT", "3");
  const ScopedVariable id("SLURM_ARRAY_TASK_ID", "7");
  EXPECT_THAT(messageOf<UsageError>([] { (void)shardOfEnvironment(); }),
              HasSubstr("SLURM_ARRAY_TASK_ID: 7 found, one of 3 numbers from 1 in steps of 1"));
}

TEST_F(ShardOfEnvironment, AVariableAloneOrWithoutANumberIsRefused) {
  {
    const ScopedVariable id("SLURM_ARRAY_TASK_ID", "1");
    EXPECT_THAT(messageOf<UsageError>([] { (void)shardOfEnvironment(); }),
                HasSubstr("SLURM_ARRAY_TASK_COUNT: nothing found"));
  }
  const ScopedVariable index("TEST_SHARD_INDEX", "2");
  EXPECT_THAT(messageOf<UsageError>([] { (void)shardOfEnvironment(); }),
              HasSubstr("TEST_TOTAL_SHARDS: nothing found"));
  const ScopedVariable total("TEST_TOTAL_SHARDS", "2");
  EXPECT_THAT(messageOf<UsageError>([] { (void)shardOfEnvironment(); }),
              HasSubstr("TEST_SHARD_INDEX: \"2\" found, a whole number from 0 to 1 expected"));
}

TEST_F(ShardOfEnvironment, ARunnerOfTestsCountsFromNoughtAndIsAnswered) {
  const ScopedVariable index("TEST_SHARD_INDEX", "0");
  const ScopedVariable total("TEST_TOTAL_SHARDS", "2");
  const ScopedVariable status("TEST_SHARD_STATUS_FILE", file("answered").c_str());
  EXPECT_EQ(shardOfEnvironment(), (Shard{1, 2}));
  EXPECT_TRUE(std::filesystem::exists(file("answered")));
}

TEST_F(ShardOfEnvironment, SlurmComesFirst) {
  const ScopedVariable index("TEST_SHARD_INDEX", "0");
  const ScopedVariable total("TEST_TOTAL_SHARDS", "2");
  const ScopedVariable id("SLURM_ARRAY_TASK_ID", "5");
  const ScopedVariable count("SLURM_ARRAY_TASK_COUNT", "6");
  EXPECT_EQ(shardOfEnvironment(), (Shard{5, 6}));
}

}  // namespace
}  // namespace gnomon::cli
