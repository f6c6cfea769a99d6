#include "cache/cache.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "cache/cache_folder.h"
#include "support/temporary_folder.h"

namespace gnomon::cache {
namespace {

namespace fs = std::filesystem;

const ContentKey program = keyOfBytes("a program");
const ContentKey inputKey = keyOfBytes("an input");

class CacheTest : public TemporaryFolder {
 protected:
  /// A value that is computed if the cache does not have it.
  int remembered(Cache& cache, const ContentKey& of, int value) {
    return cache.remember(of, [&] {
      ++computed_;
      return value;
    });
  }
  [[nodiscard]] fs::path onlyEntry() const {
    for (const auto& entry : fs::recursive_directory_iterator(folder())) {
      if (entry.path().extension() == ".entry") return entry.path();
    }
    return {};
  }
  void expectCounts(const Cache& cache, std::uint64_t hits, std::uint64_t misses,
                    std::uint64_t damaged) {
    EXPECT_EQ(cache.counts().hits, hits);
    EXPECT_EQ(cache.counts().misses, misses);
    EXPECT_EQ(cache.counts().damaged, damaged);
  }

  int computed_ = 0;
};

TEST_F(CacheTest, WhatOneRunComputesAnotherFinds) {
  {
    Cache first(folder(), 1'000'000, program, {});
    EXPECT_FALSE(first.holds(inputKey));
    EXPECT_EQ(remembered(first, inputKey, 7), 7);
    EXPECT_EQ(remembered(first, inputKey, 8), 7);
    expectCounts(first, 1, 1, 0);
  }
  Cache second(folder(), 1'000'000, program, {});
  EXPECT_TRUE(second.holds(inputKey));
  EXPECT_EQ(remembered(second, inputKey, 9), 7);
  EXPECT_EQ(computed_, 1);
  expectCounts(second, 1, 0, 0);
}

TEST_F(CacheTest, AnotherProgramFindsNothing) {
  Cache first(folder(), 1'000'000, program, {});
  EXPECT_EQ(remembered(first, inputKey, 7), 7);
  Cache other(folder(), 1'000'000, keyOfBytes("another program"), {});
  EXPECT_EQ(remembered(other, inputKey, 8), 8);
  EXPECT_EQ(remembered(first, inputKey, 9), 7);
}

TEST_F(CacheTest, ProcessorsShareWhatHoldsOnAll) {
  const ContentKey key = keyOfBytes("a result");
  Cache first(folder(), 1'000'000, {program, keyOfBytes("AVX-512")}, {});
  first.keep(key, std::string("here"));
  first.keep(key, std::string("everywhere"), HoldsOn::anyProcessor);
  Cache other(folder(), 1'000'000, {program, keyOfBytes("AVX2")}, {});
  EXPECT_EQ(other.find<std::string>(key), std::nullopt);
  EXPECT_EQ(other.find<std::string>(key, HoldsOn::anyProcessor), "everywhere");
  EXPECT_EQ(first.find<std::string>(key), "here");
  Cache program2(folder(), 1'000'000, {keyOfBytes("another"), keyOfBytes("AVX-512")}, {});
  EXPECT_EQ(program2.find<std::string>(key, HoldsOn::anyProcessor), std::nullopt);
}

TEST_F(CacheTest, OneThatIsOffKeepsNothing) {
  Cache off;
  EXPECT_EQ(remembered(off, inputKey, 7), 7);
  EXPECT_EQ(remembered(off, inputKey, 8), 8);
  expectCounts(off, 0, 0, 0);
}

TEST_F(CacheTest, ADamagedEntryIsComputedAgain) {
  Cache cache(folder(), 1'000'000, program, {});
  EXPECT_EQ(remembered(cache, inputKey, 7), 7);
  std::fstream(onlyEntry(), std::ios::in | std::ios::out).seekp(65).put('!');
  EXPECT_EQ(remembered(cache, inputKey, 8), 8);
  expectCounts(cache, 0, 2, 1);
  EXPECT_EQ(remembered(cache, inputKey, 9), 8);
  // Another kind of value under the same key, as no sound program writes it.
  EXPECT_EQ(cache.find<std::string>(inputKey), std::nullopt);
  expectCounts(cache, 1, 3, 2);
  EXPECT_FALSE(cache.holds(inputKey));
}

TEST_F(CacheTest, CountsNoLookThatIsNotToBeCounted) {
  Cache cache(folder(), 1'000'000, program, {});
  const auto look = [&] { return cache.find<int>(inputKey, HoldsOn::thisProcessor, Counted::no); };
  EXPECT_EQ(look(), std::nullopt);
  cache.keep(inputKey, 7);
  EXPECT_EQ(look(), 7);
  std::ofstream(onlyEntry(), std::ios::in | std::ios::out).seekp(-1, std::ios::end) << '#';
  EXPECT_EQ(look(), std::nullopt);
  EXPECT_FALSE(cache.holds(inputKey)) << "the damaged entry is removed";
  expectCounts(cache, 0, 0, 0);
}

TEST_F(CacheTest, WhatIsNoFileOfTheRightSizeIsNoEntry) {
  const auto fifo = [](const fs::path& path) { (void)::mkfifo(path.c_str(), 0600); };
  const std::vector<std::function<void(const fs::path&)>> kinds = {
      [](const fs::path& path) { fs::create_directory(path); },
      [](const fs::path& path) { fs::create_directories(path / "ab/cd"); },
      fifo,
      [](const fs::path& path) { fs::create_symlink("/dev/zero", path); },
      [](const fs::path& path) { fs::create_symlink("nowhere", path); },
      [](const fs::path& path) { std::ofstream{path}; },
      [](const fs::path& path) { std::ofstream(path) << "short"; },
  };
  Cache cache(folder(), 1'000'000, program, {});
  EXPECT_EQ(remembered(cache, inputKey, 1), 1);
  const fs::path entry = onlyEntry();
  int value = 1;
  for (const auto& make : kinds) {
    fs::remove_all(entry);
    make(entry);
    EXPECT_EQ(remembered(cache, inputKey, value + 1), value + 1);
    EXPECT_EQ(remembered(cache, inputKey, 0), value + 1) << "it has been kept anew";
    ++value;
  }
  expectCounts(cache, kinds.size(), 1 + kinds.size(), kinds.size());
}

TEST_F(CacheTest, AnEntryThatHasGrownIsNotRead) {
  // Under a limit that would let it pass.
  Cache cache(folder(), std::uint64_t{1} << 60, program, {});
  EXPECT_EQ(remembered(cache, inputKey, 1), 1);
  std::error_code failure;
  int value = 1;
  for (const int bits : {20, 34, 43}) {
    fs::resize_file(onlyEntry(), std::uintmax_t{1} << bits, failure);
    if (failure) continue;
    EXPECT_EQ(remembered(cache, inputKey, value + 1), value + 1) << bits;
    ++value;
  }
  EXPECT_GT(value, 1);
}

TEST_F(CacheTest, HoldsItsBound) {
  constexpr std::uint64_t limit = 20'000;
  {
    Cache cache(folder(), limit, program, {});
    for (int i = 0; i < 100; ++i) {
      cache.keep(KeyBuilder("test").add("i", i).key(), std::string(900, 'x'));
    }
    // Larger than all that may be kept.
    cache.keep(inputKey, std::string(30'000, 'x'));
    EXPECT_FALSE(cache.holds(inputKey));
    EXPECT_TRUE(cache.holds(KeyBuilder("test").add("i", 99).key()));
  }
  EXPECT_LE(usageOf(folder()).bytes, limit / 16 * 17);
  EXPECT_GT(usageOf(folder()).entries, 5U);
}

TEST_F(CacheTest, AFolderThatCannotBeWrittenCostsOneWarning) {
  std::ofstream(file("taken")) << "a file";
  std::vector<std::string> warnings;
  Cache cache(file("taken") / "cache", 1'000'000, program,
              [&](const std::string& text) { warnings.push_back(text); });
  EXPECT_EQ(remembered(cache, inputKey, 7), 7);
  EXPECT_EQ(remembered(cache, inputKey, 8), 8);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("taken"), std::string::npos) << warnings[0];
}

TEST_F(CacheTest, ManyThreadsMayUseIt) {
  Cache cache(folder(), 1'000'000, program, {});
  std::vector<std::thread> threads;
  std::atomic<int> wrong = 0;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 50; ++i) {
        const auto found =
            cache.remember(KeyBuilder("test").add("i", i).key(), [&] { return std::to_string(i); });
        if (found != std::to_string(i)) ++wrong;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(cache.counts().hits + cache.counts().misses, 200U);
  EXPECT_EQ(cache.counts().damaged, 0U);
  EXPECT_EQ(usageOf(folder()).entries, 50U);
}

ContentKey keyOf(int number) {
  return KeyBuilder("test").add("number", number).key();
}

/// A cache of numbers that counts how often one is made.
struct Counting {
  Cache cache{100};
  int made = 0;

  int get(int number, std::uint64_t bytes) {
    return *cache.share(
        keyOf(number),
        [&] {
          ++made;
          return number;
        },
        bytes);
  }
};

TEST(SharedValues, MakesAValueOnce) {
  Counting counting;
  EXPECT_EQ(counting.get(3, 10), 3);
  EXPECT_EQ(counting.get(3, 10), 3);
  EXPECT_EQ(counting.made, 1);
  EXPECT_EQ(counting.get(4, 10), 4);
  EXPECT_EQ(counting.made, 2);
}

TEST(SharedValues, LeastRecentlyUsedMakeRoom) {
  Counting counting;
  for (const int number : {1, 2, 1, 3}) (void)counting.get(number, 40);
  EXPECT_EQ(counting.made, 3);
  (void)counting.get(1, 40);
  EXPECT_EQ(counting.made, 3) << "it was used after 2";
  (void)counting.get(2, 40);
  EXPECT_EQ(counting.made, 4);
}

TEST(SharedValues, HoldsSoManyValuesOfOneTypeAtMost) {
  constexpr int most = Cache::mostOfAType;
  Counting counting;
  const auto other = [&] { return counting.cache.shared<std::string>(keyOf(0)) != nullptr; };
  (void)counting.cache.share(
      keyOf(0), [] { return std::string("other"); }, 0);
  for (int number = 0; number < most; ++number) (void)counting.get(number, 0);
  (void)counting.get(0, 0);
  EXPECT_EQ(counting.made, most) << "all are there";
  (void)counting.get(most, 0);
  (void)counting.get(0, 0);
  EXPECT_EQ(counting.made, most + 1) << "0 was used after 1";
  (void)counting.get(1, 0);
  EXPECT_EQ(counting.made, most + 2);
  EXPECT_TRUE(other()) << "of another type";
}

TEST(SharedValues, KeepsNothingThatIsLargerThanItself) {
  Counting counting;
  (void)counting.get(1, 60);
  EXPECT_FALSE(counting.cache.canShare(101));
  (void)counting.get(2, 101);
  (void)counting.get(2, 101);
  EXPECT_EQ(counting.made, 3);
  (void)counting.get(1, 60);
  EXPECT_EQ(counting.made, 3) << "it made no room";
}

TEST(SharedValues, ValuesOfTwoTypesMayHaveOneKey) {
  Counting counting;
  EXPECT_EQ(counting.get(1, 1), 1);
  const auto text = counting.cache.share(
      keyOf(1), [] { return std::string("one"); },
      [](const std::string& one) { return one.size(); });
  EXPECT_EQ(*text, "one");
  EXPECT_EQ(counting.get(1, 1), 1);
  EXPECT_EQ(counting.made, 1);
}

TEST(SharedValues, OutliveTheirPlace) {
  Cache cache(100);
  const auto get = [&](int number) {
    return cache.share(
        keyOf(number), [&] { return number; }, 100);
  };
  const std::shared_ptr<const int> first = get(1);
  (void)get(2);
  EXPECT_EQ(*first, 1);
  EXPECT_EQ(first.use_count(), 1);
}

TEST(SharedValues, OthersGoWhereMemoryIsTooSmall) {
  Counting counting;
  (void)counting.get(1, 10);
  int tries = 0;
  const auto make = [&] {
    if (++tries == 1) throw MemoryError("too small");
    return 2;
  };
  EXPECT_EQ(*counting.cache.share(keyOf(2), make, 10), 2);
  (void)counting.get(1, 10);
  EXPECT_EQ(counting.made, 2) << "it had gone";
  counting.cache.dropShared();
  tries = 0;
  EXPECT_THROW((void)counting.cache.share(keyOf(2), make, 10), MemoryError) << "nothing could go";
}

}  // namespace
}  // namespace gnomon::cache
