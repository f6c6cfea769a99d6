#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "common/parallel.h"
#include "render/render_scene.h"

namespace gnomon::test {

/// What rays through the triangles of a displaced mesh say of a view's pixels.
class Rays {
 public:
  explicit Rays(const DisplacedScene& scene, int subdivisions)
      : mesh_(scene.displaced.mesh), cuts_(subdivisions) {
    for (std::size_t i = 0; i < mesh_.triangleCount(); ++i) {
      const Vec3 a = corner(i, 0);
      triangles_.push_back({a, corner(i, 1) - a, corner(i, 2) - a});
      for (const int k : {0, 1, 2}) extent_ = std::max(extent_, glm::length(corner(i, k)));
    }
  }

  /// lit, shadowed, or none where a pixel lies so near to an edge of anything that rounding
  /// decides.
  /// @param grazing  facets whose cosine to the light is smaller are left out
  [[nodiscard]] Mask mask(const surface::SampleGrid& samples, const Vec3& light,
                          double grazing = 1e-4) const {
    Mask result{samples.width, samples.height,
                std::vector<Shade>(samples.samples.size(), Shade::none)};
    const std::vector<Obstacle> obstacles = obstaclesOf(light);
    parallelFor(0, samples.samples.size(), [&](std::size_t i) {
      if (samples.samples[i].face >= 0) {
        result.samples[i] = shadeOf(samples.samples[i], light, obstacles, grazing);
      }
    });
    return result;
  }

 private:
  struct Triangle {
    Vec3 corner, along, across;
  };

  /// A triangle with what all rays of one direction have in common.
  struct Obstacle {
    Triangle triangle;
    Vec3 p;
    double volume;
  };

  /// All triangles but those that the direction lies in.
  [[nodiscard]] std::vector<Obstacle> obstaclesOf(const Vec3& direction) const {
    std::vector<Obstacle> obstacles;
    for (const Triangle& t : triangles_) {
      const Vec3 p = glm::cross(direction, t.across);
      const double volume = glm::dot(t.along, p);
      if (std::abs(volume) >= 1e-12) obstacles.push_back({t, p, volume});
    }
    return obstacles;
  }

  [[nodiscard]] Vec3 corner(std::size_t triangle, int k) const {
    return mesh_.vertices[mesh_.triangles[3 * triangle + static_cast<std::size_t>(k)]]
        .frame.position;
  }

  [[nodiscard]] Shade shadeOf(const surface::SurfaceSample& sample, const Vec3& light,
                              const std::vector<Obstacle>& obstacles, double grazing) const {
    const Vec2 place = Vec2(sample.s, sample.t) * static_cast<double>(cuts_);
    const Vec2 cell = glm::clamp(glm::floor(place), Vec2(0), Vec2(cuts_ - 1));
    const Vec2 in = place - cell;
    // GL snaps corners to 1/256 of a pixel, and triangles here are a few pixels wide.
    constexpr double border = 0.02;
    if (std::min(in.x, in.y) < border || std::max(in.x, in.y) > 1 - border ||
        std::abs(in.x - in.y) < border) {
      return Shade::none;
    }
    const bool upper = in.y > in.x;
    const auto quad = static_cast<std::size_t>(
        (sample.face * cuts_ + static_cast<int>(cell.y)) * cuts_ + static_cast<int>(cell.x));
    const Triangle& own = triangles_[2 * quad + (upper ? 1 : 0)];
    const Vec3 normal = glm::normalize(glm::cross(own.along, own.across));
    const double cosine = glm::dot(normal, light);
    if (std::abs(cosine) < grazing) return Shade::none;
    if (cosine < 0) return Shade::shadowed;
    // (0,0) (1,0) (1,1) below the diagonal, (0,0) (1,1) (0,1) above it.
    const Vec2 share = upper ? Vec2(in.x, in.y - in.x) : Vec2(in.x - in.y, in.y);
    const Vec3 point = own.corner + share.x * own.along + share.y * own.across;
    const double shift = 1e-4 * extent_;
    const Vec3 sideways = shift * glm::normalize(own.along);
    const Vec3 upward = shift * glm::normalize(glm::cross(normal, own.along));
    const bool dark = meets(obstacles, point + 1e-9 * extent_ * normal, light);
    for (const Vec3& move : {sideways, -sideways, upward, -upward}) {
      if (meets(obstacles, point + move + 1e-9 * extent_ * normal, light) != dark)
        return Shade::none;
    }
    return dark ? Shade::shadowed : Shade::lit;
  }

  /// Möller & Trumbore 1997, every triangle of the mesh.
  [[nodiscard]] static bool meets(const std::vector<Obstacle>& obstacles, const Vec3& origin,
                                  const Vec3& direction) {
    for (const auto& [t, p, volume] : obstacles) {
      const Vec3 from = origin - t.corner;
      const double u = glm::dot(from, p) / volume;
      if (u < 0 || u > 1) continue;
      const Vec3 q = glm::cross(from, t.along);
      const double v = glm::dot(direction, q) / volume;
      if (v < 0 || u + v > 1) continue;
      if (glm::dot(t.across, q) / volume > 0) return true;
    }
    return false;
  }

  const surface::BaseMesh& mesh_;
  int cuts_;
  double extent_ = 0;
  std::vector<Triangle> triangles_;
};

inline Camera cameraAt(const Vec3& eye, const Vec3& target, double fov, int side) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.verticalFov = radians(fov);
  camera.width = side;
  camera.height = side;
  camera.up = std::abs(glm::normalize(eye - target).z) > 0.99 ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  return camera;
}

/// How a mask compares with what the rays are sure of.
struct Verdict {
  std::size_t wrong = 0;
  std::size_t lit = 0;
  std::size_t dark = 0;
  std::size_t unsure = 0;
};

inline Verdict judge(const Mask& mask, const Mask& rays, const surface::SampleGrid& samples) {
  Verdict verdict;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    EXPECT_EQ(mask.samples[i] == Shade::none, samples.samples[i].face < 0);
    if (samples.samples[i].face < 0) continue;
    if (rays.samples[i] == Shade::none) {
      ++verdict.unsure;
      continue;
    }
    verdict.wrong += mask.samples[i] != rays.samples[i] ? 1 : 0;
    verdict.lit += rays.samples[i] == Shade::lit ? 1 : 0;
    verdict.dark += rays.samples[i] == Shade::shadowed ? 1 : 0;
  }
  return verdict;
}

/// An arched patch that ends at its rim.
inline surface::Cage arch(int columns, int rows) {
  std::array<Vec3, 16> points{};
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const double rise = (i == 1 || i == 2 ? 12 : 0) + (j == 1 || j == 2 ? 6 : 0);
      points[static_cast<std::size_t>(4 * j + i)] = Vec3(-24 + 16 * i, -24 + 16 * j, rise);
    }
  }
  return surface::makeBezier(points, columns, rows);
}

/// Above the middle, looking down.
inline const Camera fromAbove = cameraAt({0, 0, 100}, {0, 0, 0}, 30, 96);

}  // namespace gnomon::test
