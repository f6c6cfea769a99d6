#include "study/spec/suite/suite_text.h"

#include <gtest/gtest.h>

namespace gnomon::study {
namespace {

TEST(SuiteText, ReadsBackAndIsWrittenOneWay) {
  const toml::table study = toml::parse(R"([relief]
height = 0.1
name = 'a "b" \c'
texels = [4, 8]
flag = true
whole = 3.0
points = [[0.5, 1], [2, -3e-7]]
[[method]]
name = "a"
bake = { azimuths = 8 }
[[method]]
"odd key" = "tab\there"
)");
  const std::string text = suiteText(study, {"relief", "none", "method"});
  EXPECT_EQ(text, R"([relief]
flag = true
height = 0.1
name = "a \"b\" \\c"
points = [
  [0.5, 1],
  [2, -3e-07],
]
texels = [4, 8]
whole = 3.0

[[method]]
bake = { azimuths = 8 }
name = "a"

[[method]]
"odd key" = "tab\u0009here"
)");
  EXPECT_EQ(toml::parse(text), study);
}

}  // namespace
}  // namespace gnomon::study
