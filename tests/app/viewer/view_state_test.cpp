#include "viewer/view_state.h"

#include <gtest/gtest.h>

#include "common/error.h"

namespace gnomon {
namespace {

const std::vector<std::string> labels = {"onoue-2004", "max-forsyth", "mine: 8 bits"};

TEST(PaneContent, TextAndContentAreEachOthersInverse) {
  for (const PaneContent& content :
       {PaneContent{"onoue-2004", ""}, PaneContent{"truth", ""}, PaneContent{"displaced", ""},
        PaneContent{"onoue-2004", "truth"}, PaneContent{"truth", "max-forsyth"},
        PaneContent{"mine: 8 bits", ""}, PaneContent{"mine: 8 bits", "onoue-2004"},
        PaneContent{"onoue-2004", "mine: 8 bits"}}) {
    EXPECT_EQ(parseContent(contentText(content), labels), content);
  }
}

TEST(PaneContent, WhatIsNoneIsRefused) {
  for (const char* text : {"", ":", "onoue", "onoue-2004:", ":truth", "displaced:truth",
                           "truth:displaced", "onoue-2004:truth:truth"}) {
    EXPECT_THROW((void)parseContent(text, labels), UsageError) << text;
  }
}

TEST(ViewState, MethodsOfHiddenPanesAreNotShown) {
  ViewState state;
  state.panes = {PaneContent{"onoue-2004", "truth"}, PaneContent{"max-forsyth", "onoue-2004"},
                 PaneContent{"mine: 8 bits", ""}, PaneContent{"displaced", ""}};
  using Labels = std::vector<std::string>;
  EXPECT_EQ(shownMethods(state), Labels{"onoue-2004"});
  state.paneCount = 2;
  EXPECT_EQ(shownMethods(state), (Labels{"onoue-2004", "max-forsyth"}));
  state.paneCount = 4;
  EXPECT_EQ(shownMethods(state), (Labels{"onoue-2004", "max-forsyth", "mine: 8 bits"}));
}

}  // namespace
}  // namespace gnomon
