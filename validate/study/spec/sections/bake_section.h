#pragma once

#include "common/vec.h"
#include "horizon/horizon_bake.h"
#include "horizon/stored_table.h"
#include "study/spec/sections/study_key.h"

namespace gnomon::study {

/// `[bake]`: the tables that methods read.
struct BakeSpec {
  horizon::BakeSettings settings;
  horizon::TableBits bits = horizon::TableBits::eight;
  double angleLimit = pi / 2;  ///< of horizon angles: the largest off the normal, radians
};

/// @param resample  as Relief::resample: the file counts texels of the map before it
inline StudyKeys keysOf(BakeSpec& bake, int resample) {
  using enum Enters;
  const std::vector<std::pair<horizon::TableBits, std::string>> bits = {
      {horizon::TableBits::eight, "8"},
      {horizon::TableBits::sixteen, "16"},
      {horizon::TableBits::thirtyTwo, "32"}};
  return {studyKey("azimuths", &bake.settings.azimuths, "directions of a table", {1, 1024}, {},
                   horizons | shotAngles),
          studyKey("radius", numbers(bake.settings.radiusTexels, resample),
                   "texels: how far tables are searched and maps are marched", {0, 1e5, true},
                   "by the rule of the search radius", horizons | search),
          studyKey("bits", chosenName(bake.bits, bits, true), "of a table's entry", {}, {}, codes),
          studyKey("limit", degrees(bake.angleLimit),
                   "degrees: largest horizon angle off the normal, of methods that store angles",
                   {1, 180}, {}, flatAngles | shotAngles)};
}

}  // namespace gnomon::study
