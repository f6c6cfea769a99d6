#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "horizon/horizon_bake.h"

namespace gnomon::horizon {

// What a bake must be, by brute force in double precision.

inline relief::HeightField sampled(int width, int height, relief::Wrap wrap,
                                   const std::function<double(int, int)>& h) {
  std::vector<float> texels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) texels.push_back(static_cast<float>(h(x, y)));
  }
  return {width, height, texels, wrap};
}

inline relief::HeightField noise(int width, int height, relief::Wrap wrap, unsigned seed = 1,
                                 double offset = 0) {
  std::mt19937 random(seed);
  return sampled(width, height, wrap,
                 [&](int, int) { return offset + static_cast<double>(random()) * 0x1p-32; });
}

/// Noise with plateaus, steps and single peaks: many exact ties.
inline relief::HeightField coarseNoise(int width, int height, relief::Wrap wrap, unsigned seed) {
  std::mt19937 random(seed);
  return sampled(width, height, wrap,
                 [&](int, int) { return 0.5 * static_cast<int>(random() % 3); });
}

inline float horizonAt(const HorizonTables& t, int m, int x, int y) {
  return t.horizon[static_cast<std::size_t>((m * t.height + y) * t.width + x)];
}

inline float distanceAt(const HorizonTables& t, int m, int x, int y) {
  return t.distance[static_cast<std::size_t>((m * t.height + y) * t.width + x)];
}

/// (h(p + r e) - h(p)) / r, by the height field itself, in double precision.
class SlopeAlongRay {
 public:
  SlopeAlongRay(const relief::HeightField& field, Vec2 p, Vec2 e)
      : field_(field), p_(p), e_(e), h0_(field.at(p)) {}
  double operator()(double r) const { return (field_.at(p_ + r * e_) - h0_) / r; }

 private:
  const relief::HeightField& field_;
  Vec2 p_, e_;
  double h0_;
};

struct Supremum {
  double slope, distance;
};

/// The maximum of a slope between two crossings: samples, then a golden section around the best.
inline Supremum maximumBetween(const SlopeAlongRay& slope, double near, double far) {
  constexpr int steps = 24;
  const auto position = [&](int i) { return i == steps ? far : near + (far - near) * i / steps; };
  int best = 1;
  for (int i = 1; i <= steps; ++i) {
    if (slope(position(i)) > slope(position(best))) best = i;
  }
  double a = position(best - 1);
  double b = position(std::min(best + 1, steps));
  if (a <= 0) a = b * 1e-9;
  constexpr double golden = 0.6180339887498949;
  while (b - a > 1e-9) {
    const double c = b - golden * (b - a);
    const double d = a + golden * (b - a);
    if (slope(c) >= slope(d))
      b = d;
    else
      a = c;
  }
  const double middle = 0.5 * (a + b);
  const double sample = position(best);
  return slope(sample) >= slope(middle) ? Supremum{slope(sample), sample}
                                        : Supremum{slope(middle), middle};
}

/// The supremum by brute force: every stretch between lattice lines on its own.
/// Up to a border, or the radius.
inline Supremum bruteForce(const relief::HeightField& field, Vec2 p, Vec2 e, double radius) {
  const auto knownAlong = [&](double place, double way, int size, bool border) {
    if (!border || std::abs(way) < 1e-12) return radius;
    return (way > 0 ? size - place : place) / std::abs(way);
  };
  radius = std::min({radius, knownAlong(p.x, e.x, field.width(), field.border().x),
                     knownAlong(p.y, e.y, field.height(), field.border().y)});
  std::vector<double> ends{radius};
  for (const double component : {std::abs(e.x), std::abs(e.y)}) {
    for (int k = 1; component > 1e-9 && k / component < radius; ++k) ends.push_back(k / component);
  }
  std::sort(ends.begin(), ends.end());
  const SlopeAlongRay slope(field, p, e);
  // The limit r → 0⁺, with the profile's bend taken out.
  Supremum best{2 * slope(1e-5) - slope(2e-5), 0};
  double near = 0;
  for (const double far : ends) {
    if (far - near > 1e-9) {
      const Supremum found = maximumBetween(slope, near, far);
      if (found.slope > best.slope + 1e-9) best = found;
    }
    near = far;
  }
  return best;
}

inline void expectExact(const relief::HeightField& field, const BakeSettings& settings) {
  const HorizonTables tables = bakeHorizons(field, settings);
  const double range = static_cast<double>(field.maximum()) - field.minimum();
  // Float heights and slopes, and the tolerance by which slopes count as equal: all shares of the
  // range, since no crossing is nearer than one texel.
  const double allowed = 3e-6 * range + 1e-9;
  int failures = 0;
  for (int m = 0; m < settings.azimuths; ++m) {
    const double angle = 2 * pi * m / settings.azimuths;
    const Vec2 e(std::cos(angle), std::sin(angle));
    for (int y = 0; y < field.height(); ++y) {
      for (int x = 0; x < field.width(); ++x) {
        const Vec2 p(x + 0.5, y + 0.5);
        const Supremum truth = bruteForce(field, p, e, settings.radiusTexels);
        const double delta = horizonAt(tables, m, x, y);
        const double d = distanceAt(tables, m, x, y);
        const SlopeAlongRay slope(field, p, e);
        const double there = d == 0 ? 2 * slope(1e-5) - slope(2e-5) : slope(d);
        const bool right = std::abs(delta - truth.slope) <= allowed &&
                           std::abs(there - truth.slope) <= allowed && d >= 0 &&
                           d <= settings.radiusTexels * (1 + 1e-6) &&
                           // The smallest that attains it: nothing nearer does.
                           d <= truth.distance + 0.02;
        if (right) continue;
        ADD_FAILURE() << "azimuth " << m << " texel " << x << " " << y << " radius "
                      << settings.radiusTexels << ": slope " << delta << " at " << d << " (there "
                      << there << "), expected " << truth.slope << " at " << truth.distance;
        if (++failures > 5) return;
      }
    }
  }
}

}  // namespace gnomon::horizon
