#include "compare/contour.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "common/error.h"
#include "common/system/memory.h"

namespace gnomon::compare {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void requireLayout(const SampleLayout& layout, std::size_t samples) {
  requireOnePerSample(layout.breaks.size(), samples, "breaks");
  for (const double step : {layout.columnStep, layout.rowStep}) {
    if (!(step > 0 && std::isfinite(step))) {
      throw InputError(fmt::format("layout: a step of {}, a finite one above 0 expected", step));
    }
  }
  if (layout.tileSide < 0) {
    throw InputError(fmt::format("layout: tiles of side {}, at least 0 expected", layout.tileSide));
  }
}

/// Tells which sides of a mask are its contour.
class Sides {
 public:
  Sides(const Mask& mask, const Mask& other, const SampleLayout& layout)
      : mask_(mask),
        other_(other),
        layout_(layout),
        width_(static_cast<std::size_t>(mask.width)),
        height_(static_cast<std::size_t>(mask.height)),
        tile_(static_cast<std::size_t>(layout.tileSide)) {}

  /// Calls `act(halfColumn)` for the sides of a half row, ascending.
  template <typename Act>
  void visit(std::size_t halfRow, const Act& act) const {
    const std::size_t row = halfRow / 2;
    const bool isBelow = halfRow % 2 == 1;
    if (isBelow && endsTile(row)) return;
    const std::size_t count = isBelow ? width_ : width_ - 1;
    // Most samples are as their neighbours are, which shows fastest for many at once.
    constexpr std::size_t atOnce = 64;
    for (std::size_t first = 0; first < count; first += atOnce) {
      const std::size_t end = std::min(first + atOnce, count);
      const Shade* samples = &mask_.samples[row * width_ + first];
      if (std::memcmp(samples, samples + (isBelow ? width_ : 1), end - first) == 0) continue;
      for (std::size_t column = first; column < end; ++column) {
        const std::size_t i = row * width_ + column;
        if (isSide(i, isBelow ? i + width_ : i + 1, isBelow)) {
          act(static_cast<int>(2 * column + (isBelow ? 0 : 1)));
        }
      }
    }
  }

  [[nodiscard]] std::size_t halfRows() const {
    return width_ == 0 || height_ == 0 ? 0 : 2 * height_ - 1;
  }

 private:
  /// Between a sample and the one to its right or below.
  [[nodiscard]] bool isSide(std::size_t i, std::size_t j, bool isBelow) const {
    return mask_.samples[i] != mask_.samples[j] && hasAnswers(i) && hasAnswers(j) &&
           !isBroken(i, isBelow ? breakBelow : breakRight) && (isBelow || !endsTile(i % width_));
  }
  [[nodiscard]] bool hasAnswers(std::size_t i) const {
    return isAnswer(mask_.samples[i]) && isAnswer(other_.samples[i]);
  }
  [[nodiscard]] bool isBroken(std::size_t i, std::uint8_t which) const {
    return !layout_.breaks.empty() && (layout_.breaks[i] & which) != 0;
  }
  [[nodiscard]] bool endsTile(std::size_t place) const {
    return tile_ > 0 && (place + 1) % tile_ == 0;
  }

  const Mask& mask_;
  const Mask& other_;
  const SampleLayout& layout_;
  std::size_t width_, height_, tile_;
};

/// Fills `columnStarts` and `rows` from the sides row by row: a counting sort.
void orderByColumn(Contour& contour, std::size_t width) {
  std::vector<std::size_t> places(2 * width + 1, 0);
  for (const int column : contour.columns) ++places[static_cast<std::size_t>(column) + 1];
  std::partial_sum(places.begin(), places.end(), places.begin());
  contour.columnStarts = places;
  contour.rows.resize(contour.size());
  for (std::size_t row = 0; row + 1 < contour.rowStarts.size(); ++row) {
    for (std::size_t i = contour.rowStarts[row]; i < contour.rowStarts[row + 1]; ++i) {
      contour.rows[places[static_cast<std::size_t>(contour.columns[i])]++] = static_cast<int>(row);
    }
  }
}

int halfColumns(const Contour& contour) {
  return static_cast<int>(contour.columnStarts.size()) - 1;
}

int halfRows(const Contour& contour) {
  return static_cast<int>(contour.rowStarts.size()) - 1;
}

/// How many steps of a length lie within a distance, at most `most`.
int stepsWithin(double distance, double step, int most) {
  return static_cast<int>(std::min(std::floor(distance / step), static_cast<double>(most)));
}

/// The row of a side that is not there: farther away than any.
constexpr int nowhere = std::numeric_limits<int>::max() / 4;
/// Half columns on either side among which a nearest side is searched one by one.
constexpr int mostColumnsSearched = 256;

/// A block of half columns whose sides are counted together.
int blockOf(int halfColumn) {
  constexpr int columnsOfBlock = 16;
  return halfColumn / columnsOfBlock;
}

void requireSides(std::size_t sides) {
  // Row and column of each; its distance and length, twice while a percentile is found.
  constexpr double bytesPerSide = 2 * sizeof(int) + 4 * sizeof(double);
  requireMemory(bytesPerSide * static_cast<double>(sides),
                fmt::format("boundaries: a contour of {} sides of samples", sides));
}

}  // namespace

Contour contourOf(const Mask& mask, const Mask& other, const SampleLayout& layout) {
  requireSameView(mask, other);
  requireLayout(layout, mask.size());
  const Sides sides(mask, other, layout);
  Contour contour;
  contour.rowStarts.push_back(0);
  for (std::size_t row = 0; row < sides.halfRows(); ++row) {
    sides.visit(row, [&](int column) { contour.columns.push_back(column); });
    contour.rowStarts.push_back(contour.columns.size());
  }
  requireSides(contour.columns.size());
  orderByColumn(contour, static_cast<std::size_t>(mask.width));
  return contour;
}

ContourDistances::ContourDistances(const Contour& contour, const SampleLayout& layout,
                                   int firstHalfRow)
    : contour_(contour),
      columnScale_(layout.columnStep / 2),
      rowScale_(layout.rowStep / 2),
      far_(reachOf(mostColumnsSearched * columnScale_)),
      near_(reachOf(std::min(nearby, far_.distance))),
      halfRow_(firstHalfRow),
      neighbours_(static_cast<std::size_t>(halfColumns(contour)) +
                      2 * static_cast<std::size_t>(far_.columns),
                  {-nowhere, nowhere}),
      next_(static_cast<std::size_t>(halfColumns(contour))),
      nearSides_(static_cast<std::size_t>(blockOf(halfColumns(contour)) + 1)),
      nearBegin_(std::max(0, firstHalfRow - near_.rows)),
      nearEnd_(nearBegin_) {
  const auto rows = contour.rows.begin();
  for (std::size_t column = 0; column < next_.size(); ++column) {
    const std::size_t begin = contour.columnStarts[column];
    const std::size_t end = contour.columnStarts[column + 1];
    const auto next = std::lower_bound(rows + static_cast<std::ptrdiff_t>(begin),
                                       rows + static_cast<std::ptrdiff_t>(end), firstHalfRow);
    next_[column] = static_cast<std::size_t>(next - rows);
    Neighbours& own = neighbours(column);
    if (next_[column] > begin) own.above = contour.rows[next_[column] - 1];
    if (next_[column] < end) own.below = contour.rows[next_[column]];
  }
}

void ContourDistances::moveTo(int halfRow) {
  if (halfRow != halfRow_) hasEnvelope_ = false;
  while (halfRow_ < halfRow) passRow(halfRow_++);
  const int end = std::min(halfRow + near_.rows + 1, halfRows(contour_));
  while (nearEnd_ < end) countRow(nearEnd_++, 1);
  while (nearBegin_ < halfRow - near_.rows) countRow(nearBegin_++, -1);
}

void ContourDistances::passRow(int halfRow) {
  const auto row = static_cast<std::size_t>(halfRow);
  for (std::size_t i = contour_.rowStarts[row]; i < contour_.rowStarts[row + 1]; ++i) {
    const auto column = static_cast<std::size_t>(contour_.columns[i]);
    const std::size_t next = ++next_[column];
    neighbours(column) = {halfRow,
                          next < contour_.columnStarts[column + 1] ? contour_.rows[next] : nowhere};
  }
}

void ContourDistances::countRow(int halfRow, int change) {
  const auto row = static_cast<std::size_t>(halfRow);
  for (std::size_t i = contour_.rowStarts[row]; i < contour_.rowStarts[row + 1]; ++i) {
    nearSides_[static_cast<std::size_t>(blockOf(contour_.columns[i]))] += change;
  }
}

int ContourDistances::gapOf(const Neighbours& neighbours) const {
  return std::min(halfRow_ - neighbours.above, neighbours.below - halfRow_);
}

bool ContourDistances::hasNearSide(int halfColumn) const {
  const int first = blockOf(std::max(0, halfColumn - near_.columns));
  const int last = blockOf(std::min(halfColumn + near_.columns, halfColumns(contour_) - 1));
  for (int block = first; block <= last; ++block) {
    if (nearSides_[static_cast<std::size_t>(block)] > 0) return true;
  }
  return false;
}

ContourDistances::Reach ContourDistances::reachOf(double distance) const {
  return {distance, stepsWithin(distance, columnScale_, mostColumnsSearched),
          stepsWithin(distance, rowScale_, halfRows(contour_))};
}

double ContourDistances::search(int halfColumn, const Reach& reach) const {
  const Neighbours* here =
      &neighbours_[static_cast<std::size_t>(halfColumn) + static_cast<std::size_t>(far_.columns)];
  double nearest = infinity;
  for (int steps = 0; steps <= reach.columns; ++steps) {
    const double along = steps * columnScale_;
    if (along * along >= nearest) break;
    const int gap = std::min(gapOf(here[-steps]), gapOf(here[steps]));
    if (gap > reach.rows) continue;
    const double height = gap * rowScale_;
    nearest = std::min(nearest, along * along + height * height);
  }
  return nearest <= reach.distance * reach.distance ? std::sqrt(nearest) : infinity;
}

double ContourDistances::from(int halfColumn) {
  const double found = search(halfColumn, far_);
  return found < infinity ? found : fromEnvelope(halfColumn);
}

double ContourDistances::fromNearby(int halfColumn) {
  const double found = hasNearSide(halfColumn) ? search(halfColumn, near_) : infinity;
  return found < infinity || near_.distance >= nearby ? found : fromEnvelope(halfColumn);
}

double ContourDistances::fromEnvelope(int halfColumn) {
  if (!hasEnvelope_) envelop();
  if (envelope_.empty()) return infinity;
  const double place = halfColumn * columnScale_;
  while (last_ + 1 < envelope_.size() && envelope_[last_ + 1].from <= place) ++last_;
  while (envelope_[last_].from > place) --last_;
  const Parabola& nearest = envelope_[last_];
  return std::sqrt((place - nearest.place) * (place - nearest.place) + nearest.height);
}

void ContourDistances::envelop() {
  hasEnvelope_ = true;
  envelope_.clear();
  last_ = 0;
  for (std::size_t column = 0; column < next_.size(); ++column) {
    if (contour_.columnStarts[column] == contour_.columnStarts[column + 1]) continue;
    const double height = gapOf(neighbours(column)) * rowScale_;
    add({static_cast<double>(column) * columnScale_, height * height, -infinity});
  }
}

void ContourDistances::add(Parabola parabola) {
  while (!envelope_.empty()) {
    const Parabola& before = envelope_.back();
    // Where both are as high: the new one is lower from there on.
    parabola.from = ((parabola.height + parabola.place * parabola.place) -
                     (before.height + before.place * before.place)) /
                    (2 * (parabola.place - before.place));
    if (parabola.from > before.from) break;
    envelope_.pop_back();
  }
  if (envelope_.empty()) parabola.from = -infinity;
  envelope_.push_back(parabola);
}

}  // namespace gnomon::compare
