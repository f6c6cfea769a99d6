#include "horizon/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::horizon {

namespace {

/// A position as a node and an offset from it in [0, 1), the node where nodes are counted in ints.
struct LatticePlace {
  Node node;
  Vec2 offset;
};

/// A coordinate beyond all that a ray of this radius can tell apart, brought near.
double broughtNear(double x, int size, relief::Wrap wrap, double radius) {
  if (wrap == relief::Wrap::repeat) return x - size * std::floor(x / size);
  return std::clamp(x, -radius - 2, size + radius + 2);
}

LatticePlace placeOf(const relief::HeightField& field, Vec2 origin, double radius) {
  const Vec2 near(broughtNear(origin.x, field.width(), field.wrap(), radius),
                  broughtNear(origin.y, field.height(), field.wrap(), radius));
  Vec2 corner = glm::floor(near - 0.5);
  Vec2 offset = near - 0.5 - corner;
  for (int k = 0; k < 2; ++k) {
    // A stretch so short that its slope were rounding.
    constexpr double touching = 1e-9;
    if (offset[k] > 1 - touching) corner[k] += 1;
    if (offset[k] > 1 - touching || offset[k] < touching) offset[k] = 0;
  }
  return {{static_cast<int>(corner.x), static_cast<int>(corner.y)}, offset};
}

/// A ray over the relief, with heights at its crossings.
class ReliefRay {
 public:
  ReliefRay(const relief::HeightField& field, const LatticePlace& place, Vec2 direction,
            double radius)
      : field_(field), place_(place), ray_(cutRay(direction, radius, place.offset)) {}

  [[nodiscard]] const RayCrossings& ray() const { return ray_; }

  [[nodiscard]] double heightAt(const Crossing& crossing) const {
    const double from = at(crossing.from);
    return from + crossing.share * (at(crossing.to) - from);
  }

  /// At a distance within the cell of that node.
  [[nodiscard]] double heightIn(Node cell, double distance) const {
    const Vec2 inside = place_.offset + distance * ray_.direction - Vec2(cell.x, cell.y);
    const double low = at(cell) + inside.x * (at({cell.x + 1, cell.y}) - at(cell));
    const Node upper{cell.x, cell.y + 1};
    const double high = at(upper) + inside.x * (at({upper.x + 1, upper.y}) - at(upper));
    return low + inside.y * (high - low);
  }

  /// C of the parabola A + B r + C r² that the relief is in that cell.
  [[nodiscard]] double bend(Node cell) const {
    const double twist = at(cell) - at({cell.x + 1, cell.y}) - at({cell.x, cell.y + 1}) +
                         at({cell.x + 1, cell.y + 1});
    return twist * ray_.direction.x * ray_.direction.y;
  }

  /// The first cell that the ray runs through.
  [[nodiscard]] Node firstCell() const {
    return ray_.crossings.empty() ? ray_.lastCell : ray_.crossings.front().cell;
  }

  /// The limit of the slope, r → 0⁺.
  [[nodiscard]] double startingSlope() const {
    const Node cell = firstCell();
    const Vec2 inside = place_.offset - Vec2(cell.x, cell.y);
    const double lower = at({cell.x + 1, cell.y}) - at(cell);
    const double upper = at({cell.x + 1, cell.y + 1}) - at({cell.x, cell.y + 1});
    const double left = at({cell.x, cell.y + 1}) - at(cell);
    const double right = at({cell.x + 1, cell.y + 1}) - at({cell.x + 1, cell.y});
    return ray_.direction.x * (lower + inside.y * (upper - lower)) +
           ray_.direction.y * (left + inside.x * (right - left));
  }

 private:
  [[nodiscard]] double at(Node node) const {
    return field_.texel(place_.node.x + node.x, place_.node.y + node.y);
  }

  const relief::HeightField& field_;
  LatticePlace place_;
  RayCrossings ray_;
};

/// The greatest slope so far, with the rule of `bakeHorizons` for what counts as greater.
class Highest {
 public:
  Highest(double slope, double range) : best_{slope, 0}, tolerance_(0x1p-20 * range) {}

  void offer(double slope, double distance) {
    if (slope > best_.slope + tolerance_ / std::max(best_.distance, 1.0)) best_ = {slope, distance};
  }

  [[nodiscard]] const FlatHorizon& best() const { return best_; }

 private:
  FlatHorizon best_;
  double tolerance_;
};

/// A stretch of the profile inside one cell.
struct CellStretch {
  ProfilePoint from, to;
  double bend;  ///< C
};

/// Offers the slope's extremum inside a stretch, at r = √((A - h₀) / C): a maximum where A < h₀.
void offerInside(const CellStretch& stretch, double start, Highest& highest) {
  if (!(stretch.bend < 0)) return;
  const auto [near, far, c] = stretch;
  const double b = (far.height - near.height) / (far.distance - near.distance) -
                   c * (near.distance + far.distance);
  const double a = near.height - near.distance * (b + c * near.distance);
  const double r = std::sqrt(std::max(0.0, (a - start) / c));
  if (r > near.distance && r < far.distance) highest.offer((a - start) / r + b + c * r, r);
}

}  // namespace

HeightProfile heightProfile(const relief::HeightField& field, Vec2 origin, Vec2 direction,
                            double radius, double behind) {
  HeightProfile profile{origin, direction, {}};
  const LatticePlace place = placeOf(field, origin, std::max(radius, behind));
  if (behind > 0) {
    const ReliefRay back(field, place, -direction, behind);
    profile.points.push_back({-behind, back.heightIn(back.ray().lastCell, behind)});
    const auto& crossings = back.ray().crossings;
    for (auto crossing = crossings.rbegin(); crossing != crossings.rend(); ++crossing) {
      if (crossing->leave < behind) {
        profile.points.push_back({-crossing->leave, back.heightAt(*crossing)});
      }
    }
  }
  const ReliefRay ahead(field, place, direction, radius);
  profile.points.push_back({0, ahead.heightIn(ahead.firstCell(), 0)});
  for (const Crossing& crossing : ahead.ray().crossings) {
    profile.points.push_back({crossing.leave, ahead.heightAt(crossing)});
  }
  if (ahead.ray().lastEnter < radius) {
    profile.points.push_back({radius, ahead.heightIn(ahead.ray().lastCell, radius)});
  }
  return profile;
}

FlatHorizon flatHorizon(const relief::HeightField& field, Vec2 origin, Vec2 direction,
                        double radius) {
  radius = std::min(radius, field.knownLength(origin, direction));
  const ReliefRay ahead(field, placeOf(field, origin, radius), direction, radius);
  const double start = ahead.heightIn(ahead.firstCell(), 0);
  Highest highest(ahead.startingSlope(), static_cast<double>(field.maximum()) - field.minimum());
  ProfilePoint from{0, start};
  const auto follow = [&](Node cell, ProfilePoint to) {
    // In the first cell A = h₀: the slope B + C r has its ends alone.
    if (from.distance > 0) offerInside({from, to, ahead.bend(cell)}, start, highest);
    highest.offer((to.height - start) / to.distance, to.distance);
    from = to;
  };
  for (const Crossing& crossing : ahead.ray().crossings) {
    follow(crossing.cell, {crossing.leave, ahead.heightAt(crossing)});
  }
  if (ahead.ray().lastEnter < radius) {
    const Node cell = ahead.ray().lastCell;
    follow(cell, {radius, ahead.heightIn(cell, radius)});
  }
  return highest.best();
}

namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

/// Below this angle sine and tangent are the angle itself, to double precision.
constexpr double smallAngle = 1e-8;

/// Of 1 + κh: no bump in a bowl reaches the circle's centre.
constexpr double leastGround = 1e-3;

}  // namespace

double smallAngleHorizon(const HorizonLookups& at) {
  return at.slope * (1 - at.curvature * at.height) - at.curvature * at.arcLength / 2;
}

double unreducedHorizon(const HorizonLookups& at) {
  const double angle = at.curvature * at.arcLength;
  if (std::abs(angle) > pi / 2) return nothing;
  // Above and below divided by R + h = (1 + κh) / κ; 2 sin(γ/2) cos(γ/2) = sin γ.
  const double ground = std::max(1 + at.curvature * at.height, leastGround);
  const double shrink = std::abs(angle) < smallAngle ? 1 : angle / std::tan(angle);
  return at.slope / ground * shrink - std::tan(angle / 2);
}

double osculatingHorizon(const HorizonLookups& at) {
  const double angle = at.curvature * at.arcLength;
  if (std::abs(angle) > pi / 2) return nothing;
  // With cos γ = 1 - 2 sin²(γ/2), to have no difference of two numbers near 1.
  const double peak =
      std::max(1 + at.curvature * (at.height + at.slope * at.arcLength), leastGround);
  const double stretch = std::abs(angle) < smallAngle ? 1 : angle / std::sin(angle);
  return at.slope / peak * stretch - std::tan(angle / 2);
}

double bareHorizon(double curvature, double height) {
  if (!(curvature > 0)) return nothing;
  const double rise = curvature * std::max(height, 0.0);
  return -std::sqrt(rise * (rise + 2));
}

namespace {

/// cos and sin of (π/2) · numerator/denominator, 0 ≤ numerator < denominator, from the first octant
/// so that mirrored azimuths are mirrored exactly.
Vec2 inFirstQuadrant(long long numerator, long long denominator) {
  if (numerator == 0) return {1, 0};
  if (2 * numerator == denominator) return {std::sqrt(0.5), std::sqrt(0.5)};
  const bool upper = 2 * numerator > denominator;
  const long long reduced = upper ? denominator - numerator : numerator;
  const double angle = pi / 2 * (static_cast<double>(reduced) / static_cast<double>(denominator));
  const Vec2 e(std::cos(angle), std::sin(angle));
  return upper ? Vec2(e.y, e.x) : e;
}

/// Lattice nodes as the ray sees them: mirrored so that it runs toward +x and +y.
struct Mirror {
  int x, y;
  [[nodiscard]] Node node(int i, int j) const { return {x * i, y * j}; }
  [[nodiscard]] Node cell(int i, int j) const {
    return {x > 0 ? i : -(i + 1), y > 0 ? j : -(j + 1)};
  }
};

}  // namespace

Vec2 azimuthDirection(int azimuth, int azimuths) {
  const long long quarters = 4LL * azimuth;
  const Vec2 e = inFirstQuadrant(quarters % azimuths, azimuths);
  switch ((quarters / azimuths) % 4) {
    case 0:
      return e;
    case 1:
      return {-e.y, e.x};
    case 2:
      return {-e.x, -e.y};
    default:
      return {e.y, -e.x};
  }
}

RayCrossings cutRay(Vec2 direction, double radius, Vec2 offset) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const Vec2 e = glm::abs(direction);
  const Mirror mirror{direction.x < 0 ? -1 : 1, direction.y < 0 ? -1 : 1};
  const Vec2 origin = offset * Vec2(mirror.x, mirror.y);
  RayCrossings ray{direction, {}, radius, {}, 0};
  ray.crossings.reserve(static_cast<std::size_t>(radius * (e.x + e.y)) + 2);
  double r = 0;
  // The next vertical and horizontal line; the ray is in cell (i - 1, j - 1).
  int i = static_cast<int>(std::floor(origin.x)) + 1;
  int j = static_cast<int>(std::floor(origin.y)) + 1;
  while (true) {
    const double vertical = e.x > 0 ? (i - origin.x) / e.x : never;
    const double horizontal = e.y > 0 ? (j - origin.y) / e.y : never;
    const double next = std::min(vertical, horizontal);
    if (next > radius) break;
    Crossing c{r, next, mirror.cell(i - 1, j - 1), {}, {}, 0};
    if (vertical == horizontal) {
      c.from = c.to = mirror.node(i++, j++);
    } else if (vertical < horizontal) {
      c.from = mirror.node(i, j - 1);
      c.to = mirror.node(i, j);
      c.share = std::clamp(origin.y + (i - origin.x) * (e.y / e.x) - (j - 1), 0.0, 1.0);
      ++i;
    } else {
      c.from = mirror.node(i - 1, j);
      c.to = mirror.node(i, j);
      c.share = std::clamp(origin.x + (j - origin.y) * (e.x / e.y) - (i - 1), 0.0, 1.0);
      ++j;
    }
    ray.crossings.push_back(c);
    r = next;
  }
  ray.lastCell = mirror.cell(i - 1, j - 1);
  ray.lastEnter = r;
  return ray;
}

namespace {

double layerValue(const StoredTable& table, const TableShape& shape, Vec2 texel, int azimuth) {
  const relief::Neighbours column =
      relief::neighbours(texel.x, shape.width, shape.border.x ? relief::Wrap::clamp : shape.wrap);
  const relief::Neighbours row =
      relief::neighbours(texel.y, shape.height, shape.border.y ? relief::Wrap::clamp : shape.wrap);
  const auto entry = [&](int x, int y) {
    return static_cast<double>(table.value(shape.entry(azimuth, x, y)));
  };
  const double low = (1 - column.share) * entry(column.first, row.first) +
                     column.share * entry(column.second, row.first);
  const double high = (1 - column.share) * entry(column.first, row.second) +
                      column.share * entry(column.second, row.second);
  return (1 - row.share) * low + row.share * high;
}

}  // namespace

double filteredValue(const StoredTable& table, const TableShape& shape, Vec2 texel,
                     double azimuth) {
  const double turns = azimuth / (2 * pi);
  const double place = (turns - std::floor(turns)) * shape.layers;
  const int below = static_cast<int>(place);
  const double share = place - below;
  return (1 - share) * layerValue(table, shape, texel, below % shape.layers) +
         share * layerValue(table, shape, texel, (below + 1) % shape.layers);
}

}  // namespace gnomon::horizon
