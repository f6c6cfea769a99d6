#include <fmt/core.h>
#include <gmock/gmock.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>
#include <thread>

#include "common/error.h"
#include "faults/run_folders.h"
#include "faults/shell_run.h"
#include "support/test_length.h"

// Signals at random moments. Whatever the moment, each folder is that of one whole run or has no
// index that says so, and the next run makes it whole and leaves nothing beside it.
// Disks of every size from none to enough, each a file system in memory.
// A study that needs more than its control group may take is refused, where it was killed.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

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

/// Whether a mesh is being written below a folder, whose content may go meanwhile.
bool isMeshBegun(const fs::path& folder) {
  std::error_code failure;
  for (fs::recursive_directory_iterator it(folder, failure), end; !failure && it != end;
       it.increment(failure)) {
    if (it->path().string().ends_with(".part.ply")) return true;
  }
  return false;
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
    for (int i = 0; i < 20'000 && !isMeshBegun(file("out")); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::kill(process, signal);
    EXPECT_EQ(endOf(process), 128 + signal);
    const bool isLeft = isMeshBegun(file("out"));
    if (signal == SIGKILL) {
      if (!isLeft) signals.push_back(signal);
    } else {
      EXPECT_EQ(partFilesBelow(file("out")), nothing) << signal;
    }
    left += isLeft ? 1 : 0;
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

/// Does work in a thread that has a file system of so many bytes at a folder, and nobody else.
/// @return why that is not allowed, or nothing
std::string onDisk(const fs::path& folder, int kilobytes, const std::function<void()>& work) {
  std::string failure;
  std::thread([&] {
    const std::string size = fmt::format("size={}k", kilobytes);
    const bool isThere = ::unshare(CLONE_NEWNS) == 0 &&
                         ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                         ::mount("disk", folder.c_str(), "tmpfs", 0, size.c_str()) == 0;
    if (isThere) {
      work();
    } else {
      failure = std::strerror(errno);
    }
  }).join();
  return failure;
}

/// More room from now on.
void enlarge(const fs::path& folder) {
  ASSERT_EQ(::mount("disk", folder.c_str(), "tmpfs", MS_REMOUNT, "size=100m"), 0);
}

class FullDisk : public EndToEnd {
 protected:
  void SetUp() override {
    write("small.toml", smallStudy());
    fs::create_directories(file("disk"));
    ASSERT_EQ(run("whole", "kept").status, 0);
    whole_ = contentOf(file("whole"));
    const std::string reason = onDisk(file("disk"), 100, [] {});
    if (!reason.empty()) GTEST_SKIP() << "no file system of this test's own: " << reason;
  }
  [[nodiscard]] Outcome run(const std::string& out, const std::string& cache) const {
    return gnomon({"run", "small.toml", "--out", out}, {"GNOMON_CACHE=" + file(cache).string()});
  }
  /// The sizes that are tried: from 8 kB to what is enough.
  static std::vector<int> sizes() {
    const int count = repetitions(6, 40);
    std::vector<int> kilobytes;
    for (int i = 0; i < count; ++i) kilobytes.push_back(8 + 800 * i / count);
    return kilobytes;
  }

  FolderContent whole_;
};

TEST_F(FullDisk, ARunSaysWhyItFailsAndIsMadeWholeByTheNext) {
  int failed = 0;
  int passed = 0;
  for (const int kilobytes : sizes()) {
    SCOPED_TRACE(kilobytes);
    const std::string reason = onDisk(file("disk"), kilobytes, [&] {
      const Outcome outcome = run("disk/out", "kept");
      EXPECT_EQ(partFilesBelow(file("disk")), nothing);
      ++(outcome.status == 0 ? passed : failed);
      if (outcome.status == 0) {
        EXPECT_EQ(differences(contentOf(file("disk/out")), whole_), nothing);
        return;
      }
      EXPECT_EQ(outcome.status, 3);
      EXPECT_THAT(outcome.err, HasSubstr("No space left on device"));
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
      EXPECT_FALSE(fs::exists(file("disk/out/small/summary.json")));
      enlarge(file("disk"));
      const Outcome again = run("disk/out", "kept");
      EXPECT_EQ(again.status, 0) << again.err;
      EXPECT_EQ(differences(contentOf(file("disk/out")), whole_), nothing);
    });
    ASSERT_EQ(reason, "");
  }
  EXPECT_GT(failed, 0);
  EXPECT_GT(passed, 0);
  fmt::print("faults: {} disks too small for a run, {} large enough, 0 folders mixed\n", failed,
             passed);
}

TEST_F(FullDisk, ACacheOnItCostsAWarning) {
  int warned = 0;
  for (const int kilobytes : sizes()) {
    SCOPED_TRACE(kilobytes);
    const std::string reason = onDisk(file("disk"), kilobytes, [&] {
      const Outcome outcome = run("out", "disk/cache");
      EXPECT_EQ(outcome.status, 0) << outcome.err;
      if (!outcome.err.empty()) {
        ++warned;
        EXPECT_THAT(outcome.err, HasSubstr("gnomon: warning: the cache keeps nothing more: "));
        EXPECT_THAT(outcome.err, HasSubstr("No space left on device"));
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
      }
      EXPECT_EQ(partFilesBelow(file("disk")), nothing);
      EXPECT_EQ(filesBelow("out").size(), whole_.size());
      const Outcome again = run("out", "disk/cache");
      EXPECT_EQ(again.status, 0) << again.err;
      EXPECT_EQ(summary("small").at("cache").at("damaged"), 0);
    });
    ASSERT_EQ(reason, "");
  }
  EXPECT_GT(warned, 0);
  fmt::print("faults: {} full disks under a cache, each one line of warning\n", warned);
}

/// The folder of this process's own group, of the hierarchy that limits memory; empty where it
/// cannot be seen.
fs::path ownGroup() {
  std::ifstream file("/proc/self/cgroup");
  fs::path unified;
  for (std::string line; std::getline(file, line);) {
    const std::size_t path = line.find(':', line.find(':') + 1) + 1;
    const auto below = [&](const char* root) {
      const fs::path whole = fs::path(root) / fs::path(line.substr(path)).relative_path();
      return fs::exists(whole) ? whole : fs::path(root);
    };
    if (line.find(":memory:") != std::string::npos) return below("/sys/fs/cgroup/memory");
    if (line.starts_with("0::")) unified = below("/sys/fs/cgroup");
  }
  return unified;
}

/// A group within a group, with a limit on the outer one, while it lives.
class LimitedGroup {
 public:
  explicit LimitedGroup(std::uint64_t bytes) {
    outer_ = ownGroup() / fmt::format("gnomon-test-{}", getpid());
    std::error_code failure;
    fs::create_directory(outer_, failure);
    if (failure) {
      why_ = outer_.string() + ": " + failure.message();
      return;
    }
    const bool isLegacy = fs::exists(outer_ / "memory.limit_in_bytes");
    if (isLegacy) std::ofstream(outer_ / "memory.use_hierarchy") << 1;
    std::ofstream limit(outer_ / (isLegacy ? "memory.limit_in_bytes" : "memory.max"));
    limit << bytes;
    limit.close();
    fs::create_directory(inner(), failure);
    if (!limit || failure) why_ = outer_.string() + ": no limit can be set";
  }
  LimitedGroup(const LimitedGroup&) = delete;
  LimitedGroup& operator=(const LimitedGroup&) = delete;
  ~LimitedGroup() {
    ::rmdir(inner().c_str());
    ::rmdir(outer_.c_str());
  }
  /// Why there is none; empty where there is.
  [[nodiscard]] const std::string& why() const { return why_; }
  /// The shell's command by which it goes into the inner group.
  [[nodiscard]] std::string enter() const {
    return fmt::format("echo $$ > '{}' || exit 99; ", (inner() / "cgroup.procs").string());
  }

 private:
  [[nodiscard]] fs::path inner() const { return outer_ / "inner"; }

  fs::path outer_;
  std::string why_;
};

class MemoryLimit : public EndToEnd {};

TEST_F(MemoryLimit, OfTheGroupAboveIsSeenBeforeTheKernelKills) {
#ifdef GNOMON_SANITIZED
  GTEST_SKIP() << "what a sanitizer takes for itself is more than the limit";
#endif
  const LimitedGroup group(std::uint64_t{400} << 20U);
  if (!group.why().empty()) GTEST_SKIP() << "no control group can be made: " << group.why();
  write("small.toml", smallStudy());
  const Outcome fits = runShell(folder(), group.enter() + "gnomon run small.toml");
  if (fits.status == 99) GTEST_SKIP() << "no control group can be entered";
  EXPECT_EQ(fits.status, 0) << fits.err;
  // Some 2 GB of micro-mesh.
  const Outcome large =
      runShell(folder(), group.enter() + "gnomon run small.toml --set truth.step=0.005");
  EXPECT_EQ(large.status, static_cast<int>(ExitStatus::internal)) << large.err;
  EXPECT_THAT(large.err, HasSubstr("GB, "));
  EXPECT_THAT(large.err, HasSubstr("MB available"));
  std::printf("faults: a limit of 400 MiB on a group above: %s", large.err.c_str());
}

class StackLimit : public EndToEnd {};

// It died of SIGSEGV below 96 kB: in a thread, whose stack is as small.
TEST_F(StackLimit, TooSmallAStackIsOneLine) {
#ifdef GNOMON_SANITIZED
  GTEST_SKIP() << "sanitizers need a larger stack before the program begins";
#endif
  write("small.toml", smallStudy());
  for (const int size : {48, 64, 96, 128, 255}) {
    for (const char* words : {"list", "run small.toml", "no such command"}) {
      const Outcome outcome =
          runShell(folder(), fmt::format("ulimit -s {}; gnomon {} >/dev/null", size, words));
      EXPECT_EQ(outcome.status, 3) << size << words << outcome.err;
      EXPECT_EQ(outcome.err, fmt::format("gnomon: the stack is limited to {} kB, 256 kB or more "
                                         "expected: ulimit -s\n",
                                         size));
    }
  }
  const Outcome enough = runShell(folder(), "ulimit -s 256; gnomon run small.toml");
  EXPECT_EQ(enough.status, 0) << enough.err;
}

}  // namespace
}  // namespace gnomon::test
