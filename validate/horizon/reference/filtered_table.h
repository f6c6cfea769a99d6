#pragma once

#include "common/vec.h"
#include "horizon/stored_table.h"
#include "horizon/table_shape.h"

namespace gnomon::horizon {

/// A table's value as shaders filter it (`filter = "exact"`): linear between texel centres in x and
/// y and between azimuths, in double.
/// @param texel    any finite position, texels
/// @param azimuth  radians, any finite angle
double filteredValue(const StoredTable& table, const TableShape& shape, Vec2 texel, double azimuth);

}  // namespace gnomon::horizon
