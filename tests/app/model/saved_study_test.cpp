#include "model/saved_study.h"

#include <gmock/gmock.h>

#include <fstream>
#include <map>

#include "study/record/sweep_record.h"
#include "study/spec/sweep/sweep.h"
#include "support/error_messages.h"
#include "support/same_study.h"
#include "support/scene_files.h"
#include "support/temporary_folder.h"

namespace gnomon::app {
namespace {
namespace fs = std::filesystem;
using test::expectSame;
using test::sameCage;
using test::sameCamera;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const fs::path scenes = GNOMON_SCENES;

class SavedStudy : public TemporaryFolder {};

TEST_F(SavedStudy, OfEverySceneReadsAsTheScene) {
  int files = 0;
  for (const fs::path& path : test::sceneFiles(scenes)) {
    SCOPED_TRACE(path.filename().string());
    ++files;
    const study::StudyPlan plan = study::readStudyPlan(path);
    // Of a sweep its last step: one case.
    study::StudyOptions options;
    study::StudySpec expected = plan.steps.back();
    if (plan.sweep) {
      const auto& values = plan.sweep->cases.back().values;
      for (std::size_t k = 0; k < values.size(); ++k) {
        options.overrides.push_back(plan.sweep->keys.at(k).key + "=" + values[k].written);
      }
      expected.title = plan.title;
    }
    const fs::path target = file(path.filename().string());
    saveStudy({path, options, {}, {}, {}}, target);
    const study::StudyPlan saved = study::readStudyPlan(target);
    EXPECT_FALSE(saved.sweep);
    expectSame(expected, saved.steps.front());
    EXPECT_EQ(saved.name, path.stem());
    EXPECT_FALSE(saved.steps.front().ranked);
    EXPECT_TRUE(saved.steps.front().thresholds.empty());
    EXPECT_TRUE(saved.steps.front().claims.empty());
    EXPECT_TRUE(saved.steps.front().ladders.empty());
    // Saved again from there, it is the same to the byte.
    const StudyState again{target, {}, {}, {}, {}};
    EXPECT_EQ(savedStudy(again, target), savedStudy({path, options, {}, {}, {}}, target));
  }
  EXPECT_GT(files, 15);
}

TEST_F(SavedStudy, HoldsEveryChangeOfTheSliders) {
  StudyChanges changes;
  changes.height = 3.3;
  changes.curvature = 1.0 / 90;
  changes.bake = {24, 16, 40.5};
  changes.subdivisions = 3;
  changes.methods["relief-march"].parameters["steps"] = 30;
  changes.methods["onoue-2004"].bake.azimuths = 12;
  changes.methods["onoue-2004"].subdivisions = 2;
  StudyState state;
  state.file = scenes / "sphere-columns.toml";
  state.options.overrides = overridesOf(changes, state.file);
  state.methods = {"onoue-2004", "relief-march"};
  Camera camera;
  camera.eye = {1.0 / 3, -70.123456789012345, 66};
  camera.target = {0.1, 0.2, 55};
  camera.up = {0, 0, 1};
  camera.verticalFov = radians(27.3);
  camera.width = 640;
  camera.height = 360;
  state.camera = camera;
  state.light = LightAngles{123.456, -3.2};
  saveStudy(state, file("a state of mine.toml"));

  const study::StudySpec saved = study::readStudy(file("a state of mine.toml"));
  EXPECT_EQ(saved.name, "a-state-of-mine");
  EXPECT_EQ(saved.relief.field.maximum(), 3.3F);
  EXPECT_EQ(saved.bake.settings.azimuths, 24);
  EXPECT_EQ(saved.bake.settings.radiusTexels, 40.5);
  EXPECT_EQ(saved.bake.bits, horizon::TableBits::sixteen);
  EXPECT_EQ(saved.base.subdivisions, 3);
  ASSERT_EQ(saved.methods.size(), 2U);
  EXPECT_EQ(saved.methods[0].label, "onoue-2004");
  EXPECT_EQ(saved.methods[0].bake.settings.azimuths, 12);
  EXPECT_EQ(saved.methods[0].bake.bits, horizon::TableBits::sixteen);
  EXPECT_EQ(saved.methods[0].base.subdivisions, 2);
  EXPECT_EQ(saved.methods[1].parameters.at("steps"), 30);
  EXPECT_EQ(saved.methods[1].base.subdivisions, 3);
  ASSERT_EQ(saved.views.size(), 1U);
  EXPECT_TRUE(sameCamera(std::get<Camera>(saved.views[0].kind), camera));
  ASSERT_EQ(saved.lights.size(), 1U);
  EXPECT_EQ(saved.lights[0].angles.azimuth, 123.456);
  EXPECT_EQ(saved.lights[0].angles.elevation, -3.2);
  EXPECT_EQ(saved.lights[0].name, makeLight(*state.light).name);

  // What is on the screen is what is saved.
  study::StudyOptions options = state.options;
  options.methods = state.methods;
  study::StudySpec shown = study::readStudy(state.file, options);
  shown.views = saved.views;
  shown.lights = {makeLight(*state.light)};
  expectSame(shown, saved);
  EXPECT_FALSE(sameCage(saved.cage, study::readStudy(state.file).cage));
}

TEST_F(SavedStudy, HoldsTheLightsRadius) {
  StudyState state;
  state.file = scenes / "soft/figure8-sun.toml";
  state.options.overrides = {"truth.directions=64"};
  study::StudySpec shown = study::readStudy(state.file, state.options);
  ASSERT_EQ(shown.lights.front().angles.radius, study::sunRadius);
  for (const double radius : {study::sunRadius, 3.001, study::largestLightRadius, 0.0}) {
    state.light = LightAngles{165, 20, radius};
    saveStudy(state, file("state.toml"));
    const study::StudySpec saved = study::readStudy(file("state.toml"));
    EXPECT_EQ(saved.lights.at(0).angles, *state.light);
    EXPECT_EQ(saved.lights.at(0).isSoft(), radius > 0);
    shown.lights = {makeLight(*state.light)};
    expectSame(shown, saved);
  }
  state.methods = {"max-forsyth + disc"};
  saveStudy(state, file("disc.toml"));
  const study::StudySpec held = study::readStudy(file("disc.toml"));
  ASSERT_EQ(held.methods.size(), 1U);
  EXPECT_TRUE(held.methods.front().disc);
  // A point's text is as it always was.
  EXPECT_THAT(savedStudy(state, file("state.toml")),
              HasSubstr("[[light]]\nazimuth = 165.0\nelevation = 20.0\n\n[["));
}

TEST_F(SavedStudy, FindsItsFilesFromElsewhere) {
  fs::create_directories(file("studies/maps"));
  fs::create_directories(file("saved/deep"));
  fs::copy(scenes / "heights/jacksboro_fault_dem.png", file("studies/maps/dem.png"));
  fs::copy(scenes / "meshes/spot_control_mesh.obj", file("studies/spot.obj"));
  fs::copy(scenes / "methods/horizon-ladder.glsl", file("studies/mine.glsl"));
  std::ofstream(file("studies/study.toml")) << R"(
[study]
name = "study"
title = "t"
source = "s"
[surface]
mesh = "spot.obj"
scheme = "catmull-clark"
[relief]
image = "maps/dem.png"
height = 2
height_space = "texture"
[[view]]
type = "atlas"
samples = 3
[[light]]
elevation = 30
[[method]]
file = "mine.glsl"
[[method]]
name = "onoue-2004"
)";
  const StudyState state{file("studies/study.toml"), {}, {}, {}, {}};
  const fs::path target = file("saved/deep/state.toml");
  saveStudy(state, target);
  expectSame(study::readStudy(state.file), study::readStudy(target));
  EXPECT_THAT(savedStudy(state, target), HasSubstr("../../studies/maps/dem.png"));
  EXPECT_THAT(savedStudy(state, target), Not(HasSubstr(folder().string())));
  // An absolute path stays right as it is.
  StudyState absolute = state;
  absolute.options.overrides = {"relief.image=" + file("studies/maps/dem.png").string()};
  saveStudy(absolute, target);
  expectSame(study::readStudy(state.file), study::readStudy(target));
}

TEST_F(SavedStudy, KeepsTheMethodsThatTheStudyWasOpenedWith) {
  StudyState state;
  state.file = scenes / "figure8.toml";
  state.options.methods = {"resampled-horizon", "onoue-2004"};
  saveStudy(state, file("state.toml"));
  expectSame(study::readStudy(state.file, state.options), study::readStudy(file("state.toml")));
  state.methods = {"resampled-horizon"};
  saveStudy(state, file("state.toml"));
  EXPECT_EQ(study::readStudy(file("state.toml")).methods.size(), 1U);
  state.methods = {"no-such"};
  EXPECT_THAT(messageOf<InputError>([&] { saveStudy(state, file("other.toml")); }),
              HasSubstr("\"no-such\" asked for, one of unshadowed"));
  EXPECT_FALSE(fs::exists(file("other.toml")));
}

TEST_F(SavedStudy, KeepsAPathThatIsNoText) {
  const fs::path odd = folder() / "not-\xff-text";
  fs::create_directories(odd);
  fs::copy(scenes / "meshes/spot_control_mesh.obj", odd / "spot.obj");
  fs::copy(scenes / "spot-cells.toml", odd / "study.toml");
  StudyState state;
  state.file = odd / "study.toml";
  state.options.overrides = {"surface.mesh=spot.obj"};
  saveStudy(state, file("state.toml"));
  const study::StudySpec saved = study::readStudy(file("state.toml"));
  EXPECT_EQ(std::get<study::SurfaceMesh>(saved.surfaceSection).path, "file:not-%FF-text/spot.obj");
  EXPECT_EQ(saved.cage.positions, study::readStudy(scenes / "spot-cells.toml").cage.positions);
}

TEST(StudyChanges, AreOverridesInPlainText) {
  StudyChanges changes;
  EXPECT_THAT(overridesOf(changes, scenes / "figure8.toml"), ElementsAre());
  changes.height = 0.1;
  changes.bake.azimuths = 8;
  changes.methods["max-forsyth"].bake.bits = 32;
  EXPECT_THAT(overridesOf(changes, scenes / "figure8.toml"),
              ElementsAre("relief.height=0.1", "bake.azimuths=8", "method.1.bake.bits=32"));
  changes.methods["nothing"].subdivisions = 3;
  EXPECT_THROW(overridesOf(changes, scenes / "figure8.toml"), InputError);
}

}  // namespace
}  // namespace gnomon::app
