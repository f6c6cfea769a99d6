#include "compare/boundaries.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "common/parallel.h"
#include "compare/answer_pair.h"
#include "compare/contour.h"

namespace gnomon::compare {
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

/// A candidate's contour beside the truth's.
struct Outline {
  Contour contour;
  std::vector<BoundaryDistance> distances;       ///< of its sides to the truth's contour
  std::vector<BoundaryDistance> truthDistances;  ///< of the truth's sides to its contour
  std::vector<RowShares> rows;                   ///< of each half row

  /// Over all rows, from the top down.
  [[nodiscard]] Shares shares(std::size_t tolerance) const {
    Shares sum;
    for (const RowShares& row : rows) sum += row.at(tolerance);
    return sum;
  }
};

/// Compares a group of candidates (see answer_pair.h), to which the truth's contour is the same.
class Comparison {
 public:
  Comparison(std::span<const Mask* const> candidates, const Mask& truth, const SampleLayout& layout)
      : candidates_(candidates),
        truth_(truth),
        layout_(layout),
        rooms_(layout),
        contour_(contourOf(truth, *candidates.front(), layout)),
        outlines_(candidates.size()) {
    parallelFor(0, outlines_.size(), [&](std::size_t c) {
      Outline& outline = outlines_[c];
      outline.contour = contourOf(*candidates[c], truth, layout);
      outline.distances.resize(outline.contour.size());
      outline.truthDistances.resize(contour_.size());
      outline.rows.resize(halfRows());
    });
  }

  /// Fills all distances and sums. Rows are independent of each other.
  const std::vector<Outline>& measure() {
    constexpr std::size_t rowsAtOnce = 128;
    parallelFor(0, (halfRows() + rowsAtOnce - 1) / rowsAtOnce, [&](std::size_t strip) {
      const std::size_t first = strip * rowsAtOnce;
      const std::size_t end = std::min(first + rowsAtOnce, halfRows());
      ContourDistances toTruth(contour_, layout_, static_cast<int>(first));
      std::vector<ContourDistances> toCandidates;
      toCandidates.reserve(outlines_.size());
      for (const Outline& outline : outlines_) {
        toCandidates.emplace_back(outline.contour, layout_, static_cast<int>(first));
      }
      for (std::size_t row = first; row < end; ++row) {
        for (std::size_t c = 0; c < outlines_.size(); ++c)
          measureRow(row, c, toCandidates[c], toTruth);
      }
    });
    return outlines_;
  }

 private:
  [[nodiscard]] std::size_t halfRows() const { return contour_.rowStarts.size() - 1; }

  void measureRow(std::size_t row, std::size_t c, ContourDistances& toCandidate,
                  ContourDistances& toTruth) {
    Outline& outline = outlines_[c];
    RowShares& shares = outline.rows[row];
    measureSides(row, outline.contour, toTruth, outline.distances, shares);
    measureSides(row, contour_, toCandidate, outline.truthDistances, shares);
    if (row % 2 == 0) measureSamples(row, *candidates_[c], toCandidate, toTruth, shares);
  }

  void measureSides(std::size_t row, const Contour& contour, ContourDistances& other,
                    std::vector<BoundaryDistance>& distances, RowShares& rowShares) const {
    if (contour.rowStarts[row] == contour.rowStarts[row + 1]) return;
    const int halfRow = static_cast<int>(row);
    other.moveTo(halfRow);
    const double length = row % 2 == 0 ? layout_.rowStep : layout_.columnStep;
    for (std::size_t i = contour.rowStarts[row]; i < contour.rowStarts[row + 1]; ++i) {
      // Among tiles no distance is stated, and all that counts is near.
      const double distance = layout_.tileSide == 0 ? other.from(contour.columns[i])
                                                    : other.fromNearby(contour.columns[i]);
      distances[i] = {distance, length};
      for (std::size_t t = 0; t < tolerances; ++t) {
        const double tolerance = boundaryTolerances.at(t);
        if (!rooms_.isRoomy(contour.columns[i], halfRow, tolerance)) continue;
        Shares& shares = rowShares.at(t);
        shares.sides += length;
        if (isWithin(distance, tolerance)) shares.near += length;
      }
    }
  }

  void measureSamples(std::size_t row, const Mask& candidate, ContourDistances& toCandidate,
                      ContourDistances& toTruth, RowShares& rowShares) const {
    const int halfRow = static_cast<int>(row);
    toCandidate.moveTo(halfRow);
    toTruth.moveTo(halfRow);
    const auto width = static_cast<std::size_t>(truth_.width);
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t i = row / 2 * width + column;
      const Shade ours = candidate.samples[i];
      const Shade theirs = truth_.samples[i];
      if (!isAnswer(ours) || !isAnswer(theirs)) continue;
      const auto place = static_cast<int>(2 * column);
      constexpr double never = std::numeric_limits<double>::infinity();
      const double our = ours == Shade::shadowed ? toCandidate.fromNearby(place) : never;
      const double their = theirs == Shade::shadowed ? toTruth.fromNearby(place) : never;
      if (isWithin(std::min(our, their), boundaryTolerances.back())) {
        addSample(place, halfRow, our, their, rowShares);
      }
    }
  }

  void addSample(int halfColumn, int halfRow, double our, double their,
                 RowShares& rowShares) const {
    for (std::size_t t = 0; t < tolerances; ++t) {
      const double tolerance = boundaryTolerances.at(t);
      const bool inOurs = isWithin(our, tolerance);
      const bool inTheirs = isWithin(their, tolerance);
      if (!(inOurs || inTheirs) || !rooms_.isRoomy(halfColumn, halfRow, tolerance)) continue;
      Shares& shares = rowShares.at(t);
      ++shares.any;
      if (inOurs && inTheirs) ++shares.both;
    }
  }

  std::span<const Mask* const> candidates_;
  const Mask& truth_;
  const SampleLayout& layout_;
  Rooms rooms_;
  Contour contour_;  ///< the truth's
  std::vector<Outline> outlines_;
};
static_assert(ContourDistances::nearby > boundaryTolerances.back());

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
std::string_view noDistanceReason(const Outline& found, const SampleLayout& layout) {
  if (layout.tileSide > 0) return facesApart;
  if (found.distances.empty()) return onlyTruth;
  if (found.truthDistances.empty()) return onlyCandidate;
  return {};
}

std::vector<Metric> metricsOf(const Outline& found, const SampleLayout& layout) {
  static const std::vector<MetricId> ids = metricsOfKinds({MetricKind::boundary});
  std::vector<Metric> metrics;
  const auto add = [&](std::string_view reason, const auto& value) {
    Metric metric{ids[metrics.size()], {}, reason};
    if (reason.empty()) metric.value = value();
    metrics.push_back(metric);
  };
  const bool isEmpty = found.distances.empty() && found.truthDistances.empty();
  const std::string_view none = isEmpty ? noBoundary : std::string_view();
  const std::string_view apart = isEmpty ? none : noDistanceReason(found, layout);
  add(apart, [&] { return averageDistance(found.distances, found.truthDistances); });
  add(apart, [&] {
    return std::max(percentileDistance(found.distances), percentileDistance(found.truthDistances));
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

}  // namespace

std::vector<Metric> compareBoundaries(const Mask& candidate, const Mask& truth,
                                      const SampleLayout& layout) {
  const std::array<const Mask*, 1> one = {&candidate};
  return compareBoundaries(one, truth, layout).front();
}

std::vector<std::vector<Metric>> compareBoundaries(std::span<const Mask* const> candidates,
                                                   const Mask& truth, const SampleLayout& layout) {
  return compareInGroups(candidates, truth, [&](std::span<const Mask* const> group) {
    Comparison comparison(group, truth, layout);
    const std::vector<Outline>& outlines = comparison.measure();
    std::vector<std::vector<Metric>> found(group.size());
    parallelFor(0, group.size(), [&](std::size_t c) { found[c] = metricsOf(outlines[c], layout); });
    return found;
  });
}

const std::vector<std::string_view>& boundaryReasons() {
  static const std::vector<std::string_view> reasons = {
      facesApart, onlyTruth, onlyCandidate, noBoundary, noneNear, noneOnTile, allAtBorder};
  return reasons;
}

}  // namespace gnomon::compare
