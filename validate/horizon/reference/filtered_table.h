#pragma once

#include "common/vec.h"
#include "horizon/stored_table.h"
#include "relief/height_field.h"

namespace gnomon {

/// How the entries of a stored horizon or distance table lie: [m][y][x].
struct TableShape {
  int width = 0;
  int height = 0;
  int azimuths = 0;
  Wrap wrap = Wrap::repeat;
  Border border = {};  ///< past it the outermost entries hold
};

/// A table's value as shaders filter it (`filter = "exact"`): linear between texel centres in x and
/// y and between azimuths, in double.
/// @param texel    any finite position, texels
/// @param azimuth  radians, any finite angle
double filteredValue(const StoredTable& table, const TableShape& shape, Vec2 texel, double azimuth);

}  // namespace gnomon
