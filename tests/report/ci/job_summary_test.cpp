#include "report/ci/job_summary.h"

#include <gmock/gmock.h>

#include "common/error.h"
#include "image/images.h"
#include "report/ci/mosaic.h"
#include "report/sample_check.h"
#include "support/temporary_folder.h"

namespace gnomon::report {
namespace {

using test::passedCheck;
using test::sampleCheck;
using ::testing::HasSubstr;

class JobSummary : public TemporaryFolder {
 protected:
  /// The signed difference of two masks, written as a run does. `#` shadowed, `.` lit, ` ` none.
  std::filesystem::path difference(const std::string& name, int width, const std::string& candidate,
                                   const std::string& truth) const {
    const auto mask = [&](const std::string& signs) {
      Mask result{width, static_cast<int>(signs.size()) / width, {}};
      for (const char sign : signs) {
        result.samples.push_back(sign == '#'   ? Shade::shadowed
                                 : sign == '.' ? Shade::lit
                                               : Shade::none);
      }
      return result;
    };
    std::filesystem::path file = folder() / name;
    image::writePng(file, image::differenceImage(mask(candidate), mask(truth)));
    return file;
  }
};

TEST_F(JobSummary, MosaicShowsEachKind) {
  EXPECT_EQ(mosaicOf(difference("a.png", 5, "#.#. ", "..## "), 5), "🟧⬜⬛🟦🟫\n");
}

/// Blocks of 4 × 4: one wrong pixel of 16 is less than an eighth, two are not.
TEST_F(JobSummary, MosaicShowsAnErrorOfAnEighth) {
  const std::string lit(32, '.');
  std::string one = lit;
  one[0] = '#';
  EXPECT_EQ(mosaicOf(difference("one.png", 8, one, lit), 2), "⬜⬜\n");
  std::string two = one;
  two[1] = '#';
  EXPECT_EQ(mosaicOf(difference("two.png", 8, two, lit), 2), "🟧⬜\n");
  EXPECT_EQ(mosaicOf(difference("all.png", 8, two, lit), 99).size(),
            mosaicOf(difference("all.png", 8, two, lit), 8).size());
}

TEST_F(JobSummary, MosaicRefusesAnotherPicture) {
  image::writePng(folder() / "grey.png", image::maskImage({1, 1, {Shade::none}}));
  EXPECT_THROW(mosaicOf(folder() / "grey.png", 1), InputError);
}

TEST_F(JobSummary, NamesEveryFaultAndTheCommandThatAccepts) {
  study::CheckRecord check = sampleCheck();
  check.shaders["a"] = "my|shader.glsl";
  const std::vector<study::CheckRecord> checks = {check};
  const std::string text = jobSummary(checks, {}, "gnomon check --update-baseline");
  EXPECT_THAT(text, HasSubstr("## Shadows: fail\n\n1 limits hold, 3 do not."));
  EXPECT_THAT(text, HasSubstr("| sample | a | error\\_rate | camera, elevation 30° azimuth 20° | "
                              "0.0900 | 0.0700 | ≤ 0.0800 | my\\|shader.glsl |\n"));
  EXPECT_THAT(text, HasSubstr("| a, &quot;b&quot; &amp; &lt;c&gt; |"));
  EXPECT_THAT(text, HasSubstr("- sample: scenes/sample.toml:7: 100 % wrong\n"));
  EXPECT_THAT(text, HasSubstr("```\ngnomon check --update-baseline\n```\n"));
}

/// Two rows fail: the worse share is shown, although a length fails by more.
TEST_F(JobSummary, ShowsThePicturesOfTheWorstCase) {
  study::StudyRecord record;
  record.name = ".";
  for (const char* light : {"noon", "evening", "dusk"}) {
    study::Judgement judgement = sampleCheck().judgements.back();
    judgement.gate.light = light;
    judgement.value = std::string(light) == "evening" ? 0.3 : 0.1;
    if (std::string(light) == "dusk") {
      judgement.gate.metric = "shadow_length_ratio";
      judgement.value = 5.0;
    }
    record.judgements.push_back(judgement);
    record.referencePictures.push_back(
        {"a", "camera", light, "before.png", "after.png", "change.png", ""});
  }
  difference("before.png", 2, "..", "..");
  difference("after.png", 2, "#.", "..");
  difference("change.png", 2, "#.", "..");
  const std::vector<study::StudyRecord> records = {record};
  const std::optional<WorstCase> worst = worstCase(records, folder());
  ASSERT_TRUE(worst.has_value());
  EXPECT_EQ(worst->light, "evening");
  EXPECT_DOUBLE_EQ(worst->margin, 0.08 - 0.3);
  const std::vector<study::CheckRecord> checks = {sampleCheck()};
  const std::string text = jobSummary(checks, worst, "");
  EXPECT_THAT(text, HasSubstr("**Before**"));
  EXPECT_THAT(text, HasSubstr("```\n⬜⬜\n```"));
  EXPECT_THAT(text, HasSubstr("**Change**"));
  EXPECT_THAT(text, HasSubstr("```\n🟧⬜\n```"));
  EXPECT_FALSE(worstCase({}, folder()).has_value());
}

}  // namespace
}  // namespace gnomon::report
