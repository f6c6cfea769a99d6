#include "model/saved_study.h"
#include "study/spec/study_file.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "end_to_end/support/program.h"

// A saved state of the viewer, run: the same figures and masks as the study run with the state's
// settings.

namespace gnomon::test {
namespace {

class SavedRun : public EndToEnd {};

TEST_F(SavedRun, HasTheFiguresAndMasksOfTheStateItHolds) {
  // The quick form has four times the step.
  write("small.toml", replaced(smallStudy(), "step = 0.25", "step = 0.0625"));
  app::StudyChanges changes;
  changes.height = 6.5;
  changes.bake.azimuths = 12;
  app::StudyState state;
  state.file = file("small.toml");
  state.options.overrides = app::overridesOf(changes, state.file);
  Camera camera;
  camera.eye = {20, -60.5, 55};
  camera.up = {0, 0, 1};
  camera.verticalFov = radians(35);
  camera.width = 128;
  camera.height = 96;
  state.camera = camera;
  state.light = app::LightAngles{47.125, 22.5};
  std::filesystem::create_directories(file("saved"));
  app::saveStudy(state, file("saved/state.toml"));

  // The state keeps the radius of the tables that it shows, which the rule chose by the file's
  // light.
  const std::string radius = fmt::format(
      "bake.radius={}", study::readStudy(state.file, state.options).bake.settings.radiusTexels);
  const Outcome saved = gnomon({"run", "saved/state.toml", "--quick"});
  ASSERT_EQ(saved.status, 0) << saved.err;
  const Outcome original = gnomon({"run",
                                   "small.toml",
                                   "--quick",
                                   "--set",
                                   "relief.height=6.5",
                                   "--set",
                                   "bake.azimuths=12",
                                   "--set",
                                   radius,
                                   "--set",
                                   "view.0.eye=[20, -60.5, 55]",
                                   "--set",
                                   "view.0.up=[0, 0, 1]",
                                   "--set",
                                   "view.0.fov=35",
                                   "--set",
                                   "view.0.width=128",
                                   "--set",
                                   "view.0.height=96",
                                   "--set",
                                   "light.0.azimuth=47.125",
                                   "--set",
                                   "light.0.elevation=22.5",
                                   "--set",
                                   "light.0.name=elevation 22.5° azimuth 47.125°"});
  ASSERT_EQ(original.status, 0) << original.err;
  const nlohmann::json results = summary("state").at("results");
  EXPECT_GT(results.size(), 2U);
  EXPECT_EQ(results, summary("small").at("results"));
  const std::vector<std::string> masks = filesBelow("out/state/masks");
  EXPECT_EQ(masks.size(), 5U);  // the truth, and two answers of two methods
  for (const std::string& mask : masks) {
    EXPECT_EQ(read("out/state/masks/" + mask), read("out/small/masks/" + mask));
  }
  // Not those of the study as it was.
  const Outcome unchanged = gnomon({"run", "small.toml", "--quick", "--out", "plain"});
  ASSERT_EQ(unchanged.status, 0) << unchanged.err;
  EXPECT_NE(results, summary("small", "plain").at("results"));
}

}  // namespace
}  // namespace gnomon::test
