#include <fmt/core.h>

#include <algorithm>
#include <random>

#include "study/spec/study_file_fixture.h"
#include "surface/limit_surface.h"
#include "truth/micro_scene.h"
#include "truth/shadow_tracer.h"
#include "truth/truth_scenes.h"

// A study whose map is resampled is the same study: surface, shadows and lengths in the world.

namespace gnomon::study {
namespace {

using ::testing::HasSubstr;

/// Random-looking scales on a part of a sphere; the map's border is not flat.
constexpr const char* sphere =
    R"(surface={shape="sphere", curvature=0.02, size=[48, 48], quads=[12, 12]})";
constexpr const char* scales =
    R"(relief={pattern="cells", texels=[36, 36], period=12, height=4, wrap="clamp",)"
    R"( height_space="texture"})";

class ResampledStudy : public StudyFile {
 protected:
  StudySpec sphereStudy(int resample, const std::string& more = "bake.azimuths=8") {
    return readWith({sphere, scales, fmt::format("relief.resample={}", resample), more});
  }
};

TEST_F(ResampledStudy, HasItsLengthsInTexelsOfTheMapBefore) {
  // By the rule, as long in the world: rounded up in texels of either map.
  const double once = readWith({}).bake.settings.radiusTexels;
  EXPECT_NEAR(readWith({"relief.resample=3"}).bake.settings.radiusTexels, 3 * once, 3);
  const StudySpec study =
      readWith({"relief.resample=3", "bake.radius=20", "method.1.bake.radius=7", "truth.step=0.1"});
  EXPECT_EQ(study.relief.field.width(), 192);
  EXPECT_EQ(study.relief.field.height(), 96);
  EXPECT_EQ(study.bake.settings.radiusTexels, 60);
  EXPECT_EQ(study.methods[0].bake.settings.radiusTexels, 60);
  EXPECT_EQ(study.methods[1].bake.settings.radiusTexels, 21);
  EXPECT_DOUBLE_EQ(study.truth.stepTexels.value(), 0.3);
}

TEST_F(ResampledStudy, HasHeightsInTheUnitsOfItsSpace) {
  const float highest = readWith({}).relief.field.maximum();
  EXPECT_EQ(readWith({"relief.resample=5"}).relief.field.maximum(), highest);
  EXPECT_EQ(readWith({"relief.resample=5", "relief.height_space=texture"}).relief.field.maximum(),
            5 * highest);
  const StudySpec inverted = readWith({"relief.resample=3", "relief.invert=true"});
  EXPECT_EQ(inverted.relief.field.maximum(), 4);
  EXPECT_EQ(inverted.relief.field.minimum(), 0);
}

TEST_F(ResampledStudy, IsTheSameSurface) {
  for (const std::string space : {"world", "texture"}) {
    for (const int factor : {3, 5}) {
      const std::string change = fmt::format("relief.height_space={}", space);
      const StudySpec coarse = sphereStudy(1, change);
      const StudySpec fine = sphereStudy(factor, change);
      const surface::LimitSurface surface(coarse.cage);
      std::mt19937 random(11);
      std::uniform_real_distribution<double> share(0, 1);
      double moved = 0;
      for (int i = 0; i < 5000; ++i) {
        const surface::TangentPoint point =
            surface.tangentPoint(i % surface.faceCount(), share(random), share(random));
        const auto place = [&](const relief::Relief& of) {
          return relief::displaced(of, surface::texelFrame(point, of.texelsPerUv()));
        };
        ASSERT_LT(glm::length(place(coarse.relief) - place(fine.relief)), 1e-6) << space;
        moved = std::max(moved, glm::length(place(coarse.relief) - point.position));
      }
      EXPECT_GT(moved, 1) << "the control: there is a relief";
    }
  }
}

/// The truth of a study at fixed points of its surface.
Mask truthOf(const StudySpec& study, double coarser = 1) {
  const surface::LimitSurface surface(study.cage);
  surface::SampleGrid samples{200, 150, {}};
  std::mt19937 random(5);
  std::uniform_real_distribution<float> share(0, 1);
  for (int i = 0; i < samples.width * samples.height; ++i) {
    samples.samples.push_back({i % surface.faceCount(), share(random), share(random)});
  }
  truth::MicroMeshSettings settings = study.truth.ofMesh();
  settings.stepTexels = coarser * settings.stepTexels.value();
  const truth::MicroMesh mesh(surface, study.relief, settings);
  const truth::MicroScene scene(mesh);
  return truth::traceShadows(surface, study.relief, mesh, scene, samples,
                             truth::TraceSettings{{test::lightToward(20, 25)}})
      .mask;
}

double shadowedShare(const Mask& mask) {
  return static_cast<double>(
             std::count(mask.samples.begin(), mask.samples.end(), Shade::shadowed)) /
         static_cast<double>(mask.size());
}

TEST_F(ResampledStudy, HasTheSameTruthWhereTheMicroMeshIsTheSame) {
  // A sixth of a texel: half a texel of the map three times as fine, where all lines fall again.
  const Mask coarse = truthOf(sphereStudy(1, "truth.step=0.1667"));
  const Mask fine = truthOf(sphereStudy(3, "truth.step=0.1667"));
  EXPECT_EQ(truth::flipRate(coarse, fine), 0);
  EXPECT_GT(shadowedShare(coarse), 0.1);
  EXPECT_LT(shadowedShare(coarse), 0.9);
}

TEST_F(ResampledStudy, HasTheSameTruthWithinItsUncertaintyElsewhere) {
  const StudySpec study = sphereStudy(1, "truth.step=0.125");
  const Mask coarse = truthOf(study);
  const double uncertainty = truth::flipRate(coarse, truthOf(study, 2));
  EXPECT_GT(uncertainty, 0);
  for (const int factor : {3, 5}) {
    EXPECT_LE(truth::flipRate(coarse, truthOf(sphereStudy(factor, "truth.step=0.125"))),
              uncertainty);
  }
  // The control: heights that are not scaled with the map are another surface.
  StudySpec lower = sphereStudy(3, "truth.step=0.125");
  std::vector<float> texels = lower.relief.field.texels();
  for (float& texel : texels) texel /= 3;
  lower.relief.field = relief::HeightField(108, 108, texels, relief::Wrap::clamp);
  EXPECT_GT(truth::flipRate(coarse, truthOf(lower)), 10 * uncertainty);
}

TEST_F(ResampledStudy, TakesOddFactorsThatFitAlone) {
  EXPECT_THAT(failureWith({"relief.resample=2"}),
              HasSubstr("relief.resample: 2 found, an odd number expected"));
  EXPECT_THAT(failureWith({"relief.resample=0"}),
              HasSubstr("relief.resample: 0 found, a whole number from 1 to 255 expected"));
  EXPECT_THAT(failureWith({"relief.resample=1.5"}), HasSubstr("relief.resample: 1.5 found"));
  EXPECT_THAT(failure<MemoryError>(
                  plainStudy, {{"relief.texels=[4096, 4096]", "relief.resample=255"}, {}, false}),
              HasSubstr("relief.resample: 255, a map of 1044480 × 1044480 texels"));
}

}  // namespace
}  // namespace gnomon::study
