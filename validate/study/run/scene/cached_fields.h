#pragma once

#include <algorithm>
#include <vector>

#include "cache/byte_stream.h"
#include "common/error.h"
#include "compare/block_errors.h"
#include "compare/boundaries.h"
#include "compare/confidence_interval.h"
#include "compare/counts.h"
#include "compare/sample_layout.h"
#include "compare/shadow_length.h"
#include "horizon/angle_table.h"
#include "horizon/horizon_bake.h"
#include "horizon/horizon_ellipses.h"
#include "render/passes/method_pass.h"
#include "render/view.h"
#include "study/record/record.h"
#include "study/run/scene/method_outcome.h"
#include "surface/sample_grid.h"
#include "truth/shadow_tracer.h"

namespace gnomon {

/// How the results in a cache are written and read, field by field: see byte_stream.h.

template <typename Stream, SameAs<Mask> T>
void fields(Stream& stream, T& mask) {
  stream(mask.width, mask.height, mask.samples);
}

template <typename Stream, SameAs<MethodAnswers> T>
void fields(Stream& stream, T& answers) {
  stream(answers.drawn, answers.test);
}

template <typename Stream, SameAs<Truth> T>
void fields(Stream& stream, T& truth) {
  std::uint64_t undefined = truth.undefinedSamples;
  stream(truth.mask, truth.regions, undefined, truth.crossesSeam);
  if constexpr (!std::is_const_v<T>) truth.undefinedSamples = undefined;
}

template <>
inline constexpr bool isPacked<SurfaceSample> = sizeof(SurfaceSample) == 12;

template <typename Stream, SameAs<SampleGrid> T>
void fields(Stream& stream, T& grid) {
  stream(grid.width, grid.height, grid.samples);
}

template <>
inline constexpr bool isPacked<RenderView> = sizeof(RenderView) ==
                                             sizeof(glm::mat4) + 4 * sizeof(int) +
                                                 sizeof(RenderView::texelWindow);

template <typename Stream, SameAs<SampleLayout> T>
void fields(Stream& stream, T& layout) {
  stream(layout.columnStep, layout.rowStep, layout.tileSide, layout.breaks);
}

template <typename Stream, SameAs<Tiling> T>
void fields(Stream& stream, T& tiling) {
  stream(tiling.cellSide, tiling.columns);
}

template <typename Stream, SameAs<HorizonTables> T>
void fields(Stream& stream, T& tables) {
  stream(tables.width, tables.height, tables.layers, tables.radiusTexels, tables.wrap,
         tables.border.x, tables.border.y, tables.horizon, tables.distance);
}

template <typename Stream, SameAs<EllipseTable> T>
void fields(Stream& stream, T& table) {
  stream(table.width, table.height, table.wrap, table.border.x, table.border.y, table.values);
  if constexpr (!std::is_const_v<T>) table.layers = EllipseTable::numbers;
}

template <typename Stream, SameAs<AngleTable> T>
void fields(Stream& stream, T& table) {
  stream(table.width, table.height, table.layers, table.limit, table.angles, table.wrap,
         table.originX, table.originY);
}

template <typename Stream, SameAs<Counts> T>
void fields(Stream& stream, T& counts) {
  std::uint64_t samples = counts.samples;
  stream(counts.truePositive, counts.falsePositive, counts.falseNegative, counts.trueNegative,
         samples);
  if constexpr (!std::is_const_v<T>) counts.samples = samples;
}

template <typename Stream, SameAs<BlockErrors> T>
void fields(Stream& stream, T& errors) {
  stream(errors.wrong, errors.weight);
}

template <typename Stream, SameAs<ShadowLengths> T>
void fields(Stream& stream, T& lengths) {
  stream(lengths.runs, lengths.ratio, lengths.lowerQuartile, lengths.upperQuartile,
         lengths.truthLength);
}

/// Boundary metrics: their texts are constants, kept by their places in the lists of them.
struct BoundaryMetrics {
  std::vector<Metric> metrics;
};

/// The place of a text in a list; the list's size for an empty one.
inline std::uint64_t placeIn(const std::vector<std::string_view>& list, std::string_view text) {
  const auto found = std::find(list.begin(), list.end(), text);
  if (found == list.end() && !text.empty()) throw InternalError("a metric's text is in no list");
  return static_cast<std::uint64_t>(found - list.begin());
}

inline std::string_view textAt(const std::vector<std::string_view>& list, std::uint64_t place) {
  if (place > list.size()) throw DamagedBytes();
  return place < list.size() ? list[place] : std::string_view();
}

template <typename Stream, SameAs<BoundaryMetrics> T>
void fields(Stream& stream, T& boundaries) {
  std::uint64_t count = boundaries.metrics.size();
  stream(count);
  if constexpr (!std::is_const_v<T>) {
    if (count > boundaryMetricNames().size()) throw DamagedBytes();
    boundaries.metrics.resize(count);
  }
  for (auto& metric : boundaries.metrics) {
    std::uint64_t name = placeIn(boundaryMetricNames(), metric.name);
    std::uint64_t reason = placeIn(boundaryReasons(), metric.reason);
    stream(name, metric.value, reason);
    if constexpr (!std::is_const_v<T>) {
      metric.name = textAt(boundaryMetricNames(), name);
      metric.reason = textAt(boundaryReasons(), reason);
    }
  }
}

/// The figures, without the names of view and light.
template <typename Stream, SameAs<UncertaintyRecord> T>
void fields(Stream& stream, T& truth) {
  BoundaryMetrics boundaries{truth.boundaries};
  stream(truth.flipRate, truth.lengthError, boundaries);
  if constexpr (!std::is_const_v<T>) truth.boundaries = std::move(boundaries.metrics);
}

/// The sizes alone.
template <typename Stream, SameAs<TruthRecord> T>
void fields(Stream& stream, T& truth) {
  stream(truth.microTriangles, truth.bvhBytes, truth.meshBytes, truth.stepTexels,
         truth.askedStepTexels);
}

template <typename Stream, SameAs<RefinementRecord> T>
void fields(Stream& stream, T& level) {
  stream(level.stepTexels, level.microTriangles, level.flipRate);
}

template <typename Stream, SameAs<LayersRecord> T>
void fields(Stream& stream, T& layers) {
  stream(layers.lit, layers.dark);
}

template <typename Stream, SameAs<AnswerOutcome> T>
void fields(Stream& stream, T& outcome) {
  BoundaryMetrics boundaries{outcome.boundaries};
  stream(outcome.regions, outcome.lengths, boundaries);
  if constexpr (!std::is_const_v<T>) outcome.boundaries = std::move(boundaries.metrics);
}

template <typename Stream, SameAs<MethodOutcome> T>
void fields(Stream& stream, T& outcome) {
  stream(outcome.drawn, outcome.test, outcome.bins, outcome.blocks);
}

}  // namespace gnomon
