#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <variant>

#include "common/overloaded.h"
#include "relief/patterns.h"
#include "relief/relief.h"
#include "study/spec/sections/study_key.h"

namespace gnomon {

/// `[relief]`: a height map from a pattern, told by its `pattern`, or from an image.

using Pattern = std::variant<ColumnsPattern, CosinePattern, CellsPattern, RipplesPattern>;
constexpr std::array<std::string_view, 4> patternNames = {"columns", "cosine", "cells", "ripples"};

struct PatternMap {
  Pattern pattern;
  glm::ivec2 texels{0};
};

struct ImageMap {
  std::string path;  ///< as the file has it, see pathOf
  int channel = 0;
};

struct ReliefSection {
  double height = 0;
  HeightSpace space = HeightSpace::world;
  Wrap wrap = Wrap::repeat;
  Vec2 repeats{1, 1};
  bool isInverted = false;
  int resample = 1;
  std::variant<PatternMap, ImageMap> map;
};

inline StudyKeys keysOf(Pattern& pattern) {
  const auto period = [](double& place) -> StudyKey {
    return studyKey("period", numbers(place), "texels from one feature to the next", positive);
  };
  using Keys = StudyKeys;
  return std::visit(
      Overloaded{[&](ColumnsPattern& p) -> Keys {
                   return {period(p.period),
                           studyKey("radius", numbers(p.radius), "texels: of a column", positive),
                           studyKey("wall", numbers(p.wall), "texels: width of its slope", {0})};
                 },
                 [&](CosinePattern& p) -> Keys { return {period(p.period)}; },
                 [&](CellsPattern& p) -> Keys {
                   return {
                       period(p.period),
                       studyKey("jitter", numbers(p.jitter),
                                "share of its square in which a point may lie", {0, 1}),
                       studyKey("groove", numbers(p.groove), "texels: width of a rim", positive),
                       studyKey("seed", &p.seed, "of the points",
                                {0, std::numeric_limits<int>::max()})};
                 },
                 [&](RipplesPattern& p) -> Keys {
                   return {period(p.period),
                           studyKey("windward", numbers(p.windward),
                                    "share of the wavelength that rises", {0, 1}),
                           studyKey("meander", numbers(p.meander),
                                    "texels that crest lines stray at most", {0})};
                 }},
      pattern);
}

inline StudyKeys keysOf(PatternMap& map) {
  return {studyKey("texels", &map.texels, "columns and rows of the map", {1, 16384}, required)};
}

inline StudyKeys keysOf(ImageMap& map) {
  return {studyKey("image", &map.path, "a picture; integer values count as 0 to 1", {}, required,
                   Enters::nothing),  // the file's content enters
          studyKey("channel", &map.channel, "of the picture", {0, 1023})};
}

/// The keys that a pattern and an image have in common.
inline StudyKeys keysOf(ReliefSection& relief) {
  const std::vector<std::pair<Wrap, std::string>> wraps = {{Wrap::repeat, "repeat"},
                                                           {Wrap::clamp, "clamp"}};
  const std::vector<std::pair<HeightSpace, std::string>> spaces = {
      {HeightSpace::world, "world"}, {HeightSpace::texture, "texture"}};
  return {
      studyKey("height", numbers(relief.height), "of the value 1, in units of `height_space`",
               {-1e6, 1e6}, required),
      studyKey("wrap", chosenName(relief.wrap, wraps), "what lies past the map's sides"),
      studyKey("height_space", chosenName(relief.space, spaces),
               "world units, or texels (Max 1988)", {}, required),
      studyKey("repeats", numbers(relief.repeats), "times that the map is laid over u and v",
               {0, 1e6, true}),
      studyKey("invert", &relief.isInverted, "1 - value"),
      studyKey(
          "resample", &relief.resample,
          "an odd number: texels along a side for one of the map. The same relief on finer texels; "
          "lengths in the file stay texels of the map before",
          {1, 255})};
}

/// The keys of a relief's own form.
inline StudyKeys allKeysOf(ReliefSection& relief) {
  StudyKeys keys = keysOf(relief);
  const auto add = [&](StudyKeys more) { keys.insert(keys.end(), more.begin(), more.end()); };
  std::visit([&](auto& map) { add(keysOf(map)); }, relief.map);
  if (auto* map = std::get_if<PatternMap>(&relief.map)) add(keysOf(map->pattern));
  return keys;
}

/// Reads `[relief]`.
/// @throws InputError as TomlReader
ReliefSection readReliefSection(const TomlReader& section);

/// The section as a table of the file.
toml::table tableOf(ReliefSection relief);

/// The relief that the section asks for.
/// @param section  for messages
/// @param folder   of the study: what paths are relative to
/// @throws InputError for an image or pattern that cannot be
Relief reliefOf(const ReliefSection& relief, const TomlReader& section,
                const std::filesystem::path& folder);

}  // namespace gnomon
