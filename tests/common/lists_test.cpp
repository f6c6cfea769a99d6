#include "common/lists.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace gnomon {
namespace {

TEST(FirstOfSame, IsTheFirstThatHoldsTheSame) {
  const std::string letters = "abacbca";
  const auto firsts = firstOfSame(
      letters.size(), [&](std::size_t a, std::size_t b) { return letters[a] == letters[b]; });
  EXPECT_THAT(firsts, testing::ElementsAre(0, 1, 0, 3, 1, 3, 0));
  EXPECT_THAT(firstOfSame(0, [](std::size_t, std::size_t) { return true; }), testing::IsEmpty());
}

}  // namespace
}  // namespace gnomon
