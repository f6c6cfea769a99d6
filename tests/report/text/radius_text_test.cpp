#include "report/text/radius_text.h"
#include "study/judge/distinguish.h"

#include <gmock/gmock.h>

#include "report/json/json_values.h"
#include "report/page/html_page.h"
#include "report/text/confidence_text.h"
#include "report/text/terminal_page.h"

namespace gnomon {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ClaimRecord turningClaim() {
  ClaimRecord claim{"a is better than b", "a test", Verdict::held, "by far"};
  claim.radius = {Verdict::failed, Verdict::held};
  return claim;
}

TEST(RadiusText, TerminalPageAndFilesSayTheSame) {
  const ClaimRecord claim = turningClaim();
  const std::string note = radiusNote(claim);
  EXPECT_EQ(note, "depends on the radius: failed at half of it, held at twice");
  EXPECT_THAT(htmlClaim(claim).text(), HasSubstr(note));
  TerminalPage page(false);
  page.claims({claim});
  EXPECT_THAT(page.text(), HasSubstr(note));
  const Json json = jsonClaim(claim).at("radius");
  EXPECT_EQ(json.at("half"), "failed");
  EXPECT_EQ(json.at("twice"), "held");
  EXPECT_EQ(json.at("depends"), true);
}

TEST(RadiusText, NothingIsSaidOfVerdictsThatStay) {
  ClaimRecord claim = turningClaim();
  claim.radius = {Verdict::held, Verdict::held};
  EXPECT_EQ(radiusNote(claim), "");
  EXPECT_EQ(jsonClaim(claim).at("radius").at("depends"), false);
  EXPECT_THAT(htmlClaim(claim).text(), Not(HasSubstr("radius")));
  claim.radius.reset();
  EXPECT_EQ(radiusNote(claim), "");
  EXPECT_TRUE(jsonClaim(claim).at("radius").is_null());
}

TEST(RadiusText, ADifferenceSeenFromTheOtherSideTurnsWithItsCheck) {
  StudyRecord record;
  for (const char* method : {"a", "b"}) {
    ConfidenceRecord row;
    row.method = method;
    row.view = "camera";
    row.light = allLights;
    row.rate = method[0] == 'a' ? 0.01 : 0.02;
    record.confidence.push_back(row);
  }
  DifferenceRecord row;
  row.view = "camera";
  row.light = allLights;
  row.first = "a";
  row.second = "b";
  row.difference = -0.01;
  row.interval = Interval{-0.02, -0.005};
  row.verdict = DifferenceVerdict::better;
  row.radius = {DifferenceVerdict::worse, DifferenceVerdict::better};
  record.differences = {row};
  const auto turned = differenceOf(record, "camera", allLights, "b", "a");
  ASSERT_TRUE(turned);
  EXPECT_EQ(turned->radius->atHalf, DifferenceVerdict::better);
  EXPECT_EQ(turned->radius->atTwice, DifferenceVerdict::worse);
  EXPECT_EQ(differenceMark(*turned), std::string(" ") + radiusMark);
  EXPECT_THAT(verdictText(record, "camera"),
              HasSubstr("which depends on the radius: worse at half of it, better at twice."));
  EXPECT_THAT(confidenceNote(record, "camera"), HasSubstr(radiusMark));
}

}  // namespace
}  // namespace gnomon
