#include "truth/disc_directions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "common/disc_share.h"

namespace gnomon::truth {
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
