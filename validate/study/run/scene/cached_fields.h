#pragma once

#include <vector>

#include "cache/byte_stream.h"
#include "common/packed_shades.h"
#include "compare/block_errors.h"
#include "compare/confidence_interval.h"
#include "compare/sample_layout.h"
#include "horizon/angle_table.h"
#include "horizon/horizon_bake.h"
#include "horizon/horizon_ellipses.h"
#include "render/bakes/gpu_bake.h"
#include "render/passes/method_pass.h"
#include "render/view.h"
#include "study/record/record_fields.h"
#include "study/run/scene/method_outcome.h"
#include "surface/sample_grid.h"
#include "truth/shadow_tracer.h"

namespace gnomon::cache {

/// How the results in a cache are written and read, field by field: see byte_stream.h.

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
