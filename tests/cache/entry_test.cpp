#include "cache/cache_folder.h"

#include <gtest/gtest.h>

namespace gnomon::cache {
namespace {

const ContentKey entryKey = keyOfBytes("an input");

TEST(Entry, OpensAsItWasSealed) {
  for (const std::string& content : {std::string(), std::string("x"), std::string(5000, '\0')}) {
    const std::string file = sealedEntry(entryKey, content);
    EXPECT_EQ(file.size(), 64 + content.size());
    EXPECT_EQ(openedEntry(entryKey, file), content);
  }
}

TEST(Entry, EveryFlippedBitIsSeen) {
  const std::string file = sealedEntry(entryKey, "some content");
  for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
    std::string damaged = file;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    EXPECT_EQ(openedEntry(entryKey, damaged), std::nullopt) << bit;
  }
}

TEST(Entry, EveryOtherLengthIsSeen) {
  const std::string file = sealedEntry(entryKey, "some content");
  for (std::size_t size = 0; size < file.size(); ++size) {
    EXPECT_EQ(openedEntry(entryKey, file.substr(0, size)), std::nullopt) << size;
  }
  EXPECT_EQ(openedEntry(entryKey, file + '\0'), std::nullopt);
}

TEST(Entry, AnotherKeysIsNone) {
  EXPECT_EQ(openedEntry(keyOfBytes("another input"), sealedEntry(entryKey, "content")),
            std::nullopt);
}

}  // namespace
}  // namespace gnomon::cache
