#include <gmock/gmock.h>

#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

constexpr const char* claim = R"(
[[claim]]
text = "Horizons beat bump mapping"
source = "a test"
less = "max-forsyth"
than = "unshadowed"
)";

class RadiusRun : public EndToEnd {};

/// What --vary-radius says of half and of twice the radius is what runs at these radii find.
TEST_F(RadiusRun, JudgesAtHalfAndAtTwiceAsRunsOfTheirOwnDo) {
  // So high a light leaves shadows that half of this radius is too short to tell.
  const std::string study = replaced(smallStudy(), "elevation = 30", "elevation = 62") + claim;
  runStudy("small", study, {"--vary-radius", "--set", "bake.radius=1.2"});
  const nlohmann::json varied = summary("small");
  bool anyTurns = false;
  for (const auto& [key, radius] : {std::pair("half", "0.6"), std::pair("twice", "2.4")}) {
    runStudy("small", study, {"--set", std::string("bake.radius=") + radius, "--out", key});
    const nlohmann::json single = summary("small", key);
    for (const char* list : {"claims", "differences"}) {
      ASSERT_EQ(varied.at(list).size(), 1U);
      const nlohmann::json& row = varied.at(list).front();
      EXPECT_EQ(row.at("radius").at(key), single.at(list).front().at("verdict")) << list;
      EXPECT_TRUE(single.at(list).front().at("radius").is_null());
      anyTurns = anyTurns || row.at("radius").at("depends");
    }
  }
  EXPECT_TRUE(anyTurns) << "at half of the radius next to nothing is shadowed";
  EXPECT_EQ(varied.at("search_radius").at("texels"), 1.2);
}

/// The truth is the same at all three, and so is what the study itself finds.
TEST_F(RadiusRun, ChangesNothingOfTheStudyItself) {
  runStudy("small", smallStudy(), {"--out", "plain"});
  runStudy("small", smallStudy(), {"--vary-radius", "--out", "varied"});
  EXPECT_EQ(summary("small", "plain").at("results"), summary("small", "varied").at("results"));
  EXPECT_EQ(summary("small", "plain").at("search_radius").at("texels"), 7);
}

}  // namespace
}  // namespace gnomon::test
