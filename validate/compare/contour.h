#pragma once

#include <cstddef>
#include <vector>

#include "common/mask.h"
#include "compare/answer_metrics.h"

namespace gnomon::compare {

/// The contour of a mask: every side between two samples, one beside or above the other, of which
/// one is lit and the other shadowed. Where it is not known what comes after a sample there is no
/// side: at the image's edge, at a sample without an answer (the silhouette), at a break in the
/// surface, at the border of a tile.
///
/// A side stands at its middle, in half samples: sample (c, r) at (2c, 2r), the side to its right
/// at (2c + 1, 2r), the one below at (2c, 2r + 1). A view of w × h samples has 2h - 1 half rows.
struct Contour {
  std::vector<std::size_t> rowStarts;  ///< of each half row's sides in `columns`, then their count
  std::vector<int> columns;            ///< half columns of all sides, row by row, ascending
  std::vector<std::size_t> columnStarts;  ///< of each half column's sides in `rows`, then the count
  std::vector<int> rows;                  ///< half rows of all sides, column by column, ascending

  [[nodiscard]] std::size_t size() const { return columns.size(); }
};

/// The contour of `mask` among the samples for which `other` has an answer too.
/// @throws InputError if sizes differ, or of the layout's breaks, or for a step that is not above 0
///   and finite, or for tiles of a negative side; MemoryError if the contour does not fit in memory
Contour contourOf(const Mask& mask, const Mask& other, const SampleLayout& layout);

/// Exact Euclidean distances to the nearest side of a contour, one half row at a time.
///
/// Most places asked for lie near the contour. The nearest side is found by looking at the half
/// columns on both sides, at each for the nearest side above and below, until the next column is
/// farther away than what was found. Where no side is found within some hundred steps, the lower
/// envelope of the parabolas that all half columns with a side give (Felzenszwalb & Huttenlocher
/// 2012) is made, once a half row.
class ContourDistances {
 public:
  /// @param contour       must outlive it
  /// @param firstHalfRow  the first that will be asked for
  ContourDistances(const Contour& contour, const SampleLayout& layout, int firstHalfRow);

  /// Goes to a half row, not one above an earlier one.
  void moveTo(int halfRow);

  /// From a place of this half row, in the layout's unit; infinite for a contour without a side.
  [[nodiscard]] double from(int halfColumn);
  /// The same where it is at most `nearby`; anything above that elsewhere.
  [[nodiscard]] double fromNearby(int halfColumn);

  /// How near sides are for `fromNearby`, in the layout's unit.
  static constexpr double nearby = 5;

 private:
  /// The half rows of the sides of a half column that are nearest to this half row.
  struct Neighbours {
    int above, below;  ///< the latter may be in this half row; far away where there is none
  };
  /// How far a side is searched.
  struct Reach {
    double distance;    ///< in the layout's unit
    int columns, rows;  ///< the same in half columns and half rows
  };
  /// Squared distance (x - place)² + height, the lowest of all from x = `from` on.
  struct Parabola {
    double place, height, from;
  };

  [[nodiscard]] Reach reachOf(double distance) const;
  /// To the nearest side, if it is within reach; else infinite.
  [[nodiscard]] double search(int halfColumn, const Reach& reach) const;
  /// Whether any side may be within the near reach.
  [[nodiscard]] bool hasNearSide(int halfColumn) const;
  [[nodiscard]] Neighbours& neighbours(std::size_t halfColumn) {
    return neighbours_[halfColumn + static_cast<std::size_t>(far_.columns)];
  }
  /// In half rows.
  [[nodiscard]] int gapOf(const Neighbours& neighbours) const;
  /// Goes beyond a half row: its sides are above from there on.
  void passRow(int halfRow);
  /// Adds `change` for each of its sides to `nearSides_`.
  void countRow(int halfRow, int change);
  double fromEnvelope(int halfColumn);
  /// Makes that of this half row.
  void envelop();
  void add(Parabola parabola);

  const Contour& contour_;
  double columnScale_, rowScale_;
  Reach far_;   ///< as far as half columns are looked at one by one
  Reach near_;  ///< `nearby`, or the former where that is less
  int halfRow_;
  std::vector<Neighbours> neighbours_;  ///< of each half column, and of far_.columns at either end
  std::vector<std::size_t> next_;       ///< of each half column: its first side not above this row
  /// The number of sides in each block of half columns, in the half rows from nearBegin_ to
  /// nearEnd_.
  std::vector<int> nearSides_;
  int nearBegin_, nearEnd_;   ///< the half rows of near_ about this one
  bool hasEnvelope_ = false;  ///< of this half row
  std::vector<Parabola> envelope_;
  std::size_t last_ = 0;  ///< where in the envelope the last answer was
};

}  // namespace gnomon::compare
