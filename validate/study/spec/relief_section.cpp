#include "study/spec/relief_section.h"

#include <fmt/core.h>

#include <array>
#include <cstdint>
#include <limits>

#include "relief/height_image.h"
#include "relief/patterns.h"
#include "relief/resampled_heights.h"
#include "study/spec/study_paths.h"

namespace gnomon {
namespace {

constexpr double highest = 1e6;  // height units, above and below 0

/// What every pattern takes.
struct PatternSize {
  int width;
  int height;
  double amplitude;
  Wrap wrap;
};

HeightField readColumns(const TomlReader& section, const PatternSize& size) {
  ColumnsPattern pattern;
  pattern.period = section.number("period", positive, pattern.period);
  pattern.radius = section.number("radius", positive, pattern.radius);
  pattern.wall = section.number("wall", Range{0}, pattern.wall);
  return section.blame("pattern", [&] {
    return makeColumns(size.width, size.height, pattern, size.amplitude, size.wrap);
  });
}

HeightField readCosine(const TomlReader& section, const PatternSize& size) {
  CosinePattern pattern;
  pattern.period = section.number("period", positive, pattern.period);
  return section.blame("pattern", [&] {
    return makeCosine(size.width, size.height, pattern, size.amplitude, size.wrap);
  });
}

HeightField readCells(const TomlReader& section, const PatternSize& size) {
  CellsPattern pattern;
  pattern.period = section.number("period", positive, pattern.period);
  pattern.jitter = section.number("jitter", Range{0, 1}, pattern.jitter);
  pattern.groove = section.number("groove", positive, pattern.groove);
  pattern.seed = static_cast<std::uint32_t>(
      section.integer("seed", 0, std::numeric_limits<int>::max(), static_cast<int>(pattern.seed)));
  return section.blame("pattern", [&] {
    return makeCells(size.width, size.height, pattern, size.amplitude, size.wrap);
  });
}

HeightField readRipples(const TomlReader& section, const PatternSize& size) {
  RipplesPattern pattern;
  pattern.period = section.number("period", positive, pattern.period);
  pattern.windward = section.number("windward", Range{0, 1}, pattern.windward);
  pattern.meander = section.number("meander", Range{0}, pattern.meander);
  return section.blame("pattern", [&] {
    return makeRipples(size.width, size.height, pattern, size.amplitude, size.wrap);
  });
}

HeightField readPattern(const TomlReader& section, double height, Wrap wrap) {
  constexpr int mostTexels = 16384;
  constexpr std::array readers = {readColumns, readCosine, readCells, readRipples};
  const auto reader =
      readers.at(section.choice("pattern", {"columns", "cosine", "cells", "ripples"}));
  const Vec2 texels = section.vec2("texels", Range{1, mostTexels});
  const PatternSize size{static_cast<int>(texels.x), static_cast<int>(texels.y), height, wrap};
  if (size.width != texels.x || size.height != texels.y) {
    section.fail("texels",
                 fmt::format("[{}, {}] found, two whole numbers expected", texels.x, texels.y));
  }
  return reader(section, size);
}

HeightField readImage(const TomlReader& section, const std::filesystem::path& folder, double height,
                      Wrap wrap) {
  constexpr int mostChannels = 1023;
  const int channel = section.integer("channel", 0, mostChannels, 0);
  return readHeightImage(folder / pathOf(section.text("image")), channel, height, wrap);
}

/// Heights as far as `height` may go, which is that of the value 1: floats may have others.
void requireHeights(const TomlReader& section, const HeightField& field) {
  if (field.minimum() >= -highest && field.maximum() <= highest) return;
  section.fail("height", fmt::format("heights from {:g} to {:g} found, {:g} to {:g} expected",
                                     field.minimum(), field.maximum(), -highest, highest));
}

/// An even factor would have no texel where an old one was, and so be another function.
int readResample(const TomlReader& section) {
  constexpr int most = 255;
  const int factor = section.integer("resample", 1, most, 1);
  if (factor % 2 == 0) {
    section.fail("resample", fmt::format("{} found, an odd number expected", factor));
  }
  return factor;
}

}  // namespace

Relief readReliefSection(const TomlReader& section, const std::filesystem::path& folder) {
  section.allow({"pattern", "image", "channel", "texels", "height", "height_space", "wrap",
                 "repeats", "invert", "resample", "period", "radius", "wall", "jitter", "groove",
                 "seed", "windward", "meander"});
  section.requireOneOf("pattern", "image");
  constexpr std::array wraps = {Wrap::repeat, Wrap::clamp};
  constexpr std::array spaces = {HeightSpace::world, HeightSpace::texture};
  const double height = section.number("height", Range{-highest, highest});
  const Wrap wrap = wraps.at(section.choice("wrap", {"repeat", "clamp"}, 0));
  const HeightSpace space = spaces.at(section.choice("height_space", {"world", "texture"}));
  const Vec2 repeats = section.vec2("repeats", Range{0, 1e6, true}, Vec2(1));
  const bool invert = section.flag("invert", false);
  HeightField field = section.has("image") ? readImage(section, folder, height, wrap)
                                           : readPattern(section, height, wrap);
  if (invert) field = inverted(field, height);
  requireHeights(section, field);
  const int resample = readResample(section);
  // Where heights count texels, there are now more of them in the same height.
  const double scale = space == HeightSpace::texture ? resample : 1;
  return {resample == 1 ? std::move(field) : resampledHeights(field, resample, scale), space,
          repeats, resample};
}

}  // namespace gnomon
