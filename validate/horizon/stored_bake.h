#pragma once

#include "horizon/horizon_bake.h"
#include "horizon/stored_table.h"
#include "horizon/table_file.h"

namespace gnomon::horizon {

/// The tables of `bakeHorizons` as `storeTable` stores them, to the byte, without ever holding
/// them as floats. Codes of 8 and 16 bits need the tables' extremes first, so these are baked
/// twice: twice the time for a quarter or half of the memory.
/// @throws as `bakeHorizons`
StoredHorizons bakeStoredHorizons(const relief::HeightField& field, const BakeSettings& settings,
                                  TableBits bits, const Progress& progress = {});

}  // namespace gnomon::horizon
