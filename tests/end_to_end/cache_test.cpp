#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "end_to_end/support/program.h"

// What runs leave to be taken up: nothing of it may show in what a run says.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class CachedRuns : public EndToEnd {
 protected:
  void SetUp() override {
    const std::string timed = replaced(smallStudy(), "frames = 0", "frames = 5");
    write("small.toml",
          replaced(timed, "name = \"evening\"\n", "") + "\n[[method]]\nname = \"onoue-2004\"\n");
  }
  [[nodiscard]] Outcome run(const std::string& out, std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {"run", "small.toml", "--out", out});
    return gnomon(options, {"GNOMON_CACHE=" + cache().string()});
  }
  void expectRun(const std::string& out, const std::vector<std::string>& options = {}) const {
    const Outcome outcome = run(out, options);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    ASSERT_EQ(outcome.err, "");
  }
  [[nodiscard]] fs::path cache() const { return file("kept"); }
  [[nodiscard]] std::vector<fs::path> entries() const {
    std::vector<fs::path> paths;
    if (!fs::exists(cache())) return paths;
    for (const auto& entry : fs::recursive_directory_iterator(cache())) {
      if (entry.path().extension() == ".entry") paths.push_back(entry.path());
    }
    return paths;
  }
  [[nodiscard]] nlohmann::json counts(const std::string& out,
                                      const std::string& name = "small") const {
    return summary(name, out).at("cache");
  }
  /// A summary without what tells of times and of the cache, the command, and the hashes of files,
  /// which an edit changes.
  [[nodiscard]] nlohmann::json lasting(const std::string& out) const {
    nlohmann::json json = lastingPart(summary("small", out));
    json.at("study").erase("inputs");
    return json;
  }
  /// Every file but those that hold times is the same, byte for byte, and so are all other figures.
  void expectSame(const std::string& a, const std::string& b) const {
    const auto files = filesBelow(a);
    EXPECT_EQ(files, filesBelow(b));
    for (const std::string& name : files) {
      const bool holdsTimes = name == "small/summary.json" || name == "small/report.html" ||
                              name.starts_with("small/table.");
      if (holdsTimes) continue;
      const std::string file = "/" + name;
      EXPECT_TRUE(read(a + file) == read(b + file)) << name;
    }
    EXPECT_EQ(lasting(a), lasting(b));
  }
  /// Labels of the methods whose frames this run timed.
  [[nodiscard]] std::vector<std::string> timed(const std::string& out) const {
    std::vector<std::string> labels;
    const nlohmann::json json = summary("small", out);
    for (const nlohmann::json& cost : json.at("cost")) {
      if (cost.at("frame_kept_since").is_null()) labels.push_back(cost.at("method"));
    }
    return labels;
  }
};

TEST_F(CachedRuns, WithWithoutAndWithAFilledCacheTheBytesAreTheSame) {
  expectRun("without", {"--no-cache"});
  EXPECT_TRUE(entries().empty());
  EXPECT_TRUE(counts("without").is_null());
  expectRun("first");
  EXPECT_EQ(counts("first").at("hits"), 0);
  EXPECT_GT(counts("first").at("misses"), 20);
  expectRun("second");
  EXPECT_EQ(counts("second").at("misses"), 0);
  EXPECT_GT(counts("second").at("hits"), 20);
  EXPECT_TRUE(timed("second").empty());
  EXPECT_THAT(read("second/small/report.html"), HasSubstr("measured by an earlier run"));
  expectSame("without", "first");
  expectSame("without", "second");
}

TEST_F(CachedRuns, AfterAnEditOneMethodIsComputed) {
  const fs::path own = fs::path(GNOMON_OWN_METHODS) / "biased-horizon.glsl";
  fs::copy(own, file("mine.glsl"));
  write("small.toml", read("small.toml") + "\n[[method]]\nfile = \"mine.glsl\"\n");
  expectRun("first");
  const std::string text = read("mine.glsl");
  write("mine.glsl", text + "\n// a word more\n");
  expectRun("second");
  EXPECT_EQ(timed("second"), std::vector<std::string>{"mine"});
  // Of its one case: answers, outcome, four pictures and what a page embeds, worst places, cost.
  EXPECT_EQ(counts("second").at("misses"), 9);
  expectSame("first", "second");
  // An edit that changes its answers changes those alone.
  write("mine.glsl", replaced(text, "return ", "return !"));
  expectRun("third");
  EXPECT_EQ(timed("third"), std::vector<std::string>{"mine"});
  expectRun("fresh", {"--no-cache"});
  expectSame("fresh", "third");
  EXPECT_NE(read("first/small/metrics.csv"), read("third/small/metrics.csv"));
}

TEST_F(CachedRuns, DamagedEntriesAreComputedAgain) {
  expectRun("first");
  const std::size_t count = entries().size();
  for (const fs::path& entry : entries()) {
    const auto middle = static_cast<std::streamoff>(fs::file_size(entry) / 2);
    std::fstream bytes(entry, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekg(middle);
    const int byte = bytes.get();
    bytes.seekp(middle);
    bytes.put(static_cast<char>(byte ^ 16));
  }
  const Outcome outcome = run("second");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("damaged"));
  expectSame("first", "second");
  EXPECT_GT(counts("second").at("damaged"), 20);
  EXPECT_LE(counts("second").at("damaged"), count);
  expectRun("third");
  EXPECT_EQ(counts("third").at("damaged"), 0);
  EXPECT_EQ(counts("third").at("misses"), 0);
  expectSame("first", "third");
}

TEST_F(CachedRuns, TheBoundHolds) {
  const std::vector<std::string> environment = {"GNOMON_CACHE=" + cache().string()};
  ASSERT_EQ(gnomon({"cache", "--limit", "150kB"}, environment).status, 0);
  expectRun("first");
  std::uintmax_t bytes = 0;
  for (const fs::path& entry : entries()) bytes += fs::file_size(entry);
  EXPECT_LE(bytes, 150'000U / 16 * 17);
  EXPECT_GT(bytes, 30'000U);
  expectRun("fresh", {"--no-cache"});
  expectSame("fresh", "first");
  EXPECT_THAT(gnomon({"cache"}, environment).out, HasSubstr("of at most 150 kB"));
  EXPECT_THAT(gnomon({"cache", "--clear"}, environment).out, HasSubstr("0 entries"));
  EXPECT_TRUE(entries().empty());
  EXPECT_THAT(gnomon({"cache"}, environment).out, HasSubstr("of at most 150 kB"));
  EXPECT_EQ(gnomon({"cache", "--limit", "much"}, environment).status, 2);
}

TEST_F(CachedRuns, AKilledSweepGoesOnWhereItWas) {
  write("small.toml", read("small.toml") +
                          "\n[sweep]\nkey = \"relief.height\"\nvalues = [1, 2, 3, 4, 5, 6]\n"
                          "axis = \"height\"\n");
  const std::vector<std::string> environment = {"GNOMON_CACHE=" + cache().string()};
  // The folder takes its name when it is whole: till then it lies beside its place.
  const auto isSecondDone = [&] {
    const std::vector<std::string> files = filesBelow("cut");
    return std::any_of(files.begin(), files.end(),
                       [](const std::string& name) { return name.ends_with("/2/summary.json"); });
  };
  runAndKillWhen(folder(), {"run", "small.toml", "--out", "cut"}, environment, isSecondDone);
  ASSERT_TRUE(isSecondDone());
  EXPECT_FALSE(fs::exists(file("cut/small")));
  expectRun("again");
  for (const char* finished : {"small/1", "small/2"}) {
    EXPECT_EQ(counts("again", finished).at("misses"), 0) << finished;
  }
  EXPECT_GT(counts("again", "small/6").at("misses"), 0);
  expectRun("fresh", {"--no-cache"});
  for (const std::string& name : filesBelow("fresh")) {
    if (!name.ends_with(".csv") && !name.ends_with(".png")) continue;
    if (name.ends_with("table.csv")) continue;  // holds frame times
    EXPECT_TRUE(read("fresh/" + name) == read("again/" + name)) << name;
  }
}

TEST_F(CachedRuns, SingleStepsShareThem) {
  const std::vector<std::string> environment = {"GNOMON_CACHE=" + cache().string()};
  for (const std::string command : {"bake", "truth", "export"}) {
    for (const std::string out : {"first", "second"}) {
      const Outcome outcome = gnomon({command, "small.toml", "--out", command + out}, environment);
      ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
    for (const std::string& name : filesBelow(command + "first")) {
      if (name.ends_with(".json")) continue;  // holds the command
      EXPECT_TRUE(read(command + "first/" + name) == read(command + "second/" + name))
          << command << " " << name;
    }
  }
}

}  // namespace
}  // namespace gnomon::test
