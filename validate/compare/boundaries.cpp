#include "compare/boundaries.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "common/parallel.h"
#include "compare/contour.h"
#include "compare/mask_checks.h"

namespace gnomon {
namespace {

constexpr std::size_t tolerances = boundaryTolerances.size();
constexpr double hausdorffShare = 0.95;

bool isWithin(double distance, double tolerance) {
  return distance <= tolerance * (1 + 1e-9);
}

/// Whether a place of an atlas is so far from its tile's border that nothing within `tolerance`
/// lies in another tile.
class Rooms {
 public:
  explicit Rooms(const SampleLayout& layout) : layout_(layout) {}

  [[nodiscard]] bool isRoomy(int halfColumn, int halfRow, double tolerance) const {
    if (layout_.tileSide == 0) return true;
    const double room = std::min(halfSteps(halfColumn) * layout_.columnStep / 2,
                                 halfSteps(halfRow) * layout_.rowStep / 2);
    return room >= tolerance * (1 - 1e-9);
  }

 private:
  /// To the tile's nearer border; the first lies half a step before the first sample.
  [[nodiscard]] int halfSteps(int place) const {
    const int side = 2 * layout_.tileSide;
    const int before = (place + 1) % side;
    return std::min(before, side - before);
  }

  const SampleLayout& layout_;
};

/// A side of one contour, as the other sees it.
struct BoundaryDistance {
  double distance;  ///< to the other contour
  double length;    ///< of the side
};

/// What is added up for one tolerance.
struct Shares {
  double near = 0;   ///< length of both contours within the tolerance of the other
  double sides = 0;  ///< length of both contours
  double both = 0;   ///< samples of C_d ∩ T_d
  double any = 0;    ///< samples of C_d ∪ T_d

  Shares& operator+=(const Shares& other) {
    near += other.near;
    sides += other.sides;
    both += other.both;
    any += other.any;
    return *this;
  }
};
using RowShares = std::array<Shares, tolerances>;

/// One of the two masks, with its contour as the other sees it.
struct Outline {
  Outline(const Mask& shown, const Mask& other, const SampleLayout& layout)
      : mask(shown), contour(contourOf(shown, other, layout)), distances(contour.size()) {}

  const Mask& mask;
  Contour contour;
  std::vector<BoundaryDistance> distances;  ///< of its sides, row by row
};

class Comparison {
 public:
  Comparison(const Mask& candidate, const Mask& truth, const SampleLayout& layout)
      : candidate_(candidate, truth, layout),
        truth_(truth, candidate, layout),
        layout_(layout),
        rooms_(layout),
        rows_(candidate_.contour.rowStarts.size() - 1) {}

  /// Fills all distances and sums. Rows are independent of each other.
  void measure() {
    constexpr std::size_t rowsAtOnce = 64;
    parallelFor(0, (rows_.size() + rowsAtOnce - 1) / rowsAtOnce, [&](std::size_t strip) {
      const std::size_t first = strip * rowsAtOnce;
      ContourDistances toCandidate(candidate_.contour, layout_, static_cast<int>(first));
      ContourDistances toTruth(truth_.contour, layout_, static_cast<int>(first));
      for (std::size_t row = first; row < std::min(first + rowsAtOnce, rows_.size()); ++row) {
        measureSides(row, candidate_, toTruth);
        measureSides(row, truth_, toCandidate);
        if (row % 2 == 0) measureSamples(row, toCandidate, toTruth);
      }
    });
  }

  [[nodiscard]] const std::vector<BoundaryDistance>& candidateDistances() const {
    return candidate_.distances;
  }
  [[nodiscard]] const std::vector<BoundaryDistance>& truthDistances() const {
    return truth_.distances;
  }

  /// Over all rows, from the top down.
  [[nodiscard]] Shares shares(std::size_t tolerance) const {
    Shares sum;
    for (const RowShares& row : rows_) sum += row.at(tolerance);
    return sum;
  }

 private:
  void measureSides(std::size_t row, Outline& from, ContourDistances& other) {
    const Contour& contour = from.contour;
    if (contour.rowStarts[row] == contour.rowStarts[row + 1]) return;
    const int halfRow = static_cast<int>(row);
    other.moveTo(halfRow);
    const double length = row % 2 == 0 ? layout_.rowStep : layout_.columnStep;
    for (std::size_t i = contour.rowStarts[row]; i < contour.rowStarts[row + 1]; ++i) {
      const double distance = other.from(contour.columns[i]);
      from.distances[i] = {distance, length};
      for (std::size_t t = 0; t < tolerances; ++t) {
        const double tolerance = boundaryTolerances.at(t);
        if (!rooms_.isRoomy(contour.columns[i], halfRow, tolerance)) continue;
        Shares& shares = rows_[row].at(t);
        shares.sides += length;
        if (isWithin(distance, tolerance)) shares.near += length;
      }
    }
  }

  void measureSamples(std::size_t row, ContourDistances& toCandidate, ContourDistances& toTruth) {
    const int halfRow = static_cast<int>(row);
    toCandidate.moveTo(halfRow);
    toTruth.moveTo(halfRow);
    const auto width = static_cast<std::size_t>(candidate_.mask.width);
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t i = row / 2 * width + column;
      const Shade ours = candidate_.mask.samples[i];
      const Shade theirs = truth_.mask.samples[i];
      if (!isAnswer(ours) || !isAnswer(theirs)) continue;
      const auto place = static_cast<int>(2 * column);
      constexpr double never = std::numeric_limits<double>::infinity();
      const double our = ours == Shade::shadowed ? toCandidate.from(place) : never;
      const double their = theirs == Shade::shadowed ? toTruth.from(place) : never;
      if (isWithin(std::min(our, their), boundaryTolerances.back())) {
        addSample(place, halfRow, our, their);
      }
    }
  }

  void addSample(int halfColumn, int halfRow, double our, double their) {
    for (std::size_t t = 0; t < tolerances; ++t) {
      const double tolerance = boundaryTolerances.at(t);
      const bool inOurs = isWithin(our, tolerance);
      const bool inTheirs = isWithin(their, tolerance);
      if (!(inOurs || inTheirs) || !rooms_.isRoomy(halfColumn, halfRow, tolerance)) continue;
      Shares& shares = rows_[static_cast<std::size_t>(halfRow)].at(t);
      ++shares.any;
      if (inOurs && inTheirs) ++shares.both;
    }
  }

  Outline candidate_;
  Outline truth_;
  const SampleLayout& layout_;
  Rooms rooms_;
  std::vector<RowShares> rows_;  ///< of each half row
};

double averageDistance(const std::vector<BoundaryDistance>& a,
                       const std::vector<BoundaryDistance>& b) {
  double sum = 0;
  double length = 0;
  for (const auto* distances : {&a, &b}) {
    for (const BoundaryDistance& side : *distances) {
      sum += side.distance * side.length;
      length += side.length;
    }
  }
  return sum / length;
}

/// The smallest distance that the share of the length does not exceed.
double percentileDistance(std::vector<BoundaryDistance> distances) {
  std::sort(
      distances.begin(), distances.end(),
      [](const BoundaryDistance& a, const BoundaryDistance& b) { return a.distance < b.distance; });
  double all = 0;
  for (const BoundaryDistance& side : distances) all += side.length;
  double length = 0;
  for (const BoundaryDistance& side : distances) {
    length += side.length;
    // Up to rounding, so that the order of the sum does not matter.
    if (length >= hausdorffShare * all * (1 - 1e-12)) return side.distance;
  }
  return distances.back().distance;
}

constexpr std::string_view facesApart = "neighbouring faces lie apart in this atlas";
constexpr std::string_view onlyTruth = "only the truth has a boundary";
constexpr std::string_view onlyCandidate = "only the candidate has a boundary";
constexpr std::string_view noBoundary = "neither the truth nor the candidate has a boundary";
constexpr std::string_view noneNear = "no shadow so near a boundary";
constexpr std::string_view noneOnTile =
    "no shadow so near a boundary, and no nearer to a face's border";
constexpr std::string_view allAtBorder = "every boundary is nearer to a face's border";

/// Why there is no distance between two contours, or empty.
std::string_view noDistanceReason(const Comparison& found, const SampleLayout& layout) {
  if (layout.tileSide > 0) return facesApart;
  if (found.candidateDistances().empty()) return onlyTruth;
  if (found.truthDistances().empty()) return onlyCandidate;
  return {};
}

}  // namespace

std::vector<Metric> compareBoundaries(const Mask& candidate, const Mask& truth,
                                      const SampleLayout& layout) {
  Comparison found(candidate, truth, layout);
  found.measure();

  std::vector<Metric> metrics;
  const auto add = [&](std::string_view reason, const auto& value) {
    Metric metric{boundaryMetricNames()[metrics.size()], {}, reason};
    if (reason.empty()) metric.value = value();
    metrics.push_back(metric);
  };
  const bool isEmpty = found.candidateDistances().empty() && found.truthDistances().empty();
  const std::string_view none = isEmpty ? noBoundary : std::string_view();
  const std::string_view apart = isEmpty ? none : noDistanceReason(found, layout);
  add(apart, [&] { return averageDistance(found.candidateDistances(), found.truthDistances()); });
  add(apart, [&] {
    return std::max(percentileDistance(found.candidateDistances()),
                    percentileDistance(found.truthDistances()));
  });
  for (std::size_t t = 0; t < tolerances; ++t) {
    const Shares shares = found.shares(t);
    const bool isDefined = isEmpty || shares.any > 0;
    const std::string_view reason = layout.tileSide == 0 ? noneNear : noneOnTile;
    add(isDefined ? none : reason, [&] { return shares.both / shares.any; });
  }
  for (std::size_t t = 0; t < tolerances; ++t) {
    const Shares shares = found.shares(t);
    const bool isDefined = isEmpty || shares.sides > 0;
    add(isDefined ? none : allAtBorder, [&] { return shares.near / shares.sides; });
  }
  return metrics;
}

bool isBoundaryDistance(std::string_view name) {
  return name == "assd" || name == "hd95";
}

const std::vector<std::string_view>& boundaryMetricNames() {
  static const std::vector<std::string_view> names = {
      "assd",           "hd95",           "boundary_iou_1", "boundary_iou_2",
      "boundary_iou_4", "surface_dice_1", "surface_dice_2", "surface_dice_4"};
  return names;
}

const std::vector<std::string_view>& boundaryReasons() {
  static const std::vector<std::string_view> reasons = {
      facesApart, onlyTruth, onlyCandidate, noBoundary, noneNear, noneOnTile, allAtBorder};
  return reasons;
}

}  // namespace gnomon
