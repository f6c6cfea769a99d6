// The boundary metrics against their definition, place by place, and identities that follow from
// it.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "compare/boundaries.h"
#include "compare/boundary_values.h"
#include "compare/masks.h"

namespace gnomon::compare {
namespace {

using test::complement;
using test::drawn;
using test::expectAlike;
using test::placeOf;
using test::transposed;
using test::Values;
using test::valuesOf;

// ---- the definition, place by place

/// Masks with discs of shadow and some noise, and how their samples lie.
struct Scene {
  Mask candidate, truth;
  SampleLayout layout;
};

Scene arbitraryScene(bool withTiles = true) {
  const auto width = *rc::gen::inRange(1, 24);
  const auto height = *rc::gen::inRange(1, 24);
  const auto step = rc::gen::element(0.25, 0.5, 0.75, 1.0, 1.5);
  Scene scene;
  scene.layout = {*step, *step, withTiles ? *rc::gen::element(0, 0, 2, 5, 9) : 0, {}};
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const auto below = [&](int bound) {
    return static_cast<int>(random() % static_cast<std::uint32_t>(bound));
  };
  const bool withBreaks = below(2) == 0;
  const bool withGaps = below(2) == 0;
  const int noise = below(3);
  const std::array centre = {below(width), below(height)};
  for (Mask* mask : {&scene.candidate, &scene.truth}) {
    const double radius = below(14);
    *mask = drawn(width, height, [&](int x, int y) {
      return (std::hypot(x - centre[0], y - centre[1]) < radius) != (below(20) < noise);
    });
  }
  for (int i = 0; i < width * height; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (withGaps && below(12) == 0) scene.candidate.samples[at] = Shade::none;
    if (withGaps && below(12) == 0) scene.truth.samples[at] = Shade::none;
    if (withBreaks) {
      scene.layout.breaks.push_back(static_cast<std::uint8_t>(below(5) == 0 ? below(4) : 0));
    }
  }
  return scene;
}

/// A place of the view in its unit, and the distance to the border of its tile.
struct Place {
  double x, y, length, room;
};

class Definition {
 public:
  explicit Definition(const Scene& scene) : scene_(scene) {}

  [[nodiscard]] Values values() const {
    const auto ours = sides(scene_.candidate);
    const auto theirs = sides(scene_.truth);
    Values found(test::boundaryNames().size());
    if (ours.empty() && theirs.empty()) return found;
    if (!ours.empty() && !theirs.empty() && scene_.layout.tileSide == 0) {
      found[0] = (total(ours, theirs) + total(theirs, ours)) / (length(ours) + length(theirs));
      found[1] = std::max(percentile(ours, theirs), percentile(theirs, ours));
    }
    for (std::size_t t = 0; t < boundaryTolerances.size(); ++t) {
      found[2 + t] = bandOverlap(ours, theirs, boundaryTolerances.at(t));
      found[5 + t] = agreement(ours, theirs, boundaryTolerances.at(t));
    }
    return found;
  }

 private:
  [[nodiscard]] Shade at(const Mask& mask, int x, int y) const {
    const auto i = static_cast<std::size_t>(y * mask.width + x);
    const bool known =
        scene_.candidate.samples[i] != Shade::none && scene_.truth.samples[i] != Shade::none;
    return known ? mask.samples[i] : Shade::none;
  }

  [[nodiscard]] Place place(double x, double y, double length) const {
    const SampleLayout& layout = scene_.layout;
    double room = std::numeric_limits<double>::infinity();
    if (layout.tileSide > 0) {
      for (int k = 0; k <= 24; ++k) {
        const double border = k * layout.tileSide - 0.5;
        room = std::min({room, std::abs(x - border) * layout.columnStep,
                         std::abs(y - border) * layout.rowStep});
      }
    }
    return {x * layout.columnStep, y * layout.rowStep, length, room};
  }

  [[nodiscard]] std::vector<Place> sides(const Mask& mask) const {
    const SampleLayout& layout = scene_.layout;
    std::vector<Place> found;
    for (int y = 0; y < mask.height; ++y) {
      for (int x = 0; x < mask.width; ++x) {
        const auto look = [&](int toX, int toY, int flag, double length) {
          if (toX >= mask.width || toY >= mask.height) return;
          const auto i = static_cast<std::size_t>(y * mask.width + x);
          if (!layout.breaks.empty() && (layout.breaks[i] & flag) != 0) return;
          const int tile = layout.tileSide;
          if (tile > 0 && (x / tile != toX / tile || y / tile != toY / tile)) return;
          const Shade a = at(mask, x, y);
          const Shade b = at(mask, toX, toY);
          if (a == Shade::none || b == Shade::none || a == b) return;
          found.push_back(place((x + toX) / 2.0, (y + toY) / 2.0, length));
        };
        look(x + 1, y, breakRight, layout.rowStep);
        look(x, y + 1, breakBelow, layout.columnStep);
      }
    }
    return found;
  }

  static double distance(const Place& from, const std::vector<Place>& to) {
    double least = std::numeric_limits<double>::infinity();
    for (const Place& p : to) least = std::min(least, std::hypot(from.x - p.x, from.y - p.y));
    return least;
  }

  static double length(const std::vector<Place>& sides) {
    double sum = 0;
    for (const Place& side : sides) sum += side.length;
    return sum;
  }

  static double total(const std::vector<Place>& from, const std::vector<Place>& to) {
    double sum = 0;
    for (const Place& side : from) sum += side.length * distance(side, to);
    return sum;
  }

  /// The smallest of all distances that 95 % of the length do not exceed.
  static double percentile(const std::vector<Place>& from, const std::vector<Place>& to) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Place& candidate : from) {
      const double limit = distance(candidate, to);
      double covered = 0;
      for (const Place& side : from) {
        if (distance(side, to) <= limit) covered += side.length;
      }
      if (covered >= 0.95 * length(from) - 1e-9) smallest = std::min(smallest, limit);
    }
    return smallest;
  }

  [[nodiscard]] std::optional<double> bandOverlap(const std::vector<Place>& ours,
                                                  const std::vector<Place>& theirs,
                                                  double d) const {
    double both = 0;
    double any = 0;
    for (int y = 0; y < scene_.truth.height; ++y) {
      for (int x = 0; x < scene_.truth.width; ++x) {
        const Place sample = place(x, y, 1);
        if (sample.room < d) continue;
        const bool inOurs =
            at(scene_.candidate, x, y) == Shade::shadowed && distance(sample, ours) <= d + 1e-9;
        const bool inTheirs =
            at(scene_.truth, x, y) == Shade::shadowed && distance(sample, theirs) <= d + 1e-9;
        both += inOurs && inTheirs ? 1 : 0;
        any += inOurs || inTheirs ? 1 : 0;
      }
    }
    return any > 0 ? std::optional(both / any) : std::nullopt;
  }

  static std::optional<double> agreement(const std::vector<Place>& ours,
                                         const std::vector<Place>& theirs, double d) {
    double near = 0;
    double all = 0;
    for (const auto& [from, to] : {std::pair(&ours, &theirs), {&theirs, &ours}}) {
      for (const Place& side : *from) {
        if (side.room < d) continue;
        all += side.length;
        if (distance(side, *to) <= d + 1e-9) near += side.length;
      }
    }
    return all > 0 ? std::optional(near / all) : std::nullopt;
  }

  const Scene& scene_;
};

/// Throws where a property fails, as RapidCheck wants it.
void requireAlike(const Values& found, const Values& expected) {
  RC_ASSERT(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    RC_LOG() << test::boundaryNames()[i] << ": " << found[i].value_or(-1) << " found, "
             << expected[i].value_or(-1) << " expected\n";
    RC_ASSERT(found[i].has_value() == expected[i].has_value());
    if (found[i]) RC_ASSERT(std::abs(*found[i] - *expected[i]) < 1e-9);
  }
}

TEST(Boundaries, FollowTheirDefinitionOnRandomMasks) {
  EXPECT_TRUE(rc::check([] {
    const Scene scene = arbitraryScene();
    requireAlike(valuesOf(scene.candidate, scene.truth, scene.layout), Definition(scene).values());
  }));
}

/// Larger than the strips in which rows are measured.
TEST(Boundaries, FollowTheirDefinitionOnATallMask) {
  const auto mask = [](double phase) {
    return drawn(9, 150, [=](int x, int y) { return std::sin(0.3 * y + 0.2 * x + phase) > 0.4; });
  };
  const Scene scene{mask(0), mask(0.7), {1.5, 0.5, 0, {}}};
  expectAlike(valuesOf(scene.candidate, scene.truth, scene.layout), Definition(scene).values());
}

// ---- identities

SampleLayout transposedLayout(const SampleLayout& layout, const Mask& mask) {
  SampleLayout turned{layout.rowStep, layout.columnStep, layout.tileSide, {}};
  if (layout.breaks.empty()) return turned;
  for (int x = 0; x < mask.width; ++x) {
    for (int y = 0; y < mask.height; ++y) {
      const int flags = layout.breaks[static_cast<std::size_t>(y * mask.width + x)];
      turned.breaks.push_back(static_cast<std::uint8_t>((flags & 1) * 2 + (flags & 2) / 2));
    }
  }
  return turned;
}

/// Left becomes right.
Mask mirrored(Mask mask) {
  for (auto row = mask.samples.begin(); row != mask.samples.end(); row += mask.width) {
    std::reverse(row, row + mask.width);
  }
  return mask;
}

TEST(Boundaries, AreSymmetricInTheTwoMasks) {
  EXPECT_TRUE(rc::check([] {
    const Scene s = arbitraryScene();
    requireAlike(valuesOf(s.candidate, s.truth, s.layout),
                 valuesOf(s.truth, s.candidate, s.layout));
  }));
}

TEST(Boundaries, DoNotChangeWhenTransposedOrMirrored) {
  EXPECT_TRUE(rc::check([] {
    const Scene s = arbitraryScene();
    const Values found = valuesOf(s.candidate, s.truth, s.layout);
    requireAlike(
        valuesOf(transposed(s.candidate), transposed(s.truth), transposedLayout(s.layout, s.truth)),
        found);
  }));
  EXPECT_TRUE(rc::check([] {
    Scene s = arbitraryScene(false);
    s.layout.breaks.clear();
    requireAlike(valuesOf(mirrored(s.candidate), mirrored(s.truth), s.layout),
                 valuesOf(s.candidate, s.truth, s.layout));
  }));
}

TEST(Boundaries, AMaskAgreesWithItself) {
  EXPECT_TRUE(rc::check([] {
    const Scene s = arbitraryScene(false);
    const Values found = valuesOf(s.truth, s.truth, s.layout);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i]) RC_ASSERT(*found[i] == (i < placeOf("boundary_iou_1") ? 0.0 : 1.0));
    }
  }));
}

TEST(Boundaries, LightHasTheSameContourAsShadow) {
  EXPECT_TRUE(rc::check([] {
    const Scene s = arbitraryScene();
    const Values dark = valuesOf(s.candidate, s.truth, s.layout);
    const Values light = valuesOf(complement(s.candidate), complement(s.truth), s.layout);
    for (const std::string_view name :
         {"assd", "hd95", "surface_dice_1", "surface_dice_2", "surface_dice_4"}) {
      RC_ASSERT(dark[placeOf(name)] == light[placeOf(name)]);
    }
  }));
}

TEST(Boundaries, ScaleWithTheUnit) {
  EXPECT_TRUE(rc::check([] {
    Scene s = arbitraryScene(false);
    const Values found = valuesOf(s.candidate, s.truth, s.layout);
    s.layout.columnStep *= 2;
    s.layout.rowStep *= 2;
    const Values doubled = valuesOf(s.candidate, s.truth, s.layout);
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
      RC_ASSERT(found[i].has_value() == doubled[i].has_value());
      if (found[i]) RC_ASSERT(*doubled[i] == 2 * *found[i]);
    }
    RC_ASSERT(doubled[placeOf("surface_dice_4")] == found[placeOf("surface_dice_2")]);
    RC_ASSERT(doubled[placeOf("boundary_iou_2")] == found[placeOf("boundary_iou_1")]);
  }));
}

TEST(Boundaries, DoNotDependOnThreads) {
  std::mt19937 random(3);
  const auto noise = [&] { return drawn(300, 200, [&](int, int) { return random() % 3 == 0; }); };
  const Mask candidate = noise();
  const Mask truth = noise();
  const SampleLayout layout{0.3, 0.7, 0, {}};
  const Values found = valuesOf(candidate, truth, layout);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(valuesOf(candidate, truth, layout), found);
}

TEST(Boundaries, OfManyCandidatesAtOnceAreThoseOfEach) {
  std::mt19937 random(5);
  const Mask truth = drawn(90, 70, [](int x, int y) { return (x / 11 + y / 13) % 3 == 0; });
  std::vector<Mask> masks;
  for (int k = 0; k < 70; ++k) {
    Mask mask = drawn(90, 70, [k](int x, int y) { return ((x + k) / 11 + y / 13) % 3 == 0; });
    for (Shade& shade : mask.samples) {
      if (k % 10 == 9 && random() % 50 == 0) shade = Shade::none;
    }
    masks.push_back(std::move(mask));
  }
  std::vector<const Mask*> candidates;
  for (const Mask& mask : masks) candidates.push_back(&mask);
  for (const SampleLayout& layout :
       {SampleLayout{}, SampleLayout{0.3, 0.7, 0, {}}, SampleLayout{0.3, 0.7, 10, {}}}) {
    const auto found = compareBoundaries(candidates, truth, layout);
    ASSERT_EQ(found.size(), masks.size());
    for (std::size_t k = 0; k < masks.size(); ++k) {
      const auto alone = compareBoundaries(masks[k], truth, layout);
      ASSERT_EQ(found[k].size(), alone.size());
      for (std::size_t i = 0; i < alone.size(); ++i) {
        EXPECT_EQ(found[k][i].value, alone[i].value) << k << ' ' << alone[i].name();
        EXPECT_EQ(found[k][i].reason, alone[i].reason) << k << ' ' << alone[i].name();
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::compare
