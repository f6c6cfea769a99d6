#include "gnomon/horizon.h"

#include <utility>
#include <vector>

#include "api/inner/height_field_of.h"
#include "api/inner/translated.h"
#include "horizon/horizon_bake.h"

namespace gnomon {
inline namespace api {

relief::HeightField heightFieldOf(const HeightMap& map) {
  return {map.width,
          map.height,
          {map.texels.begin(), map.texels.end()},
          map.repeats ? relief::Wrap::repeat : relief::Wrap::clamp,
          {map.endsInX, map.endsInY}};
}

HorizonMaps bakeHorizons(const HeightMap& map, int azimuths, double radius,
                         const std::function<void(double share)>& progress) {
  return watched(progress, [&](const auto& tell) {
    const auto tables = std::make_shared<const horizon::HorizonTables>(
        horizon::bakeHorizons(heightFieldOf(map), horizon::BakeSettings{azimuths, radius}, tell));
    return HorizonMaps{tables->width,   tables->height,   tables->layers,
                       tables->horizon, tables->distance, tables};
  });
}

}  // namespace api
}  // namespace gnomon
