#include <gmock/gmock.h>

#include "report/page/opening_html.h"
#include "report/sample_record.h"

namespace gnomon::report {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A record whose only panel shows these methods; "control" is bump mapping alone, and the best.
study::StudyRecord recordWith(const std::vector<std::string>& shown) {
  study::StudyRecord record = test::sampleRecord(1);
  record.methods.push_back({"control", "unshadowed", "", ""});
  record.results.push_back(
      test::result("control", "elevation 15°", "camera", "all", test::countsOf(1000, 1, 0)));
  record.claims = {{"Never judged", "", study::Verdict::notEvaluated, ""},
                   {"Closer than none", "", study::Verdict::held, "ratio 0.5"},
                   {"Closer", "", study::Verdict::held, "ratio 0.12"}};
  record.claims[1].methods = {"rough, \"old\"", "control"};
  record.claims[2].methods = {"close", "rough, \"old\""};
  study::PanelRecord panel{"camera", "elevation 15°", 1, 1, {}};
  for (const std::string& method : shown) {
    panel.pictures.push_back(
        {study::PictureRecord::Kind::shaded, method, method, "", "", "bytes of " + method});
  }
  record.panels = {panel};
  return record;
}

std::vector<std::string> figuresOf(const study::StudyRecord& record) {
  std::vector<std::string> texts;
  for (const OpeningFigure& figure : openingFigures(record, study::rankMethods(record))) {
    texts.push_back(figure.role + ": " + figure.method);
  }
  return texts;
}

TEST(Opening, ShowsFlatClaimedBestAndTruth) {
  EXPECT_THAT(figuresOf(recordWith({"control", "best", "close", "rough, \"old\"", "truth"})),
              ElementsAre("flat: rough, \"old\"", "claimed: close", "best: best", "truth: truth"));
}

TEST(Opening, ShowsFewerWhereAStudyHasNoSuch) {
  EXPECT_THAT(figuresOf(recordWith({"close", "truth"})),
              ElementsAre("claimed: close", "truth: truth"));
  study::StudyRecord record = recordWith({"best", "close", "truth"});
  record.claims.back().methods = {"best"};
  EXPECT_THAT(figuresOf(record), ElementsAre("claimed and best: best", "truth: truth"));
  record.claims.clear();
  EXPECT_THAT(figuresOf(record), ElementsAre("best: best", "truth: truth"));
  EXPECT_THAT(figuresOf(test::sampleRecord()), IsEmpty());
}

TEST(Opening, EachPictureHasItsErrorThere) {
  const study::StudyRecord record = recordWith({"best", "close", "rough, \"old\"", "truth"});
  const std::string html = openingHtml(record, study::rankMethods(record)).text();
  EXPECT_THAT(html, HasSubstr("<b>flat</b> rough, &quot;old&quot;<span class=\"rate\" title=\"\">"
                              "error 10.00\u202f%</span>"));
  EXPECT_THAT(html, HasSubstr("<b>claimed</b> close<span class=\"rate\" title=\"\">error 1.20"));
  EXPECT_THAT(html, HasSubstr("uncertain by 0.20\u202f%"));
  EXPECT_THAT(html, HasSubstr("in the view “camera” under the light “elevation 15°”"));
  EXPECT_THAT(openingHtml(test::sampleRecord(), {}).text(), Not(HasSubstr("<figure")));
}

TEST(Opening, ExplainsOnlyTheRolesThatAPictureHas) {
  const auto opening = [](const study::StudyRecord& record) {
    return openingHtml(record, study::rankMethods(record)).text();
  };
  study::StudyRecord record = recordWith({"best", "close", "rough, \"old\"", "truth"});
  for (const char* role : {" Flat: ", " Claimed: ", " Best: "}) {
    EXPECT_THAT(opening(record), HasSubstr(role));
  }
  record.claims.clear();
  EXPECT_THAT(opening(record), Not(HasSubstr(" Claimed: ")));
  EXPECT_THAT(opening(record), HasSubstr(" Best: "));
  const std::string claimed = opening(recordWith({"close", "truth"}));
  EXPECT_THAT(claimed, HasSubstr(" Claimed: "));
  for (const char* role : {" Flat: ", " Best: "}) EXPECT_THAT(claimed, Not(HasSubstr(role)));
}

TEST(Opening, OfSoftLightAnErrorIsAShareOfTheLight) {
  study::StudyRecord record = recordWith({"best", "close", "rough, \"old\"", "truth"});
  const auto opening = [&] { return openingHtml(record, study::rankMethods(record)).text(); };
  EXPECT_THAT(opening(), HasSubstr("</button> at <b>0.10&#8239;%</b> of the <button"));
  for (study::ResultRecord& result : record.results) result.shares.push_back({"mae", 0.01, {}});
  EXPECT_THAT(opening(), HasSubstr("share of the light</button> is off by <b>0.10&#8239;%</b>, "));
  EXPECT_THAT(opening(), Not(HasSubstr("of the <button")));
}

}  // namespace
}  // namespace gnomon::report
