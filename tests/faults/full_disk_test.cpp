#include <fmt/core.h>
#include <gmock/gmock.h>
#include <sched.h>
#include <sys/mount.h>

#include <cerrno>
#include <cstring>
#include <functional>
#include <thread>

#include "faults/run_folders.h"
#include "support/test_length.h"

// Disks of every size from none to enough, each a file system in memory.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

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

}  // namespace
}  // namespace gnomon::test
