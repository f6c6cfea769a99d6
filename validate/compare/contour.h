#pragma once

#include <cstddef>
#include <vector>

#include "common/mask.h"
#include "compare/sample_layout.h"

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
///   and finite, or for tiles of a negative side; MemoryError if the contour cannot be held
Contour contourOf(const Mask& mask, const Mask& other, const SampleLayout& layout);

/// Exact Euclidean distances to the nearest side of a contour, one half row at a time: first to the
/// nearest side in each half column, then the lower envelope of the parabolas that these give
/// (Felzenszwalb & Huttenlocher 2012). Takes time in proportion to the half columns that hold a
/// side, and to the places asked for.
///
/// Most places asked for lie near the contour, and there only sides near the half row count: so at
/// first only those are taken, and all once a place turns out to be farther away.
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
  /// A half column with a side: its sides in `rows`, the first of them not above this half row.
  struct Column {
    int halfColumn;
    std::size_t begin, end, next;
    double height = 0;  ///< squared distance of the nearest of them, along the column
  };
  /// Squared distance (x - place)² + height, the lowest of all from x = `from` on.
  struct Parabola {
    double place, height, from;
  };

  /// The envelope of the columns that are at most so high.
  void envelop(double height);
  void add(Parabola parabola);

  const Contour& contour_;
  double columnScale_;
  double rowScale_;
  /// Squared: columns that are higher are left out of the envelope at first. Infinite where
  /// distances are rounded, since which of two equally near sides is taken then shows in the last
  /// bit; but not among tiles, where no distance is stated.
  double nearHeight_;
  bool isWhole_ = false;  ///< the envelope is that of all columns
  int halfRow_ = -1;
  std::vector<Column> columns_;
  std::vector<Parabola> envelope_;
  std::size_t last_ = 0;  ///< where in the envelope the last answer was
};

}  // namespace gnomon::compare
