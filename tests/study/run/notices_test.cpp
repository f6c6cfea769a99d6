#include "study/run/notices.h"

#include <gmock/gmock.h>

#include "study/spec/study_file_fixture.h"
#include "surface/cage/shapes.h"

namespace gnomon::study {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TruthRecord truthWith(double uncertainty, double step) {
  TruthRecord truth;
  truth.uncertainty = uncertainty;
  truth.askedStepTexels = step;
  truth.stepTexels = 0.9 * step;
  return truth;
}

class UncertaintyNotice : public StudyFile {
 protected:
  /// Of a study with these lines under [truth].
  std::optional<std::string> notice(const std::string& lines, const TruthRecord& truth,
                                    bool isQuick = false) {
    const std::string text = std::string(plainStudy) + "\n[truth]\n" + lines;
    return uncertaintyNotice(read(text, {{}, {}, isQuick}), truth);
  }
};

TEST_F(UncertaintyNotice, ThreePerMilleIsGoodEnough) {
  EXPECT_EQ(notice("step = 0.25", truthWith(0.003, 0.25)), std::nullopt);
  EXPECT_EQ(notice("step = 0.25", truthWith(0, 0.25)), std::nullopt);
  EXPECT_TRUE(notice("step = 0.25", truthWith(0.00301, 0.25)));
}

TEST_F(UncertaintyNotice, NamesTheKeyThatRefinesTheTruth) {
  const std::string step = notice("step = 0.25", truthWith(0.0047, 0.25)).value();
  EXPECT_THAT(step, HasSubstr("0.47 %"));
  EXPECT_THAT(step, HasSubstr("more than 0.3 %"));
  EXPECT_THAT(step, HasSubstr("Set truth.step = 0.125 (now 0.25)."));
  // Where the study leaves it to the program, the step that was found.
  EXPECT_EQ(notice("", truthWith(0.0047, 0.25)), step);
}

TEST_F(UncertaintyNotice, InTheQuickFormNamesTheKeysAsTheStudyHasThem) {
  const std::string step = notice("step = 0.25", truthWith(0.01, 1.0), true).value();
  EXPECT_THAT(step, HasSubstr("Leave out --quick; or set truth.step = 0.125 (now 0.25)."));
}

TEST(Notices, OverlapIsToldWithItsShare) {
  surface::TextureLayout layout;
  EXPECT_EQ(overlapNotice(layout), std::nullopt);
  layout.isOneToOne = false;
  layout.sharedArea = 0.02534;
  EXPECT_THAT(overlapNotice(layout).value(), HasSubstr("2.53 % of the surface's area"));
}

TEST(Notices, MethodsThatMetOtherChartsAreNamedWithTheirShares) {
  std::vector<MethodRecord> methods(3);
  methods[0].label = "one";
  methods[1].label = "two";
  methods[2].label = "three";
  methods[1].otherChartShare = 0;
  EXPECT_EQ(otherChartNotice(methods), std::nullopt);
  methods[0].otherChartShare = 0.125;
  methods[2].otherChartShare = 0.00001;
  EXPECT_THAT(otherChartNotice(methods).value(),
              HasSubstr(": “one” at 12.5 % of the samples, “three” at 0.001 % of the samples."));
}

TEST(Notices, PiecesLongerThanTwoTexelsAreTooCoarse) {
  // Figure 8's: 8 texels a face.
  EXPECT_EQ(coarsePiecesNotice("shadow-volume", 9, 8), std::nullopt);
  EXPECT_EQ(coarsePiecesNotice("shadow-volume", 4, 8), std::nullopt);
  // One face over a map of 256 × 128 texels.
  const std::string notice = coarsePiecesNotice("shadow-volume", 9, 256).value();
  EXPECT_THAT(notice, StartsWith("shadow-volume: "));
  EXPECT_THAT(notice, HasSubstr("9 a side"));
  EXPECT_THAT(notice, HasSubstr("28 texels"));
  EXPECT_THAT(notice, HasSubstr("base.subdivisions = 256"));
  EXPECT_EQ(coarsePiecesNotice("shadow-volume", 256, 256), std::nullopt) << "as it says";
  const std::string most = coarsePiecesNotice("shadow-map", 9, 5000).value();
  EXPECT_THAT(most, HasSubstr("more faces"));
  EXPECT_THAT(most, Not(HasSubstr("base.subdivisions =")));
}

TEST(Notices, OfALightsOwnMeshNameItsPieces) {
  const std::string notice = coarsePiecesNotice("two-scales", 9, 256, true).value();
  EXPECT_THAT(notice, HasSubstr("the displaced mesh that the light sees, 9 a side"));
  EXPECT_THAT(notice, HasSubstr("Set parameters.light_pieces = 256 for"));
}

class LightNotices : public StudyFile {
 protected:
  /// Of a study with two lights.
  std::vector<std::string> notices(LightCount first, LightCount second) {
    const std::string text =
        test::replaced(plainStudy, "[[light]]\n", "[[light]]\nname = \"high\"\n") +
        "[[light]]\nname = \"low\"\nelevation = 5\n";
    return lightNotices(read(text), std::vector{first, second});
  }
};

TEST_F(LightNotices, AreOfLightsUnderWhichNextToAllSamplesAreAlike) {
  EXPECT_EQ(notices({500, 500, 998}, {2, 998}).size(), 0U);
  const auto dark = notices({500, 500}, {1, 999});
  ASSERT_EQ(dark.size(), 1U);
  EXPECT_THAT(dark[0], StartsWith("Under low at least 99.9 % of the samples are shadowed"));
  // What is displaced may catch the light from below.
  EXPECT_THAT(notices({500, 500}, {300, 700, 999}).at(0),
              StartsWith("Under low the whole surface is turned from the light"));
  const auto both = notices({999, 1}, {1000, 0});
  ASSERT_EQ(both.size(), 1U);
  EXPECT_THAT(both[0], StartsWith("Under “high”, “low” at least 99.9 % of the samples are lit"));
  EXPECT_EQ(notices({1000, 0}, {0, 1000}).size(), 2U);
}

/// A torus, or the same with its inside out.
surface::LimitSurface torus(bool isInsideOut) {
  surface::Cage cage = surface::makeTorus(30, 10, 66, 58);
  for (std::size_t corner = 0; isInsideOut && corner < cage.faceVertices.size(); corner += 4) {
    std::swap(cage.faceVertices[corner + 1], cage.faceVertices[corner + 3]);
    std::swap(cage.faceUvs[corner + 1], cage.faceUvs[corner + 3]);
  }
  if (isInsideOut) cage.grid.reset();
  return surface::LimitSurface(cage);
}

TEST(Notices, AClosedSurfaceInsideOutIsToldOnlyWhereAllIsDark) {
  const std::optional<std::string> notice = insideOutNotice(torus(true), 0.999);
  ASSERT_TRUE(notice);
  EXPECT_THAT(*notice, HasSubstr("inside out"));
  EXPECT_THAT(*notice, HasSubstr("99.9 %"));
  EXPECT_EQ(insideOutNotice(torus(true), 0.9), std::nullopt) << "someone looks at its inside";
  EXPECT_EQ(insideOutNotice(torus(false), 1), std::nullopt) << "it is night";
  const surface::LimitSurface open(surface::makePlane(8, 8, 4, 4));
  EXPECT_EQ(insideOutNotice(open, 1), std::nullopt);
}

}  // namespace
}  // namespace gnomon::study
