#include "report/json/summary_json.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "compare/answer_metrics.h"
#include "compare/boundaries.h"
#include "report/json/json_values.h"
#include "report/tables/confidence.h"
#include "report/tables/cost_table.h"
#include "report/text/number_text.h"
#include "study/judge/distinguish.h"
#include "study/record/cases.h"
#include "study/run/stages/budget.h"

namespace gnomon::report {

namespace {

Json methodJson(const study::MethodRecord& method) {
  return {{"label", method.label},
          {"name", method.name},
          {"title", method.title},
          {"citation", method.citation},
          {"family", method.mark.family},
          {"symbol", method.mark.symbol},
          {"other_chart_share", jsonNumber(method.otherChartShare, "methods.other_chart_share")}};
}

Json jsonTexture(const study::TextureRecord& texture) {
  return {{"charts", texture.charts},
          {"charts_overlap", texture.chartsOverlap},
          {"shared_area", jsonNumber(texture.sharedArea, "texture.shared_area")}};
}

Json resultJson(const study::ResultRecord& result) {
  const compare::Counts& counts = result.counts;
  Json json = {{"method", result.method},
               {"light", result.light},
               {"view", result.view},
               {"answer", study::answerName(result.answer)},
               {"region", result.region},
               {"samples", counts.samples},
               {"tp", jsonNumber(counts.truePositive, "results.tp")},
               {"fp", jsonNumber(counts.falsePositive, "results.fp")},
               {"fn", jsonNumber(counts.falseNegative, "results.fn")},
               {"tn", jsonNumber(counts.trueNegative, "results.tn")}};
  addMetrics(json, study::metricsOf(result));
  return json;
}

/// A bin without an end has null there. Its rates are over its own samples.
Json binJson(const study::BinRecord& bin) {
  Json json = {{"method", bin.method},
               {"view", bin.view},
               {"light", bin.light},
               {"axis", bin.axis},
               {"low", jsonNumber(bin.low, "bins.low")},
               {"high", jsonNumber(bin.high, "bins.high")},
               {"samples", bin.counts.samples},
               {"tp", jsonNumber(bin.counts.truePositive, "bins.tp")},
               {"fp", jsonNumber(bin.counts.falsePositive, "bins.fp")},
               {"fn", jsonNumber(bin.counts.falseNegative, "bins.fn")},
               {"tn", jsonNumber(bin.counts.trueNegative, "bins.tn")}};
  for (const compare::MetricId id :
       {compare::metrics::errorRate, compare::metrics::falseShadow, compare::metrics::falseLight}) {
    json[std::string(id.name())] = jsonNumber(compare::rate(bin.counts, id).value, id.name());
  }
  return json;
}

Json costJson(const study::StudyRecord& record, const study::CostRecord& cost) {
  return {{"method", cost.method},
          {"polygons", cost.polygons},
          {"table_bytes", cost.tableBytes},
          {"height_bytes", cost.heightBytes},
          {"frame_ms", jsonNumber(cost.frameMs, "cost.frame_ms")},
          {"still_ms", jsonNumber(cost.stillMs, "cost.still_ms")},
          {"texels", jsonNumber(cost.texels, "cost.texels")},
          {"passes", cost.passes},
          {"frame_ratio", jsonNumber(frameRatio(record, cost), "cost.frame_ratio")},
          {"frame_kept_since", cost.keptSince.empty() ? Json(nullptr) : Json(cost.keptSince)}};
}

Json cacheJson(const std::optional<cache::CacheCounts>& cache) {
  if (!cache) return nullptr;
  return {{"hits", cache->hits}, {"misses", cache->misses}, {"damaged", cache->damaged}};
}

Json timingJson(const study::TimingRecord& timing) {
  return {{"stage", timing.stage}, {"seconds", jsonNumber(timing.seconds, "timings.seconds")}};
}

Json truthFilesJson(const std::optional<study::TruthFilesRecord>& truth) {
  if (!truth) return nullptr;
  return {{"mask", truth->mask},
          {"regions", truth->regions},
          {"seam", truth->seam.empty() ? Json(nullptr) : Json(truth->seam)},
          {"weights", truth->weights.empty() ? Json(nullptr) : Json(truth->weights)}};
}

Json pictureJson(const study::PictureRecord& picture) {
  return {{"kind", pictureKindName(picture.kind)},
          {"method", picture.method},
          {"caption", picture.caption},
          {"path", picture.path},
          {"mask", picture.mask.empty() ? Json(nullptr) : Json(picture.mask)},
          {"test_mask", picture.testMask.empty() ? Json(nullptr) : Json(picture.testMask)},
          {"truth", truthFilesJson(picture.truth)}};
}

Json panelJson(const study::PanelRecord& panel) {
  return {{"view", panel.view},
          {"light", panel.light},
          {"width", panel.width},
          {"height", panel.height},
          {"pictures", jsonList(panel.pictures, pictureJson)}};
}

Json confidenceJson(const study::ConfidenceRecord& confidence) {
  return {{"method", confidence.method},
          {"view", confidence.view},
          {"light", confidence.light},
          {"error_rate", jsonNumber(confidence.rate, "confidence.error_rate")},
          {"low", jsonNumber(lowOf(confidence.interval), "confidence.low")},
          {"high", jsonNumber(highOf(confidence.interval), "confidence.high")},
          {"reason", jsonReason(confidence.reason)},
          {"blocks", confidence.blocks},
          {"block_side", confidence.blockSide}};
}

Json differenceJson(const study::DifferenceRecord& difference) {
  return {{"view", difference.view},
          {"light", difference.light},
          {"first", difference.first},
          {"second", difference.second},
          {"difference", jsonNumber(difference.difference, "differences.difference")},
          {"low", jsonNumber(lowOf(difference.interval), "differences.low")},
          {"high", jsonNumber(highOf(difference.interval), "differences.high")},
          {"reason", jsonReason(difference.reason)},
          {"uncertainty", jsonNumber(difference.uncertainty, "differences.uncertainty")},
          {"verdict", differenceVerdictName(difference.verdict)}};
}

Json shareJson(const study::BudgetShare& share) {
  return {{"share", jsonNumber(share.value, "budget.share")},
          {"low", jsonNumber(lowOf(share.interval), "budget.low")},
          {"high", jsonNumber(highOf(share.interval), "budget.high")},
          {"reason", jsonReason(share.reason)},
          {"distinguishable", study::isDistinguishable(share.verdict)}};
}

Json causeJson(const study::BudgetCause& cause) {
  return {{"cause", cause.name},
          {"change", cause.change},
          {"forward", shareJson(cause.forward)},
          {"backward", shareJson(cause.backward)}};
}

Json stateJson(const study::BudgetState& state) {
  return {{"error_rate", jsonNumber(state.errorRate, "budget.error_rate")},
          {"false_shadow", jsonNumber(state.falseShadow, "budget.false_shadow")},
          {"false_light", jsonNumber(state.falseLight, "budget.false_light")}};
}

Json budgetJson(const study::BudgetRecord& budget) {
  Json json = {
      {"method", budget.method},
      {"view", budget.view},
      {"light", budget.light},
      {"uncertainty", jsonNumber(budget.uncertainty, "budget.uncertainty")},
      {"blocks", budget.blocks},
      {"order_dependence", jsonNumber(study::orderDependence(budget), "budget.order_dependence")},
      {"total", shareJson(budget.total)},
      {"causes", jsonList(budget.causes, causeJson)}};
  for (const study::BudgetRest& rest : budget.rest) json[rest.name] = shareJson(rest.share);
  json["forward_states"] = jsonList(budget.forward, stateJson);
  json["backward_states"] = jsonList(budget.backward, stateJson);
  return json;
}

}  // namespace

std::string summaryJson(const study::StudyRecord& record) {
  const auto [thresholds, references, options] = study::byOrigin(record.judgements);
  const Json json = {
      {"schema", summarySchema},
      {"status", jsonStatus(record.status())},
      {"study", jsonStudy(record)},
      {"environment", jsonEnvironment(record.environment)},
      {"search_radius", jsonRadius(record.radius)},
      {"texture", jsonTexture(record.texture)},
      {"truth", jsonTruth(record.truth)},
      {"methods", jsonList(record.methods, methodJson)},
      {"results", jsonList(record.results, resultJson)},
      {"confidence", jsonList(record.confidence, confidenceJson)},
      {"differences", jsonList(record.differences, differenceJson)},
      {"bins", jsonList(record.bins, binJson)},
      {"cost", jsonList(record.cost,
                        [&](const study::CostRecord& cost) { return costJson(record, cost); })},
      {"timings", jsonList(record.timings, timingJson)},
      {"thresholds", jsonList(thresholds, jsonJudgement)},
      {"baseline", record.baseline.empty() ? Json(nullptr) : Json(record.baseline)},
      {"references", jsonList(references, jsonJudgement)},
      {"problems", jsonList(record.problems, jsonProblem)},
      {"claims", jsonList(record.claims, jsonClaim)},
      {"budget", jsonList(record.budgets, budgetJson)},
      {"panels", jsonList(record.panels, panelJson)},
      {"region_colours", jsonRegionColours()},
      {"notices", record.notices},
      {"undefined_samples", record.undefinedSamples},
      {"cache", cacheJson(record.cache)}};
  return jsonText(json);
}

namespace {

std::uint64_t readCount(const JsonReader& row, const char* key) {
  const double value = row.number(key);
  if (!(value >= 0 && value < 1e15)) {
    row.fail(key, fmt::format("{} found, a count expected", value));
  }
  return static_cast<std::uint64_t>(value);
}

compare::Counts readCounts(const JsonReader& row) {
  compare::Counts counts;
  counts.truePositive = row.number("tp");
  counts.falsePositive = row.number("fp");
  counts.falseNegative = row.number("fn");
  counts.trueNegative = row.number("tn");
  for (const char* key : {"tp", "fp", "fn", "tn"}) (void)readCount(row, key);
  counts.samples = readCount(row, "samples");
  return counts;
}

/// Metrics of a kind, whose reasons are constants; none where the record has none of them.
std::vector<compare::Metric> readMetrics(const JsonReader& row, compare::MetricKind kind,
                                         const std::vector<std::string_view>& reasons) {
  std::vector<compare::Metric> metrics;
  for (const compare::MetricId id : compare::metricsOfKinds({kind})) {
    const std::string key(id.name());
    if (!row.has(key.c_str())) return {};
    compare::Metric metric{id, row.numberOrNull(key.c_str()), {}};
    if (!metric.value) {
      const std::string reason = row.object("undefined").text(key.c_str());
      const auto found = std::find(reasons.begin(), reasons.end(), reason);
      if (found == reasons.end()) return {};  // it was not measured
      metric.reason = *found;
    }
    metrics.push_back(metric);
  }
  return metrics;
}

std::vector<compare::Metric> readBoundaries(const JsonReader& row) {
  return readMetrics(row, compare::MetricKind::boundary, compare::boundaryReasons());
}

std::vector<compare::Metric> readShares(const JsonReader& row) {
  return readMetrics(row, compare::MetricKind::share, compare::shareReasons());
}

study::EnvironmentRecord readWholeEnvironment(const JsonReader& row) {
  return {row.text("gnomon_version"),
          row.text("commit"),
          row.text("cpu"),
          static_cast<int>(row.numberOrNull("threads").value_or(0)),
          row.text("gl_renderer"),
          row.text("gl_version"),
          row.text("embree_version"),
          row.text("opensubdiv_version"),
          row.text("frame_clock")};
}

std::optional<double> readOptional(const JsonReader& row, const char* key) {
  return row.has(key) ? row.numberOrNull(key) : std::nullopt;
}

study::UncertaintyRecord readFlip(const JsonReader& row) {
  study::UncertaintyRecord flip{row.text("view"), row.text("light"), row.number("flip_rate")};
  flip.lengthError = readOptional(row, "length_error");
  if (row.has("boundaries")) flip.boundaries = readBoundaries(row.object("boundaries"));
  flip.percentile99 = readOptional(row, "percentile_99");
  flip.percentile999 = readOptional(row, "percentile_99_9");
  flip.brightening = readOptional(row, "brightening");
  if (row.has("shares")) flip.shares = readShares(row.object("shares"));
  return flip;
}

study::ResultRecord readResult(const JsonReader& row) {
  study::ResultRecord result{row.text("method"), row.text("light"), row.text("view"),
                             row.text("region"), readCounts(row)};
  const auto answer = study::answerOfName(row.text("answer"));
  if (!answer) row.fail("answer", "\"drawn\" or \"test\" expected");
  result.answer = *answer;
  if (const auto runs = readOptional(row, "shadow_runs")) {
    result.lengths = compare::ShadowLengths{*runs,
                                            row.numberOrNull("shadow_length_ratio"),
                                            row.numberOrNull("shadow_length_q1"),
                                            row.numberOrNull("shadow_length_q3"),
                                            {}};
  }
  result.boundaries = readBoundaries(row);
  result.shares = readShares(row);
  return result;
}

std::optional<compare::Interval> readInterval(const JsonReader& row) {
  const auto low = row.numberOrNull("low"), high = row.numberOrNull("high");
  return low && high ? std::optional(compare::Interval{*low, *high}) : std::nullopt;
}

std::string readReason(const JsonReader& row) {
  return row.isNull("reason") ? "" : row.text("reason");
}

study::ConfidenceRecord readConfidence(const JsonReader& row) {
  return {row.text("method"),       row.text("view"),
          row.text("light"),        row.number("error_rate"),
          readInterval(row),        readReason(row),
          readCount(row, "blocks"), static_cast<int>(row.number("block_side"))};
}

study::DifferenceVerdict readVerdict(const JsonReader& row) {
  using enum study::DifferenceVerdict;
  const std::string name = row.text("verdict");
  for (const auto verdict : {better, worse, equal, notDistinguishable, noInterval}) {
    if (name == differenceVerdictName(verdict)) return verdict;
  }
  row.fail("verdict", "\"" + name + "\" found, a verdict on two methods expected");
}

study::DifferenceRecord readDifference(const JsonReader& row) {
  return {row.text("view"),   row.text("light"),         row.text("first"),
          row.text("second"), row.number("difference"),  readInterval(row),
          readReason(row),    row.number("uncertainty"), readVerdict(row)};
}

study::BinRecord readBin(const JsonReader& row) {
  return {row.text("method"),      row.text("view"),         row.text("light"), row.text("axis"),
          row.numberOrNull("low"), row.numberOrNull("high"), readCounts(row)};
}

study::MethodRecord readMethod(const JsonReader& row) {
  study::MethodRecord method{row.text("label"), row.text("name"), row.text("title"),
                             row.text("citation")};
  // Summaries of older versions have none.
  if (row.has("family")) method.mark = {row.text("family"), row.text("symbol")};
  method.otherChartShare = readOptional(row, "other_chart_share");
  return method;
}

study::CostRecord readCost(const JsonReader& row) {
  study::CostRecord cost{row.text("method"), readCount(row, "polygons"),
                         readCount(row, "table_bytes"), readCount(row, "height_bytes"),
                         row.numberOrNull("frame_ms")};
  cost.stillMs = readOptional(row, "still_ms");
  cost.texels = readOptional(row, "texels");
  if (row.has("passes")) cost.passes = static_cast<int>(row.number("passes"));
  if (row.has("frame_kept_since") && !row.isNull("frame_kept_since")) {
    cost.keptSince = row.text("frame_kept_since");
  }
  return cost;
}

study::Judgement readThreshold(const JsonReader& row, const std::string& step) {
  const std::string name = row.text("metric");
  const auto metric = compare::MetricId::find(name);
  if (!metric) row.fail("metric", "\"" + name + "\" found, a metric expected");
  study::Gate gate{row.text("method"),         row.text("light"), row.text("view"),
                   row.text("region"),         *metric,           row.numberOrNull("minimum"),
                   row.numberOrNull("maximum")};
  gate.answer = study::answerOfName(row.text("answer")).value_or(study::Answer::drawn);
  gate.step = step;
  const std::optional<double> value = row.numberOrNull("value");
  const study::GateVerdict verdict = row.flag("passed") ? study::GateVerdict::passed
                                     : value            ? study::GateVerdict::failed
                                                        : study::GateVerdict::undefined;
  return {std::move(gate), verdict, value, readReason(row)};
}

template <typename Read>
auto readList(const JsonReader& summary, const char* key, const Read& read) {
  std::vector<decltype(read(summary))> rows;
  for (const JsonReader& row : summary.list(key)) rows.push_back(read(row));
  return rows;
}

}  // namespace

study::StudyRecord readSummary(const JsonReader& summary) {
  const JsonReader study = summary.object("study");
  study::StudyRecord record;
  record.name = study.text("name");
  record.title = study.text("title");
  record.source = study.text("source");
  record.file = study.text("file");
  record.command = study.text("command");
  const JsonReader settings = study.object("settings");
  if (settings.has("study") && settings.object("study").has("suite")) {
    const std::string suite = settings.object("study").text("suite");
    record.reproduction.settings.insert("study", toml::table{{"suite", suite}});
  }
  for (const JsonReader& input : study.list("inputs")) {
    record.reproduction.inputs.push_back({{}, input.text("file"), input.text("sha256")});
  }
  record.environment = readWholeEnvironment(summary.object("environment"));
  const JsonReader truth = summary.object("truth");
  record.truth.uncertainty = truth.number("uncertainty");
  record.truth.flips = readList(truth, "flips", readFlip);
  record.methods = readList(summary, "methods", readMethod);
  record.results = readList(summary, "results", readResult);
  record.confidence = readList(summary, "confidence", readConfidence);
  record.differences = readList(summary, "differences", readDifference);
  record.bins = readList(summary, "bins", readBin);
  record.cost = readList(summary, "cost", readCost);
  record.judgements = readList(summary, "thresholds", [&](const JsonReader& row) {
    return readThreshold(row, record.name);
  });
  record.problems = readList(summary, "problems", [](const JsonReader& row) {
    return study::ProblemRecord{row.text("part"), ExitStatus::internal, row.text("message")};
  });
  record.notices = summary.texts("notices");
  return record;
}

study::StudyRecord readSummary(const std::filesystem::path& file) {
  const Json json = readJson(file);
  const JsonReader summary(json, file.string(), "");
  const std::string schema = summary.text("schema");
  if (schema != summarySchema) {
    summary.fail("schema", fmt::format("\"{}\" found, \"{}\" expected", schema, summarySchema));
  }
  return readSummary(summary);
}

}  // namespace gnomon::report
