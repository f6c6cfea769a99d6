#include "horizon/angle_table.h"

#include <algorithm>
#include <cmath>

namespace gnomon::horizon {

AngleTable horizonAngles(const HorizonTables& tables, double limit, double texelsPerHeight) {
  AngleTable result{tables, limit, std::vector<float>(tables.horizon.size())};
  std::transform(
      tables.horizon.begin(), tables.horizon.end(), result.angles.begin(), [&](float slope) {
        return static_cast<float>(std::min(std::atan2(1.0, texelsPerHeight * slope), limit));
      });
  return result;
}

}  // namespace gnomon::horizon
