#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "relief/patterns.h"
#include "render/method_named.h"
#include "render/render_scene.h"
#include "render/soft/soft_light.h"
#include "truth/truth_scenes.h"

namespace gnomon::test {

inline const double sun = radians(0.266);

constexpr double inDegrees(double angle) {
  return angle * 180 / pi;
}

/// The answer that a method has to give of a disc: its own, else by its horizon.
inline render::SoftAnswer softAnswerOf(const render::Method& method) {
  return method.answersShares ? render::SoftAnswer::own : render::SoftAnswer::disc;
}

/// A wall of height 10 over x ≤ 15.5 texels, that falls to the ground within the next texel. Behind
/// it, at the middles of the texels, its horizon toward -x is at 10 / (x - 15.5), with nothing to
/// interpolate.
struct SoftWall {
  static constexpr int columns = 96;
  static constexpr int rows = 16;

  /// @param reach  of tables and marches, texels
  explicit SoftWall(double reach = columns)
      : scene(surface::makePlane(columns, rows, 12, 2),
              stepRelief(columns, rows, 10, [](int i, int) { return i < 16; }), {8, reach},
              horizon::TableBits::thirtyTwo) {}

  RenderScene scene;
  render::RenderView view = render::atlasView(scene.surface, 8);

  static Vec3 light(double elevation) { return lightToward(180, elevation); }

  /// The largest error of `answered` behind the wall, but for the rows nearer than `margin` to its
  /// ends.
  [[nodiscard]] double error(const Visibility& answered, double elevation, double radius,
                             int margin = 0) const {
    double largest = 0;
    for (int row = margin; row < rows - margin; ++row) {
      for (int column = 18; column < columns; ++column) {
        const double horizon = std::atan(10 / (column + 0.5 - 15.5));
        const double exact = shareOver(radians(elevation) - horizon, radius);
        const auto i = static_cast<std::size_t>(row * view.width + column);
        largest = std::max(largest, std::abs(exact - static_cast<double>(answered.shares[i])));
      }
    }
    return largest;
  }

  [[nodiscard]] double errorOf(const std::string& name, double radius,
                               const std::map<std::string, double>& parameters = {},
                               int margin = 0) const {
    const render::Method method = methodOf(name);
    double largest = 0;
    for (const double elevation : {11.1, 14.0, 17.3, 22.0, 31.6}) {
      const render::VisibilityAnswers found =
          scene.shares(method, view, light(elevation), radius, softAnswerOf(method), parameters);
      largest = std::max(largest, error(found.test, elevation, radius, margin));
      EXPECT_EQ(meanDifference(found.test, found.drawn), 0) << "the ground faces all of the disc";
    }
    return largest;
  }
};

/// Bumps on a sphere, whose every method has something to say, with a background.
struct SoftBumps {
  RenderScene scene{surface::makeSphere(60, 1.2, 1.2, 16, 16),
                    {relief::makeColumns(64, 64, {32, 8, 2}, 8, relief::Wrap::repeat),
                     relief::HeightSpace::world, Vec2(1)},
                    {16, 64},
                    horizon::TableBits::sixteen,
                    2};
  render::RenderView view =
      render::cameraView(Camera{{80, 40, 150}, {0, 0, 50}, {0, 1, 0}, 0.7, 80, 64}, scene.mesh);
  Vec3 light = lightToward(20, 25);
};

}  // namespace gnomon::test
