#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <sstream>

#include "common/error.h"
#include "common/system/memory.h"
#include "common/system/own_files.h"
#include "common/system/process.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

class ChildProcess : public TemporaryFolder {
 protected:
  /// Runs a line of the shell to its end.
  int stateOf(const std::string& line, ChildProgram program = {}) {
    program.words = {"sh", "-c", line};
    program.out = out.get();
    program.err = err.get();
    const ChildStart started = startChild(program);
    EXPECT_EQ(started.failure, 0);
    return endOfChild(started.process, true).value_or(-1);
  }
  File out{std::tmpfile()};
  File err{std::tmpfile()};
};

TEST_F(ChildProcess, HasItsStreamsItsFolderAndItsVariables) {
  File in(std::tmpfile());
  std::fputs("given", in.get());
  std::rewind(in.get());
  ChildProgram program;
  program.in = in.get();
  program.folder = file("");
  program.variables = {{"ONE=1", "PATH=/usr/bin:/bin"}};
  const int state =
      stateOf("cat; echo \" $ONE$HOME\"; touch made; echo wrong >&2; exit 7", program);
  EXPECT_EQ(WEXITSTATUS(state), 7);
  EXPECT_EQ(contentOf(out.get()), "given 1\n");
  EXPECT_EQ(contentOf(err.get()), "wrong\n");
  EXPECT_TRUE(std::filesystem::exists(file("made")));
}

TEST_F(ChildProcess, WithoutAnInputReadsNothing) {
  EXPECT_EQ(stateOf("cat"), 0);
  EXPECT_EQ(contentOf(out.get()), "");
}

TEST_F(ChildProcess, DiesOfASignalThatThisProcessIgnores) {
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  const int state = stateOf("kill -PIPE $$");
  std::signal(SIGPIPE, before);
  ASSERT_TRUE(WIFSIGNALED(state));
  EXPECT_EQ(WTERMSIG(state), SIGPIPE);
}

TEST_F(ChildProcess, IsAskedWithoutWaiting) {
  const ChildStart started = startChild({{"sleep", "60"}, {}, {}, nullptr, out.get(), err.get()});
  ASSERT_EQ(started.failure, 0);
  EXPECT_EQ(endOfChild(started.process, false), std::nullopt);
  ::kill(started.process, SIGKILL);
  EXPECT_EQ(WTERMSIG(endOfChild(started.process, true).value_or(0)), SIGKILL);
}

TEST_F(ChildProcess, ThatIsNoneHasFailed) {
  EXPECT_EQ(WEXITSTATUS(endOfChild(::getpid(), true).value_or(0)), 127);
}

TEST_F(ChildProcess, ThatIsNotThereHasAReason) {
  EXPECT_EQ(startChild({{"no-such-program"}, {}, {}, nullptr, out.get(), err.get()}).failure,
            ENOENT);
}

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();
/// What the older hierarchy writes where there is no limit.
constexpr const char* legacyUnlimited = "9223372036854771712";

/// Hierarchies in a folder, as they are below /sys/fs/cgroup.
class ControlGroup : public TemporaryFolder {
 protected:
  void put(const std::string& group, const std::map<std::string, std::string>& files) const {
    std::filesystem::create_directories(file(group));
    for (const auto& [name, text] : files) std::ofstream(file(group) / name) << text << "\n";
  }
  [[nodiscard]] std::uint64_t available(const std::string& membership) const {
    return controlGroupAvailableBytes(folder(), membership);
  }
};

TEST_F(ControlGroup, WithoutALimitLeavesEverything) {
  EXPECT_EQ(available(""), unlimited);
  EXPECT_EQ(available("0::/\n"), unlimited);
  EXPECT_EQ(available("no line of this kind\n4:memory\n"), unlimited);
  put("", {{"memory.max", "max"}, {"memory.high", "max"}, {"memory.current", "100"}});
  EXPECT_EQ(available("0::/\n"), unlimited);
}

TEST_F(ControlGroup, LeavesTheLimitLessWhatIsHeld) {
  put("", {{"memory.max", "1000"},
           {"memory.current", "600"},
           {"memory.stat", "anon 200\nfile 400\ninactive_file 150\nactive_file 250"}});
  // Inactive file pages count as used, but are given up first.
  EXPECT_EQ(available("0::/\n"), 1000U - (600U - 150U));
}

TEST_F(ControlGroup, LeavesNothingWhereMoreIsHeldThanTheLimit) {
  put("", {{"memory.max", "1000"}, {"memory.current", "1200"}});
  EXPECT_EQ(available("0::/\n"), 0U);
}

TEST_F(ControlGroup, TheLeastOfAllGroupsAboveCounts) {
  put("a/b/c", {{"memory.max", "5000"}, {"memory.current", "10"}});
  EXPECT_EQ(available("0::/a/b/c\n"), 4990U);
  // A group of siblings, whose own use is larger.
  put("a", {{"memory.max", "9000"}, {"memory.current", "8500"}});
  EXPECT_EQ(available("0::/a/b/c\n"), 500U);
  put("a/b", {{"memory.max", "max"}, {"memory.high", "300"}, {"memory.current", "20"}});
  EXPECT_EQ(available("0::/a/b/c\n"), 280U);
  // Beside the way up, it is not ours.
  put("a/d", {{"memory.max", "1"}, {"memory.current", "0"}});
  EXPECT_EQ(available("0::/a/b/c\n"), 280U);
}

TEST_F(ControlGroup, TheLowerOfTheTwoLimitsCounts) {
  put("", {{"memory.max", "400"}, {"memory.high", "700"}, {"memory.current", "100"}});
  EXPECT_EQ(available("0::/\n"), 300U);
  put("", {{"memory.max", "700"}, {"memory.high", "400"}});
  EXPECT_EQ(available("0::/\n"), 300U);
}

TEST_F(ControlGroup, OfTheOlderHierarchyIsSeen) {
  put("memory/docker/one", {{"memory.limit_in_bytes", "2000"},
                            {"memory.usage_in_bytes", "900"},
                            {"memory.stat", "inactive_file 1\ntotal_inactive_file 100"}});
  put("memory", {{"memory.limit_in_bytes", legacyUnlimited}, {"memory.usage_in_bytes", "950"}});
  const std::string membership = "5:devices:/docker/one\n4:memory:/docker/one\n0::/\n";
  EXPECT_EQ(available(membership), 2000U - 800U);
  EXPECT_EQ(available("3:cpu,memory:/docker/one\n"), 1200U);
  EXPECT_EQ(available("3:memory2:/docker/one\n"), unlimited);
}

TEST_F(ControlGroup, OfTheOlderHierarchyTellsOfLimitsAboveIt) {
  put("memory", {{"memory.limit_in_bytes", legacyUnlimited},
                 {"memory.usage_in_bytes", "100"},
                 {"memory.stat", "hierarchical_memory_limit 750"}});
  EXPECT_EQ(available("4:memory:/\n"), 650U);
}

// In a container the hierarchy that is mounted is the container's own, but the membership may be
// the host's.
TEST_F(ControlGroup, OfAContainerIsTheRootThatIsMounted) {
  put("memory", {{"memory.limit_in_bytes", "1000"}, {"memory.usage_in_bytes", "0"}});
  EXPECT_EQ(available("4:memory:/docker/0123456789ab\n"), 1000U);
  put("", {{"memory.max", "800"}, {"memory.current", "0"}});
  EXPECT_EQ(available("0::/../elsewhere\n"), 800U);
}

TEST_F(ControlGroup, MayBeOfTwoHierarchies) {
  put("memory/one", {{"memory.limit_in_bytes", "1000"}, {"memory.usage_in_bytes", "0"}});
  put("unified/two", {{"memory.max", "600"}, {"memory.current", "0"}});
  EXPECT_EQ(available("4:memory:/one\n0::/two\n"), 600U);
}

TEST_F(ControlGroup, OfAFileThatIsNoneIsPassedOver) {
  put("", {{"memory.max", "word"}, {"memory.current", "10"}});
  EXPECT_EQ(available("0::/\n"), unlimited);
  put("", {{"memory.max", "100"}, {"memory.current", ""}});
  EXPECT_EQ(available("0::/\n"), unlimited);
}

class Interruption : public TemporaryFolder {
 protected:
  /// Runs `work` in a process of its own, then sends that process a signal.
  /// @return what waitpid tells of its end
  static int endOf(int signal, const std::function<void()>& work) {
    int ready[2];
    if (::pipe(ready) != 0) return -1;
    const pid_t process = ::fork();
    if (process == 0) {
      ::close(STDERR_FILENO);
      work();
      (void)!::write(ready[1], "x", 1);
      ::sleep(20);
      ::_exit(0);
    }
    ::close(ready[1]);
    char byte = 0;
    (void)!::read(ready[0], &byte, 1);  // or its end
    ::kill(process, signal);
    int state = 0;
    ::waitpid(process, &state, 0);
    ::close(ready[0]);
    return state;
  }
};

TEST_F(Interruption, RemovesWhatIsUnfinishedAndExitsWithTheSignal) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::ofstream(file("half")) << "half";
    std::ofstream(file("whole")) << "whole";
    const int state = endOf(signal, [&] {
      ::signal(signal, SIG_DFL);
      cleanUpOnSignals();
      changeUnfinished([&](Unfinished& unfinished) {
        unfinished.files = {file("half"), file("whole")};
        unfinished.files.erase(file("whole"));
      });
    });
    ASSERT_TRUE(WIFEXITED(state)) << signal;
    EXPECT_EQ(WEXITSTATUS(state), 128 + signal);
    EXPECT_FALSE(fs::exists(file("half")));
    EXPECT_TRUE(fs::exists(file("whole")));
  }
}

TEST_F(Interruption, KillsTheHelpers) {
  int alive[2];
  ASSERT_EQ(::pipe(alive), 0);
  (void)endOf(SIGTERM, [&] {
    cleanUpOnSignals();
    changeUnfinished([&](Unfinished& unfinished) {
      const pid_t helper = ::fork();
      if (helper == 0) {
        ::pause();
        ::_exit(0);
      }
      unfinished.helpers.insert(helper);
    });
  });
  ::close(alive[1]);
  // Ends when the last process that has the other end is gone.
  char byte = 0;
  EXPECT_EQ(::read(alive[0], &byte, 1), 0);
  ::close(alive[0]);
}

TEST_F(Interruption, LeavesASignalIgnoredThatIs) {
  const int state = endOf(SIGINT, [] {
    ::signal(SIGINT, SIG_IGN);
    cleanUpOnSignals();
    ::kill(::getpid(), SIGINT);
    ::usleep(50'000);
    ::_exit(7);
  });
  ASSERT_TRUE(WIFEXITED(state));
  EXPECT_EQ(WEXITSTATUS(state), 7);
}

TEST(FormatBytes, HasThreeSignificantDigitsInDecimalUnits) {
  EXPECT_EQ(formatBytes(0), "0 B");
  EXPECT_EQ(formatBytes(999), "999 B");
  EXPECT_EQ(formatBytes(1000), "1.00 kB");
  EXPECT_EQ(formatBytes(12'345), "12.3 kB");
  EXPECT_EQ(formatBytes(123'456), "123 kB");
  EXPECT_EQ(formatBytes(128 * 128 * 32 * 2), "1.05 MB");
  EXPECT_EQ(formatBytes(2'514'000'000), "2.51 GB");
  EXPECT_EQ(formatBytes(3e12), "3.00 TB");
  EXPECT_EQ(formatBytes(4e15), "4.00 PB");
}

TEST(FormatBytes, RoundsUpIntoTheNextUnit) {
  EXPECT_EQ(formatBytes(999.4), "999 B");
  EXPECT_EQ(formatBytes(999.6), "1.00 kB");
  EXPECT_EQ(formatBytes(9'996), "10.0 kB");
  EXPECT_EQ(formatBytes(99'960), "100 kB");
  EXPECT_EQ(formatBytes(999'600), "1.00 MB");
}

TEST(FormatBytes, StaysShortBeyondTheLastUnit) {
  EXPECT_EQ(formatBytes(1.234e40), "1.23e+25 PB");
  EXPECT_EQ(formatBytes(std::numeric_limits<double>::infinity()), "inf PB");
}

TEST(FormatBytes, ReadBackIsWithinHalfAPercent) {
  const std::map<std::string, double> units = {{"B", 1},    {"kB", 1e3},  {"MB", 1e6},
                                               {"GB", 1e9}, {"TB", 1e12}, {"PB", 1e15}};
  EXPECT_TRUE(rc::check([&](std::uint64_t bytes) {
    std::istringstream text(formatBytes(static_cast<double>(bytes)));
    double value = 0;
    std::string unit;
    text >> value >> unit;
    const double back = value * units.at(unit);
    RC_ASSERT(std::abs(back - static_cast<double>(bytes)) <= 0.005001 * static_cast<double>(bytes));
  }));
}

TEST(AvailableMemory, IsSomeAndNoMoreThanTheMachineHas) {
  const double machine =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  EXPECT_GT(availableMemoryBytes(), 0U);
  EXPECT_LE(static_cast<double>(availableMemoryBytes()), machine);
}

TEST(RequireMemory, LetsPassWhatFits) {
  EXPECT_NO_THROW(requireMemory(0, "nothing"));
  EXPECT_NO_THROW(requireMemory(0.5 * static_cast<double>(availableMemoryBytes()), "half"));
}

TEST(RequireMemory, RefusesWhatDoesNotFitWithBothFigures) {
  const std::string message =
      messageOf<MemoryError>([] { requireMemory(7.5e17, "a micro-mesh", "step"); });
  EXPECT_THAT(message, StartsWith("step: a micro-mesh: needs 750 PB, "));
  EXPECT_THAT(message, HasSubstr("B available"));
}

TEST(RequireMemory, LeavesATenthFree) {
  const double available = static_cast<double>(availableMemoryBytes());
  EXPECT_THROW(requireMemory(0.97 * available, "nearly all"), MemoryError);
}

TEST(RequireMemory, RefusesWhatIsNoNumber) {
  EXPECT_THROW(requireMemory(std::nan(""), "a size gone wrong"), MemoryError);
  EXPECT_THROW(requireMemory(std::numeric_limits<double>::infinity(), "a size"), MemoryError);
}

// The library's own answers are tested where it is installed (tests/install).
TEST(OwnFiles, AProgramIsItsOwnFile) {
  EXPECT_TRUE(fs::equivalent(ownFile(), "/proc/self/exe"));
  EXPECT_TRUE(fs::equivalent(ownProgram(), "/proc/self/exe"));
}

TEST(OwnFiles, TheFolderIsTheProgramsOwn) {
  EXPECT_EQ(ownFolder(), fs::canonical("/proc/self/exe").parent_path());
}

/// A folder beside the test program, removed at the end.
class InstalledPath : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(near / "share/what"); }
  void TearDown() override {
    fs::remove_all(near / "share/what");
    fs::remove_all(far / "share/what");
  }
  const fs::path near = ownFolder();
  const fs::path far = ownFolder().parent_path();
};

TEST_F(InstalledPath, IsTheNearestAboveThisCode) {
  fs::create_directories(far / "share/what");
  EXPECT_EQ(installedFile("share/what"), near / "share/what");
  fs::remove_all(near / "share/what");
  EXPECT_EQ(installedFile("share/what"), far / "share/what");
  fs::remove_all(far / "share/what");
  EXPECT_EQ(installedFile("share/what"), std::nullopt);
}

TEST_F(InstalledPath, HasItsLinksResolved) {
  fs::create_directories(far / "share/what/target");
  fs::create_directory_symlink(far / "share/what/target", near / "share/what/link");
  EXPECT_EQ(installedFile("share/what/link"), far / "share/what/target");
}

}  // namespace
}  // namespace gnomon
