#include "relief/solid.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/lists.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "relief/patterns.h"
#include "surface/curvature.h"
#include "surface/texel_frame.h"
#include "surface/texture_layout.h"

namespace gnomon::relief {

namespace {

using Cell = glm::vec<3, std::int64_t>;

Cell cellOf(const Vec3& p) {
  return Cell(glm::floor(p));
}

/// A number in [0, 1) for a point of a lattice.
double hashedCell(const Cell& cell, std::uint32_t salt) {
  const auto word = [](std::int64_t k) { return static_cast<std::uint32_t>(k); };
  // The third coordinate goes in by way of the salt, mixed by itself first.
  const double third = hashed(word(cell.z), salt, 0x5BD1E995U);
  return hashed(word(cell.x), word(cell.y), static_cast<std::uint32_t>(third * 0x1p32));
}

/// The dot product with one of the twelve edges of a cube (Perlin 2002).
double alongEdge(std::size_t edge, const Vec3& v) {
  const std::size_t zero = edge / 4;  // the axis that the edge's direction has nothing of
  const double a = v[static_cast<int>((zero + 1) % 3)];
  const double b = v[static_cast<int>((zero + 2) % 3)];
  return (edge % 2 == 0 ? a : -a) + (edge / 2 % 2 == 0 ? b : -b);
}

double fade(double t) {
  return t * t * t * (t * (6 * t - 15) + 10);
}

/// Gradient noise of period 1, about -1 to 1.
double noise(const Vec3& p, std::uint32_t salt) {
  const Cell cell = cellOf(p);
  const Vec3 within = p - Vec3(cell);
  const Vec3 share(fade(within.x), fade(within.y), fade(within.z));
  double value = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Cell step(corner & 1, corner >> 1 & 1, corner >> 2);
    const auto edge = static_cast<std::size_t>(12 * hashedCell(cell + step, salt));
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis) {
      weight *= step[axis] == 1 ? share[axis] : 1 - share[axis];
    }
    value += weight * alongEdge(edge, within - Vec3(step));
  }
  return value;
}

double noiseHeight(const SolidNoise& made, const Vec3& point) {
  double sum = 0;
  double weights = 0;
  double weight = 1;
  double frequency = 1 / made.period;
  for (int octave = 0; octave < made.octaves; ++octave) {
    // Shifted, so that the lattices of two octaves have no point in common where all is 0.
    const Vec3 shift = static_cast<double>(octave) * Vec3(0.37, 0.71, 0.13);
    const auto salt = static_cast<std::uint32_t>(made.seed) * 31U + static_cast<unsigned>(octave);
    sum += weight * noise(frequency * point + shift, salt);
    weights += weight;
    weight *= made.gain;
    frequency *= 2;
  }
  return std::clamp(0.5 + 0.5 * sum / weights, 0.0, 1.0);
}

/// The jittered point of a cube, in periods.
Vec3 pointOf(const SolidCells& made, const Cell& cell) {
  const std::uint32_t salt = 3 * static_cast<std::uint32_t>(made.seed);
  const Vec3 random(hashedCell(cell, salt), hashedCell(cell, salt + 1), hashedCell(cell, salt + 2));
  return Vec3(cell) + 0.5 + made.jitter * (random - 0.5);
}

double cellsHeight(const SolidCells& made, const Vec3& point) {
  const Vec3 p = point / made.period;
  const Cell home = cellOf(p);
  // The two nearest points are less than two cubes away.
  constexpr int reach = 2;
  constexpr std::size_t side = 2 * reach + 1;
  std::array<Vec3, side * side * side> points;
  std::size_t count = 0;
  for (int z = -reach; z <= reach; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) points[count++] = pointOf(made, home + Cell(x, y, z));
    }
  }
  const auto nearest = std::min_element(points.begin(), points.end(), [&p](auto& a, auto& b) {
    return glm::dot(a - p, a - p) < glm::dot(b - p, b - p);
  });
  std::array<double, points.size()> fromBisectors;
  std::transform(points.begin(), points.end(), fromBisectors.begin(), [&](const Vec3& other) {
    const double apart = glm::length(other - *nearest);
    return apart > 0 ? glm::dot(0.5 * (*nearest + other) - p, other - *nearest) / apart : 10.0;
  });
  const double groove = made.groove / made.period;
  const double fromBorder = std::max(softMinimum(fromBisectors, 0.3 * groove), 0.0);
  return cellHeight(glm::length(*nearest - p), fromBorder, 1, groove);
}

}  // namespace

SolidFunction solidFunction(const SolidPattern& solid) {
  return std::visit(
      Overloaded{[](const SolidNoise& made) -> SolidFunction {
                   requireLength("period", made.period);
                   requireBetween("octaves", made.octaves, 1, 16);
                   requireBetween("gain", made.gain, 0, 1);
                   return [made](const Vec3& point) { return noiseHeight(made, point); };
                 },
                 [](const SolidCells& made) -> SolidFunction {
                   requireLength("period", made.period);
                   requireBetween("jitter", made.jitter, 0, 1);
                   requireLength("groove", made.groove);
                   return [made](const Vec3& point) { return cellsHeight(made, point); };
                 },
                 [](const SolidRipples& made) -> SolidFunction {
                   requireLength("period", made.period);
                   requireBetween("windward", made.windward, 0.01, 0.99);
                   requireBetween("meander", made.meander, 0, longestOfPatterns);
                   const double length = glm::length(made.direction);
                   if (!(length > 0)) throw InputError("a vector of length 0 found", "direction");
                   const Vec3 direction = made.direction / length;
                   const SolidNoise meanders{4 * made.period, 1, 0.5, made.seed};
                   return [made, direction, meanders](const Vec3& point) {
                     const double shift = 2 * noiseHeight(meanders, point) - 1;
                     const double phase =
                         (glm::dot(point, direction) + made.meander * shift) / made.period;
                     return rippleProfile(phase - std::floor(phase), made.windward);
                   };
                 }},
      solid);
}

namespace {

double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// A face as it lies on the map: the bilinear image of [0, 1]² with corners at (0, 0), (1, 0),
/// (1, 1), (0, 1), texels.
class FaceOnMap {
 public:
  FaceOnMap(const surface::LimitFace& face, Vec2 texelsPerUv)
      : corners_{face.at(0, 0).uv * texelsPerUv, face.at(1, 0).uv * texelsPerUv,
                 face.at(1, 1).uv * texelsPerUv, face.at(0, 1).uv * texelsPerUv} {}

  [[nodiscard]] Vec2 least() const {
    return bound([](auto a, auto b) { return glm::min(a, b); });
  }
  [[nodiscard]] Vec2 most() const {
    return bound([](auto a, auto b) { return glm::max(a, b); });
  }
  [[nodiscard]] bool hasArea() const {
    return cross(corners_[2] - corners_[0], corners_[3] - corners_[1]) != 0;
  }

  /// Whether a place lies inside, not on the border: exact.
  [[nodiscard]] bool holds(Vec2 place) const {
    // To the same side of all edges, or, beside a reflex corner, in a triangle.
    int turns = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      turns += surface::orientation(corners_.at(k), corners_.at((k + 1) % 4), place);
    }
    if (std::abs(turns) == 4) return true;
    const std::vector<surface::TextureTriangle> triangles = surface::trianglesOf(corners_);
    return std::any_of(triangles.begin(), triangles.end(),
                       [&](const auto& triangle) { return surface::isInside(triangle, place); });
  }

  /// The face's nearest place with its parameters, and how far it is: 0 for a place on the face.
  struct Nearest {
    Vec2 parameters{0};
    Vec2 place{0};
    double distance = std::numeric_limits<double>::infinity();
  };
  [[nodiscard]] Nearest nearest(Vec2 place) const {
    if (const Vec2 inside = inverse(place); isParameter(inside)) {
      return {inside, place, 0};
    }
    constexpr std::array<Vec2, 4> at = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
    Nearest best;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t next = (k + 1) % 4;
      const Vec2 side = corners_[next] - corners_[k];
      const double square = glm::dot(side, side);
      const double share =
          square > 0 ? std::clamp(glm::dot(place - corners_[k], side) / square, 0.0, 1.0) : 0.0;
      const Vec2 foot = corners_[k] + share * side;
      const double distance = glm::length(foot - place);
      if (distance < best.distance) best = {glm::mix(at[k], at[next], share), foot, distance};
    }
    return best;
  }

 private:
  template <typename Pick>
  [[nodiscard]] Vec2 bound(const Pick& pick) const {
    return pick(pick(corners_[0], corners_[1]), pick(corners_[2], corners_[3]));
  }

  static bool isParameter(Vec2 p) { return p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1; }

  /// (s, t) at which e s + f t + g s t = h, with h the place from the first corner: a root of
  /// (g × f) t² + (e × f + h × g) t + h × e. Without a root in the face, a place outside it.
  [[nodiscard]] Vec2 inverse(Vec2 place) const {
    const Vec2 e = corners_[1] - corners_[0];
    const Vec2 f = corners_[3] - corners_[0];
    const Vec2 g = corners_[0] - corners_[1] + corners_[2] - corners_[3];
    const Vec2 h = place - corners_[0];
    const double a = cross(g, f);
    const double b = cross(e, f) + cross(h, g);
    const double c = cross(h, e);
    const auto at = [&](double t) {
      const Vec2 along = e + t * g;
      const Vec2 rest = h - t * f;
      const bool byX = std::abs(along.x) > std::abs(along.y);
      return Vec2(byX ? rest.x / along.x : rest.y / along.y, t);
    };
    const double root = b * b - 4 * a * c;
    if (!(root >= 0)) return Vec2(-1);
    // The form of the quadratic's roots that loses no digits where a is small.
    const double q = -0.5 * (b + std::copysign(std::sqrt(root), b));
    const Vec2 first = q != 0 ? at(c / q) : Vec2(-1);
    if (isParameter(first)) return first;
    return a != 0 ? at(q / a) : Vec2(-1);
  }

  std::array<Vec2, 4> corners_;
};

/// A place of a face that a texel may take its height from.
struct Claim {
  int face = -1;
  glm::vec2 parameters{0};
  glm::vec2 beyond{0};  ///< from that place to the texel's centre, texels
};

/// The claim that a texel's height is taken from.
struct Owner {
  float distance = std::numeric_limits<float>::infinity();
  Claim claim;
  bool isDisputed = false;  ///< another face that holds the texel's centre asks for another height
};

class Owners {
 public:
  Owners(int width, int height, Wrap wrap)
      : width_(width),
        height_(height),
        wrap_(wrap),
        owners_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  /// Offers a face all texels within the margin.
  /// @param agree  whether two claims on one texel ask for the same height
  template <typename Agree>
  void offer(int face, const FaceOnMap& map, const Agree& agree) {
    const Vec2 size(width_, height_);
    Vec2 low = map.least() - solidMargin;
    Vec2 high = map.most() + solidMargin;
    if (wrap_ == Wrap::clamp) {
      low = glm::max(low, Vec2(0));
      high = glm::min(high, size);
    }
    for (double j = std::ceil(low.y - 0.5); j + 0.5 <= high.y; ++j) {
      for (double i = std::ceil(low.x - 0.5); i + 0.5 <= high.x; ++i) {
        const Vec2 centre(i + 0.5, j + 0.5);
        const auto nearest = map.nearest(centre);
        Owner& owner = at(i, j);
        if (nearest.distance > solidMargin) continue;
        const Claim claim = {face, nearest.parameters, centre - nearest.place};
        if (static_cast<float>(nearest.distance) < owner.distance) {
          owner = {static_cast<float>(nearest.distance), claim};
        } else if (nearest.distance == 0 && !owner.isDisputed && map.holds(centre)) {
          owner.isDisputed = !agree(owner.claim, claim);
        }
      }
    }
  }

  [[nodiscard]] const std::vector<Owner>& list() const { return owners_; }

  /// Of the texels whose centre a face holds, the share that two ask different heights of.
  [[nodiscard]] double disputedShare() const {
    const auto owned = std::count_if(owners_.begin(), owners_.end(),
                                     [](const Owner& owner) { return owner.distance == 0; });
    const auto disputed = std::count_if(owners_.begin(), owners_.end(),
                                        [](const Owner& owner) { return owner.isDisputed; });
    return disputed > 0 ? static_cast<double>(disputed) / static_cast<double>(owned) : 0;
  }

 private:
  Owner& at(double i, double j) {
    const Vec2 size(width_, height_);
    const Vec2 wrapped = Vec2(i, j) - glm::floor(Vec2(i, j) / size) * size;
    return owners_[static_cast<std::size_t>(wrapped.y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(wrapped.x)];
  }

  int width_, height_;
  Wrap wrap_;
  std::vector<Owner> owners_;
};

/// n₀ + S T, of length 1.
Vec3 turnedNormal(const surface::LimitFace& face, Vec2 parameters, const Vec3& normal,
                  const Vec3& tangent) {
  const double length = glm::length(tangent);
  if (!(length > 0)) return normal;
  const surface::LimitPoint point = face.evaluate(parameters.x, parameters.y);
  return glm::normalize(normal + length * surface::applyShapeOperator(point, tangent));
}

}  // namespace

HeightField makeSolidMap(const surface::LimitSurface& surface, int width, int height,
                         const SolidFunction& solid, double amplitude, Wrap wrap) {
  const SurfaceFunction ofPoint = [&](const Vec3& point, const Vec3&) { return solid(point); };
  return makeSolidMap(surface, width, height, ofPoint, amplitude, wrap);
}

HeightField makeSolidMap(const surface::LimitSurface& surface, int width, int height,
                         const SurfaceFunction& solid, double amplitude, Wrap wrap) {
  requireMap(width, height, amplitude);
  const Vec2 texelsPerUv(width, height);
  const double texels = texelsPerUv.x * texelsPerUv.y;
  requireMemory(texels * (sizeof(Owner) + sizeof(float)),
                fmt::format("a solid on a map of {} × {} texels", width, height));
  const std::vector<surface::LimitFace> faces =
      surface::limitFaces(surface, static_cast<std::size_t>(texels));
  const auto valueAt = [&](const Claim& claim) {
    const surface::LimitFace& face = faces[static_cast<std::size_t>(claim.face)];
    const Vec2 parameters(claim.parameters);
    const surface::TangentPoint point = face.at(parameters.x, parameters.y);
    const surface::TexelFrame frame = surface::tangentFrame(point, texelsPerUv);
    const Vec2 past(claim.beyond);
    const Vec3 beyond = past.x * frame.px + past.y * frame.py;
    // Of polygons the direction, which both sides of a hard edge share.
    const Vec3& normal = point.ownDirection == Vec3(0) ? frame.normal : point.ownDirection;
    return solid(frame.position + beyond, turnedNormal(face, parameters, normal, beyond));
  };
  const auto agree = [&](const Claim& a, const Claim& b) {
    return amplitude == 0 || std::abs(valueAt(a) - valueAt(b)) <= solidStep;
  };
  Owners owners(width, height, wrap);
  for (std::size_t face = 0; face < faces.size(); ++face) {
    const FaceOnMap map(faces[face], texelsPerUv);
    if (map.hasArea()) owners.offer(static_cast<int>(face), map, agree);
  }
  if (const double share = owners.disputedShare(); share > mostDisputed) {
    throw InputError(fmt::format(
        "{:.3g} % of the surface's texels are asked for two heights, since charts of the texture "
        "overlap there: charts that share no texels expected, or a `pattern` or an `image` without "
        "`projection`",
        100 * share));
  }
  const std::vector<Owner>& list = owners.list();
  return sampledMap(width, height, amplitude, wrap, [&](Vec2 centre) {
    const auto column = static_cast<std::size_t>(centre.x);
    const auto row = static_cast<std::size_t>(centre.y);
    const Owner& owner = list[row * static_cast<std::size_t>(width) + column];
    return owner.claim.face < 0 ? 0.0 : valueAt(owner.claim);
  });
}

namespace {

/// Zigzag between 0 and `side`: x itself from 0 to `side`, then back.
double mirrored(double x, double side) {
  const double along = x - 2 * side * std::floor(x / (2 * side));
  return along <= side ? along : 2 * side - along;
}

/// The outermost half texels hold their value: there neighbours of both sides are alike.
double mirroredAt(const HeightField& image, Vec2 place) {
  const double x = std::clamp(mirrored(place.x, image.width()), 0.5, image.width() - 0.5);
  const double y = std::clamp(mirrored(place.y, image.height()), 0.5, image.height() - 0.5);
  return image.at({x, y});
}

/// Equal weights where there is no normal.
Vec3 weightsOf(const Vec3& normal) {
  const Vec3 squares = normal * normal;
  const Vec3 powers = squares * squares;
  const double sum = powers.x + powers.y + powers.z;
  return sum > 0 ? powers / sum : Vec3(1.0 / 3);
}

}  // namespace

SurfaceFunction triplanar(HeightField image, double period) {
  requireLength("period", period);
  const double texelsPerUnit = image.width() / period;
  return [image = std::move(image), texelsPerUnit](const Vec3& point, const Vec3& normal) {
    const Vec3 place = texelsPerUnit * point;
    const Vec3 weights = weightsOf(normal);
    return weights.x * mirroredAt(image, {place.y, place.z}) +
           weights.y * mirroredAt(image, {place.z, place.x}) +
           weights.z * mirroredAt(image, {place.x, place.y});
  };
}

}  // namespace gnomon::relief
