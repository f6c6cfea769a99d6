#include "horizon/angle_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/parallel.h"

namespace gnomon::horizon {

AngleTable horizonAngles(const HorizonTables& tables, double limit, double texelsPerHeight) {
  AngleTable result{static_cast<const TableShape&>(tables), limit,
                    std::vector<float>(tables.horizon.size())};
  constexpr std::size_t anglesAtOnce = 1 << 12;
  parallelFor(
      0, result.angles.size(),
      [&](std::size_t i) {
        const double angle = std::atan2(1.0, texelsPerHeight * tables.horizon[i]);
        result.angles[i] = static_cast<float>(std::min(angle, limit));
      },
      anglesAtOnce);
  return result;
}

}  // namespace gnomon::horizon
