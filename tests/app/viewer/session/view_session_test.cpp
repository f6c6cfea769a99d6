#include "viewer/session/view_session.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "app/viewer/viewed_study.h"
#include "common/files/atomic_file.h"
#include "model/cross_section.h"
#include "model/light_angles.h"
#include "render/gl_context.h"
#include "render/shader_files.h"
#include "support/replaced.h"
#include "support/scoped_variable.h"
#include "truth/surface_paths.h"
#include "viewer/session/pixel_probe.h"
#include "viewer/window/saved_view.h"

namespace gnomon::app {
namespace {

/// A session without a window: the test is the loop that draws its frames.
class ViewSessionTest : public ViewedStudy {
 protected:
  [[nodiscard]] cli::ViewRequest request(std::vector<std::string> show) const {
    cli::ViewRequest asked;
    asked.study = study();
    asked.show = std::move(show);
    asked.tryMethod = tryNone;
    asked.options.overrides = {"truth.step=0.06"};  // a truth that takes some time
    return asked;
  }
  /// Until a condition holds, or half a minute is over.
  template <typename Condition>
  static bool comesTrue(const Condition& condition) {
    for (int i = 0; i < 15000; ++i) {
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }
  static bool completes(ViewSession& session) {
    return comesTrue([&] {
      session.update();
      return session.isComplete();
    });
  }
  /// Frames until the truth is asked for, and none while it is traced: all of it waits to be taken.
  static bool tracesWithoutAFrame(ViewSession& session) {
    return comesTrue([&] {
             session.update();
             return session.tracing().busy;
           }) &&
           comesTrue([&] { return !session.tracing().busy; });
  }
  static std::optional<Mask> maskOf(ViewSession& session, std::size_t pane) {
    const Answers* answers = session.answersOf(session.state().panes.at(pane));
    return answers != nullptr ? std::optional(std::get<Mask>(*answers)) : std::nullopt;
  }
  static double errorRate(const ViewSession& session) {
    const auto& figures = session.pane(0).figures;
    return figures && figures->errorRate.value ? *figures->errorRate.value : -1;
  }

  render::GlContext gl_;
};

TEST_F(ViewSessionTest, ATruthThatEndsAsTheCameraMovesMeasuresNothing) {
  ViewSession session(request({"max-forsyth"}), [] {});
  ASSERT_TRUE(tracesWithoutAFrame(session));
  session.state().camera = orbited(session.state().camera, 0.4, 0.2);
  session.update();
  EXPECT_FALSE(session.pane(0).figures) << "measured against the truth of the camera before";
  EXPECT_EQ(session.tracedShare(0), 0);
  // What is measured then is what a session finds that never saw another camera.
  const Camera camera = session.state().camera;
  ASSERT_TRUE(completes(session));
  ViewSession other(request({"max-forsyth"}), [] {});
  other.state().camera = camera;
  ASSERT_TRUE(completes(other));
  EXPECT_EQ(errorRate(session), errorRate(other));
  EXPECT_GT(errorRate(other), 0);
}

TEST_F(ViewSessionTest, ATruthThatEndsAsTheLightMovesMeasuresNothing) {
  ViewSession session(request({"max-forsyth"}), [] {});
  ASSERT_TRUE(tracesWithoutAFrame(session));
  session.state().light.elevation = 12;
  session.update();
  EXPECT_FALSE(session.pane(0).figures) << "measured against the truth of the light before";
}

TEST_F(ViewSessionTest, AMethodLabelledDisplacedIsThatMethod) {
  std::ofstream(study(), std::ios::app)
      << "[[method]]\nname = \"unshadowed\"\nlabel = \"displaced\"\n";
  ViewSession session(request({"displaced"}), [] {});
  ASSERT_TRUE(completes(session));
  const auto mask = maskOf(session, 0);
  ASSERT_TRUE(mask) << "the ray-traced surface has none";
  const double error = errorRate(session);
  session.state().panes[0] = {methodSource("unshadowed")};
  ASSERT_TRUE(completes(session));
  EXPECT_EQ(maskOf(session, 0)->samples, mask->samples);
  EXPECT_EQ(errorRate(session), error);
  EXPECT_GT(error, 0);
  // The surface is still there to be looked at.
  session.state().panes[0] = {displacedSurface};
  ASSERT_TRUE(completes(session));
  EXPECT_FALSE(maskOf(session, 0));
  EXPECT_FALSE(session.pane(0).figures);
}

TEST_F(ViewSessionTest, HorizonsThatWereShotForOtherTablesAreNotTaken) {
  std::ofstream(study(), std::ios::app) << "[[method]]\nname = \"sloan-cohen-surface\"\n";
  const std::string method = "sloan-cohen-surface";
  ViewSession session(request({method}), [] {});
  // The first horizons are on their way when others are asked for.
  ASSERT_TRUE(comesTrue([&] {
    session.update();
    return session.tracing().busy;
  }));
  session.state().changes.methods[method].bake.azimuths = 16;
  ASSERT_TRUE(completes(session));
  const double changed = errorRate(session);
  ViewSession other(request({method}), [] {});
  other.state().changes.methods[method].bake.azimuths = 16;
  ASSERT_TRUE(completes(other));
  EXPECT_EQ(changed, errorRate(other));
  ViewSession plain(request({method}), [] {});
  ASSERT_TRUE(completes(plain));
  EXPECT_NE(changed, errorRate(plain)) << "the tables make no difference: the test shows nothing";
}

TEST_F(ViewSessionTest, AMethodIsTriedBeforeTheDriverGetsItAndAgainWhenItsFileChanges) {
  const std::filesystem::path mine = file("mine.glsl");
  const std::string text = readFile(render::shaderFolder() / "methods/max-forsyth.glsl");
  std::ofstream(mine) << text;
  std::ofstream(study(), std::ios::app) << "[[method]]\nfile = \"mine.glsl\"\n";
  cli::ViewRequest asked = request({"mine"});
  std::atomic<int> trials = 0;
  asked.tryMethod = [&](const study::MethodSpec& method, relief::Wrap /*wrap*/) {
    ++trials;
    if (readFile(method.file).ends_with("// fatal\n")) throw InputError("mine.glsl: it crashes");
  };
  ViewSession session(asked, [] {});
  ASSERT_TRUE(completes(session));
  EXPECT_EQ(trials, 1);
  session.state().changes.methods["mine"].bake.azimuths = 16;
  ASSERT_TRUE(completes(session));
  EXPECT_EQ(trials, 1) << "its file is the same";
  const auto mask = maskOf(session, 0);
  ASSERT_TRUE(mask);
  std::ofstream(mine) << text << "float broken = ;\n// fatal\n";
  ASSERT_TRUE(comesTrue([&] {
    session.update();
    return !session.errors().empty();
  }));
  EXPECT_EQ(trials, 2);
  EXPECT_EQ(session.errors(), std::vector<std::string>{"mine.glsl: it crashes"})
      << "the driver has compiled it";
  EXPECT_EQ(maskOf(session, 0)->samples, mask->samples);
}

/// Its answers are those of the panes, its region that of a trace of the whole view.
TEST_F(ViewSessionTest, TellsWhatIsKnownOfAPixel) {
  ViewSession session(request({"max-forsyth"}), [] {});
  session.state().overlays.pixel = true;
  ASSERT_TRUE(completes(session));
  const surface::SampleGrid& samples = *session.samples();
  const SceneData& scene = *session.scene();
  const TracedMesh& traced = *session.traced();
  const truth::TraceSettings light{{scene.study->lights.front().direction}};
  const double radiusTexels = scene.study->bake.settings.radiusTexels;
  truth::Truth truth = truth::traceShadows(*scene.surface, scene.study->relief, traced.mesh,
                                           traced.scene, samples, light);
  truth::splitCastShadows(*scene.surface, scene.study->relief, traced.mesh, traced.scene,
                          truth::SurfacePaths(*scene.surface), {radiusTexels}, samples, {&light, 1},
                          {&truth, 1});
  const Mask mask = *maskOf(session, 0);
  const auto word = [](Shade shade) { return shade == Shade::lit ? "lit" : "in shadow"; };
  PixelProbe probe;
  std::set<truth::Region> regions;
  for (std::size_t i = 0; i < mask.size(); i += 7) {
    const auto width = static_cast<std::size_t>(samples.width);
    const ViewPixel pixel{static_cast<int>(i % width), static_cast<int>(i / width)};
    const std::vector<std::string> lines = probe.linesOf(session, pixel);
    if (mask.samples[i] == Shade::none) {
      EXPECT_TRUE(lines.empty());
      continue;
    }
    ASSERT_EQ(lines.size(), 5U);
    EXPECT_EQ(lines[0], fmt::format("max-forsyth: {}", word(mask.samples[i])));
    EXPECT_EQ(lines[1], fmt::format("truth: {}", word(truth.mask.samples[i])));
    EXPECT_THAT(lines[2], ::testing::StartsWith(
                              fmt::format("region {}: ", truth::regionName(truth.regions[i]))));
    // The horizon of a flat relief over the base surface, and its height, by the reference.
    const auto section = crossSection(*scene.surface, scene.study->relief, samples.samples[i],
                                      light.light.direction, {radiusTexels, 0});
    ASSERT_TRUE(section);
    EXPECT_EQ(lines[3], fmt::format("horizon {:.1f}° over the surface, light {:.1f}°",
                                    std::atan(section->here.flat.slope) * 180 / pi,
                                    std::atan(section->lightSlope) * 180 / pi));
    EXPECT_EQ(lines[4], fmt::format("height {:.3g}", section->here.lookups.height));
    regions.insert(truth.regions[i]);
  }
  EXPECT_GE(regions.size(), 3U);
  // Under a disc the answers are shares.
  session.state().light.radius = 5;
  ASSERT_TRUE(completes(session));
  const std::vector<std::string> soft =
      probe.linesOf(session, {samples.width / 2, samples.height / 2});
  ASSERT_GE(soft.size(), 2U);
  EXPECT_THAT(soft[0], ::testing::MatchesRegex("max-forsyth: V = [01]\\.000"));
  EXPECT_THAT(soft[1], ::testing::MatchesRegex("truth: V = [01]\\.[0-9]+"));
}

/// Of masks and of shares, and when it alone moves.
TEST_F(ViewSessionTest, ARectangleIsMeasuredByItsOwnSamples) {
  ViewSession session(request({"max-forsyth", "max-forsyth:truth"}), [] {});
  ASSERT_TRUE(completes(session));
  EXPECT_FALSE(session.pane(0).partFigures);
  for (const double radius : {0.0, 4.0}) {
    session.state().light.radius = radius;
    ASSERT_TRUE(completes(session));
    for (const ViewPart& part : {ViewPart{0.3, 0.2, 0.6, 0.7}, {0.5, 0.5, 0.9, 0.6}}) {
      session.state().part = part;
      EXPECT_TRUE(session.update());
      const Answers method = *session.answersOf({methodSource("max-forsyth")});
      const Answers truth = *session.answersOf({tracedTruth});
      const auto shadeOf = [](const Answers& answers, std::size_t i) {
        const auto* map = std::get_if<Visibility>(&answers);
        if (map != nullptr) return 1.0 - static_cast<double>(map->shares[i]);
        return std::get<Mask>(answers).samples[i] == Shade::lit ? 0.0 : 1.0;
      };
      const Camera& camera = session.state().camera;
      const std::vector<std::uint8_t> inside = pixelsIn(part, camera.width, camera.height);
      double wrong = 0;
      std::size_t count = 0;
      for (std::size_t i = 0; i < inside.size(); ++i) {
        const bool isThere =
            std::visit([&](const auto& map) { return isAnswer(valuesOf(map)[i]); }, truth);
        if (inside[i] == 0 || !isThere) continue;
        ++count;
        wrong += std::abs(shadeOf(method, i) - shadeOf(truth, i));
      }
      for (const std::size_t pane : {0, 1}) {
        const auto& figures = session.pane(pane).partFigures;
        ASSERT_TRUE(figures);
        EXPECT_EQ(figures->samples, count);
        EXPECT_NEAR(figures->wrong, wrong, 1e-6);
        EXPECT_NEAR(*figures->errorRate.value, wrong / static_cast<double>(count), 1e-9);
      }
      EXPECT_GT(count, 100U);
      EXPECT_GT(wrong, 0);
    }
  }
  session.state().part.reset();
  session.update();
  EXPECT_FALSE(session.pane(0).partFigures);
}

TEST_F(ViewSessionTest, AMethodsOwnBakesFollowItsFilesAndTheRelief) {
  // Shadowed where the map is higher than a part of its highest texel, by a bake of it.
  const std::string head =
      "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\ntables = [\"height\"]\n[bakes.high]\n*/\n"
      "#include \"part.glsl\"\n"
      "float bakeHigh(vec2 texel) { return heightAt(texel) > limit() ? 1.0 : 0.0; }\n"
      "bool isShadowed(Pixel pixel, LocalLight light) { return highAt(pixel.texel) > 0.5; }\n";
  std::ofstream(file("mine.glsl")) << head;
  std::ofstream(file("part.glsl")) << "float limit() { return 2.0; }\n";
  std::ofstream(study(), std::ios::app) << "[[method]]\nfile = \"mine.glsl\"\n";
  ViewSession session(request({"mine"}), [] {});
  ASSERT_TRUE(completes(session));
  const auto shadowed = [&] {
    const auto mask = maskOf(session, 0);
    return mask ? std::count(mask->samples.begin(), mask->samples.end(), Shade::shadowed) : 0;
  };
  const auto first = shadowed();
  EXPECT_GT(first, 0);
  session.state().changes.height = 1;  // nothing is higher than 2
  ASSERT_TRUE(completes(session));
  const auto flat = shadowed();
  EXPECT_LT(flat, first);
  session.state().changes.height.reset();
  ASSERT_TRUE(completes(session));
  EXPECT_EQ(shadowed(), first);
  std::ofstream(file("part.glsl")) << "float limit() { return -1.0; }\n";
  EXPECT_TRUE(comesTrue([&] {
    session.update();
    return shadowed() > first;
  }));
  std::ofstream(file("part.glsl")) << "float limit() { return 0.0 / 0.0; }\n"
                                      "float bakeHigh2() { return missing; }\n";
  EXPECT_TRUE(comesTrue([&] {
    session.update();
    return !session.errors().empty();
  }));
  EXPECT_THAT(session.errors().front(), testing::HasSubstr("part.glsl:2: "));
}

TEST_F(ViewSessionTest, WhatTheDriverDrawsWrongIsNotShown) {
  namespace fs = std::filesystem;
  std::ofstream(study(), std::ios::app) << "[[method]]\nname = \"shadow-volume\"\n";
  fs::copy(render::shaderFolder(), file("shaders"), fs::copy_options::recursive);
  const fs::path walls = file("shaders/common/shadow_volume.geom");
  const std::string right = readFile(walls);
  const std::string wrong =
      test::replaced(right, "  emitWall(lit, b, c, a.world, world[3]);\n", "");
  std::ofstream(walls) << wrong;
  const test::ScopedVariable shaders("GNOMON_SHADERS", file("shaders").c_str());
  ViewSession session(request({"max-forsyth", "shadow-volume"}), [] {});
  ASSERT_TRUE(completes(session));
  EXPECT_TRUE(maskOf(session, 0));
  EXPECT_FALSE(maskOf(session, 1));
  EXPECT_FALSE(session.pane(1).figures);
  EXPECT_EQ(session.pane(1).note, "not shown: see the message");
  ASSERT_EQ(session.errors().size(), 1U);
  EXPECT_THAT(session.errors().front(),
              ::testing::StartsWith("shadow-volume is not shown: this OpenGL gets shadow volumes"));
  // Once it is right, it is shown.
  std::ofstream(walls) << right;
  ASSERT_TRUE(comesTrue([&] {
    session.update();
    return session.errors().empty() && session.isComplete();
  }));
  EXPECT_TRUE(maskOf(session, 1));
  // What all methods need is not checked in vain either.
  const fs::path samples = file("shaders/common/samples.frag");
  const std::string turned =
      test::replaced(readFile(samples), "sampleSt = clamp(st", "sampleSt = clamp(st.yx");
  const std::string unturned = readFile(samples);
  std::ofstream(samples) << turned;
  ViewSession other(request({"max-forsyth"}), [] {});
  ASSERT_TRUE(completes(other));
  EXPECT_FALSE(other.hasScene());
  ASSERT_EQ(other.errors().size(), 1U);
  EXPECT_THAT(other.errors().front(), ::testing::StartsWith("nothing is measured: this OpenGL"));
  std::ofstream(samples) << unturned;
  EXPECT_TRUE(comesTrue([&] {
    other.update();
    return other.hasScene() && other.isComplete();
  }));
  EXPECT_TRUE(other.errors().empty());
}

TEST_F(ViewSessionTest, IsSavedWhereNamesAreNoText) {
  namespace fs = std::filesystem;
  const fs::path home = file("caf\xE9");
  const fs::path shader = home / "own\xE9.glsl";
  fs::create_directories(home);
  fs::copy(render::shaderFolder() / "methods/max-forsyth.glsl", shader);
  std::ofstream(home / "ball.toml")
      << test::replaced(readFile(study()), "name = \"max-forsyth\"", "file = \"file:own%E9.glsl\"");
  cli::ViewRequest asked = request({"own%E9"});
  asked.study = home / "ball.toml";
  asked.out = home / "out";
  ViewSession session(asked, [] {});
  ASSERT_TRUE(completes(session));
  EXPECT_NO_THROW((void)saveStudyView(session));
  const study::StudySpec saved = study::readStudy(home / "out/ball/view/view-1.toml");
  EXPECT_TRUE(fs::equivalent(saved.methods.at(0).file, shader));
  // An error that names the file is part of what is on the screen.
  std::ofstream(shader) << "no method";
  ASSERT_TRUE(comesTrue([&] {
    session.update();
    return !session.errors().empty();
  }));
  EXPECT_NE(session.errors().front().find("caf\xE9"), std::string::npos);
  const auto screen = nlohmann::json::parse(screenJson(session));
  EXPECT_NE(screen.at("errors").at(0).get<std::string>().find("caf\uFFFD/own\uFFFD.glsl"),
            std::string::npos);
}

}  // namespace
}  // namespace gnomon::app
