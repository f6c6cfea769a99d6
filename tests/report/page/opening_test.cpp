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

}  // namespace
}  // namespace gnomon::report
