#include "report/text/radius_text.h"
#include "study/judge/distinguish.h"

#include <gmock/gmock.h>

#include "report/json/json_values.h"
#include "report/page/html_page.h"
#include "report/text/confidence_text.h"
#include "report/text/terminal_page.h"

namespace gnomon::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

study::ClaimRecord turningClaim() {
  study::ClaimRecord claim{"a is better than b", "a test", study::Verdict::held, "by far"};
  claim.radius = {study::Verdict::failed, study::Verdict::held};
  return claim;
}

TEST(RadiusText, TerminalPageAndFilesSayTheSame) {
  const study::ClaimRecord claim = turningClaim();
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
  study::ClaimRecord claim = turningClaim();
  claim.radius = {study::Verdict::held, study::Verdict::held};
  EXPECT_EQ(radiusNote(claim), "");
  EXPECT_EQ(jsonClaim(claim).at("radius").at("depends"), false);
  EXPECT_THAT(htmlClaim(claim).text(), Not(HasSubstr("radius")));
  claim.radius.reset();
  EXPECT_EQ(radiusNote(claim), "");
  EXPECT_TRUE(jsonClaim(claim).at("radius").is_null());
}

TEST(RadiusText, ADifferenceSeenFromTheOtherSideTurnsWithItsCheck) {
  study::StudyRecord record;
  for (const char* method : {"a", "b"}) {
    study::ConfidenceRecord row;
    row.method = method;
    row.view = "camera";
    row.light = study::allLights;
    row.rate = method[0] == 'a' ? 0.01 : 0.02;
    record.confidence.push_back(row);
  }
  study::DifferenceRecord row;
  row.view = "camera";
  row.light = study::allLights;
  row.first = "a";
  row.second = "b";
  row.difference = -0.01;
  row.interval = compare::Interval{-0.02, -0.005};
  row.verdict = study::DifferenceVerdict::better;
  row.radius = {study::DifferenceVerdict::worse, study::DifferenceVerdict::better};
  record.differences = {row};
  const auto turned = study::differenceOf(record, "camera", study::allLights, "b", "a");
  ASSERT_TRUE(turned);
  EXPECT_EQ(turned->radius->atHalf, study::DifferenceVerdict::better);
  EXPECT_EQ(turned->radius->atTwice, study::DifferenceVerdict::worse);
  EXPECT_EQ(differenceMark(*turned), std::string(" ") + radiusMark);
  EXPECT_THAT(verdictText(record, "camera"),
              HasSubstr("which depends on the radius: worse at half of it, better at twice."));
  EXPECT_THAT(confidenceNote(record, "camera"), HasSubstr(radiusMark));
}

}  // namespace
}  // namespace gnomon::report
