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

}  // namespace
}  // namespace gnomon::app
