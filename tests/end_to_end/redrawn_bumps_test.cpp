#include <gtest/gtest.h>

#include <cmath>

#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

/// Reptile skin on a sphere cap whose error grows toward the terminator, drawn sixteen times.
constexpr const char* redrawn = R"(
[study]
name = "redrawn"
title = "Bumps drawn anew"
source = "a test"
frames = 0
[surface]
shape = "sphere"
curvature = 0.015
size = [128, 128]
quads = [64, 64]

[relief]
pattern = "cells"
texels = [256, 256]
period = 16
height = 4
height_space = "texture"

[truth]
step = 0.25

[[view]]
type = "camera"
width = 256
height = 256
eye = [0, -150, 260]
target = [0, 0, 46]
up = [0, 1, 0]
fov = 26

[[light]]
azimuth = 20
elevation = [45, 30]

[[method]]
name = "max-forsyth"

[[method]]
name = "onoue-2004"

[sweep]
key = "relief.seed"
values = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16]
)";

/// What one figure and its interval are over all draws.
class Draws {
 public:
  void add(const nlohmann::json& row, const char* figure) {
    ASSERT_TRUE(row.at("low").is_number()) << row.at("reason");
    values_.push_back(row.at(figure));
    halfWidths_ += (row.at("high").get<double>() - row.at("low").get<double>()) / 2;
  }
  /// The mean half-width of the intervals over 1.96 standard deviations of the figure.
  [[nodiscard]] double relativeWidth() const {
    const auto count = static_cast<double>(values_.size());
    double mean = 0;
    for (const double value : values_) mean += value / count;
    double squares = 0;
    for (const double value : values_) squares += (value - mean) * (value - mean);
    return halfWidths_ / count / (1.96 * std::sqrt(squares / (count - 1)));
  }

 private:
  std::vector<double> values_;
  double halfWidths_ = 0;
};

class RedrawnBumps : public EndToEnd {};

/// An interval speaks of other draws of the bumps: so draw them. Sixteen draws tell a standard
/// deviation to a fifth.
TEST_F(RedrawnBumps, VaryAsTheIntervalsSay) {
  runStudy("redrawn", redrawn);
  Draws flat;
  Draws curved;
  Draws difference;
  for (int seed = 1; seed <= 16; ++seed) {
    const nlohmann::json json = summary("redrawn/" + std::to_string(seed));
    for (const nlohmann::json& row : json.at("confidence")) {
      if (row.at("light") != "all") continue;
      (row.at("method") == "max-forsyth" ? flat : curved).add(row, "error_rate");
    }
    difference.add(json.at("differences").at(0), "difference");
  }
  for (const Draws* draws : {&flat, &curved, &difference}) {
    EXPECT_GT(draws->relativeWidth(), 1 / 1.5);
    EXPECT_LT(draws->relativeWidth(), 1.5);
  }
}

}  // namespace
}  // namespace gnomon::test
