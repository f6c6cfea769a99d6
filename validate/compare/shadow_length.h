#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/mask.h"
#include "common/raw_vector.h"
#include "compare/counts.h"

namespace gnomon::compare {

/// How one sample of a view continues along its light. Without a value of its own, so that whoever
/// fills a field's steps touches their memory first, on all threads; `{}` ends a walk.
struct LightStep {
  /// Columns and rows (downward) of a step away from the light: together one sample long, or zero
  /// where that has no meaning. A walk ends there.
  glm::vec2 away;
  float length;     ///< what that step measures along the surface, in any one unit
  glm::vec3 place;  ///< the sample's point of the surface, in that unit
  /// Upper bound on the distance between neighbouring samples of a connected surface, in that unit.
  float spacing;
};

/// The steps of all samples of a view, row by row as in its masks.
struct LightField {
  int width = 0;
  int height = 0;
  /// Side of the square tiles whose borders no walk crosses: those of an atlas in which neighbours
  /// in the picture are none on the surface. 0 where there are none.
  int tileSide = 0;
  RawVector<LightStep> steps;
};

/// How long the cast shadows of a candidate are, over those of the truth.
struct ShadowLengths {
  double runs = 0;                      ///< what was measured: samples of width across the light
  std::optional<double> ratio;          ///< median over the runs
  std::optional<double> lowerQuartile;  ///< of the ratios
  std::optional<double> upperQuartile;  ///< of the ratios
  std::optional<double> truthLength;    ///< median length of the truth's own runs
  bool operator==(const ShadowLengths&) const = default;
};

/// Fewer runs than this have no median: neighbouring runs belong to the same bump.
constexpr double leastRuns = 30;
/// Shorter runs are left out: their length is known to one sample only.
constexpr std::size_t leastRunSamples = 4;

/// Measures every cast shadow of the truth along its light, and the candidate's shadow of the same
/// occluder on the same line.
///
/// A line is walked step by step: from a point of the view by the step of the nearest sample, from
/// the point reached by the step of the sample nearest to that. A *run* starts at every point in a
/// sample that the truth shadows and from which one step back toward the light leads into one that
/// it lights; it ends before the next that it lights. Its length is the sum of its steps. Attached
/// shadow comes before the cast shadow on the far side of a bump and is part of the run, in the
/// truth as in the candidate.
///
/// Lines start at 17 points of every sample, each counting as a seventeenth of a run. Since steps
/// are one sample long, a shadow then has one run for each sample of its width across the light,
/// whatever the light's direction in the view: a broad shadow counts in proportion.
///
/// The candidate's length on that line is the sum of the steps that it shadows
///   in the truth's run                        (so that a slit costs no more than its width),
///   on from its end, if shadowed there, until it becomes lit, the truth's next run starts (that
///     is another occluder's), or the line cannot go on,
///   back from its start, likewise; nothing, if that leads without a gap into the truth's previous
///     run (then it is that occluder's shadow that came so far).
/// It is 0 where the candidate shadows none of the truth's run. A candidate that equals the truth
/// has the ratio 1, exactly, in every run.
///
/// Left out, whatever the candidate, so that all candidates are measured on the same runs: runs
/// shorter than `leastRunSamples`; those without a selected sample; those whose line meets the
/// view's edge, a sample without answer or direction, or a break in the surface, before they end or
/// within their own length after that (unless the next run starts first). There a longer shadow
/// could not be told. A break is a step over a tile's border or between samples that lie farther
/// apart than the spacing of one of them, as at the contour of a fold.
///
/// Quartiles interpolate linearly between neighbours in order. All but `runs` are undefined where
/// there are fewer than `leastRuns`.
/// @param selected  non-zero where a sample is of the shadows asked for, or empty for all
/// @throws InputError if sizes differ
ShadowLengths compareShadowLengths(const Mask& candidate, const Mask& truth,
                                   const LightField& field,
                                   std::span<const std::uint8_t> selected = {});

/// The same for several candidates at once: the lines of the truth are walked once for all of them.
/// @returns one a candidate
/// @throws likewise
std::vector<ShadowLengths> compareShadowLengths(std::span<const Mask* const> candidates,
                                                const Mask& truth, const LightField& field,
                                                std::span<const std::uint8_t> selected = {});

/// As metrics, in this order:
///   shadow_length_ratio  the median: 1 as long as the truth, 2 twice as long, 0 missing
///   shadow_length_q1     lower quartile
///   shadow_length_q3     upper quartile
///   shadow_runs          width of all shadows measured, in samples across the light
std::vector<Metric> lengthMetrics(const ShadowLengths& lengths);

}  // namespace gnomon::compare
