#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "app/viewer/viewed_study.h"
#include "common/error.h"
#include "common/files/atomic_file.h"
#include "support/replaced.h"
#include "support/temporary_folder.h"
#include "viewer/panes/layout.h"
#include "viewer/session/drawn_scene.h"
#include "viewer/session/view_session.h"
#include "viewer/session/view_state.h"

namespace gnomon::app {
namespace {

using Contents = std::vector<std::string>;

class FirstView : public ViewedStudy {
 protected:
  [[nodiscard]] cli::ViewRequest request() const {
    cli::ViewRequest asked;
    asked.study = study();
    return asked;
  }
  void addMethod(const std::string& keys) const {
    std::ofstream(study(), std::ios::app) << "[[method]]\n" << keys << "\n";
  }
  /// The study with other methods in place of its own.
  void writeMethods(const std::string& methods) const {
    const std::string text = readFile(study());
    std::ofstream(study()) << text.substr(0, text.find("[[method]]")) << methods;
  }
  static Contents shown(const ViewState& state) {
    Contents contents;
    for (int i = 0; i < state.paneCount; ++i) {
      contents.push_back(contentText(state.panes.at(static_cast<std::size_t>(i))));
    }
    return contents;
  }
};

TEST_F(FirstView, IsTheStudysFirstMethodBesideTheTruth) {
  EXPECT_EQ(shown(firstView(openStudy(request()))), (Contents{"max-forsyth", "truth"}));
  cli::ViewRequest asked = request();
  asked.show = {"ellipse"};
  EXPECT_EQ(shown(firstView(openStudy(asked))), Contents{"ellipse"}) << "options say otherwise";
}

TEST_F(FirstView, AScreenshotReplacesNothingThatTheStudyReads) {
  const std::string before = readFile(study());
  cli::ViewRequest asked = request();
  asked.screenshot = study();
  EXPECT_THROW((void)openStudy(asked), UsageError);
  EXPECT_EQ(readFile(study()), before);
}

TEST_F(FirstView, PassesOverTheControlWhereThereIsAnotherMethod) {
  const std::string control = "[[method]]\nname = \"unshadowed\"\nlabel = \"none at all\"\n";
  writeMethods(control + "[[method]]\nname = \"ellipse\"\n[[method]]\nname = \"max-forsyth\"\n");
  EXPECT_EQ(firstMethod(openStudy(request())), "ellipse");
  // Alone it is looked at: the methods that the program adds are not the study's own.
  writeMethods(control);
  const OpenedStudy alone = openStudy(request());
  EXPECT_EQ(firstMethod(alone), "none at all");
  EXPECT_EQ(alone.ownCount, 1U);
  EXPECT_GT(alone.labels.size(), 10U);
}

TEST_F(FirstView, TakesTheRectangleFromTheOptions) {
  cli::ViewRequest asked = request();
  asked.rectangle = {25, 20, 75, 70};
  EXPECT_EQ(firstView(openStudy(asked)).part, (ViewPart{0.25, 0.2, 0.75, 0.7}));
  for (const std::vector<double>& wrong :
       {std::vector<double>{75, 20, 25, 70}, {0, 0, 101, 50}, {-1, 0, 50, 50}, {0, 0, 0, 50}}) {
    asked.rectangle = wrong;
    EXPECT_THROW((void)firstView(openStudy(asked)), UsageError);
  }
}

const std::vector<std::string> labels = {"onoue-2004", "max-forsyth", "mine: 8 bits"};
const PaneSource onoue = methodSource(labels[0]);
const PaneSource flat = methodSource(labels[1]);
const PaneSource mine = methodSource(labels[2]);

TEST(PaneContent, TextAndContentAreEachOthersInverse) {
  for (const PaneContent& content :
       {PaneContent{onoue}, PaneContent{tracedTruth}, PaneContent{displacedSurface},
        PaneContent{onoue, tracedTruth}, PaneContent{tracedTruth, flat}, PaneContent{mine},
        PaneContent{mine, onoue}, PaneContent{onoue, mine}}) {
    EXPECT_EQ(parseContent(contentText(content), labels), content);
  }
}

TEST(PaneContent, AMethodMayHaveTheNameOfAnotherSource) {
  const std::vector<std::string> names = {"displaced", "truth"};
  EXPECT_EQ(parseContent("displaced", names), PaneContent{methodSource("displaced")});
  EXPECT_EQ(parseContent("displaced:truth", names),
            (PaneContent{methodSource("displaced"), methodSource("truth")}));
  ViewState state;
  state.panes[0] = {methodSource("displaced")};
  EXPECT_EQ(shownMethods(state), std::vector<std::string>{"displaced"});
  EXPECT_TRUE(needsTruth(state.panes[0]));
  state.panes[0] = {displacedSurface};
  EXPECT_TRUE(shownMethods(state).empty());
  EXPECT_FALSE(needsTruth(state.panes[0]));
}

TEST(PaneContent, WhatIsNoneIsRefused) {
  for (const char* text : {"", ":", "onoue", "onoue-2004:", ":truth", "displaced:truth",
                           "truth:displaced", "onoue-2004:truth:truth"}) {
    EXPECT_THROW((void)parseContent(text, labels), UsageError) << text;
  }
}

TEST(ViewState, MethodsOfHiddenPanesAreNotShown) {
  ViewState state;
  state.panes = {PaneContent{onoue, tracedTruth}, PaneContent{flat, onoue}, PaneContent{mine},
                 PaneContent{displacedSurface}};
  using Labels = std::vector<std::string>;
  EXPECT_EQ(shownMethods(state), Labels{"onoue-2004"});
  state.paneCount = 2;
  EXPECT_EQ(shownMethods(state), (Labels{"onoue-2004", "max-forsyth"}));
  state.paneCount = 4;
  EXPECT_EQ(shownMethods(state), (Labels{"onoue-2004", "max-forsyth", "mine: 8 bits"}));
}

class ShaderWatchTest : public TemporaryFolder {
 protected:
  void write(const char* name) const { std::ofstream(folder() / name) << "text"; }
  /// Another time than the file has, whatever the clock's steps are.
  void touch(const char* name) const {
    const auto path = folder() / name;
    std::filesystem::last_write_time(
        path, std::filesystem::last_write_time(path) + std::chrono::seconds(1));
  }
  static bool noticed(ShaderWatch& watch) {
    std::this_thread::sleep_for(std::chrono::milliseconds(550));
    return watch.changed();
  }
};

TEST_F(ShaderWatchTest, NoticesFilesThatChangeComeAndGo) {
  write("a.glsl");
  ShaderWatch watch(folder());
  EXPECT_FALSE(noticed(watch));
  touch("a.glsl");
  EXPECT_TRUE(noticed(watch));
  EXPECT_FALSE(noticed(watch));
  write("b.glsl");
  EXPECT_TRUE(noticed(watch));
  std::filesystem::remove(folder() / "b.glsl");
  EXPECT_TRUE(noticed(watch));
}

TEST_F(ShaderWatchTest, NoticesFilesElsewhere) {
  std::filesystem::create_directory(folder() / "shaders");
  write("mine.glsl");
  ShaderWatch watch(folder() / "shaders");
  watch.watch({folder() / "mine.glsl"});
  EXPECT_FALSE(noticed(watch));
  touch("mine.glsl");
  EXPECT_TRUE(noticed(watch));
}

TEST(WindowLayout, PicturesAndControlsFillTheWindow) {
  const WindowLayout layout = windowLayout(1280, 720, {true, false, 1});
  EXPECT_EQ(layout.pictures.size.x + layout.panel.size.x, 1280);
  EXPECT_EQ(layout.panel.corner.x, layout.pictures.size.x);
  EXPECT_EQ(layout.panes[0].size, layout.pictures.size);
  EXPECT_EQ(windowLayout(1280, 720, {false, false, 1}).pictures.size, Vec2(1280, 720));
}

TEST(WindowLayout, TheCrossSectionCoversNoPane) {
  for (const int height : {800, 600, 301}) {
    for (const int paneCount : {1, 2, 4}) {
      const WindowLayout layout = windowLayout(800, height, {true, true, paneCount});
      EXPECT_EQ(layout.pictures.size.y + layout.section.size.y, height);
      EXPECT_EQ(layout.section.corner.y, layout.pictures.size.y);
      EXPECT_EQ(layout.section.size.x, layout.pictures.size.x);
      EXPECT_GT(layout.section.size.y, 100);
      for (const PaneRectangle& pane : layout.panes) {
        EXPECT_LE(pane.corner.y + pane.size.y, layout.section.corner.y);
      }
      EXPECT_EQ(paneUnder(layout, layout.section.corner + Vec2(1), 0.5), -1);
    }
  }
}

TEST(WindowLayout, FourPanesAreOfOneSizeAndDoNotOverlap) {
  for (const int width : {1281, 640, 65}) {
    const WindowLayout layout = windowLayout(width, 481, {true, false, 4});
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(layout.panes[i].size, layout.panes[0].size);
      const Vec2 end = layout.panes[i].corner + layout.panes[i].size;
      EXPECT_LE(end.x, layout.pictures.size.x);
      EXPECT_LE(end.y, layout.pictures.size.y);
      EXPECT_EQ(paneUnder(layout, layout.panes[i].corner, 0.5), static_cast<int>(i));
    }
    EXPECT_GE(layout.panes[1].corner.x, layout.panes[0].corner.x + layout.panes[0].size.x);
  }
}

TEST(WindowLayout, TheWipePartsTwoPanes) {
  const WindowLayout layout = windowLayout(1000, 500, {false, false, 2});
  EXPECT_EQ(layout.panes[0].size, layout.panes[1].size);
  EXPECT_EQ(paneUnder(layout, {299, 100}, 0.3), 0);
  EXPECT_EQ(paneUnder(layout, {301, 100}, 0.3), 1);
  EXPECT_EQ(paneUnder(layout, {-1, 100}, 0.3), -1);
  EXPECT_EQ(paneUnder(layout, {500, 500}, 0.3), -1);
}

TEST(WindowLayout, ATinyWindowStillHasAPicture) {
  const WindowLayout layout = windowLayout(10, 3, {true, true, 4});
  for (const PaneRectangle& pane : layout.panes) {
    EXPECT_GE(pane.size.x, 1);
    EXPECT_GE(pane.size.y, 1);
  }
}

}  // namespace
}  // namespace gnomon::app
