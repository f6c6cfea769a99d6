#include "model/history.h"

#include <gtest/gtest.h>

#include <string>

namespace gnomon::app {
namespace {

constexpr double rest = History<int>::restSeconds;

/// A value that a person sets, now and then, with a pause after each.
class Steps {
 public:
  void set(int value) {
    history.observe(value, time += 0.1, false);
    history.observe(value, time += 2 * rest, false);
  }
  History<int> history{0};
  double time = 0;
};

TEST(History, GoesBackAndForth) {
  Steps steps;
  EXPECT_FALSE(steps.history.canUndo());
  EXPECT_EQ(steps.history.undo(), 0) << "nothing to undo";
  for (const int value : {1, 2, 3}) steps.set(value);
  EXPECT_FALSE(steps.history.canRedo());
  EXPECT_EQ(steps.history.undo(), 2);
  EXPECT_EQ(steps.history.undo(), 1);
  EXPECT_TRUE(steps.history.canRedo());
  EXPECT_EQ(steps.history.redo(), 2);
  EXPECT_EQ(steps.history.undo(), 1);
  EXPECT_EQ(steps.history.undo(), 0);
  EXPECT_FALSE(steps.history.canUndo());
  EXPECT_EQ(steps.history.undo(), 0);
  for (const int value : {1, 2, 3, 3}) EXPECT_EQ(steps.history.redo(), value);
}

TEST(History, ANewStepForgetsWhatWasUndone) {
  Steps steps;
  for (const int value : {1, 2}) steps.set(value);
  EXPECT_EQ(steps.history.undo(), 1);
  steps.set(7);
  EXPECT_FALSE(steps.history.canRedo());
  EXPECT_EQ(steps.history.redo(), 7);
  EXPECT_EQ(steps.history.undo(), 1);
  EXPECT_EQ(steps.history.undo(), 0);
}

TEST(History, WhatChangesWithoutARestIsOneStep) {
  History<int> history(0);
  double time = 0;
  for (int value = 1; value <= 20; ++value) history.observe(value, time += 0.9 * rest, false);
  EXPECT_EQ(history.undo(), 0);
  EXPECT_EQ(history.redo(), 20);
  // A held button ends no step however long it is still, and its end starts the rest.
  history.observe(30, time += rest, true);
  history.observe(30, time += 9 * rest, true);
  history.observe(31, time += 9 * rest, true);
  history.observe(31, time += 2 * rest, true);
  history.observe(31, time += 0.1 * rest, false);
  history.observe(32, time += 0.1 * rest, false);
  EXPECT_EQ(history.undo(), 20);
  EXPECT_EQ(history.redo(), 32);
}

/// As when a window draws slowly: a change comes before the value's rest was seen.
TEST(History, WhatRestedIsAStepThoughNothingWasToldMeanwhile) {
  History<int> history(0);
  history.observe(1, 1, false);
  history.observe(2, 1 + 1.1 * rest, false);
  EXPECT_EQ(history.undo(), 1);
  history.observe(3, 20, false);
  history.observe(3, 20 + 1.1 * rest, true);  // a button goes down
  history.observe(4, 20 + 1.2 * rest, true);
  EXPECT_EQ(history.undo(), 3);
  EXPECT_EQ(history.undo(), 1);
  EXPECT_EQ(history.undo(), 0);
}

TEST(History, ABackAndForthIsNoStep) {
  History<int> history(5);
  history.observe(6, 0, false);
  EXPECT_TRUE(history.canUndo());
  history.observe(5, 0.1, false);
  history.observe(5, 9, false);
  EXPECT_FALSE(history.canUndo());
}

TEST(History, KeepsABoundedNumberOfSteps) {
  Steps steps;
  constexpr int most = static_cast<int>(History<int>::mostSteps);
  for (int value = 1; value <= most + 10; ++value) steps.set(value);
  int undone = 0;
  for (; steps.history.canUndo(); ++undone) steps.history.undo();
  EXPECT_EQ(undone, most);
  EXPECT_EQ(steps.history.undo(), 10);
}

}  // namespace
}  // namespace gnomon::app
