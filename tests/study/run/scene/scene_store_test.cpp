#include "study/run/scene/scene_store.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace gnomon::study {
namespace {

cache::ContentKey keyOf(int number) {
  return cache::KeyBuilder("test").add("number", number).key();
}

/// A store of numbers that counts how often one is made.
struct Counting {
  SceneStore store{100};
  int made = 0;

  int get(int number, std::uint64_t bytes) {
    return *store.get<int>(
        keyOf(number),
        [&] {
          ++made;
          return std::make_shared<const int>(number);
        },
        [&](int) { return bytes; });
  }
};

TEST(SceneStore, MakesAValueOnce) {
  Counting counting;
  EXPECT_EQ(counting.get(3, 10), 3);
  EXPECT_EQ(counting.get(3, 10), 3);
  EXPECT_EQ(counting.made, 1);
  EXPECT_EQ(counting.get(4, 10), 4);
  EXPECT_EQ(counting.made, 2);
}

TEST(SceneStore, LeastRecentlyUsedMakeRoom) {
  Counting counting;
  for (const int number : {1, 2, 1, 3}) (void)counting.get(number, 40);
  EXPECT_EQ(counting.made, 3);
  (void)counting.get(1, 40);
  EXPECT_EQ(counting.made, 3) << "it was used after 2";
  (void)counting.get(2, 40);
  EXPECT_EQ(counting.made, 4);
}

TEST(SceneStore, HoldsSoManyValuesOfOneTypeAtMost) {
  constexpr int most = SceneStore::mostOfAType;
  Counting counting;
  const auto other = [&] { return counting.store.held<std::string>(keyOf(0)) != nullptr; };
  (void)counting.store.get<std::string>(
      keyOf(0), [] { return std::make_shared<const std::string>("other"); },
      [](const std::string&) { return std::uint64_t{0}; });
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

TEST(SceneStore, KeepsNothingThatIsLargerThanItself) {
  Counting counting;
  (void)counting.get(1, 60);
  EXPECT_FALSE(counting.store.canHold(101));
  (void)counting.get(2, 101);
  (void)counting.get(2, 101);
  EXPECT_EQ(counting.made, 3);
  (void)counting.get(1, 60);
  EXPECT_EQ(counting.made, 3) << "it made no room";
}

TEST(SceneStore, ValuesOfTwoTypesMayHaveOneKey) {
  Counting counting;
  EXPECT_EQ(counting.get(1, 1), 1);
  const auto text = counting.store.get<std::string>(
      keyOf(1), [] { return std::make_shared<const std::string>("one"); },
      [](const std::string&) { return 1U; });
  EXPECT_EQ(*text, "one");
  EXPECT_EQ(counting.get(1, 1), 1);
  EXPECT_EQ(counting.made, 1);
}

TEST(SceneStore, WhatIsHeldOutlivesItsPlace) {
  SceneStore store(100);
  const auto get = [&](int number) {
    return store.get<int>(
        keyOf(number), [&] { return std::make_shared<const int>(number); },
        [](int) { return 100U; });
  };
  const std::shared_ptr<const int> first = get(1);
  (void)get(2);
  EXPECT_EQ(*first, 1);
  EXPECT_EQ(first.use_count(), 1);
}

TEST(SceneStore, LetsGoOfTheOthersWhereMemoryIsTooSmall) {
  Counting counting;
  (void)counting.get(1, 10);
  int tries = 0;
  const auto make = [&]() -> std::shared_ptr<const int> {
    if (++tries == 1) throw MemoryError("too small");
    return std::make_shared<const int>(2);
  };
  const auto bytes = [](int) { return 10U; };
  EXPECT_EQ(*counting.store.get<int>(keyOf(2), make, bytes), 2);
  (void)counting.get(1, 10);
  EXPECT_EQ(counting.made, 2) << "it had gone";
  counting.store.clear();
  tries = 0;
  EXPECT_THROW((void)counting.store.get<int>(keyOf(2), make, bytes), MemoryError)
      << "nothing could go";
}

}  // namespace
}  // namespace gnomon::study
