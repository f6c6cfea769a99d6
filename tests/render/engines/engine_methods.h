#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/method_named.h"
#include "render/render_scene.h"
#include "truth/truth_scenes.h"

namespace gnomon::test {

using Parameters = std::map<std::string, double>;

/// What the shadow test alone says.
inline Mask testOf(const RenderScene& scene, const std::string& name,
                   const render::RenderView& view, const Vec3& light,
                   const Parameters& parameters = {}) {
  return scene.test(methodOf(name), view, light, render::TableFilter::exact, parameters);
}

/// A plane of 96 × 4 texels, a world unit each, whose heights are the same in every row. Its
/// samples lie in the texels' middles along y, `perTexel` of them a texel along x.
struct Profile {
  static constexpr int columns = 96;
  static constexpr int rows = 4;
  static constexpr int perTexel = 8;

  template <typename Height>
  explicit Profile(const Height& height, const horizon::BakeSettings& bake = {4, 96})
      : scene(surface::makePlane(columns, rows, columns / rows, 1), relief(height), bake,
              horizon::TableBits::thirtyTwo) {}

  template <typename Height>
  static relief::Relief relief(const Height& height) {
    std::vector<float> texels;
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) texels.push_back(static_cast<float>(height(i)));
    }
    return {relief::HeightField(columns, rows, texels, relief::Wrap::clamp),
            relief::HeightSpace::world, Vec2(1)};
  }

  [[nodiscard]] std::vector<double> shares(const std::string& name, const Vec3& light,
                                           double radius, const Parameters& parameters = {}) const {
    const Visibility found =
        scene.shares(methodOf(name), view, light, radius, render::SoftAnswer::own, parameters).test;
    const auto* row = &found.shares[static_cast<std::size_t>(view.height / 2 * view.width)];
    return {row, row + view.width};
  }

  /// Where the light ends toward high x of what is dark beyond `from`, texels.
  [[nodiscard]] double endOfShadow(const std::string& name, const Vec3& light, double from,
                                   const Parameters& parameters = {}) const {
    const Mask mask = testOf(scene, name, view, light, parameters);
    const auto row = static_cast<std::size_t>(view.height / 2 * view.width);
    double end = from;
    for (int i = static_cast<int>(from * perTexel); i < view.width; ++i) {
      if (mask.samples[row + static_cast<std::size_t>(i)] == Shade::shadowed)
        end = place(i) + 0.5 / perTexel;
    }
    return end;
  }

  /// x of a column of samples, texels.
  static double place(int column) { return (column + 0.5) / perTexel; }

  RenderScene scene;
  render::RenderView view = render::atlasView(scene.surface, rows* perTexel);
};

/// High up to x = 31.5, 0 from x = 32.5 on.
inline double cliff(int i) {
  return i < 32 ? 10 : 0;
}

inline const Vec3 towardLowX = lightToward(180, 30);

}  // namespace gnomon::test
