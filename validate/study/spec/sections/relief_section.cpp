#include "study/spec/sections/relief_section.h"

#include <fmt/core.h>

#include "relief/height_field.h"
#include "study/spec/sections/study_files.h"

namespace gnomon::study {
namespace {

relief::HeightField heightsOf(const PatternMap& map, const ReliefSection& relief) {
  const auto [width, height] = std::pair(map.texels.x, map.texels.y);
  return std::visit(
      Overloaded{[&](const relief::ColumnsPattern& pattern) {
                   return relief::makeColumns(width, height, pattern, relief.height, relief.wrap);
                 },
                 [&](const relief::CosinePattern& pattern) {
                   return relief::makeCosine(width, height, pattern, relief.height, relief.wrap);
                 },
                 [&](const relief::CellsPattern& pattern) {
                   return relief::makeCells(width, height, pattern, relief.height, relief.wrap);
                 },
                 [&](const relief::RipplesPattern& pattern) {
                   return relief::makeRipples(width, height, pattern, relief.height, relief.wrap);
                 },
                 [&](const relief::SpectrumPattern& pattern) {
                   return relief::makeSpectrum(width, height, pattern, relief.height, relief.wrap);
                 },
                 [&](const relief::ScratchesPattern& pattern) {
                   return relief::makeScratches(width, height, pattern, relief.height, relief.wrap);
                 }},
      map.pattern);
}

void requireOneRepeat(const TomlReader& section, const ReliefSection& relief) {
  if (relief.repeats == Vec2(1)) return;
  section.fail("repeats",
               "a solid has a texel of its own for every point, no `repeats` "
               "expected");
}

}  // namespace

ReliefSection readReliefSection(const TomlReader& section) {
  ReliefSection relief;
  PatternMap pattern;
  SolidMap solid;
  ImageMap image;
  ProjectedMap projected;
  KeyNames names = namesOfAllKinds<Pattern>("pattern", keysOf);
  names.merge(namesOfAllKinds<relief::SolidPattern>("solid", keysOf));
  for (const StudyKeys& keys :
       {keysOf(relief), keysOf(pattern), keysOf(image), keysOf(projected)}) {
    names.merge(namesOf(keys));
  }
  section.allow(names);
  section.requireOneOf({"pattern", "solid", "image"});
  readKeys(section, keysOf(relief));
  // An even factor would have no texel where an old one was, and so be another function.
  if (relief.resample % 2 == 0) {
    section.fail("resample", fmt::format("{} found, an odd number expected", relief.resample));
  }
  if (section.has("projection")) {
    requireOneRepeat(section, relief);
    readKeys(section, keysOf(projected));
    readKeys(section, keysOf(projected.image));
    projected.image.isChannelNamed = section.has("channel");
    relief.map = projected;
  } else if (section.has("image")) {
    readKeys(section, keysOf(image));
    image.isChannelNamed = section.has("channel");
    relief.map = image;
  } else if (section.has("solid")) {
    requireOneRepeat(section, relief);
    solid.solid = readKind<relief::SolidPattern>(section, "solid", solidNames, keysOf);
    readKeys(section, keysOf(solid));
    relief.map = solid;
  } else {
    pattern.pattern = readKind<Pattern>(section, "pattern", patternNames, keysOf);
    readKeys(section, keysOf(pattern));
    relief.map = pattern;
  }
  return relief;
}

const ImageMap* imageOf(const ReliefSection& relief) {
  if (const auto* map = std::get_if<ProjectedMap>(&relief.map)) return &map->image;
  return std::get_if<ImageMap>(&relief.map);
}

toml::table tableOf(ReliefSection relief) {
  toml::table table = tableOf(allKeysOf(relief));
  if (const auto* map = std::get_if<PatternMap>(&relief.map)) {
    table.insert("pattern", patternNames.at(map->pattern.index()));
  }
  if (const auto* map = std::get_if<SolidMap>(&relief.map)) {
    table.insert("solid", solidNames.at(map->solid.index()));
  }
  return table;
}

std::optional<std::string> heightsFault(const relief::HeightField& field) {
  if (field.minimum() >= -highestRelief && field.maximum() <= highestRelief) return std::nullopt;
  return fmt::format("heights from {:g} to {:g} found, {:g} to {:g} expected", field.minimum(),
                     field.maximum(), -highestRelief, highestRelief);
}

relief::Relief reliefOf(const ReliefSection& relief, const TomlReader& section,
                        const std::filesystem::path& folder, const surface::Cage& cage,
                        const std::function<const surface::LimitSurface&()>& limit) {
  const auto imageAt = [&](const ImageMap& image, double height) {
    return relief::readHeightImage(
        namedFile(section, "image", folder),
        image.isChannelNamed ? std::optional(image.channel) : std::nullopt, height, relief.wrap);
  };
  relief::HeightField field = std::visit(
      Overloaded{[&](const PatternMap& map) {
                   return section.blame("texels", [&] { return heightsOf(map, relief); });
                 },
                 [&](const SolidMap& map) {
                   return section.blame("solid", [&] {
                     return relief::makeSolidMap(limit(), map.texels.x, map.texels.y,
                                                 relief::solidFunction(map.solid), relief.height,
                                                 relief.wrap);
                   });
                 },
                 [&](const ProjectedMap& map) {
                   relief::HeightField image = imageAt(map.image, 1);
                   return section.blame("period", [&] {
                     return relief::makeSolidMap(limit(), map.texels.x, map.texels.y,
                                                 relief::triplanar(std::move(image), map.period),
                                                 relief.height, relief.wrap);
                   });
                 },
                 [&](const ImageMap& map) { return imageAt(map, relief.height); }},
      relief.map);
  if (relief.isInverted) field = relief::inverted(field, relief.height);
  if (const auto fault = heightsFault(field)) section.fail("height", *fault);
  const int resample = relief.resample;
  // Where heights count texels, there are now more of them in the same height.
  const double scale = relief.space == relief::HeightSpace::texture ? resample : 1;
  if (resample != 1) {
    field =
        section.blame("resample", [&] { return relief::resampledHeights(field, resample, scale); });
  }
  relief::Relief made{std::move(field), relief.space, relief.repeats, resample};
  const FacesOfMap faces = facesOfMap(cage, made);
  if (faces.all > 0 && faces.outside == faces.all) {
    section.fail("wrap",
                 "clamp found, but the texture coordinates of all faces lie outside the map, where "
                 "it only continues its border: the surface would be flat. repeat expected, or "
                 "texture coordinates from 0 to 1");
  }
  return made;
}

FacesOfMap facesOfMap(const surface::Cage& cage, const relief::Relief& relief) {
  FacesOfMap faces;
  const std::size_t corners = cage.faceSize();
  for (std::size_t begin = 0; begin < cage.faceUvs.size(); begin += corners) {
    Vec2 low(std::numeric_limits<double>::infinity());
    Vec2 high = -low;
    for (std::size_t corner = begin; corner < begin + corners; ++corner) {
      const Vec2 uv = relief.repeats * cage.uvs[static_cast<std::size_t>(cage.faceUvs[corner])];
      low = glm::min(low, uv);
      high = glm::max(high, uv);
    }
    if (low == high) continue;
    ++faces.all;
    const bool isOutside = high.x <= 0 || high.y <= 0 || low.x >= 1 || low.y >= 1;
    if (isOutside && relief.field.wrap() == relief::Wrap::clamp) ++faces.outside;
  }
  return faces;
}

}  // namespace gnomon::study
