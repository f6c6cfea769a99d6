#include "cache/content_key.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace gnomon::cache {
namespace {

ContentKey keyOf(std::string_view name, double value) {
  return KeyBuilder("test").add(name, value).key();
}

TEST(ContentKeys, AreThoseOfXxHash) {
  // The published vector: XXH3-128 of nothing, seed 0.
  EXPECT_EQ(keyOfBytes("").text(), "99aa06d3014798d86001c324468d497f");
}

TEST(ContentKeys, EveryPartOfAnInputCounts) {
  std::set<ContentKey> keys;
  const auto expectNew = [&](const ContentKey& key) { EXPECT_TRUE(keys.insert(key).second); };
  expectNew(KeyBuilder("test").key());
  expectNew(KeyBuilder("other").key());
  expectNew(keyOf("a", 1));
  expectNew(keyOf("b", 1));
  expectNew(keyOf("a", 2));
  // The same bytes as another type, in another order, cut elsewhere, or once more.
  expectNew(KeyBuilder("test").add("a", std::int64_t{0x3ff0000000000000}).key());
  expectNew(KeyBuilder("test").add("a", 1.0).add("b", 1.0).key());
  expectNew(KeyBuilder("test").add("b", 1.0).add("a", 1.0).key());
  expectNew(KeyBuilder("test").add("a", "xy").add("b", "z").key());
  expectNew(KeyBuilder("test").add("a", "x").add("b", "yz").key());
  expectNew(KeyBuilder("test").add("a", "").key());
  expectNew(KeyBuilder("test").add("a", std::vector<float>{}).key());
  expectNew(KeyBuilder("test").add("a", std::vector<float>{1, 2}).key());
  expectNew(KeyBuilder("test").add("a", std::vector<float>{2, 1}).key());
}

TEST(ContentKeys, FloatsEnterByTheirBits) {
  EXPECT_NE(keyOf("a", 0.0), keyOf("a", -0.0));
  EXPECT_NE(keyOf("a", 0.1), keyOf("a", static_cast<double>(0.1F)));
  EXPECT_NE(keyOf("a", 1), keyOf("a", 1 + std::numeric_limits<double>::epsilon()));
  EXPECT_EQ(keyOf("a", 0.1), keyOf("a", 0.1));
}

TEST(ContentKeys, LongInputsCountToTheirLastByte) {
  std::vector<float> values(100000, 1.0F);
  const ContentKey before = KeyBuilder("test").add("a", values).key();
  EXPECT_EQ(before, KeyBuilder("test").add("a", values).key());
  values.back() = 2;
  EXPECT_NE(before, KeyBuilder("test").add("a", values).key());
}

}  // namespace
}  // namespace gnomon::cache
