#include "horizon/reference/filtered_table.h"

#include <cmath>

namespace gnomon::horizon {
namespace {

double layerValue(const StoredTable& table, const TableShape& shape, Vec2 texel, int azimuth) {
  const relief::Neighbours column =
      relief::neighbours(texel.x, shape.width, shape.border.x ? relief::Wrap::clamp : shape.wrap);
  const relief::Neighbours row =
      relief::neighbours(texel.y, shape.height, shape.border.y ? relief::Wrap::clamp : shape.wrap);
  const auto entry = [&](int x, int y) {
    return static_cast<double>(table.value(shape.entry(azimuth, x, y)));
  };
  const double low = (1 - column.share) * entry(column.first, row.first) +
                     column.share * entry(column.second, row.first);
  const double high = (1 - column.share) * entry(column.first, row.second) +
                      column.share * entry(column.second, row.second);
  return (1 - row.share) * low + row.share * high;
}

}  // namespace

double filteredValue(const StoredTable& table, const TableShape& shape, Vec2 texel,
                     double azimuth) {
  const double turns = azimuth / (2 * pi);
  const double place = (turns - std::floor(turns)) * shape.layers;
  const int below = static_cast<int>(place);
  const double share = place - below;
  return (1 - share) * layerValue(table, shape, texel, below % shape.layers) +
         share * layerValue(table, shape, texel, (below + 1) % shape.layers);
}

}  // namespace gnomon::horizon
