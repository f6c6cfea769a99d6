#include "cache/cache_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>
#include <vector>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "support/temporary_folder.h"

namespace gnomon::cache {
namespace {

namespace fs = std::filesystem;

class CacheFolder : public TemporaryFolder {
 protected:
  /// An entry of so many bytes, used so many hours ago.
  fs::path entry(const std::string& name, std::size_t bytes, int hours) const {
    const fs::path path = file("ab") / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << std::string(bytes, 'x');
    fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(hours));
    return path;
  }
};

TEST_F(CacheFolder, IsWhereTheEnvironmentSays) {
  ::setenv("GNOMON_CACHE", "/a", 1);
  ::setenv("XDG_CACHE_HOME", "/b", 1);
  ::setenv("HOME", "/c", 1);
  EXPECT_EQ(standardCacheFolder(), "/a");
  ::unsetenv("GNOMON_CACHE");
  EXPECT_EQ(standardCacheFolder(), "/b/gnomon");
  ::setenv("XDG_CACHE_HOME", "", 1);
  EXPECT_EQ(standardCacheFolder(), "/c/.cache/gnomon");
  // As the XDG Base Directory Specification has it; a run would write into any working folder.
  ::setenv("XDG_CACHE_HOME", "b/caches", 1);
  EXPECT_EQ(standardCacheFolder(), "/c/.cache/gnomon");
  ::setenv("HOME", "c", 1);
  EXPECT_EQ(standardCacheFolder(), std::nullopt);
  ::unsetenv("HOME");
  EXPECT_EQ(standardCacheFolder(), std::nullopt);
}

TEST_F(CacheFolder, TheLeastRecentlyUsedGoFirst) {
  const fs::path oldest = entry("1.entry", 400, 3);
  const fs::path newest = entry("2.entry", 400, 1);
  const fs::path middle = entry("3.entry", 400, 2);
  EXPECT_EQ(trimTo(folder(), 1200).entries, 3U);
  const CacheUsage left = trimTo(folder(), 1000);
  EXPECT_EQ(left.entries, 2U);
  EXPECT_EQ(left.bytes, 800U);
  EXPECT_FALSE(fs::exists(oldest));
  EXPECT_TRUE(fs::exists(middle));
  EXPECT_EQ(trimTo(folder(), 400).entries, 1U);
  EXPECT_TRUE(fs::exists(newest));
  EXPECT_EQ(trimTo(folder(), 0).entries, 0U);
}

TEST_F(CacheFolder, NothingElseIsTouched) {
  const PartFile written(folder(), ".entry");
  const fs::path left = file(".gnomon-00000000-77-0123456789abcdef.part.entry");
  std::ofstream(left) << "half";
  fs::last_write_time(left, fs::file_time_type::clock::now() - std::chrono::hours(2));
  std::ofstream(file("notes.entry")) << "mine";
  fs::create_directories(file("photos"));
  std::ofstream(file("photos/1.entry")) << "mine";
  fs::create_directories(file("ab"));
  std::ofstream(file("ab/notes.txt")) << "mine";
  EXPECT_EQ(usageOf(folder()).entries, 0U);
  (void)trimTo(folder(), 0);
  EXPECT_TRUE(fs::exists(written.path())) << "its writer lives";
  EXPECT_FALSE(fs::exists(left));
  for (const char* name : {"notes.entry", "photos/1.entry", "ab/notes.txt"}) {
    EXPECT_TRUE(fs::exists(file(name))) << name;
  }
}

TEST_F(CacheFolder, AFolderThatIsNotThereIsEmpty) {
  EXPECT_EQ(usageOf(file("none")).bytes, 0U);
  EXPECT_EQ(trimTo(file("none"), 0).entries, 0U);
  EXPECT_EQ(limitOf(file("none")), standardCacheLimit);
}

TEST_F(CacheFolder, KeepsItsBound) {
  setLimit(folder(), 123456);
  EXPECT_EQ(limitOf(folder()), 123456U);
  std::ofstream(file("limit")) << "much";
  EXPECT_EQ(limitOf(folder()), standardCacheLimit);
}

TEST_F(CacheFolder, IsTrimmedOnceItHoldsMoreThanItsBound) {
  entry("1.entry", 400, 3);
  entry("2.entry", 400, 2);
  account(folder(), 800, 1000);
  EXPECT_EQ(usageOf(folder()).entries, 2U);
  entry("3.entry", 400, 1);
  account(folder(), 400, 1000);
  EXPECT_EQ(usageOf(folder()).entries, 2U);
  account(folder(), 0, 100);
  EXPECT_EQ(usageOf(folder()).entries, 2U) << "nothing was written";
}

/// One in ten: 16 × 5 of 800 bytes. The chance that 600 draws give less than 25 or more than 100 is
/// below 10⁻⁶.
TEST_F(CacheFolder, IsLookedThroughOnceForASixteenthOfItsBound) {
  int trimmed = 0;
  for (int i = 0; i < 600; ++i) {
    const fs::path first = entry("1.entry", 900, 3);
    account(folder(), 5, 800);
    if (!fs::exists(first)) ++trimmed;
  }
  EXPECT_GT(trimmed, 25);
  EXPECT_LT(trimmed, 100);
}

/// Several writers and one bound: nobody waits, and what is left is whole.
TEST_F(CacheFolder, ManyMayTrimAtOnce) {
  for (int i = 0; i < 200; ++i) entry(std::to_string(i) + ".entry", 10, i);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 5; ++i) account(folder(), 1000, 1000);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_LE(usageOf(folder()).bytes, 1000U);
  EXPECT_TRUE(fs::exists(file("ab/0.entry"))) << "the last that was used";
}

TEST_F(CacheFolder, ReadsNumbersOfBytes) {
  EXPECT_EQ(parseBytes("12"), 12U);
  EXPECT_EQ(parseBytes("500MB"), 500'000'000U);
  EXPECT_EQ(parseBytes("4 GB"), 4'000'000'000U);
  EXPECT_EQ(parseBytes("1.5kB\n"), 1500U);
  EXPECT_EQ(parseBytes("0"), 0U);
  for (const char* text : {"", "x", "-1", "4 GiB", "nan", "inf", "1e30", "4 GB x"}) {
    EXPECT_THROW((void)parseBytes(text), UsageError) << text;
  }
}

}  // namespace
}  // namespace gnomon::cache
