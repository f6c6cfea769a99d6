#include "compare/scenes/scene_table.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/error.h"

namespace gnomon::compare {
namespace {

SceneTable table() {
  return {{"b", "a"}, {"new", "flat"}, {{0.1, std::nullopt}, {0.2, 0.3}}, {0.01, 0.02}};
}

TEST(SceneTable, IsSortedByName) {
  const SceneTable sorted = sortedByName(table());
  EXPECT_EQ(sorted.scenes, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(sorted.methods, (std::vector<std::string>{"flat", "new"}));
  EXPECT_EQ(sorted.errors[0], (std::vector<std::optional<double>>{0.3, 0.2}));
  EXPECT_EQ(sorted.errors[1], (std::vector<std::optional<double>>{std::nullopt, 0.1}));
  EXPECT_EQ(sorted.uncertainty, (std::vector<double>{0.02, 0.01}));
  EXPECT_EQ(sharedScenes(sorted, {0, 1}), (std::vector<std::size_t>{1}));
  EXPECT_EQ(sharedScenes(sorted, {0}), (std::vector<std::size_t>{0, 1}));
}

TEST(SceneTable, RefusesWhatIsNone) {
  SceneTable twice = table();
  twice.scenes = {"a", "a"};
  EXPECT_THROW(sortedByName(twice), InternalError);
  SceneTable narrow = table();
  narrow.errors[1].pop_back();
  EXPECT_THROW(sortedByName(narrow), InternalError);
  SceneTable large = table();
  large.errors[0][0] = 1.1;
  EXPECT_THROW(sortedByName(large), InternalError);
  SceneTable unknown = table();
  unknown.errors[0][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(sortedByName(unknown), InternalError);
  unknown = table();
  unknown.uncertainty[1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(sortedByName(unknown), InternalError);
}

}  // namespace
}  // namespace gnomon::compare
