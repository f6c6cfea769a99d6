// A study that needs more than its control group may take is refused, where it was killed.

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "common/error.h"
#include "faults/shell_run.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

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
