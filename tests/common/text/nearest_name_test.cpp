#include "common/text/nearest_name.h"

#include <gtest/gtest.h>

#include <functional>

namespace gnomon {
namespace {

const std::set<std::string, std::less<>> reliefKeys = {"height", "height_space", "radius", "wall",
                                                       "wrap"};

TEST(NearestName, FindsOneMistakeOfEveryKind) {
  EXPECT_EQ(nearestName("heigth", reliefKeys), "height") << "swapped";
  EXPECT_EQ(nearestName("hight", reliefKeys), "height") << "missing";
  EXPECT_EQ(nearestName("heeight", reliefKeys), "height") << "one too many";
  EXPECT_EQ(nearestName("hejght", reliefKeys), "height") << "wrong";
  EXPECT_EQ(nearestName("heigth_space", reliefKeys), "height_space");
  EXPECT_EQ(nearestName("wal", reliefKeys), "wall");
}

TEST(NearestName, TakesTheNearerOfTwo) {
  EXPECT_EQ(nearestName("wral", {"wall", "wrap", "real"}), "wrap");
  EXPECT_EQ(nearestName("wrapp", {"wall", "wrap"}), "wrap");
}

TEST(NearestName, FindsWhatWasCutOff) {
  EXPECT_EQ(nearestName("diff", {"difference", "different-one", "dir"}), "difference");
  EXPECT_EQ(nearestName("hei", reliefKeys), "height") << "the shortest";
  EXPECT_FALSE(nearestName("he", reliefKeys)) << "two letters";
}

TEST(NearestName, FindsNothingThatIsFarAway) {
  EXPECT_FALSE(nearestName("colour", reliefKeys));
  EXPECT_FALSE(nearestName("", reliefKeys));
  EXPECT_FALSE(nearestName("height", {}));
  EXPECT_FALSE(nearestName(std::string(100000, 'h'), reliefKeys));
}

}  // namespace
}  // namespace gnomon
