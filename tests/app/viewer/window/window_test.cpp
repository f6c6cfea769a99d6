#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "app/viewer/viewer_window.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

double elevationOf(const json& status) {
  return status.at("light").at("elevation").get<double>();
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
  DrivenViewer viewer =
      open({"--show", "max-forsyth", "--show", "onoue-2004", "--width", "800", "--height", "700"});
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  const json before = viewer.status();
  viewer.drag(150, 400, 190, 380);
  viewer.dragControl("relief.height", 0.3, 0.45);
  viewer.dragControl("surface.curvature", 0.3, 0.42);
  viewer.dragControl("light.elevation", 0.2, 0.31);
  viewer.dragControl("bake.azimuths", 0.1, 0.2);
  viewer.clickControl("bake.bits.16");
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  viewer.clickControl("save.study");
  const fs::path study = folder() / "out/ball/view/view-1.toml";
  ASSERT_TRUE(appears(folder() / "out/ball/view/view-1.json")) << viewer.status().dump(2);
  viewer.key("m");
  ASSERT_TRUE(appears(folder() / "out/ball/view/view-1_onoue-2004.png"));
  viewer.key("q");
  EXPECT_EQ(viewer.waitForEnd(), 0) << viewer.output();

  const json screen = json::parse(read("out/ball/view/view-1.json"));
  // The control: the session has changed what is measured.
  EXPECT_NE(screen.at("panes")[1].at("error_rate"), before.at("panes")[1].at("error_rate"));
  const Outcome outcome = gnomon({"run", study.string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json run = summary("view-1");
  const std::string light = run.at("results")[0].at("light");
  const std::string view = run.at("results")[0].at("view");
  for (std::size_t i = 0; i < 2; ++i) {
    const json& pane = screen.at("panes")[i];
    expectSameFigures(pane, resultOf(run, pane.at("shows"), light, view));
  }
  EXPECT_GT(screen.at("panes")[0].at("error_rate").get<double>(), 0);
  bool found = false;
  for (const auto& entry : fs::directory_iterator(folder() / "out/view-1/masks")) {
    if (entry.path().filename().string().find("onoue-2004") == std::string::npos) continue;
    found = true;
    EXPECT_EQ(differingPixels(entry.path(), folder() / "out/ball/view/view-1_onoue-2004.png"), 0U);
  }
  EXPECT_TRUE(found);
}

TEST_F(ViewerWindow, ADiscOfLightIsMeasuredAsTheSavedStudyMeasuresIt) {
  write("ball.toml", ballStudy() + "\n[[method]]\nname = \"max-forsyth\"\ndisc = true\n");
  DrivenViewer viewer = open({"--show", "max-forsyth + disc", "--show", "onoue-2004", "--width",
                              "560", "--height", "700"});
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  const json hard = viewer.status();
  EXPECT_EQ(hard.at("light").at("radius"), 0);
  viewer.clickControl("light.sun");
  ASSERT_TRUE(viewer.waitFor([](const json& now) { return now.at("light").at("radius") == 0.266; }))
      << viewer.status().dump(2);
  viewer.dragControl("light.radius", 0.05, 0.4);
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.status().dump(2);
  EXPECT_GT(viewer.status().at("light").at("radius"), 3);
  viewer.clickControl("save.study");
  ASSERT_TRUE(appears(folder() / "out/ball/view/view-1.json")) << viewer.status().dump(2);
  viewer.key("m");
  ASSERT_TRUE(appears(folder() / "out/ball/view/view-1_onoue-2004.png"));
  viewer.key("r");
  EXPECT_TRUE(viewer.waitFor([&](const json& now) {
    return now.at("complete").get<bool>() && now.at("panes") == hard.at("panes");
  })) << viewer.status().dump(2);
  viewer.key("q");
  EXPECT_EQ(viewer.waitForEnd(), 0) << viewer.output();

  const json screen = json::parse(read("out/ball/view/view-1.json"));
  const Outcome outcome = gnomon({"run", "out/ball/view/view-1.toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json run = summary("view-1");
  const json& first = run.at("results")[0];
  for (const json& pane : screen.at("panes")) {
    const json result = resultOf(run, pane.at("shows"), first.at("light"), first.at("view"));
    expectSameFigures(pane, result);
    EXPECT_EQ(pane.at("error_rate"), result.at("mae"));
  }
  EXPECT_NE(screen.at("panes")[0].at("error_rate"), hard.at("panes")[0].at("error_rate"));
  // The masks are the run's maps of shares.
  std::size_t same = 0;
  for (const auto& entry : fs::directory_iterator(folder() / "out/view-1/masks")) {
    const std::string name = entry.path().filename().string();
    for (const char* method : {"max-forsyth-disc", "onoue-2004"}) {
      if (name.find(std::string("_") + method) == std::string::npos) continue;
      ++same;
      EXPECT_EQ(read("out/view-1/masks/" + name),
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

TEST_F(ViewerWindow, ADropDownClosesOnEscape) {
  DrivenViewer viewer = open({"--show", "max-forsyth"});
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  const auto isOpen = [](const json& now) {
    return now.at("controls").contains("pane.0.shown.truth");
  };
  viewer.clickControl("pane.0.shown");
  ASSERT_TRUE(viewer.waitFor(isOpen)) << viewer.status().dump(2);
  viewer.key("Escape");
  EXPECT_TRUE(viewer.waitFor([&](const json& now) { return !isOpen(now); }, 10));
  EXPECT_EQ(viewer.status().at("panes")[0].at("shows"), "max-forsyth");
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
  for (const auto& [list, entry] : {std::pair("light", "light.1"), {"view", "view.1"}}) {
    const auto isOpen = [name = entry](const json& now) {
      return now.at("controls").contains(name);
    };
    viewer.clickControl(list);
    ASSERT_TRUE(viewer.waitFor(isOpen)) << entry;
    // A list is where it stays from its second frame on.
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    viewer.clickControl(entry);
    ASSERT_TRUE(viewer.waitFor([&](const json& now) { return !isOpen(now); })) << entry;
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
  viewer.clickControl("overlay.curvature", 0.1);
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
  {
    DrivenViewer viewer = open({"--set", "relief.texels=[512, 512]", "--set", "bake.azimuths=128",
                                "--set", "bake.radius=500"});
    ASSERT_TRUE(viewer.waitFor([](const json& now) {
      return now.at("baking").at("stage") == "Baking horizons";
    })) << viewer.output();
    viewer.key("q");
    EXPECT_EQ(viewer.waitForEnd(), 0) << viewer.output();
  }
  DrivenViewer viewer = open({"--set", "truth.step=0.02"});
  ASSERT_TRUE(viewer.waitFor([](const json& now) {
    return now.at("tracing").at("busy").get<bool>();
  })) << viewer.output();
  viewer.key("q");
  EXPECT_EQ(viewer.waitForEnd(), 0) << viewer.output();
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
