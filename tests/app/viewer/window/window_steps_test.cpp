#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "app/viewer/viewer_window.h"

// What a person does one after another: looks at a rectangle, takes changes back, opens a study.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

/// Waits until a change is a step of its own.
void rest() {
  std::this_thread::sleep_for(std::chrono::milliseconds(900));
}

void control(const DrivenViewer& viewer, const char* key) {
  viewer.keyDown("ctrl");
  viewer.key(key);
  viewer.keyUp("ctrl");
}

/// What the rectangle tells, counted in the masks that the window saved.
struct Counted {
  int samples = 0, falseShadow = 0, falseLight = 0;
};

Counted countedIn(const json& rectangle, const GreyImage& method, const GreyImage& truth) {
  const auto height = static_cast<int>(method.pixels.size()) / method.width;
  Counted counted;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < method.width; ++column) {
      const double x = (column + 0.5) / method.width;
      const double y = (row + 0.5) / height;
      const bool isInside =
          x >= rectangle[0] && x < rectangle[2] && y >= rectangle[1] && y < rectangle[3];
      const auto at = static_cast<std::size_t>(row * method.width + column);
      if (!isInside || truth.pixels[at] == 128) continue;
      ++counted.samples;
      counted.falseShadow += method.pixels[at] < truth.pixels[at] ? 1 : 0;
      counted.falseLight += method.pixels[at] > truth.pixels[at] ? 1 : 0;
    }
  }
  return counted;
}

TEST_F(ViewerWindow, BeginsBesideTheTruthAndTellsTheErrorOfARectangle) {
  write("ball.toml", replaced(ballStudy(), "[[method]]\nname = \"max-forsyth\"",
                              "[[method]]\nname = \"unshadowed\"\n\n"
                              "[[method]]\nname = \"max-forsyth\""));
  DrivenViewer viewer = open({});
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  const json before = viewer.status();
  ASSERT_EQ(before.at("panes").size(), 2U);
  EXPECT_EQ(before.at("panes")[0].at("shows"), "max-forsyth");
  EXPECT_EQ(before.at("panes")[1].at("shows"), "truth");
  EXPECT_TRUE(before.at("rectangle").is_null());

  viewer.keyDown("shift");
  viewer.drag(420, 220, 610, 470);
  viewer.keyUp("shift");
  ASSERT_TRUE(viewer.waitFor([](const json& now) { return now.at("rectangle").is_array(); }));
  viewer.key("m");
  ASSERT_TRUE(appears(folder() / "out/ball/view/view-1_truth.png"));
  const json after = viewer.status();
  EXPECT_EQ(after.at("camera"), before.at("camera")) << "the drag turned the surface";
  EXPECT_EQ(after.at("panes")[0].at("error_rate"), before.at("panes")[0].at("error_rate"));
  const json& told = after.at("panes")[0].at("rectangle");
  const Counted counted =
      countedIn(after.at("rectangle"), readGrey(folder() / "out/ball/view/view-1_max-forsyth.png"),
                readGrey(folder() / "out/ball/view/view-1_truth.png"));
  EXPECT_GT(counted.samples, 30000);
  EXPECT_GT(counted.falseShadow + counted.falseLight, 0);
  EXPECT_EQ(told.at("samples"), counted.samples);
  EXPECT_EQ(told.at("wrong"), counted.falseShadow + counted.falseLight);
  const double samples = counted.samples;
  EXPECT_EQ(told.at("false_shadow").get<double>(), counted.falseShadow / samples);
  EXPECT_EQ(told.at("false_light").get<double>(), counted.falseLight / samples);
  EXPECT_NE(told.at("error_rate"), after.at("panes")[0].at("error_rate"));
  // Without a display it is the same.
  const Outcome outcome = gnomon({"view", "ball.toml", "--status", "headless.json", "--screenshot",
                                  "view.png", "--rectangle", "25,25,75,75"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GT(json::parse(read("headless.json")).at("panes")[0].at("rectangle").at("samples"), 10000);

  viewer.key("Escape");
  EXPECT_TRUE(viewer.waitFor([](const json& now) {
    return now.at("rectangle").is_null() && !now.at("panes")[0].contains("rectangle");
  }));
}

TEST_F(ViewerWindow, StepsAreTakenBackAndStudiesOpened) {
  write("bad.toml", "[study]\nname = 3\n");
  write("other.toml", replaced(replaced(ballStudy(), "name = \"ball\"", "name = \"other\""),
                               "elevation = 30", "elevation = 41"));
  // It is read well, and fails when its mesh is made.
  write("late.toml", replaced(replaced(ballStudy(), "quads = [20, 20]", "quads = [80, 80]"),
                              "[truth]", "[base]\nsubdivisions = 1024\n\n[truth]"));
  fs::create_directory(folder() / "far");
  fs::copy(folder() / "other.toml", folder() / "far/third.toml");
  DrivenViewer viewer = open({"--show", "max-forsyth"});
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  const json first = viewer.status();
  EXPECT_FALSE(first.at("can_undo").get<bool>());

  // The light, then the method, then a slider: each is a step.
  viewer.key("Right");
  rest();
  viewer.moveTo(300, 300);
  viewer.key("n");
  rest();
  viewer.dragControl("bake.azimuths", 0.1, 0.2);
  rest();
  const json changed = viewer.status();
  EXPECT_EQ(changed.at("light").at("azimuth"), 21);
  EXPECT_EQ(changed.at("panes")[0].at("shows"), "onoue-2004");
  control(viewer, "z");
  control(viewer, "z");
  EXPECT_TRUE(viewer.waitFor([](const json& now) {
    return now.at("panes")[0].at("shows") == "max-forsyth" && now.at("light").at("azimuth") == 21;
  })) << viewer.status().dump(2);
  viewer.clickControl("undo");
  EXPECT_TRUE(viewer.waitFor([&](const json& now) {
    return now.at("complete").get<bool>() && now.at("light") == first.at("light") &&
           now.at("panes") == first.at("panes") && !now.at("can_undo").get<bool>();
  })) << viewer.status().dump(2);
  for (int i = 0; i < 3; ++i) control(viewer, "y");
  EXPECT_TRUE(viewer.waitFor([&](const json& now) {
    return now.at("complete").get<bool>() && now.at("light") == changed.at("light") &&
           now.at("panes")[0].at("shows") == "onoue-2004" && !now.at("can_redo").get<bool>();
  })) << viewer.status().dump(2);

  // A study that is none is told in one line, and the open one stays.
  const auto choose = [&](const char* entry) {
    viewer.clickControl("study");
    ASSERT_TRUE(
        viewer.waitFor([&](const json& now) { return now.at("controls").contains(entry); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    viewer.clickControl(entry);
  };
  choose("study.bad.toml");
  EXPECT_TRUE(viewer.waitFor([](const json& now) {
    return now.at("notice").at("is_error").get<bool>() &&
           now.at("opening").get<std::string>().empty();
  })) << viewer.status().dump(2);
  const json refused = viewer.status();
  const std::string said = refused.at("notice").at("text");
  EXPECT_THAT(said, HasSubstr("bad.toml:2"));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 0);
  EXPECT_EQ(refused.at("study"), "ball.toml");
  EXPECT_EQ(refused.at("light"), changed.at("light"));

  choose("study.late.toml");
  EXPECT_TRUE(viewer.waitFor([](const json& now) {
    return now.at("notice").at("text").get<std::string>().starts_with("base.subdivisions: 1024") &&
           now.at("opening").get<std::string>().empty() && now.at("study") == "ball.toml";
  })) << viewer.status().dump(2);

  choose("study.other.toml");
  EXPECT_TRUE(viewer.waitFor([](const json& now) {
    return now.at("study") == "other.toml" && now.at("complete").get<bool>() &&
           now.at("light").at("elevation") == 41 && now.at("panes")[0].at("shows") == "onoue-2004";
  })) << viewer.status().dump(2);
  EXPECT_FALSE(viewer.status().at("can_undo").get<bool>()) << "steps of another study";

  viewer.key("o");
  viewer.type("far/third.toml");
  viewer.key("Return");
  EXPECT_TRUE(viewer.waitFor([](const json& now) {
    return now.at("study") == "far/third.toml" && now.at("complete").get<bool>();
  })) << viewer.status().dump(2);
  viewer.key("q");
  EXPECT_EQ(viewer.waitForEnd(), 0) << viewer.output();
}

}  // namespace
}  // namespace gnomon::test
