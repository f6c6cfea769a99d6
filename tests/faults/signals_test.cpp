#include <fmt/core.h>
#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <random>
#include <thread>

#include "faults/run_folders.h"
#include "support/test_length.h"

// Signals at random moments. Whatever the moment, each folder is that of one whole run or has no
// index that says so, and the next run makes it whole and leaves nothing beside it.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

struct Counts {
  int kills = 0, ended = 0, whole = 0, notWhole = 0, mixed = 0, leftovers = 0;
};

class SignalsAtAnyMoment : public EndToEnd {
 protected:
  void SetUp() override {
    for (const char* name : {"old", "new"}) fs::create_directories(file(name));
    write("old/small.toml", smallStudy() + gate("unshadowed"));
    write("new/small.toml", otherStudy() + gate("unshadowed"));
    write("old/sweep.toml", sweep(smallStudy(), "[1, 2]"));
    write("new/sweep.toml", sweep(otherStudy(), "[2, 3]"));
  }

  static std::string gate(const std::string& method) {
    return "\n[[threshold]]\nmethod = \"" + method + "\"\nmax = 0.9\n";
  }
  static std::string sweep(const std::string& study, const std::string& values) {
    return replaced(study, "\"small\"", "\"sweep\"") +
           "\n[sweep]\nkey = \"relief.height\"\nvalues = " + values + "\naxis = \"height\"\n";
  }

  [[nodiscard]] Outcome run(std::vector<std::string> arguments, const std::string& out) const {
    arguments.insert(arguments.end(), {"--out", out});
    return gnomon(arguments, environment());
  }
  [[nodiscard]] std::vector<std::string> environment() const {
    return {"GNOMON_CACHE=" + file("kept").string()};
  }

  /// One old run into a folder; then new ones into copies of it, of which each is sent a signal,
  /// SIGKILL, SIGINT and SIGTERM in turn, at some moment of its life, and is made again.
  /// @param coldCache  each begins with an empty cache, so that entries are being written
  void tryAll(const std::vector<std::string>& oldRun, const std::vector<std::string>& newRun,
              int kills, bool coldCache = false) {
    for (const char* name : {"old-out", "new-out"}) fs::remove_all(file(name));
    ASSERT_EQ(run(oldRun, "old-out").status, 0);
    ASSERT_EQ(run(newRun, "new-out").status, 0);
    if (coldCache) fs::remove_all(file("kept"));
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(run(newRun, "new-out").status, 0);
    const std::chrono::duration<double> lasts = std::chrono::steady_clock::now() - begin;
    const std::vector<FolderContent> wholeRuns = {contentOf(file("old-out")),
                                                  contentOf(file("new-out"))};
    ASSERT_EQ(shownBy(wholeRuns[1], wholeRuns), Shown::whole);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> moment(0, lasts.count());
    constexpr std::array signals = {SIGKILL, SIGINT, SIGTERM};
    for (int i = 0; i < kills; ++i) {
      if (coldCache) fs::remove_all(file("kept"));
      fs::remove_all(file("out"));
      fs::copy(file("old-out"), file("out"), fs::copy_options::recursive);
      const double seconds = moment(random);
      SCOPED_TRACE(fmt::format("kill {} after {:.3f} s", i, seconds));
      killOne(newRun, signals.at(static_cast<std::size_t>(i) % 3), seconds, wholeRuns);
      const Outcome again = run(newRun, "out");
      EXPECT_EQ(again.status, 0) << again.err;
      EXPECT_EQ(differences(contentOf(file("out")), wholeRuns[1]), nothing);
      EXPECT_EQ(partFilesBelow(folder()), nothing);
      if (!HasFailure()) continue;
      break;
    }
  }

  void killOne(std::vector<std::string> newRun, int signal, double seconds,
               const std::vector<FolderContent>& wholeRuns) {
    newRun.insert(newRun.end(), {"--out", "out"});
    newRun.insert(newRun.begin(), GNOMON_PROGRAM);
    const int process = startCommand(folder(), newRun, environment(), "/dev/null", "/dev/null");
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    ::kill(process, signal);
    const int status = endOf(process);
    ++counts.kills;
    if (status == 0) ++counts.ended;
    EXPECT_TRUE(status == 0 || status == 128 + signal) << status;
    const std::vector<std::string> left = partFilesBelow(folder());
    counts.leftovers += static_cast<int>(left.size());
    if (signal != SIGKILL) {
      EXPECT_EQ(left, nothing) << "signal " << signal;
    }
    const Shown shown = shownBy(contentOf(file("out")), wholeRuns);
    ++(shown == Shown::whole      ? counts.whole
       : shown == Shown::notWhole ? counts.notWhole
                                  : counts.mixed);
    EXPECT_NE(shown, Shown::mixed);
  }

  void print(const char* what) const {
    fmt::print(
        "faults: {}: {} kills ({} had ended before), {} folders whole, {} not whole, {} mixed; {} "
        "part "
        "files of SIGKILL, all removed by the next run\n",
        what, counts.kills, counts.ended, counts.whole, counts.notWhole, counts.mixed,
        counts.leftovers);
  }

  Counts counts;
};

int killCount() {
  return repetitions(3, 42);
}

TEST_F(SignalsAtAnyMoment, Run) {
  tryAll({"run", "old/small.toml"}, {"run", "new/small.toml"}, killCount());
  print("run");
}

TEST_F(SignalsAtAnyMoment, Check) {
  tryAll({"check", "old/small.toml", "--junit", "junit.xml"},
         {"check", "new/small.toml", "--junit", "junit.xml"}, killCount());
  print("check");
}

TEST_F(SignalsAtAnyMoment, Sweep) {
  tryAll({"run", "old/sweep.toml"}, {"run", "new/sweep.toml"}, killCount());
  print("sweep");
}

TEST_F(SignalsAtAnyMoment, CacheThatIsBeingFilled) {
  tryAll({"run", "old/small.toml"}, {"run", "new/small.toml"}, killCount(), true);
  // What the killed ones had kept is sound.
  const nlohmann::json cache = summary("small").at("cache");
  EXPECT_EQ(cache.at("damaged"), 0);
  print("cache");
}

TEST_F(SignalsAtAnyMoment, ExportAndTruth) {
  for (const char* command : {"truth", "export"}) {
    tryAll({command, "old/small.toml"}, {command, "new/small.toml"}, repetitions(1, 6));
  }
  print("truth and export");
}

TEST_F(SignalsAtAnyMoment, WhileAFileIsBeingWritten) {
  // A mesh of 2 million triangles takes a while: its part file is seen, and with it the moment.
  const std::vector<std::string> words = {GNOMON_PROGRAM, "export", "new/small.toml",
                                          "--subdivisions", "256"};
  const fs::path exported = file("out/small/export");
  int left = 0;
  // SIGKILL may come just after the file has its name: it is tried until it leaves a part file.
  std::vector<int> signals = {SIGHUP, SIGTERM, SIGINT, SIGKILL};
  for (int tries = 0; !signals.empty() && tries < 14; ++tries) {
    const int signal = signals.back();
    signals.pop_back();
    fs::remove_all(file("out"));
    const int process = startCommand(folder(), words, environment(), "/dev/null", "/dev/null");
    for (int i = 0; i < 20'000 && partFilesBelow(exported).empty(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::kill(process, signal);
    EXPECT_EQ(endOf(process), 128 + signal);
    const std::size_t count = partFilesBelow(exported).size();
    EXPECT_LE(count, signal == SIGKILL ? 1U : 0U) << signal;
    if (signal == SIGKILL && count == 0) signals.push_back(signal);
    left += static_cast<int>(count);
    EXPECT_FALSE(fs::exists(exported / "export.json"));
    EXPECT_EQ(run({"export", "new/small.toml"}, "out").status, 0);
    EXPECT_EQ(partFilesBelow(folder()), nothing);
  }
  EXPECT_EQ(left, 1);
  fmt::print(
      "faults: signals while a file was written, {} part file left, by SIGKILL, and removed by "
      "the next run\n",
      left);
}

}  // namespace
}  // namespace gnomon::test
