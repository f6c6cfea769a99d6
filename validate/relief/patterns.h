#pragma once

#include <cstdint>

#include "relief/height_field.h"

namespace gnomon {

/// Reliefs as functions, sampled at texel centres; values 0 to 1 times `height`. All tile where
/// `period` divides the map's sides. Lengths in texels. See each for its formula.

/// Cylindrical columns at the centres of a square lattice (Figure 4 of Onoue, Max & Nishita 2004):
/// 1 within `radius` of a centre, 0 outside radius + wall, linear between.
struct ColumnsPattern {
  double period = 32;
  double radius = 8;
  double wall = 1;
};

/// (2 - cos(2πx/period) - cos(2πy/period)) / 4.
struct CosinePattern {
  double period = 32;
};

/// Reptile skin: a jittered lattice of points (from `seed`), one a period × period square;
/// F1 and F2 the distances to the nearest and second nearest; height smoothstep over
/// (F2 - F1) / groove, so that cells are plateaus with rounded rims parted by grooves (Worley
/// 1996).
struct CellsPattern {
  double period = 32;
  double jitter = 0.7;
  double groove = 10;
  std::uint32_t seed = 1;
};

/// Wind ripples on sand: asymmetric ridges across x, gentle on the windward side (a share
/// `windward` of the wavelength) and steep on the lee, whose crest lines meander by `meander`
/// texels.
struct RipplesPattern {
  double period = 16;
  double windward = 0.7;
  double meander = 4;
};

HeightField makeColumns(int width, int height, const ColumnsPattern&, double amplitude, Wrap);
HeightField makeCosine(int width, int height, const CosinePattern&, double amplitude, Wrap);
HeightField makeCells(int width, int height, const CellsPattern&, double amplitude, Wrap);
HeightField makeRipples(int width, int height, const RipplesPattern&, double amplitude, Wrap);

}  // namespace gnomon
