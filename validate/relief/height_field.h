#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "common/vec.h"

namespace gnomon::relief {

/// How a map or table goes on outside its texels.
enum class Wrap { repeat, clamp };

/// The axes of a map at whose ends the surface ends too.
struct Border {
  bool x = false, y = false;
  bool operator==(const Border&) const = default;
};

/// The index of texel i by the wrap rule: i modulo size, or i clamped to [0, size).
int wrappedIndex(int i, int size, Wrap wrap);

/// The two texels between whose centres a coordinate lies, and its share of the way from the first
/// to the second, 0 to 1.
struct Neighbours {
  int first, second;
  double share;
};

/// @param coordinate  any finite one, texels; the centre of texel i lies at i + 0.5
Neighbours neighbours(double coordinate, int size, Wrap wrap);

/// A height map h(x, y): *the bilinear interpolant of its texels*, whose centres lie at
/// (i + 0.5, j + 0.5). Truth, bake and shaders all use this one function. Coordinates are texels;
/// heights are height units (texels or world units: see Relief). Texels are stored row by row, y
/// slowest; row 0 is at v = 0.
///
/// Where a border is, `knownLength` says how far a method may look. The function itself goes on
/// there by the wrap rule.
class HeightField {
 public:
  /// @throws InputError if a size is not positive, the number of texels is not width × height, or a
  ///   height is not finite (naming the texel)
  HeightField(int width, int height, std::vector<float> texels, Wrap wrap, Border border = {});

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] Wrap wrap() const { return wrap_; }
  [[nodiscard]] Border border() const { return border_; }
  [[nodiscard]] const std::vector<float>& texels() const { return *texels_; }
  [[nodiscard]] float minimum() const { return minimum_; }
  [[nodiscard]] float maximum() const { return maximum_; }

  /// Height of texel (i, j); outside the map by the wrap rule.
  [[nodiscard]] float texel(int i, int j) const;
  /// h(x, y), any finite position, however far outside the map.
  /// @throws InternalError if the position is not finite
  [[nodiscard]] double at(Vec2 texelPosition) const;

  /// How far along a ray the relief is known, texels, at least 0: as far as the border, half a
  /// texel past the outermost texel centres; without end where no border lies ahead. What the wrap
  /// rule puts there casts no shadow, since there is no surface. The rule holds for all methods:
  /// they search tables and march height maps up to this length (`knownDistance` in relief.glsl).
  /// @param direction  unit
  [[nodiscard]] double knownLength(Vec2 texelPosition, Vec2 direction) const;

  /// The same map with another border.
  [[nodiscard]] HeightField withBorder(Border border) const&;
  [[nodiscard]] HeightField withBorder(Border border) &&;

 private:
  int width_;
  int height_;
  std::shared_ptr<const std::vector<float>> texels_;  ///< which copies share
  const float* first_ = nullptr;                      ///< of them
  Wrap wrap_;
  Border border_;
  float minimum_;
  float maximum_;
};

/// The relief upside down, h → height - h: ridges where grooves were, still between 0 and `height`
/// if it was.
/// @param height  height units of the value 1
HeightField inverted(const HeightField& field, double height);

/// Reads one channel of an image of any format of `ImageFormat`, told by its content, as
/// image::readGreyPicture does, times `height`: the rules are image::meaningTable's. The first row
/// of the image is the top, v = 1, as renderers take it.
/// @param channel  0-based, without alpha; none: the only one, or three that must be equal
/// @param height   height units of the value 1
/// @throws InputError naming the file as image::readGreyPicture, and for a height that is not
/// finite
///   (naming its pixel); MemoryError where it does not fit
HeightField readHeightImage(const std::filesystem::path& file, std::optional<int> channel,
                            double height, Wrap wrap);

/// The same relief on a finer map: `factor` times as many texels along x and y, each the height of
/// the bilinear function at its centre. For an odd factor every old texel centre is a new one, so
/// that the old function's kinks stay kinks of the new one, and both are the same function up to
/// float rounding: h'(factor · p) = scale · h(p) everywhere, beyond the border too.
/// @param factor  odd, at least 1
/// @param scale   new height units per old one: `factor` where heights are texels
/// @throws InternalError for an even factor; MemoryError naming `factor` where the finer map cannot
///   fit
HeightField resampledHeights(const HeightField& field, int factor, double scale);

}  // namespace gnomon::relief
