#include "viewer/panes/layout.h"

#include <gtest/gtest.h>

namespace gnomon::app {
namespace {

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
