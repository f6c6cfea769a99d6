#include "study/spec/toml/toml_text.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/error.h"

namespace gnomon::study {
namespace {

TEST(TomlText, HasSectionsInOrderAndShortNumbers) {
  const toml::table table = toml::parse(R"(
light = [{elevation = 30}, {elevation = 0.1, azimuth = 1e-7}]
[study]
title = 'A "b" ü'
ranked = false
[method]
bake = {bits = 8, radius = 8.0}
points = [[1, 2], [3.5, -4]]
empty = []
)");
  EXPECT_EQ(tomlText(table, {"study", "nothing", "method"}), R"([study]
ranked = false
title = 'A "b" ü'

[method]
bake = { bits = 8, radius = 8.0 }
empty = []
points = [
  [1, 2],
  [3.5, -4],
]

[[light]]
elevation = 30

[[light]]
azimuth = 1e-07
elevation = 0.1
)");
}

TEST(TomlText, ReadsBackToTheBit) {
  toml::table table{{"a", toml::table{{"third", 1.0 / 3},
                                      {"whole", 4.0},
                                      {"large", 1e300},
                                      {"infinite", std::numeric_limits<double>::infinity()},
                                      {"lines", "one\ntwo ' three \" \\ \t"},
                                      {"an odd key", 1}}}};
  EXPECT_TRUE(toml::parse(tomlText(table)) == table);
}

TEST(TomlText, RefusesWhatTomlCannotHold) {
  EXPECT_THROW(tomlText(toml::table{{"a", "not-\xff-text"}}), InputError);
}

}  // namespace
}  // namespace gnomon::study
