#pragma once

#include <algorithm>
#include <variant>
#include <vector>

#include "cache/byte_stream.h"
#include "common/error.h"
#include "compare/boundaries.h"
#include "compare/share_metrics.h"
#include "study/record/record.h"

namespace gnomon::cache {

/// What a StudyRecord is made of, as bytes and back: see byte_stream.h. Every member of a struct is
/// named in a structured binding, so that one that is new, and would be lost, does not compile.

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

template <typename Stream, SameAs<study::EnvironmentRecord> T>
void fields(Stream& stream, T& environment) {
  auto& [version, commit, cpu, threads, renderer, gl, embree, openSubdiv, clock] = environment;
  stream(version, commit, cpu, threads, renderer, gl, embree, openSubdiv, clock);
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

template <typename Stream, SameAs<study::RadiusRecord> T>
void fields(Stream& stream, T& radius) {
  auto& [texels, reason] = radius;
  stream(texels, reason);
}

template <typename Stream, SameAs<study::TextureRecord> T>
void fields(Stream& stream, T& texture) {
  auto& [charts, chartsOverlap, sharedArea] = texture;
  stream(charts, chartsOverlap, sharedArea);
}

template <typename Stream, SameAs<study::MethodRecord> T>
void fields(Stream& stream, T& method) {
  auto& [label, name, title, citation, mark, otherChartShare] = method;
  stream(label, name, title, citation, mark.family, mark.symbol, otherChartShare);
}

template <typename Stream, SameAs<study::RefusedMethod> T>
void fields(Stream& stream, T& refused) {
  auto& [label, reason] = refused;
  stream(label, reason);
}

template <typename Stream, SameAs<study::ResultRecord> T>
void fields(Stream& stream, T& result) {
  auto& [method, light, view, region, counts, lengths, boundaries, answer, shares] = result;
  stream(method, light, view, region, counts, lengths, answer);
  boundaryFields(stream, boundaries);
  shareFields(stream, shares);
}

template <typename Stream, SameAs<compare::Interval> T>
void fields(Stream& stream, T& interval) {
  auto& [low, high] = interval;
  stream(low, high);
}

template <typename Stream, SameAs<study::ConfidenceRecord> T>
void fields(Stream& stream, T& confidence) {
  auto& [method, view, light, rate, interval, reason, blocks, blockSide] = confidence;
  stream(method, view, light, rate, interval, reason, blocks, blockSide);
}

template <typename Stream, SameAs<study::DifferenceRecord> T>
void fields(Stream& stream, T& pair) {
  auto& [view, light, first, second, difference, interval, reason, uncertainty, verdict] = pair;
  stream(view, light, first, second, difference, interval, reason, uncertainty, verdict);
}

template <typename Stream, SameAs<study::BinRecord> T>
void fields(Stream& stream, T& bin) {
  auto& [method, view, light, axis, low, high, counts] = bin;
  stream(method, view, light, axis, low, high, counts);
}

template <typename Stream, SameAs<study::CostRecord> T>
void fields(Stream& stream, T& cost) {
  auto& [method, polygons, tableBytes, heightBytes, frameMs, stillMs, texels, passes, keptSince] =
      cost;
  stream(method, polygons, tableBytes, heightBytes, frameMs, stillMs, texels, passes, keptSince);
}

template <typename Stream, SameAs<study::TimingRecord> T>
void fields(Stream& stream, T& timing) {
  auto& [stage, seconds] = timing;
  stream(stage, seconds);
}

/// A threshold's own table stays out: it is the study's, and tells nothing of what was found.
template <typename Stream, SameAs<study::Threshold> T>
void fields(Stream& stream, T& threshold) {
  auto& [line, quick, written] = threshold;
  stream(line, quick);
  (void)written;
}

/// @throws InternalError for a gate that is no threshold: only a check judges by others
template <typename Stream, SameAs<study::Gate> T>
void fields(Stream& stream, T& gate) {
  auto& [method, light, view, region, metric, minimum, maximum, origin, answer, step] = gate;
  auto* threshold = std::get_if<study::Threshold>(&origin);
  if (threshold == nullptr) throw InternalError("a gate of a run is no threshold");
  stream(method, light, view, region, metric, minimum, maximum, *threshold, answer, step);
}

template <typename Stream, SameAs<study::Judgement> T>
void fields(Stream& stream, T& judgement) {
  auto& [gate, verdict, value, reason] = judgement;
  stream(gate, verdict, value, reason);
}

template <typename Stream, SameAs<study::ProblemRecord> T>
void fields(Stream& stream, T& problem) {
  auto& [part, status, message] = problem;
  stream(part, status, message);
}

template <typename Stream, SameAs<study::ReferencePictures> T>
void fields(Stream& stream, T& pictures) {
  auto& [method, view, light, before, after, change, note] = pictures;
  stream(method, view, light, before, after, change, note);
}

template <typename Stream, SameAs<study::Quartiles> T>
void fields(Stream& stream, T& quartiles) {
  auto& [least, first, median, third, most] = quartiles;
  stream(least, first, median, third, most);
}

template <typename Stream, SameAs<study::ClaimSpread> T>
void fields(Stream& stream, T& spread) {
  auto& [cases, held, failed, views, quantity, quartiles, hasIntervals, together, equal,
         withoutInterval] = spread;
  stream(cases, held, failed, views, quantity, quartiles, hasIntervals, together, equal,
         withoutInterval);
}

template <typename Stream, SameAs<study::ClaimRecord> T>
void fields(Stream& stream, T& claim) {
  auto& [text, source, verdict, detail, spread, methods] = claim;
  stream(text, source, verdict, detail, spread, methods);
}

template <typename Stream, SameAs<study::BudgetShare> T>
void fields(Stream& stream, T& share) {
  auto& [value, interval, reason, verdict] = share;
  stream(value, interval, reason, verdict);
}

template <typename Stream, SameAs<study::BudgetCause> T>
void fields(Stream& stream, T& cause) {
  auto& [name, change, forward, backward] = cause;
  stream(name, change, forward, backward);
}

template <typename Stream, SameAs<study::BudgetState> T>
void fields(Stream& stream, T& state) {
  auto& [errorRate, falseShadow, falseLight] = state;
  stream(errorRate, falseShadow, falseLight);
}

template <typename Stream, SameAs<study::BudgetRest> T>
void fields(Stream& stream, T& rest) {
  auto& [name, share] = rest;
  stream(name, share);
}

template <typename Stream, SameAs<study::BudgetRecord> T>
void fields(Stream& stream, T& budget) {
  auto& [method, view, light, uncertainty, blocks, total, causes, rest, forward, backward] = budget;
  stream(method, view, light, uncertainty, blocks, total, causes, rest, forward, backward);
}

template <typename Stream, SameAs<study::TruthFilesRecord> T>
void fields(Stream& stream, T& files) {
  auto& [mask, regions, seam, weights] = files;
  stream(mask, regions, seam, weights);
}

template <typename Stream, SameAs<study::WorstPlace> T>
void fields(Stream& stream, T& place) {
  auto& [left, top, side, error, answer, truth] = place;
  stream(left, top, side, error, answer, truth);
}

template <typename Stream, SameAs<study::PictureRecord> T>
void fields(Stream& stream, T& picture) {
  auto& [kind, method, caption, path, mask, embedded, layers, truth, testMask, worst] = picture;
  stream(kind, method, caption, path, mask, embedded, layers, truth, testMask, worst);
}

template <typename Stream, SameAs<study::LayersRecord> T>
void fields(Stream& stream, T& layers) {
  auto& [lit, dark] = layers;
  stream(lit, dark);
}

template <typename Stream, SameAs<study::PanelRecord> T>
void fields(Stream& stream, T& panel) {
  auto& [view, light, width, height, pictures, layers] = panel;
  stream(view, light, width, height, pictures, layers);
}

template <typename Stream, SameAs<cache::CacheCounts> T>
void fields(Stream& stream, T& counts) {
  auto& [hits, misses, damaged] = counts;
  stream(hits, misses, damaged);
}

/// What tells of the run's folder, `reproduction`, stays out: it follows from study and folder.
template <typename Stream, SameAs<study::StudyRecord> T>
void fields(Stream& stream, T& record) {
  auto& [name, title, source, file, command, reproduction, environment, radius, texture, truth,
         atlasViews, methods, refused, results, confidence, differences, bins, cost, timings,
         judgements, baseline, problems, referencePictures, claims, budgets, panels, notices,
         undefinedSamples, cache] = record;
  stream(name, title, source, file, command, environment, radius, texture, truth, atlasViews,
         methods, refused, results, confidence, differences, bins, cost, timings, judgements,
         baseline, problems, referencePictures, claims, budgets, panels, notices, undefinedSamples,
         cache);
  (void)reproduction;
}

}  // namespace gnomon::cache
