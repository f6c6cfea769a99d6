#include "study/spec/resolved_study.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>

#include "common/files/atomic_file.h"
#include "common/files/input_file.h"
#include "study/spec/sweep/sweep.h"
#include "study/spec/toml_reader.h"
#include "support/error_messages.h"
#include "support/same_study.h"
#include "support/scene_files.h"
#include "support/temporary_folder.h"

namespace gnomon::study {
namespace {

namespace fs = std::filesystem;
using test::expectSame;
using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;

const fs::path scenes = GNOMON_SCENES;

class ResolvedStudy : public TemporaryFolder {
 protected:
  /// A study's copy, as a run leaves it.
  [[nodiscard]] fs::path copied(const StudySpec& study) const {
    fs::path copy = file("out") / study.name / studyCopyName(study.name);
    writeTextAtomically(copy, studyCopyText(resolvedStudy(study, copy.parent_path()), copy));
    return copy;
  }
};

TEST_F(ResolvedStudy, OfEverySceneReadsBackToTheBit) {
  int files = 0;
  for (const fs::path& path : test::sceneFiles(scenes)) {
    ++files;
    for (const bool quick : {false, true}) {
      SCOPED_TRACE(path.filename().string() + (quick ? ", quick" : ""));
      StudyOptions options;
      options.quick = quick;
      const StudySpec study = readStudyPlan(path, options).steps.back();
      const fs::path copy = copied(study);
      const StudyPlan again = readStudyPlan(copy);
      EXPECT_FALSE(again.sweep);
      expectSame(study, again.steps.front());
      // From there it is written the same.
      EXPECT_EQ(studyCopyText(resolvedStudy(again.steps.front(), copy.parent_path()), copy),
                readFile(copy));
    }
  }
  EXPECT_GT(files, 15);
}

TEST_F(ResolvedStudy, HasWhatTheOptionsChange) {
  StudyOptions options;
  options.overrides = {"relief.height=3.25", "light.0.elevation=[10, 47.3]"};
  options.methods = {"onoue-2004", "relief-march"};
  options.replacements = {"onoue-2004=" + (scenes / "methods/horizon-ladder.glsl").string()};
  const StudySpec study = readStudy(scenes / "figure8.toml", options);
  const StudySpec again = readStudy(copied(study));
  expectSame(study, again);
  ASSERT_EQ(again.methods.size(), 2U);
  EXPECT_EQ(again.methods[0].label, "onoue-2004");
  EXPECT_EQ(again.methods[0].file.stem(), "horizon-ladder");
  EXPECT_EQ(again.lights.size(), 2U);
  EXPECT_EQ(again.lights[1].angles.elevation, 47.3);
  EXPECT_EQ(again.relief.field.maximum(), 3.25F);
}

TEST_F(ResolvedStudy, SaysEveryDefault) {
  const StudySpec study = readStudy(scenes / "figure8.toml");
  const toml::table table = resolvedStudy(study, file("out"));
  EXPECT_TRUE(table["relief"]["height_space"].is_string());
  EXPECT_TRUE(table["relief"]["wrap"].is_string());
  EXPECT_EQ(table["relief"]["invert"].value<bool>(), false);
  EXPECT_EQ(table["bake"]["limit"].value<double>(), 90);
  EXPECT_EQ(table["study"]["frames"].value<int>(), 25);
  EXPECT_EQ(table["light"][0]["azimuth"].value<double>(), 165);
  EXPECT_EQ(table["light"][0]["elevation"].value<double>(), 24);
  for (const toml::node& node : *table["method"].as_array()) {
    const toml::table& method = *node.as_table();
    if (method["label"].value<std::string>() != "relief-march") continue;
    EXPECT_TRUE(method["parameters"]["steps"].is_number());
    EXPECT_TRUE(method["bake"]["azimuths"].is_number());
  }
}

TEST_F(ResolvedStudy, OfASweepsStepIsOneCase) {
  const StudyPlan plan = readStudyPlan(scenes / "height-sweep.toml");
  const StudySpec& step = plan.steps.at(1);
  EXPECT_EQ(studyCopyName(step.name), "height-sweep-" + step.name.substr(13) + ".toml");
  const StudyPlan again = readStudyPlan(copied(step));
  EXPECT_FALSE(again.sweep);
  EXPECT_EQ(again.steps.front().relief.field.texels(), step.relief.field.texels());
}

TEST_F(ResolvedStudy, OfASweepKeepsItAndItsOptions) {
  StudyOptions options;
  options.quick = true;
  options.methods = {"onoue-2004"};
  options.overrides = {"bake.azimuths=12"};
  const StudyPlan plan = readStudyPlan(scenes / "height-sweep.toml", options);
  const fs::path copy = file("out/height-sweep/height-sweep.toml");
  writeTextAtomically(
      copy, studyCopyText(sweepStudy(plan.steps.front(), options, copy.parent_path()), copy));
  const StudyPlan again = readStudyPlan(copy);
  ASSERT_TRUE(again.sweep);
  ASSERT_EQ(again.steps.size(), plan.steps.size());
  for (std::size_t k = 0; k < plan.steps.size(); ++k) {
    expectSame(plan.steps[k], again.steps[k]);
    EXPECT_EQ(plan.steps[k].name, again.steps[k].name);
  }
  EXPECT_TRUE(again.steps.front().quick);
}

TEST_F(ResolvedStudy, DoesNotReplaceAFileOfSomebodyElse) {
  const fs::path copy = copied(readStudy(scenes / "figure8.toml"));
  EXPECT_NO_THROW(requireCopyOrNothing(copy));
  EXPECT_NO_THROW(requireCopyOrNothing(file("nothing.toml")));
  EXPECT_THAT(messageOf<InputError>([] { requireCopyOrNothing(scenes / "figure8.toml"); }),
              HasSubstr("figure8.toml: a file found that no run has written"));
}

TEST_F(ResolvedStudy, InputsAreAllFilesWithTheirHashes) {
  const StudySpec study = readStudy(scenes / "spot-terrain.toml");
  const fs::path folder = scenes / "out";
  const std::vector<InputRecord> inputs = studyInputs(study, folder);
  for (const char* name : {"../spot-terrain.toml", "../meshes/spot_control_mesh.obj",
                           "../heights/jacksboro_fault_dem.png", "shaders/common/mask.frag",
                           "shaders/methods/onoue-2004.glsl"}) {
    EXPECT_THAT(inputs, Contains(Field(&InputRecord::file, name)));
  }
  for (const InputRecord& input : inputs) {
    const fs::path file = input.kind == InputRecord::Kind::shader
                              ? scenes.parent_path() / input.file
                              : folder / input.file;
    EXPECT_EQ(input.sha256, sha256(readFile(file.lexically_normal()))) << input.file;
  }
}

}  // namespace
}  // namespace gnomon::study
