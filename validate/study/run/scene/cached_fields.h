#pragma once

#include <algorithm>
#include <vector>

#include "cache/byte_stream.h"
#include "common/error.h"
#include "common/mask.h"
#include "compare/answer_metrics.h"
#include "compare/boundaries.h"
#include "compare/confidence_interval.h"
#include "horizon/angle_table.h"
#include "horizon/horizon_bake.h"
#include "render/bakes/method_bake.h"
#include "render/gpu_scene.h"
#include "render/passes/method_pass.h"
#include "study/record/record.h"
#include "study/run/scene/method_outcome.h"
#include "surface/sample_grid.h"
#include "truth/shadow_tracer.h"

namespace gnomon::cache {

/// How the results in a cache are written and read, field by field: see byte_stream.h. A struct
/// that is named in a structured binding does not compile with a member that would be lost.

template <typename Stream, SameAs<compare::Counts> T>
void fields(Stream& stream, T& counts) {
  auto& [truePositive, falsePositive, falseNegative, trueNegative, samples] = counts;
  stream(truePositive, falsePositive, falseNegative, trueNegative, samples);
}

template <typename Stream, SameAs<compare::ShadowLengths> T>
void fields(Stream& stream, T& lengths) {
  auto& [runs, ratio, lowerQuartile, upperQuartile, truthLength] = lengths;
  stream(runs, ratio, lowerQuartile, upperQuartile, truthLength);
}

template <typename Stream, SameAs<compare::MetricId> T>
void fields(Stream& stream, T& id) {
  std::string name(id.name());
  stream(name);
  if constexpr (!std::is_const_v<T>) {
    const auto found = compare::MetricId::find(name);
    if (!found) throw DamagedBytes();
    id = *found;
  }
}

/// Metrics whose reasons are constants, kept by their places in a list.
struct ListedMetrics {
  std::vector<compare::Metric> metrics;
  const std::vector<std::string_view>* reasons;
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

template <typename Stream, SameAs<ListedMetrics> T>
void fields(Stream& stream, T& listed) {
  std::uint64_t count = listed.metrics.size();
  stream(count);
  if constexpr (!std::is_const_v<T>) {
    if (count > compare::metricTraits.size()) throw DamagedBytes();
    listed.metrics.resize(count, {compare::metrics::errorRate, {}, {}});
  }
  for (auto& metric : listed.metrics) {
    std::uint64_t reason = placeIn(*listed.reasons, metric.reason);
    stream(metric.id, metric.value, reason);
    if constexpr (!std::is_const_v<T>) metric.reason = textAt(*listed.reasons, reason);
  }
}

/// A record's boundary metrics, in their place among its other members.
template <typename Stream, SameAs<std::vector<compare::Metric>> T>
void boundaryFields(Stream& stream, T& metrics) {
  ListedMetrics listed{metrics, &compare::boundaryReasons()};
  stream(listed);
  if constexpr (!std::is_const_v<T>) metrics = std::move(listed.metrics);
}

/// Likewise its share metrics.
template <typename Stream, SameAs<std::vector<compare::Metric>> T>
void shareFields(Stream& stream, T& metrics) {
  ListedMetrics listed{metrics, &compare::shareReasons()};
  stream(listed);
  if constexpr (!std::is_const_v<T>) metrics = std::move(listed.metrics);
}

template <typename Stream, SameAs<study::UncertaintyRecord> T>
void fields(Stream& stream, T& flip) {
  auto& [view, light, flipRate, lengthError, boundaries, percentile99, shares, percentile999,
         brightening] = flip;
  stream(view, light, flipRate, lengthError, percentile99, percentile999, brightening);
  boundaryFields(stream, boundaries);
  shareFields(stream, shares);
}

template <typename Stream, SameAs<study::TruthRecord> T>
void fields(Stream& stream, T& truth) {
  auto& [triangles, step, uncertainty, bvh, mesh, flips, asked] = truth;
  stream(triangles, step, uncertainty, bvh, mesh, flips, asked);
}

template <typename Stream, SameAs<study::WorstPlace> T>
void fields(Stream& stream, T& place) {
  auto& [left, top, side, error, answer, truth] = place;
  stream(left, top, side, error, answer, truth);
}

template <typename Stream, SameAs<study::LayersRecord> T>
void fields(Stream& stream, T& layers) {
  auto& [lit, dark] = layers;
  stream(lit, dark);
}

template <typename Stream, SameAs<Mask> T>
void fields(Stream& stream, T& mask) {
  std::uint64_t count = mask.samples.size();
  std::vector<std::uint8_t> packed;
  if constexpr (std::is_const_v<T>) packed = packedShades(mask.samples);
  stream(mask.width, mask.height, count, packed);
  if constexpr (!std::is_const_v<T>) mask.samples = unpackedShades(packed, count);
}

template <typename Stream, SameAs<render::MethodAnswers> T>
void fields(Stream& stream, T& answers) {
  stream(answers.drawn, answers.test, answers.otherChartShare);
}

template <typename Stream, SameAs<Visibility> T>
void fields(Stream& stream, T& map) {
  stream(map.width, map.height, map.shares);
}

template <typename Stream, SameAs<render::VisibilityAnswers> T>
void fields(Stream& stream, T& answers) {
  stream(answers.drawn, answers.test, answers.otherChartShare);
}

template <typename Stream, SameAs<truth::Truth> T>
void fields(Stream& stream, T& truth) {
  std::uint64_t undefined = truth.undefinedSamples;
  stream(truth.mask, truth.regions, undefined, truth.crossesSeam, truth.casters, truth.visibility);
  if constexpr (!std::is_const_v<T>) truth.undefinedSamples = undefined;
}

template <>
inline constexpr bool isPacked<surface::SurfaceSample> = sizeof(surface::SurfaceSample) == 12;

template <typename Stream, SameAs<surface::SampleGrid> T>
void fields(Stream& stream, T& grid) {
  stream(grid.width, grid.height, grid.samples);
}

template <>
inline constexpr bool isPacked<render::RenderView> = sizeof(render::RenderView) ==
                                                     sizeof(glm::mat4) + 4 * sizeof(int) +
                                                         sizeof(render::RenderView::texelWindow) +
                                                         sizeof(glm::vec3);

template <typename Stream, SameAs<compare::SampleLayout> T>
void fields(Stream& stream, T& layout) {
  stream(layout.columnStep, layout.rowStep, layout.tileSide, layout.breaks);
}

template <typename Stream, SameAs<compare::Tiling> T>
void fields(Stream& stream, T& tiling) {
  stream(tiling.cellSide, tiling.columns);
}

template <typename Stream, SameAs<horizon::HorizonTables> T>
void fields(Stream& stream, T& tables) {
  stream(tables.width, tables.height, tables.layers, tables.radiusTexels, tables.wrap,
         tables.border.x, tables.border.y, tables.horizon, tables.distance);
}

template <typename Stream, SameAs<horizon::EllipseTable> T>
void fields(Stream& stream, T& table) {
  stream(table.width, table.height, table.wrap, table.border.x, table.border.y, table.values);
  if constexpr (!std::is_const_v<T>) table.layers = horizon::EllipseTable::numbers;
}

template <typename Stream, SameAs<horizon::AngleTable> T>
void fields(Stream& stream, T& table) {
  stream(table.width, table.height, table.layers, table.limit, table.angles, table.wrap,
         table.originX, table.originY);
}

template <typename Stream, SameAs<render::StoredBake> T>
void fields(Stream& stream, T& bake) {
  stream(bake.width, bake.height, bake.layers, bake.channels, bake.levels, bake.values.bits,
         bake.values.low, bake.values.high, bake.values.bytes);
}

template <typename Stream, SameAs<compare::BlockErrors> T>
void fields(Stream& stream, T& errors) {
  stream(errors.wrong, errors.weight, errors.answers);
}

template <typename Stream, SameAs<study::AnswerOutcome> T>
void fields(Stream& stream, T& outcome) {
  stream(outcome.regions, outcome.lengths);
  boundaryFields(stream, outcome.boundaries);
  shareFields(stream, outcome.shares);
}

template <typename Stream, SameAs<study::MethodOutcome> T>
void fields(Stream& stream, T& outcome) {
  stream(outcome.drawn, outcome.test, outcome.bins, outcome.blocks, outcome.otherChartShare);
}

}  // namespace gnomon::cache
