#pragma once

#include "common/progress.h"
#include "common/raw_vector.h"
#include "horizon/stored_table.h"
#include "relief/height_field.h"

namespace gnomon::horizon {

struct BakeSettings {
  int azimuths = 32;          ///< M ≥ 1: directions φ_m = 2πm/M, counter-clockwise from +x
  double radiusTexels = 128;  ///< D > 0: how far occluders are searched
};

/// Horizons of the *flat* relief, per texel centre p and azimuth m (e the unit vector of φ_m):
///   horizon  δ = sup over 0 < r ≤ D of (h(p + r e) - h(p)) / r, height units per texel: the
///            tangent of the horizon angle (Max 1988)
///   distance d = the smallest r that attains it, texels; 0 where the supremum is the limit r → 0⁺,
///            the directional derivative (Onoue, Max & Nishita 2004, Fig. 1)
/// A ray ends where the relief is no longer known (`HeightField::knownLength`), if that is nearer
/// than D.
/// One layer an azimuth.
struct HorizonTables : TableShape {
  double radiusTexels = 0;
  RawVector<float> horizon;
  RawVector<float> distance;
};

/// Exact suprema of the bilinear function (up to float rounding): along a ray inside one cell h is
/// A + B r + C r², so that the slope's extremum is at a crossing or at r = √((A - h₀) / C). Both
/// tables in one sweep, on all threads; results depend neither on their number nor on the
/// processor's vectors (unless the heights span less than about 1e-36, where floats lose digits).
///
/// δ is the greatest of these slopes. A slope found at r counts as equal to it if it is less by no
/// more than 2⁻²⁰ (highest - lowest) / max(r, 1), about what float rounding may add to either; d is
/// the smallest r with such a slope. So d is 0 on a plane and at the near end of anything that
/// rises evenly.
/// @throws InputError for settings out of range (messages call them `azimuths` and `radius`) or
///   heights more than 1e34 apart; MemoryError naming `azimuths` if the tables cannot fit
HorizonTables bakeHorizons(const relief::HeightField& field, const BakeSettings& settings,
                           const Progress& progress = {});

/// The tables of `bakeHorizons` as `storeTable` stores them, to the byte, without ever holding
/// them as floats. Codes of 8 and 16 bits need the tables' extremes first, so these are baked
/// twice: twice the time for a quarter or half of the memory.
/// @throws as `bakeHorizons`
StoredHorizons bakeStoredHorizons(const relief::HeightField& field, const BakeSettings& settings,
                                  TableBits bits, const Progress& progress = {});

}  // namespace gnomon::horizon
