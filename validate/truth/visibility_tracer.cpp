#include "truth/visibility_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "common/error.h"
#include "common/parallel.h"
#include "truth/embree.h"

namespace gnomon::truth {

namespace {

constexpr std::size_t bandRows = 4;

/// Counts how many of their directions the points of facets see. Rays wait until sixteen are there.
class SeenCounter {
 public:
  SeenCounter(const MicroScene& scene, double rayOffset) : scene_(scene), rayOffset_(rayOffset) {}

  /// @param seen  grows by the number, by the next `finish` at the latest; must live till then
  void add(const Facet& facet, std::span<const Vec3> directions, std::size_t& seen) {
    throwIfCancelled();
    const Vec3 origin = facet.rayOrigin(rayOffset_);
    for (const Vec3& direction : directions) {
      if (facet.facesAwayFrom(direction)) continue;
      counts_[rays_.count] = &seen;
      rays_.add(origin, direction);
      if (rays_.count == RayPacket::size) finish();
    }
  }

  void finish() {
    if (rays_.count == 0) return;
    const auto blocked = scene_.occluded(rays_, embree::Rays::coherent);
    for (std::size_t k = 0; k < rays_.count; ++k) *counts_[k] += blocked[k] ? 0 : 1;
    rays_.count = 0;
  }

 private:
  const MicroScene& scene_;
  double rayOffset_;  ///< world length
  RayBundle rays_{};
  std::array<std::size_t*, RayPacket::size> counts_{};
};

/// What is known of a sample from the hard light and some directions.
enum class Begun : std::uint8_t { nothing, dark, lit, mixed };

/// Every second of a list, from `first` on.
std::vector<Vec3> everySecond(std::size_t first, std::span<const Vec3> list) {
  std::vector<Vec3> some;
  for (std::size_t k = first; k < list.size(); k += 2) some.push_back(list[k]);
  return some;
}

/// Sorts points so that each four packets stand in a strip of the disc and each packet in a part of
/// it: rays of a packet that are nearly parallel visit the same boxes.
std::vector<Vec2> inPatches(std::vector<Vec2> points) {
  constexpr std::size_t strip = 4 * RayPacket::size;
  const auto place = [&](std::size_t k) {
    return points.begin() + static_cast<std::ptrdiff_t>(std::min(k, points.size()));
  };
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) { return a.x < b.x; });
  for (std::size_t k = 0; k < points.size(); k += strip) {
    std::sort(place(k), place(k + strip), [](const Vec2& a, const Vec2& b) { return a.y < b.y; });
  }
  return points;
}

/// The two passes over the points of a view.
/// @tparam FacetOf  gives the facet that holds the point of an index
template <typename FacetOf>
class DiscTracer {
 public:
  /// @param rayOffset  world length
  DiscTracer(const MicroScene& scene, const Mask& hard, const DiscSettings& settings,
             double rayOffset, FacetOf facetOf)
      : scene_(scene),
        hard_(hard),
        rayOffset_(rayOffset),
        facetOf_(facetOf),
        isAdaptive_(settings.isAdaptive),
        begun_(hard.size(), Begun::nothing) {
    const std::vector<Vec3> rim =
        discDirections(settings.light.direction, settings.light.radius, discRim(rimDirections));
    for (const std::size_t k : {0, 1}) rims_[k] = everySecond(k, rim);
    const std::vector<Vec3> all = discDirections(settings.light.direction, settings.light.radius,
                                                 inPatches(discPoints(settings.directions)));
    for (const std::size_t k : {0, 1}) halves_[k] = everySecond(k, all);
  }

  Visibility trace(const Progress& progress) {
    const auto height = static_cast<std::size_t>(hard_.height);
    const std::size_t bands = (height + bandRows - 1) / bandRows;
    CountedProgress done(progress, 2 * bands);
    const auto forEachBand = [&](const auto& work) {
      parallelFor(0, bands, [&](std::size_t band) {
        const FlushDenormals flush;
        work(band * bandRows * width(), std::min(height, (band + 1) * bandRows) * width());
        done.advance();
      });
    };
    forEachBand([this](std::size_t first, std::size_t end) { begin(first, end); });
    Visibility found{hard_.width, hard_.height, std::vector<float>(hard_.size(), noSample)};
    forEachBand([&](std::size_t first, std::size_t end) { finish(first, end, found); });
    return found;
  }

 private:
  [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(hard_.width); }

  /// Half of the rim, the other half at the neighbours in the row and in the column.
  [[nodiscard]] std::span<const Vec3> rimOf(std::size_t i) const { return rims_[colourOf(i)]; }
  [[nodiscard]] std::span<const Vec3> otherRimOf(std::size_t i) const {
    return rims_[1 - colourOf(i)];
  }
  /// As of a chess board's squares.
  [[nodiscard]] std::size_t colourOf(std::size_t i) const {
    return (i % width() + i / width()) % 2;
  }

  /// What the hard light and the rim say of some samples.
  void begin(std::size_t first, std::size_t end) {
    std::vector<std::size_t> seen(end - first, 0);
    SeenCounter counter(scene_, rayOffset_);
    for (std::size_t i = first; isAdaptive_ && i < end; ++i) {
      if (hard_.samples[i] != Shade::none) counter.add(facetOf_(i), rimOf(i), seen[i - first]);
    }
    counter.finish();
    for (std::size_t i = first; i < end; ++i) {
      if (hard_.samples[i] == Shade::none) continue;
      const bool isLit = hard_.samples[i] == Shade::lit;
      const bool agrees = isAdaptive_ && seen[i - first] == (isLit ? rimOf(i).size() : 0);
      begun_[i] = !agrees ? Begun::mixed : isLit ? Begun::lit : Begun::dark;
    }
  }

  /// The shares of some samples. Those that only neighbours call `mixed` are settled by the rest of
  /// the rim and half of the directions, where these agree too.
  void finish(std::size_t first, std::size_t end, Visibility& found) const {
    std::vector<std::size_t> seen(end - first, 0);
    std::vector<std::size_t> seenOfRim(end - first, 0);
    SeenCounter counter(scene_, rayOffset_);
    std::vector<std::size_t> open;
    for (std::size_t i = first; i < end; ++i) {
      if (begun_[i] == Begun::nothing) continue;
      if (isSettled(i)) {
        found.shares[i] = shareOf(begun_[i]);
        continue;
      }
      open.push_back(i);
      counter.add(facetOf_(i), halves_[0], seen[i - first]);
      if (begun_[i] != Begun::mixed) counter.add(facetOf_(i), otherRimOf(i), seenOfRim[i - first]);
    }
    counter.finish();
    std::erase_if(open, [&](std::size_t i) {
      const bool agrees = begun_[i] == Begun::dark
                              ? seen[i - first] + seenOfRim[i - first] == 0
                              : begun_[i] == Begun::lit && seen[i - first] == halves_[0].size() &&
                                    seenOfRim[i - first] == otherRimOf(i).size();
      if (agrees) found.shares[i] = shareOf(begun_[i]);
      return agrees;
    });
    for (const std::size_t i : open) counter.add(facetOf_(i), halves_[1], seen[i - first]);
    counter.finish();
    for (const std::size_t i : open) {
      found.shares[i] = static_cast<float>(seen[i - first]) /
                        static_cast<float>(halves_[0].size() + halves_[1].size());
    }
  }

  /// V of a sample of which all directions say the same.
  static float shareOf(Begun begun) { return begun == Begun::lit ? 1.0F : 0.0F; }

  /// Whether a sample and all its neighbours agree.
  [[nodiscard]] bool isSettled(std::size_t i) const {
    if (begun_[i] == Begun::mixed) return false;
    const auto column = static_cast<int>(i % width());
    const auto row = static_cast<int>(i / width());
    for (int y = std::max(0, row - 1); y < std::min(hard_.height, row + 2); ++y) {
      for (int x = std::max(0, column - 1); x < std::min(hard_.width, column + 2); ++x) {
        const Begun other =
            begun_[static_cast<std::size_t>(y) * width() + static_cast<std::size_t>(x)];
        if (other != Begun::nothing && other != begun_[i]) return false;
      }
    }
    return true;
  }

  const MicroScene& scene_;
  const Mask& hard_;
  double rayOffset_;
  FacetOf facetOf_;
  std::array<std::vector<Vec3>, 2> rims_;    ///< alternate places of the rim
  std::array<std::vector<Vec3>, 2> halves_;  ///< alternate ones of the N directions
  bool isAdaptive_;
  std::vector<Begun> begun_;  ///< one a point
};

/// @throws InternalError unless the mask has one answer for each point of the view
void requireView(const Mask& hard, int width, int height, std::size_t points) {
  if (hard.width == width && hard.height == height && hard.size() == points) return;
  throw InternalError("a mask of another view than the points of a soft light");
}

}  // namespace

Visibility traceVisibility(const MicroMesh& mesh, const MicroScene& scene,
                           const surface::SampleGrid& samples, const Mask& hard,
                           const DiscSettings& settings, const Progress& progress) {
  requireView(hard, samples.width, samples.height, samples.samples.size());
  return DiscTracer(scene, hard, settings, mesh.rayOffset(settings.rayOffset),
                    [&](std::size_t i) { return mesh.facet(samples.samples[i]); })
      .trace(progress);
}

Visibility traceVisibility(const SeenSurface& seen, const MicroScene& scene, const Mask& hard,
                           const DiscSettings& settings, const Progress& progress) {
  requireView(hard, seen.width, seen.height, seen.points.size());
  return DiscTracer(scene, hard, settings, seen.rayOffset,
                    [&](std::size_t i) { return seen.points[i].facet; })
      .trace(progress);
}

ShareChange shareChange(const Visibility& a, const Visibility& b) {
  if (a.width != b.width || a.height != b.height || a.size() != b.size()) {
    throw InternalError("change of shares between maps of different sizes");
  }
  std::vector<double> changes;
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a.shares[i]) || std::isnan(b.shares[i])) continue;
    changes.push_back(
        std::abs(static_cast<double>(a.shares[i]) - static_cast<double>(b.shares[i])));
    sum += changes.back();
  }
  if (changes.empty()) return {};
  // In integers: ⌈0.99 n⌉ of them do not exceed it.
  const auto percentile = [&](std::size_t perMille) {
    const std::size_t place = (perMille * changes.size() + 999) / 1000 - 1;
    std::nth_element(changes.begin(), changes.begin() + static_cast<std::ptrdiff_t>(place),
                     changes.end());
    return changes[place];
  };
  return {sum / static_cast<double>(changes.size()), percentile(990), percentile(999)};
}

double uncertaintyOf(const Truth& truth, const Truth& coarse) {
  return truth.isSoft() ? shareChange(truth.visibility, coarse.visibility).mean
                        : flipRate(truth.mask, coarse.mask);
}

double brightening(const Truth& truth, const Truth& coarse) {
  if (truth.mask.size() != coarse.mask.size() || truth.isSoft() != coarse.isSoft()) {
    throw InternalError("change of light between truths of different views");
  }
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < truth.mask.size(); ++i) {
    const auto lightOf = [i](const Truth& one) {
      return one.isSoft() ? static_cast<double>(one.visibility.shares[i])
                          : (one.mask.samples[i] == Shade::lit ? 1.0 : 0.0);
    };
    if (truth.mask.samples[i] == Shade::none || coarse.mask.samples[i] == Shade::none) continue;
    sum += lightOf(coarse) - lightOf(truth);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

namespace {

/// Where that share of the unit disc's area lies on the left.
double placeOfArea(double share) {
  double low = -1;
  double high = 1;
  for (int i = 0; i < 52; ++i) {
    const double middle = (low + high) / 2;
    (discShare(middle) < share ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Moves one coordinate of every point to the middle of the N-th of the area that its rank says.
void spreadAlong(double Vec2::*axis, std::vector<Vec2>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return points[a].*axis < points[b].*axis; });
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    points[order[rank]].*axis =
        placeOfArea((static_cast<double>(rank) + 0.5) / static_cast<double>(order.size()));
  }
}

/// The axes of a disc: x along the horizon of the xy plane, y toward +z.
struct DiscAxes {
  Vec3 level, upward;
};

DiscAxes axesOf(const Vec3& centre) {
  const bool isUpright = std::hypot(centre.x, centre.y) < 1e-9;
  const Vec3 level = isUpright ? Vec3(1, 0, 0) : glm::normalize(glm::cross(Vec3(0, 0, 1), centre));
  return {level, glm::cross(centre, level)};
}

}  // namespace

std::vector<Vec2> discPoints(int count) {
  const double golden = pi * (3 - std::sqrt(5.0));
  std::vector<Vec2> points;
  for (int k = 0; k < count; ++k) {
    const double radius = std::sqrt((k + 0.5) / count);
    points.emplace_back(radius * std::cos(k * golden), radius * std::sin(k * golden));
  }
  spreadAlong(&Vec2::x, points);
  spreadAlong(&Vec2::y, points);
  for (Vec2& point : points) point /= std::max(1.0, glm::length(point));
  return points;
}

std::vector<Vec2> discRim(int count) {
  std::vector<Vec2> points;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * pi * k / count;
    points.emplace_back(std::cos(angle), std::sin(angle));
  }
  return points;
}

std::vector<Vec3> discDirections(const Vec3& centre, double radius, std::span<const Vec2> points) {
  const auto [level, upward] = axesOf(centre);
  std::vector<Vec3> directions;
  directions.reserve(points.size());
  for (const Vec2& point : points) {
    // h = 1 - cos a, and √(h (2 - h)) = sin a; both by way of h / r², which is right for r = 0.
    const double heightOverArea = 2 * std::pow(std::sin(radius / 2), 2);
    const double height = glm::dot(point, point) * heightOverArea;
    const Vec2 aside = std::sqrt(heightOverArea * (2 - height)) * point;
    directions.push_back(
        glm::normalize((1 - height) * centre + aside.x * level + aside.y * upward));
  }
  return directions;
}

Vec3 lowestOfDisc(const Light& light) {
  const auto& [centre, radius, name, angles] = light;
  if (radius == 0) return centre;
  return std::cos(radius) * centre - std::sin(radius) * axesOf(centre).upward;
}

}  // namespace gnomon::truth
