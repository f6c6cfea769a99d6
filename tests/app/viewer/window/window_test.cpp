#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

#include "app/viewer/viewer_window.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

/// Where controls are in a window 1280 wide that shows two panes, pixels, as a screenshot has them.
struct Place {
  int x, y;
};
constexpr Place firstPaneList{1050, 91}, sunButton{1241, 222}, radiusSlider{1074, 222},
    bits16{1029, 432};
/// Lists of a study with two cameras and two lights, and how far below a list its second entry is.
constexpr int cameraList = 144, lightList = 196, secondEntry = 46;
struct Slider {
  const char* written;  ///< what the study says of it before it is dragged
  int y;
};
constexpr std::array<Slider, 4> sliders = {{{"elevation = 30", 196},
                                            {"height = 4\n", 275},
                                            {"curvature = 0.02\n", 301},
                                            {"azimuths = 8\n", 380}}};

double elevationOf(const json& status) {
  return status.at("light").at("elevation").get<double>();
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
  viewer.key("Escape");
  EXPECT_TRUE(viewer.waitFor([](const json& now) {
    return now.at("rectangle").is_null() && !now.at("panes")[0].contains("rectangle");
  }));
}

TEST_F(ViewerWindow, ADragTurnsTheSurfaceAndWithLTheLight) {
  DrivenViewer viewer = open({});
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  const json before = viewer.status();

  viewer.drag(300, 300, 380, 340);
  ASSERT_TRUE(viewer.waitUntilComplete());
  const json turned = viewer.status();
  EXPECT_NE(turned.at("camera").at("eye"), before.at("camera").at("eye"));
  EXPECT_EQ(turned.at("light"), before.at("light"));

  viewer.keyDown("l");
  viewer.drag(300, 300, 340, 260);
  viewer.keyUp("l");
  ASSERT_TRUE(viewer.waitUntilComplete());
  const json lit = viewer.status();
  EXPECT_EQ(lit.at("camera").at("eye"), turned.at("camera").at("eye"));
  // A quarter of a degree a pixel, 40 pixels each way; upward raises the light.
  EXPECT_NEAR(lit.at("light").at("azimuth").get<double>(), 30, 1e-9);
  EXPECT_NEAR(elevationOf(lit), 40, 1e-9);

  viewer.moveTo(300, 300);
  viewer.scroll(2);
  ASSERT_TRUE(viewer.waitFor(
      [&](const json& now) { return now.at("camera").at("eye") != lit.at("camera").at("eye"); }));
  viewer.key("r");
  ASSERT_TRUE(viewer.waitFor([&](const json& now) {
    return now.at("camera").at("eye") == before.at("camera").at("eye") &&
           now.at("light") == before.at("light");
  }));
  viewer.key("q");
  EXPECT_EQ(viewer.waitForEnd(), 0) << viewer.output();
}

TEST_F(ViewerWindow, PanesOfEveryKindLookAsTheyDoWithoutADisplay) {
  DrivenViewer viewer = open({"--show", "onoue-2004", "--width", "700", "--height", "500"});
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  // Every pane gets its content by keys, while the cursor is over it.
  viewer.key("Tab");
  viewer.key("4");
  viewer.moveTo(100, 100);
  viewer.key("b");
  viewer.moveTo(500, 100);
  viewer.key("t");
  viewer.moveTo(100, 400);
  viewer.key("t");
  viewer.key("n");
  viewer.key("d");
  viewer.moveTo(500, 400);
  viewer.key("g");
  const std::vector<std::string> contents = {"max-forsyth", "truth", "max-forsyth:truth",
                                             "displaced"};
  ASSERT_TRUE(viewer.waitFor([&](const json& now) {
    if (!now.at("complete").get<bool>() || now.at("panes").size() != contents.size()) return false;
    for (std::size_t i = 0; i < contents.size(); ++i) {
      if (now.at("panes")[i].at("shows") != contents[i]) return false;
    }
    return true;
  })) << viewer.status().dump(2);
  viewer.key("p");
  const fs::path saved = folder() / "out/ball/view/view-1.png";
  ASSERT_TRUE(appears(saved));

  std::vector<std::string> arguments = {"view",         "ball.toml", "--width",    "700",
                                        "--height",     "500",       "--no-panel", "--screenshot",
                                        "headless.png", "--cursor",  "500,400"};
  for (const std::string& content : contents)
    arguments.insert(arguments.end(), {"--show", content});
  const Outcome outcome = gnomon(arguments);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(differingPixels(saved, folder() / "headless.png"), 0U);
  // The control: other contents are other pictures.
  const Outcome other = gnomon({"view", "ball.toml", "--width", "700", "--height", "500",
                                "--no-panel", "--screenshot", "other.png"});
  ASSERT_EQ(other.status, 0) << other.err;
  EXPECT_GT(differingPixels(saved, folder() / "other.png"), 10000U);
}

/// The figures that `gnomon run` finds for a saved state.
void expectSameFigures(const json& pane, const json& result) {
  for (const char* metric : {"error_rate", "false_shadow", "false_light", "iou"}) {
    EXPECT_EQ(pane.at(metric).get<double>(), result.at(metric).get<double>()) << metric;
  }
}

TEST_F(ViewerWindow, ASavedStudyReproducesTheFiguresOnTheScreen) {
  DrivenViewer viewer = open({"--show", "max-forsyth", "--show", "onoue-2004"});
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  const json before = viewer.status();
  viewer.drag(150, 400, 190, 380);
  for (const Slider& slider : sliders) viewer.drag(1035, slider.y, 1060, slider.y);
  viewer.click(bits16.x, bits16.y);
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  const json screen = viewer.status();
  const std::string name = fmt::format("view-{}", viewer.lastSaved());
  viewer.key("m");
  ASSERT_TRUE(appears(folder() / "out/ball/view/view-1_onoue-2004.png"));
  viewer.key("q");
  EXPECT_EQ(viewer.waitForEnd(), 0) << viewer.output();

  // The control: the session has changed what is measured, each slider its own key.
  const std::string saved = read("out/ball/view/" + name + ".toml");
  EXPECT_THAT(saved, HasSubstr("bits = 16"));
  for (const Slider& slider : sliders) {
    EXPECT_THAT(ballStudy(), HasSubstr(slider.written));
    EXPECT_THAT(saved, Not(HasSubstr(slider.written)));
  }
  EXPECT_NE(screen.at("panes")[1].at("error_rate"), before.at("panes")[1].at("error_rate"));
  const Outcome outcome = gnomon({"run", "out/ball/view/" + name + ".toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json run = summary(name);
  const std::string light = run.at("results")[0].at("light");
  const std::string view = run.at("results")[0].at("view");
  for (std::size_t i = 0; i < 2; ++i) {
    const json& pane = screen.at("panes")[i];
    expectSameFigures(pane, resultOf(run, pane.at("shows"), light, view));
  }
  EXPECT_GT(screen.at("panes")[0].at("error_rate").get<double>(), 0);
  bool found = false;
  for (const auto& entry : fs::directory_iterator(folder() / "out" / name / "masks")) {
    if (entry.path().filename().string().find("onoue-2004") == std::string::npos) continue;
    found = true;
    EXPECT_EQ(differingPixels(entry.path(), folder() / "out/ball/view/view-1_onoue-2004.png"), 0U);
  }
  EXPECT_TRUE(found);
}

TEST_F(ViewerWindow, ADiscOfLightIsMeasuredAsTheSavedStudyMeasuresIt) {
  write("ball.toml", ballStudy() + "\n[[method]]\nname = \"max-forsyth\"\ndisc = true\n");
  DrivenViewer viewer = open({"--show", "max-forsyth + disc", "--show", "onoue-2004"});
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  const json hard = viewer.status();
  EXPECT_EQ(hard.at("light").at("radius"), 0);
  viewer.click(sunButton.x, sunButton.y);
  EXPECT_EQ(viewer.status().at("light").at("radius"), 0.266);
  viewer.drag(radiusSlider.x - 30, radiusSlider.y, radiusSlider.x, radiusSlider.y);
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.status().dump(2);
  const json screen = viewer.status();
  const std::string name = fmt::format("view-{}", viewer.lastSaved());
  EXPECT_GT(screen.at("light").at("radius"), 3);
  viewer.key("m");
  ASSERT_TRUE(appears(folder() / "out/ball/view/view-1_onoue-2004.png"));
  viewer.key("r");
  EXPECT_TRUE(viewer.waitFor([&](const json& now) {
    return now.at("complete").get<bool>() && now.at("panes") == hard.at("panes");
  })) << viewer.status().dump(2);
  viewer.key("q");
  EXPECT_EQ(viewer.waitForEnd(), 0) << viewer.output();

  const Outcome outcome = gnomon({"run", "out/ball/view/" + name + ".toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json run = summary(name);
  const json& first = run.at("results")[0];
  for (const json& pane : screen.at("panes")) {
    const json result = resultOf(run, pane.at("shows"), first.at("light"), first.at("view"));
    expectSameFigures(pane, result);
    EXPECT_EQ(pane.at("error_rate"), result.at("mae"));
  }
  EXPECT_NE(screen.at("panes")[0].at("error_rate"), hard.at("panes")[0].at("error_rate"));
  // The masks are the run's maps of shares.
  std::size_t same = 0;
  for (const auto& entry : fs::directory_iterator(folder() / "out" / name / "masks")) {
    const std::string file = entry.path().filename().string();
    for (const char* method : {"max-forsyth-disc", "onoue-2004"}) {
      if (file.find(std::string("_") + method) == std::string::npos) continue;
      ++same;
      EXPECT_EQ(read("out/" + name + "/masks/" + file),
                read(fmt::format("out/ball/view/view-1_{}.png", method)));
    }
  }
  EXPECT_EQ(same, 2U);
}

/// Also with one pane: the other content comes into it, and goes again.
TEST_F(ViewerWindow, TheFirstTwoPanesFlip) {
  DrivenViewer viewer = open({"--show", "max-forsyth", "--show", "truth"});
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  const auto shows = [](const json& now, std::size_t pane, const char* content) {
    return now.at("panes")[pane].at("shows") == content;
  };
  viewer.key("f");
  EXPECT_TRUE(viewer.waitFor(
      [&](const json& now) { return shows(now, 0, "truth") && shows(now, 1, "max-forsyth"); }));
  viewer.key("1");
  viewer.key("f");
  EXPECT_TRUE(viewer.waitFor([&](const json& now) {
    return now.at("panes").size() == 1 && shows(now, 0, "max-forsyth");
  }));
  viewer.key("f");
  EXPECT_TRUE(viewer.waitFor([&](const json& now) { return shows(now, 0, "truth"); }));
}

TEST_F(ViewerWindow, ADropDownTakesKeysUntilEscapeClosesIt) {
  DrivenViewer viewer = open({"--show", "max-forsyth", "--show", "truth"});
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  viewer.click(firstPaneList.x, firstPaneList.y);
  viewer.key("f");
  viewer.key("Escape");
  EXPECT_EQ(viewer.status().at("panes")[0].at("shows"), "max-forsyth");
  viewer.key("f");
  EXPECT_EQ(viewer.status().at("panes")[0].at("shows"), "truth");
}

TEST_F(ViewerWindow, TheStudysLightsAndViewsAreChosenFromLists) {
  write("ball.toml", ballStudy() + R"(
[[view]]
type = "camera"
name = "aside"
width = 200
height = 200
eye = [90, 0, 90]
[[light]]
azimuth = 200
elevation = 50
radius = 2
)");
  DrivenViewer viewer = open({});
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  const json before = viewer.status();
  for (const int y : {lightList, cameraList}) {
    viewer.click(1050, y);
    // A list is where it stays from its second frame on.
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    viewer.click(1050, y + secondEntry);
  }
  EXPECT_TRUE(viewer.waitFor([](const json& now) {
    const json& light = now.at("light");
    const json& eye = now.at("camera").at("eye");
    return light.at("azimuth") == 200 && light.at("elevation") == 50 && light.at("radius") == 2 &&
           eye[0] == 90 && eye[1] == 0 && eye[2] == 90;
  })) << viewer.status().dump(2);
  EXPECT_EQ(viewer.status().at("camera").at("width"), before.at("camera").at("width"));
}

TEST_F(ViewerWindow, OverlaysAndTheListOfKeysComeAndGo) {
  DrivenViewer viewer = open({});
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  viewer.moveTo(480, 360);
  viewer.key("question");
  viewer.key("k");
  viewer.key("v");
  viewer.key("x");
  EXPECT_TRUE(viewer.waitFor([](const json& now) {
    const json& overlays = now.at("overlays");
    return now.at("help").get<bool>() && overlays.at("curvature").get<bool>() &&
           overlays.at("directions").get<bool>() && overlays.at("section").get<bool>() &&
           now.at("complete").get<bool>();
  })) << viewer.status().dump(2);
  viewer.key("k");
  viewer.key("Escape");
  EXPECT_TRUE(viewer.waitFor([](const json& now) {
    return !now.at("help").get<bool>() && !now.at("overlays").at("curvature").get<bool>();
  }));
  viewer.key("q");
  EXPECT_EQ(viewer.waitForEnd(), 0) << viewer.output();
}

TEST_F(ViewerWindow, ABrokenShaderIsToldWithItsLineAndTheOldPictureStays) {
  fs::copy(GNOMON_SHADER_FOLDER, folder() / "shaders", fs::copy_options::recursive);
  DrivenViewer viewer =
      open({"--show", "max-forsyth"}, {"GNOMON_SHADERS=" + (folder() / "shaders").string()});
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  const json figures = viewer.status().at("panes");
  const std::string good = read("shaders/methods/max-forsyth.glsl");
  write("shaders/methods/max-forsyth.glsl", good + "\nfloat broken = ;\n");
  const auto line = std::count(good.begin(), good.end(), '\n') + 2;
  ASSERT_TRUE(viewer.waitFor([](const json& now) { return !now.at("errors").empty(); }));
  EXPECT_THAT(viewer.status().at("errors")[0].get<std::string>(),
              HasSubstr(fmt::format("max-forsyth.glsl:{}:", line)));
  EXPECT_EQ(viewer.status().at("panes"), figures);

  // Mended with another answer, it shows that answer.
  const std::string opposite = "float horizonSlope(Pixel pixel, LocalLight light) {";
  const std::size_t begin = good.find(opposite);
  ASSERT_NE(begin, std::string::npos);
  std::string mended = good;
  mended.insert(begin + opposite.size(), "\n  return 1e30;");
  write("shaders/methods/max-forsyth.glsl", mended);
  EXPECT_TRUE(viewer.waitFor([&](const json& now) {
    return now.at("errors").empty() && now.at("complete").get<bool>() &&
           now.at("panes")[0].at("false_light") == 0.0 && now.at("panes") != figures;
  })) << viewer.status().dump(2);
}

TEST_F(ViewerWindow, ClosesDuringABakeAndDuringATrace) {
  for (const std::vector<std::string>& slow :
       {std::vector<std::string>{"--set", "relief.texels=[512, 512]", "--set", "bake.azimuths=128",
                                 "--set", "bake.radius=500"},
        {"--set", "truth.step=0.012"}}) {
    DrivenViewer viewer = open(slow);
    // Past the checks of the driver, which come before everything else.
    std::this_thread::sleep_for(std::chrono::seconds(1));
    EXPECT_FALSE(viewer.status().at("complete").get<bool>());
    viewer.key("q");
    EXPECT_EQ(viewer.waitForEnd(), 0) << viewer.output();
  }
}

TEST_F(ViewerWindow, WithoutADisplayThereIsOneLineAndStatus77) {
  const Outcome outcome = gnomon({"view", "ball.toml"}, {"DISPLAY=", "WAYLAND_DISPLAY="});
  EXPECT_EQ(outcome.status, 77);
  EXPECT_THAT(outcome.err, HasSubstr("no window"));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST_F(ViewerWindow, ContentsThatAreNoneAreRefused) {
  const Outcome outcome =
      gnomon({"view", "ball.toml", "--show", "nothing", "--screenshot", "picture.png"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--show nothing"));
  EXPECT_FALSE(fs::exists(folder() / "picture.png"));
}

}  // namespace
}  // namespace gnomon::test
