#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>

#include "common/lists.h"
#include "relief/patterns.h"
#include "relief/relief.h"
#include "relief/solid.h"
#include "study/spec/sections/study_key.h"
#include "surface/cage/cage.h"
#include "surface/limit_surface.h"

namespace gnomon::study {

/// `[relief]`: a height map from a pattern, told by its `pattern`, from a solid, told by its
/// `solid`, or from an image, which a `projection` carves into the surface.

using Pattern =
    std::variant<relief::ColumnsPattern, relief::CosinePattern, relief::CellsPattern,
                 relief::RipplesPattern, relief::SpectrumPattern, relief::ScratchesPattern>;
constexpr std::array<std::string_view, 6> patternNames = {"columns", "cosine",   "cells",
                                                          "ripples", "spectrum", "scratches"};
/// The largest height, and the deepest, that a relief may have, in its own units.
constexpr double highestRelief = 1e6;
constexpr std::array<std::string_view, 3> solidNames = {"noise", "cells", "ripples"};

struct PatternMap {
  Pattern pattern;
  glm::ivec2 texels{0};
};

struct SolidMap {
  relief::SolidPattern solid;
  glm::ivec2 texels{0};
};

struct ImageMap {
  std::string path;  ///< as the file has it, see fileOf
  int channel = 0;
  bool isChannelNamed = false;  ///< else three channels must be equal
};

/// An image projected in space, see relief::triplanar.
struct ProjectedMap {
  ImageMap image;
  std::string projection = "triplanar";
  glm::ivec2 texels{0};
  double period = 0;
};

struct ReliefSection {
  double height = 0;
  relief::HeightSpace space = relief::HeightSpace::world;
  relief::Wrap wrap = relief::Wrap::repeat;
  Vec2 repeats{1, 1};
  bool isInverted = false;
  int resample = 1;
  std::variant<PatternMap, SolidMap, ImageMap, ProjectedMap> map;
};

inline StudyKey seedKey(int& seed, std::string_view meaning) {
  return studyKey("seed", &seed, meaning, {0, std::numeric_limits<int>::max()});
}

inline StudyKeys keysOf(Pattern& pattern) {
  const auto period = [](double& place) -> StudyKey {
    return studyKey("period", numbers(place), "texels from one feature to the next", positive);
  };
  using Keys = StudyKeys;
  return std::visit(
      Overloaded{
          [&](relief::ColumnsPattern& p) -> Keys {
            return {period(p.period),
                    studyKey("radius", numbers(p.radius), "texels: of a column", positive),
                    studyKey("wall", numbers(p.wall), "texels: width of its slope", {0})};
          },
          [&](relief::CosinePattern& p) -> Keys { return {period(p.period)}; },
          [&](relief::CellsPattern& p) -> Keys {
            return {period(p.period),
                    studyKey("jitter", numbers(p.jitter),
                             "share of its square in which a point may lie", {0, 1}),
                    studyKey("groove", numbers(p.groove), "texels: width of a rim", positive),
                    seedKey(p.seed, "of the points")};
          },
          [&](relief::RipplesPattern& p) -> Keys {
            return {period(p.period),
                    studyKey("windward", numbers(p.windward), "share of the wavelength that rises",
                             {0, 1}),
                    studyKey("meander", numbers(p.meander), "texels that crest lines stray at most",
                             {0})};
          },
          [&](relief::SpectrumPattern& p) -> Keys {
            return {studyKey("beta", numbers(p.beta),
                             "power falls as frequency to the power of minus this", {0, 10}),
                    studyKey("period", numbers(p.period), "texels: of the longest wave", positive),
                    studyKey("shortest", numbers(p.shortest), "texels: of the shortest wave", {2}),
                    seedKey(p.seed, "of the phases")};
          },
          [&](relief::ScratchesPattern& p) -> Keys {
            return {studyKey("density", numbers(p.density),
                             "share of the map that they would cover side by side", {0, 4, true}),
                    studyKey("length", numbers(p.length), "texels: of the longest", {1, 16384}),
                    studyKey("width", numbers(p.width), "texels: of a groove", {1, 16384}),
                    seedKey(p.seed, "of places, directions and lengths")};
          }},
      pattern);
}

inline StudyKeys keysOf(relief::SolidPattern& solid) {
  const auto period = [](double& place) -> StudyKey {
    return studyKey("period", numbers(place), "world units from one feature to the next", positive,
                    required);
  };
  using Keys = StudyKeys;
  return std::visit(
      Overloaded{[&](relief::SolidNoise& p) -> Keys {
                   return {
                       period(p.period),
                       studyKey("octaves", &p.octaves, "each of half the period", {1, 16}),
                       studyKey("gain", numbers(p.gain), "of an octave on the one before", {0, 1}),
                       seedKey(p.seed, "of the gradients")};
                 },
                 [&](relief::SolidCells& p) -> Keys {
                   return {period(p.period),
                           studyKey("jitter", numbers(p.jitter),
                                    "share of its cube in which a point may lie", {0, 1}),
                           studyKey("groove", numbers(p.groove), "world units: width of a rim",
                                    positive, required),
                           seedKey(p.seed, "of the points")};
                 },
                 [&](relief::SolidRipples& p) -> Keys {
                   return {period(p.period),
                           studyKey("windward", numbers(p.windward),
                                    "share of the wavelength that rises", {0, 1}),
                           studyKey("meander", numbers(p.meander),
                                    "world units that crests stray at most", {0}, required),
                           studyKey("direction", numbers(p.direction), "across the crests"),
                           seedKey(p.seed, "of the meanders")};
                 }},
      solid);
}

inline StudyKeys keysOf(PatternMap& map) {
  return {studyKey("texels", &map.texels, "columns and rows of the map", {1, 16384}, required)};
}

inline StudyKeys keysOf(SolidMap& map) {
  return {studyKey("texels", &map.texels, "columns and rows of the map", {1, 16384}, required)};
}

inline StudyKeys keysOf(ImageMap& map) {
  return {studyKey("image", &map.path, "a picture; integer values count as 0 to 1", {}, required,
                   Enters::nothing),  // the file's content enters
          studyKey("channel", &map.channel, "of the picture; without it three must be equal",
                   {0, 1023})};
}

inline StudyKeys keysOf(ProjectedMap& map) {
  return {studyKey("projection", &map.projection,
                   "along the axes of space, blended by the normal, carved into the surface", {},
                   required, Enters::everything, {"triplanar"}),
          studyKey("texels", &map.texels, "columns and rows of the map", {1, 16384}, required),
          studyKey("period", numbers(map.period), "world units: width of the image", positive,
                   required)};
}

/// The keys that all reliefs have in common.
inline StudyKeys keysOf(ReliefSection& relief) {
  const std::vector<std::pair<relief::Wrap, std::string>> wraps = {{relief::Wrap::repeat, "repeat"},
                                                                   {relief::Wrap::clamp, "clamp"}};
  const std::vector<std::pair<relief::HeightSpace, std::string>> spaces = {
      {relief::HeightSpace::world, "world"}, {relief::HeightSpace::texture, "texture"}};
  return {
      studyKey("height", numbers(relief.height), "of the value 1, in units of `height_space`",
               {-highestRelief, highestRelief}, required),
      studyKey("wrap", chosenName(relief.wrap, wraps), "what lies past the map's sides", {},
               "`\"clamp\"` for an open mesh that the map is laid over at most once, else "
               "`\"repeat\"`"),
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
  if (auto* map = std::get_if<SolidMap>(&relief.map)) add(keysOf(map->solid));
  if (auto* map = std::get_if<ProjectedMap>(&relief.map)) add(keysOf(map->image));
  return keys;
}

/// The image that a relief is made from, or null.
const ImageMap* imageOf(const ReliefSection& relief);

/// Reads `[relief]`.
/// @throws InputError as TomlReader
ReliefSection readReliefSection(const TomlReader& section);

/// The section as a table of the file.
toml::table tableOf(ReliefSection relief);

/// What is wrong with the heights of a map, if they go beyond what `height` may be: floats may.
std::optional<std::string> heightsFault(const relief::HeightField& field);

/// The faces whose texture coordinates lie wholly outside the map, where a clamped map only
/// continues its border; none of a map that repeats. Faces without texture coordinates are not
/// counted.
struct FacesOfMap {
  std::size_t all = 0, outside = 0;
};
FacesOfMap facesOfMap(const surface::Cage& cage, const relief::Relief& relief);

/// The relief that the section asks for.
/// @param section  for messages
/// @param folder   of the study: what paths are relative to
/// @param cage     of the surface
/// @param limit    gives it, where a solid or a projection is sampled on it
/// @throws InputError for an image, pattern or solid that cannot be; for one that is sampled on the
///   surface as LimitSurface; for a clamped map that no face lies in, on which nothing would rise
relief::Relief reliefOf(const ReliefSection& relief, const TomlReader& section,
                        const std::filesystem::path& folder, const surface::Cage& cage,
                        const std::function<const surface::LimitSurface&()>& limit);

}  // namespace gnomon::study
