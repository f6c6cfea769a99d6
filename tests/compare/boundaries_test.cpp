#include "compare/boundaries.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "common/error.h"
#include "compare/masks.h"

namespace gnomon {
namespace {

using test::complement;
using test::row;

constexpr std::string_view neither = "neither the truth nor the candidate has a boundary";

/// A mask drawn row by row, as `test::row` draws one.
Mask picture(const std::vector<std::string_view>& rows) {
  Mask mask{static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), {}};
  for (const std::string_view line : rows) {
    const Mask one = row(line);
    mask.samples.insert(mask.samples.end(), one.samples.begin(), one.samples.end());
  }
  return mask;
}

Mask drawn(int width, int height, const std::function<bool(int, int)>& isDark) {
  Mask mask{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      mask.samples.push_back(isDark(x, y) ? Shade::shadowed : Shade::lit);
    }
  }
  return mask;
}

std::size_t placeOf(std::string_view name) {
  const auto& names = boundaryMetricNames();
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// The values in the order of their names.
using Values = std::vector<std::optional<double>>;

Values valuesOf(const Mask& candidate, const Mask& truth, const SampleLayout& layout = {}) {
  Values values;
  for (const Metric& metric : compareBoundaries(candidate, truth, layout)) {
    values.push_back(metric.value);
  }
  return values;
}

std::string_view reasonOf(std::string_view name, const Mask& candidate, const Mask& truth,
                          const SampleLayout& layout = {}) {
  return compareBoundaries(candidate, truth, layout).at(placeOf(name)).reason;
}

void expectAlike(const Values& found, const Values& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].has_value(), expected[i].has_value()) << boundaryMetricNames()[i];
    if (!found[i]) continue;
    EXPECT_NEAR(*found[i], *expected[i], 1e-12) << boundaryMetricNames()[i];
  }
}

// ---- by hand

TEST(Boundaries, ByHandInARow) {
  // One side each, at 4.5 and 2.5. Bands overlap at last in two samples of six.
  expectAlike(valuesOf(row(".....####"), row("...######")),
              {2.0, 2.0, 0.0, 0.0, 2.0 / 6, 0.0, 1.0, 1.0});
  // The truth's second shadow is missed: its sides, at 7.5 and 8.5, are 4 and 5 from that at 3.5.
  expectAlike(valuesOf(row(".###......."), row(".###....#..")),
              {9.0 / 6, 5.0, 2.0 / 3, 3.0 / 4, 3.0 / 4, 4.0 / 6, 4.0 / 6, 5.0 / 6});
}

TEST(Boundaries, ByHandInThePlane) {
  const Mask truth = picture({".....",  //
                              ".##..",  //
                              ".##..",  //
                              "....."});
  const Mask candidate = picture({".....",  //
                                  ".###.",  //
                                  ".###.",  //
                                  "....."});
  // Of 8 and 10 sides, the right-hand ones are 1 apart; the candidate's over and under the third
  // column are √½ from the truth's right-hand ones, and these as far from their own corners.
  const double apart = 2 * std::sqrt(0.5) + 2 * 1 + 2 * std::sqrt(0.5);
  // Every shadowed sample has a side of its own.
  expectAlike(valuesOf(candidate, truth),
              {apart / 18, 1.0, 4.0 / 6, 4.0 / 6, 4.0 / 6, 1.0, 1.0, 1.0});
}

TEST(Boundaries, ThePercentileLeavesOutAtMostATwentieth) {
  // One side in every fiftieth row, the candidate's as many samples off as there are rows before.
  const auto ladder = [](int rows, int shift) {
    Mask mask = drawn(40, 50 * rows, [&](int x, int y) { return x > 5 + shift * (y / 50); });
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (i / 40 % 50 != 0) mask.samples[i] = Shade::none;
    }
    return mask;
  };
  for (const auto& [rows, expected] : {std::pair(19, 18.0), {20, 18.0}, {21, 19.0}, {30, 28.0}}) {
    const Values found = valuesOf(ladder(rows, 1), ladder(rows, 0));
    EXPECT_EQ(found[placeOf("assd")], (rows - 1) / 2.0) << rows;
    EXPECT_EQ(found[placeOf("hd95")], expected) << rows;
  }
}

TEST(Boundaries, OfAHalfPlaneAndItsShift) {
  for (int k = 0; k <= 6; ++k) {
    const auto plane = [](int shift) {
      return drawn(40, 30, [=](int x, int) { return x >= 15 + shift; });
    };
    for (const double step : {1.0, 0.5}) {
      Values expected = {k * step, k * step};
      for (const double d : boundaryTolerances) {
        const double band = d / step;  // columns
        const double both = std::max(band - k, 0.0);
        expected.emplace_back(both / (2 * band - both));
      }
      for (const double d : boundaryTolerances) expected.emplace_back(k * step <= d ? 1.0 : 0.0);
      expectAlike(valuesOf(plane(k), plane(0), {step, 7.0, 0, {}}), expected);
    }
  }
}

TEST(Boundaries, OfConcentricDiscs) {
  const auto disc = [](double radius) {
    return drawn(201, 201, [=](int x, int y) { return std::hypot(x - 100, y - 100) < radius; });
  };
  const Values found = valuesOf(disc(73), disc(70));
  EXPECT_NEAR(*found[placeOf("assd")], 3, 0.2);
  EXPECT_NEAR(*found[placeOf("hd95")], 3, 0.7);
  EXPECT_EQ(found[placeOf("surface_dice_2")], 0);
  EXPECT_EQ(found[placeOf("surface_dice_4")], 1);
  // Two rings 4 wide, of which one of width 1 is common.
  const auto area = [](double inner, double outer) { return outer * outer - inner * inner; };
  EXPECT_NEAR(*found[placeOf("boundary_iou_4")], area(69, 70) / area(66, 73), 0.03);
}

// ---- what is no boundary

TEST(Boundaries, NeitherEdgeNorSilhouette) {
  const Mask dark = drawn(6, 5, [](int, int) { return true; });
  for (const std::string_view name : boundaryMetricNames()) {
    EXPECT_EQ(reasonOf(name, dark, dark), neither) << name;
    EXPECT_EQ(reasonOf(name, dark, complement(dark)), neither) << name;
  }
  // A shadowed ball before nothing; of the second row's shadows one ends on the surface.
  EXPECT_EQ(reasonOf("assd", row("  ###  "), row("  ###  ")), neither);
  const Mask half = picture({" ### ",  //
                             " ##. "});
  EXPECT_EQ(valuesOf(half, half)[placeOf("boundary_iou_1")], 1);
  // Where the candidate has no answer, the truth has no contour either.
  EXPECT_EQ(reasonOf("assd", row("## .."), row("##...")), neither);
  EXPECT_EQ(reasonOf("assd", row("##..."), row("## ..")), neither);
}

TEST(Boundaries, NoBreakInTheSurface) {
  const Mask mask = picture({"##..",  //
                             "##.."});
  SampleLayout layout;
  layout.breaks = {0, breakRight, 0, 0, 0, breakRight, 0, 0};
  EXPECT_EQ(reasonOf("hd95", mask, mask, layout), neither);
  layout.breaks = {breakBelow, breakRight, 0, 0, 0, breakBelow, 0, 0};
  EXPECT_EQ(valuesOf(mask, mask, layout)[placeOf("hd95")], 0);
}

TEST(Boundaries, OnlyOneMaskHasSome) {
  const Mask even = row("........");
  const Mask split = row("....####");
  const Values expected = {{}, {}, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  expectAlike(valuesOf(even, split), expected);
  expectAlike(valuesOf(split, even), expected);
  EXPECT_EQ(reasonOf("assd", even, split), "only the truth has a boundary");
  EXPECT_EQ(reasonOf("hd95", split, even), "only the candidate has a boundary");
}

TEST(Boundaries, SamplesMayLieTooFarApartForABand) {
  const Mask mask = row("...####");
  const SampleLayout coarse{3, 3, 0, {}};
  expectAlike(valuesOf(mask, mask, coarse), {0.0, 0.0, {}, 1.0, 1.0, 1.0, 1.0, 1.0});
  EXPECT_EQ(reasonOf("boundary_iou_1", mask, mask, coarse), "no shadow so near a boundary");
}

// ---- tiles

TEST(Boundaries, EndAtTheBordersOfTiles) {
  const Mask mask = drawn(16, 8, [](int x, int) { return x < 8; });
  const SampleLayout tiles{1, 1, 8, {}};
  for (const std::string_view name : boundaryMetricNames()) {
    EXPECT_EQ(reasonOf(name, mask, mask, tiles), neither) << name;
  }
  // Where the other tile's contour lies means nothing.
  const Mask left = drawn(16, 8, [](int x, int) { return x >= 6; });
  const Mask right = drawn(16, 8, [](int x, int) { return x < 10; });
  EXPECT_EQ(valuesOf(left, right, tiles)[placeOf("surface_dice_2")], 0);
  EXPECT_EQ(valuesOf(left, right)[placeOf("surface_dice_4")], 1);
}

TEST(Boundaries, InTilesOnlyWhereThereIsRoom) {
  // Down the middle of a tile: rows 1 to 6 are at least 1 from its border, 2 to 5 at least 2.
  const Mask truth = drawn(8, 8, [](int x, int) { return x >= 4; });
  Mask candidate = truth;
  candidate.samples[1 * 8 + 4] = Shade::lit;
  const SampleLayout tile{1, 1, 8, {}};
  const Values found = valuesOf(candidate, truth, tile);
  EXPECT_EQ(found[placeOf("surface_dice_2")], 1);
  EXPECT_EQ(found[placeOf("boundary_iou_1")], 5.0 / 7);
  EXPECT_EQ(found[placeOf("boundary_iou_2")], 1);
  EXPECT_EQ(reasonOf("assd", candidate, truth, tile), "neighbouring faces lie apart in this atlas");
  EXPECT_EQ(reasonOf("surface_dice_4", candidate, truth, tile),
            "every boundary is nearer to a face's border");
  EXPECT_EQ(reasonOf("boundary_iou_4", candidate, truth, tile),
            "no shadow so near a boundary, and no nearer to a face's border");
}

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
    Values found(boundaryMetricNames().size());
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
    RC_LOG() << boundaryMetricNames()[i] << ": " << found[i].value_or(-1) << " found, "
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

/// The picture with its rows as columns.
Mask transposed(const Mask& mask) {
  return {mask.height, mask.width, [&] {
            std::vector<Shade> samples;
            for (int x = 0; x < mask.width; ++x) {
              for (int y = 0; y < mask.height; ++y) {
                samples.push_back(mask.samples[static_cast<std::size_t>(y * mask.width + x)]);
              }
            }
            return samples;
          }()};
}

SampleLayout transposed(const SampleLayout& layout, const Mask& mask) {
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
        valuesOf(transposed(s.candidate), transposed(s.truth), transposed(s.layout, s.truth)),
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

// ---- input

TEST(Boundaries, RefuseWhatDoesNotFit) {
  const Mask mask = row("..##");
  EXPECT_THROW((void)compareBoundaries(mask, row("..#")), InputError);
  EXPECT_THROW((void)compareBoundaries(Mask{4, 1, {}}, mask), InputError);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double step : {0.0, -1.0, nan, infinite}) {
    EXPECT_THROW((void)compareBoundaries(mask, mask, {step, 1, 0, {}}), InputError);
    EXPECT_THROW((void)compareBoundaries(mask, mask, {1, step, 0, {}}), InputError);
  }
  EXPECT_THROW((void)compareBoundaries(mask, mask, {1, 1, -1, {}}), InputError);
  EXPECT_THROW((void)compareBoundaries(mask, mask, {1, 1, 0, {0, 0}}), InputError);
}

TEST(Boundaries, OfMasksWithoutSamples) {
  for (const Mask& empty : {Mask{}, Mask{0, 7, {}}, Mask{7, 0, {}}, row("   ")}) {
    for (const Metric& metric : compareBoundaries(empty, empty)) {
      EXPECT_EQ(metric.reason, neither) << metric.name;
      EXPECT_FALSE(metric.value);
    }
  }
}

TEST(Boundaries, CarryTheirNames) {
  const auto metrics = compareBoundaries(row("..##"), row(".###"));
  ASSERT_EQ(metrics.size(), boundaryMetricNames().size());
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    EXPECT_EQ(metrics[i].name, boundaryMetricNames()[i]);
    EXPECT_TRUE(metrics[i].value && metrics[i].reason.empty());
  }
}

}  // namespace
}  // namespace gnomon
