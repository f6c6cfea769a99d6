#pragma once

#include "relief/height_field.h"

namespace gnomon::relief {

/// Reliefs as functions, sampled at texel centres; values 0 to 1 times `height`. All tile where
/// `period` divides the map's sides. Lengths in texels. See each for its formula.

/// Cylindrical columns at the centres of a square lattice (Figure 4 of Onoue, Max & Nishita 2004):
/// 1 within `radius` of a centre, 0 outside radius + wall, linear between. Centres lie at
/// (i + ½, j + ½) periods.
struct ColumnsPattern {
  double period = 32;
  double radius = 8;
  double wall = 1;
};

/// (2 - cos(2πx/period) - cos(2πy/period)) / 4.
struct CosinePattern {
  double period = 32;
};

/// Reptile skin: rounded scales parted by grooves, the cells of a jittered lattice of points (from
/// `seed`), one a period × period square, every second row of squares shifted by half a square.
/// With F1 the distance to the nearest point P (Worley 1996) and b_i
/// the distances to the bisectors between P and the other points P_i,
///   b = -s log Σ exp(-b_i / s), s = 0.3 groove, at least 0: to the border, with rounded corners
///   smoothstep(b / groove) · (1 - 0.6 (F1 / period)²): a rim as wide as `groove`, a domed top.
struct CellsPattern {
  double period = 32;
  double jitter = 0.5;  ///< 0 to 1: share of its square in which a point may lie
  double groove = 6;
  int seed = 1;  ///< 0 or more
};

/// Wind ripples on sand: asymmetric ridges across x. With t the fractional part of
/// (x + meander · w(x, y)) / period:
///   t < windward: sin(π/2 · t / windward)^1.5, the gentle side
///   else ((1 - t) / (1 - windward))^1.5, the lee, steepest at the crest.
/// w, between -1 and 1, is the sum of three sine waves of which a whole number fits on each side of
/// the map, about 13, 6 and 3.5 periods long in y and 23, 11 and 6 in x.
struct RipplesPattern {
  double period = 16;
  double windward = 0.7;  ///< 0.01 to 0.99: share of the wavelength that rises
  double meander = 6;     ///< texels that crest lines stray at most
};

/// @throws InputError naming the parameter: a period under 1 texel, a length that is negative or
///   over 1e9, a share out of range, an amplitude that is not finite; MemoryError
HeightField makeColumns(int width, int height, const ColumnsPattern&, double amplitude, Wrap);
HeightField makeCosine(int width, int height, const CosinePattern&, double amplitude, Wrap);
HeightField makeCells(int width, int height, const CellsPattern&, double amplitude, Wrap);
HeightField makeRipples(int width, int height, const RipplesPattern&, double amplitude, Wrap);

}  // namespace gnomon::relief
