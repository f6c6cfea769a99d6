#include "study/spec/study_work.h"

#include <gtest/gtest.h>

#include "study/spec/study_file_fixture.h"
#include "support/scene_files.h"
#include "truth/micro_lines.h"

namespace gnomon::study {
namespace {

class StudyWorkOf : public StudyFile {};

TEST_F(StudyWorkOf, CountsWhatTheSettingsSay) {
  const StudyWork work = workOf(readWith({"bake.azimuths=16", "truth.step=0.25"}));
  // A camera of 200 × 100, and 8 × 8 faces' samples of 4 × 2 faces; one light, two methods.
  EXPECT_EQ(work.samples, 20'000 + 8 * 64);
  EXPECT_EQ(work.rays, work.samples);
  EXPECT_EQ(work.frames, 2 * work.samples);
  // Two methods of one bake.
  EXPECT_EQ(work.horizons, 16.0 * 64 * 32);
  EXPECT_EQ(work.microTriangles, 2.0 * 64 * 32 * 16);
}

TEST_F(StudyWorkOf, GrowsWithEveryKeyThatMakesARunLonger) {
  const StudySpec plain = readWith({});
  for (const char* change :
       {"bake.azimuths=1024", "view.0.width=400", "view.1.samples=64", "light.0.azimuth=[1, 2]",
        "truth.triangles=6e7", "truth.step=0.01", "relief.texels=[640, 320]"}) {
    EXPECT_GT(standardCost(readWith({change})), standardCost(plain)) << change;
  }
  EXPECT_LT(standardCost(read(plainStudy, {{}, {"ours"}, false})), standardCost(plain));
  EXPECT_LT(standardCost(read(plainStudy, {{}, {}, true})), standardCost(plain));
}

/// The micro-mesh that the run builds, by the very lines that it is cut along.
TEST_F(StudyWorkOf, FindsTheMicroTrianglesOfAGrid) {
  for (const char* change : {"truth.step=0.25", "truth.triangles=1e6", "truth.triangles=5e5"}) {
    const StudySpec study = readWith({change});
    const surface::LimitSurface surface(study.cage);
    const truth::MicroLines lines =
        truth::placeMicroLines(surface, study.relief.texelsPerUv(), study.truth, 1);
    double quads = 0;
    for (const surface::FaceLines& face : lines.faces) {
      const auto pieces = [&](int line) {
        return static_cast<double>(lines.lines[static_cast<std::size_t>(line)].size()) - 1;
      };
      quads += pieces(face.s) * pieces(face.t);
    }
    EXPECT_NEAR(workOf(study).microTriangles / (2 * quads), 1, 0.15) << change;
  }
}

/// Shards divide the outlines, merge the whole studies.
TEST_F(StudyWorkOf, OfAnOutlineIsThatOfTheStudy) {
  std::size_t studies = 0;
  for (const std::filesystem::path& path : test::sceneFiles(GNOMON_SCENES)) {
    StudyOptions outline;
    outline.isOutline = true;
    EXPECT_EQ(standardCost(readStudy(path)), standardCost(readStudy(path, outline))) << path;
    ++studies;
  }
  EXPECT_GT(studies, 20U);
}

TEST_F(StudyWorkOf, IsCountedBySpeeds) {
  StudyWork work;
  work.microTriangles = 1e6;
  work.rays = 100;
  work.frames = 10;
  work.horizons = 1000;
  EXPECT_DOUBLE_EQ(expectedSeconds(work, {1e-6, 0.01, 0.1, 0.001, 5}), 1 + 1 + 1 + 1 + 5);
}

}  // namespace
}  // namespace gnomon::study
