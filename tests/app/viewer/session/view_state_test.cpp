#include "viewer/session/view_state.h"

#include <gtest/gtest.h>

#include "common/error.h"

namespace gnomon::app {
namespace {

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

TEST(ViewChoice, HoldsWhatAPersonTakesBackAndNothingElse) {
  ViewState state;
  state.panes = {PaneContent{onoue}, PaneContent{tracedTruth}, PaneContent{flat},
                 PaneContent{displacedSurface}};
  const ViewChoice first = choiceOf(state);
  const std::vector<void (*)(ViewState&)> changes = {
      [](ViewState& now) { now.camera.eye.x += 1; },
      [](ViewState& now) { now.light.elevation = 12; },
      [](ViewState& now) { now.light.radius = 3; },
      [](ViewState& now) { now.paneCount = 4; },
      [](ViewState& now) {
        now.panes[1] = {flat, onoue};
      },
      [](ViewState& now) { now.changes.height = 3; },
      [](ViewState& now) { now.changes.bake.azimuths = 16; },
      [](ViewState& now) { now.changes.methods["onoue-2004"].parameters["steps"] = 3; }};
  for (const auto& change : changes) {
    ViewState changed = state;
    change(changed);
    const ViewChoice choice = choiceOf(changed);
    EXPECT_FALSE(choice == first);
    // A window that has grown meanwhile keeps its size.
    changed.camera.width = 999;
    restore(first, changed);
    EXPECT_TRUE(choiceOf(changed) == first);
    EXPECT_EQ(changed.camera.width, 999);
    restore(choice, changed);
    EXPECT_TRUE(choiceOf(changed) == choice);
  }
  ViewState same = state;
  same.camera.height = 7;
  same.wipe = 0.2;
  same.overlays.pixel = true;
  same.panel = false;
  same.part = ViewPart{};
  EXPECT_TRUE(choiceOf(same) == first);
}

}  // namespace
}  // namespace gnomon::app
