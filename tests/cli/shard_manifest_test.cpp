#include "cli/shards/shard_manifest.h"

#include <gmock/gmock.h>

#include <fstream>

#include "common/error.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ShardArguments, AnOptionGoesInBothItsForms) {
  const Arguments words = {"run", "a.toml", "--shard", "1/3", "--set", "x=1", "--shard=2/3"};
  EXPECT_THAT(withoutOption(words, "--shard"), ElementsAre("run", "a.toml", "--set", "x=1"));
  EXPECT_EQ(withoutOption(words, "--out"), words);
}

TEST(ShardArguments, AnotherOutTakesThePlaceOfTheFirst) {
  EXPECT_THAT(withOut({"run", "--out", "s1", "a.toml"}, "all"),
              ElementsAre("run", "--out", "all", "a.toml"));
  EXPECT_THAT(withOut({"run", "--out=s1", "a.toml"}, "all"),
              ElementsAre("run", "--out=all", "a.toml"));
  EXPECT_THAT(withOut({"run", "a.toml"}, "all"), ElementsAre("run", "a.toml", "--out", "all"));
  EXPECT_THAT(withOut({"run", "a.toml"}, "out"), ElementsAre("run", "a.toml"));
  EXPECT_THAT(withOut({"run", "--out", "s1", "a.toml"}, "out"), ElementsAre("run", "a.toml"));
}

ShardManifest sample() {
  return {"0.1.0",
          "0123456789ab",
          {2, 3},
          {"--threads", "2", "run", "a b.toml", "--out", "s2"},
          {{"a b.toml", "a", "00ff"}},
          {{"a/1", "11", true}, {"a/2", "22", false}}};
}

class ShardManifestFile : public TemporaryFolder {
 protected:
  void write(const std::string& text) const { std::ofstream(file("shard.json")) << text; }
};

TEST_F(ShardManifestFile, IsReadAsItWasWritten) {
  write(manifestText(sample()));
  const ShardManifest read = readManifest(folder());
  EXPECT_EQ(read.version, "0.1.0");
  EXPECT_EQ(read.commit, "0123456789ab");
  EXPECT_EQ(read.shard, (Shard{2, 3}));
  EXPECT_EQ(read.arguments, sample().arguments);
  EXPECT_EQ(read.studies, sample().studies);
  EXPECT_EQ(read.cases, sample().cases);
  EXPECT_FALSE(read.isWhole());
}

TEST_F(ShardManifestFile, WhatIsNoneIsRefusedInOneLine) {
  EXPECT_THAT(messageOf<InputError>([&] { (void)readManifest(folder()); }),
              HasSubstr("no shard.json found"));
  for (const std::string& text :
       {std::string(), std::string("{}"), std::string("[1, 2"),
        std::string("{\"schema\": \"gnomon-shard/1\",").append(manifestText(sample()), 1),
        manifestText(sample()).replace(manifestText(sample()).find("shard/1"), 7, "shard/9")}) {
    write(text);
    EXPECT_THAT(messageOf<InputError>([&] { (void)readManifest(folder()); }),
                HasSubstr("shard.json: the manifest of a shard expected"));
  }
}

TEST(ShardManifest, GivesTheCommandOfAnyShard) {
  EXPECT_EQ(commandOf(sample(), {3, 3}, "s3"),
            "gnomon --threads 2 run 'a b.toml' --out s3 --shard 3/3");
  EXPECT_THAT(settingsOf(sample()), ElementsAre("run", "a b.toml"));
}

}  // namespace
}  // namespace gnomon::cli
