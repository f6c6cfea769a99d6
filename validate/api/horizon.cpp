#include "gnomon/horizon.h"

#include "api/inner/conversions.h"
#include "common/error.h"
#include "horizon/horizon_bake.h"
#include "study/spec/sections/bake_section.h"
#include "study/spec/sections/relief_section.h"

namespace gnomon {
inline namespace api {

relief::HeightField heightFieldOf(const HeightMap& map) {
  relief::HeightField field(map.width, map.height, {map.texels.begin(), map.texels.end()},
                            map.repeats ? relief::Wrap::repeat : relief::Wrap::clamp);
  if (const auto fault = study::heightsFault(field)) throw InputError(*fault);
  return field;
}

HorizonMaps bakeHorizons(const HeightMap& map, int azimuths, double radius,
                         const std::function<void(double share)>& progress) {
  return watched(progress, [&](const auto& tell) {
    study::BakeSpec bake;
    study::readValues(toml::table{{"azimuths", azimuths}, {"radius", radius}}, "horizons",
                      study::keysOf(bake, 1));
    const auto tables = std::make_shared<const horizon::HorizonTables>(
        horizon::bakeHorizons(heightFieldOf(map), bake.settings, tell));
    return HorizonMaps{tables->width,   tables->height,   tables->layers,
                       tables->horizon, tables->distance, tables};
  });
}

}  // namespace api
}  // namespace gnomon
