#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compare/boundaries.h"
#include "compare/counts.h"
#include "study/judge/distinguish.h"
#include "study/judge/gates.h"
#include "study/record/cases.h"
#include "study/record/record.h"

namespace gnomon::test {

/// A made-up run: every field is set, figures are round so that expectations can be worked out by
/// hand, and the text holds what writers must escape.
inline study::StudyRecord emptyRecord() {
  study::StudyRecord record;
  record.name = "sample";
  record.title = "Columns on a sphere <script>alert(\"1\")</script>";
  record.source = "Figure 8 & its \"claims\"";
  record.file = "scenes/sample.toml";
  record.command = "gnomon run scenes/sample.toml --set 'truth.step=1/8' > \"out\"";
  record.environment = {"0.1.0", "0123abc",           "A processor", 2,          "A rasteriser",
                        "4.5",   "3.13.5 <built-in>", "3.5.0",       "a <clock>"};
  record.truth = {2'000'000, 0.125, 0.004, 28'000'000, 24'000'000, {}};
  record.undefinedSamples = 12;
  return record;
}

inline study::ResultRecord result(const std::string& method, const std::string& light,
                                  const std::string& view, const std::string& region,
                                  const compare::Counts& counts) {
  return {method, light, view, region, counts};
}

/// Two distances, and one share for each of the others.
inline std::vector<compare::Metric> boundaries(double assd, double hd95, double share) {
  std::vector<compare::Metric> metrics;
  for (const compare::MetricId id : compare::metricsOfKinds({compare::MetricKind::boundary}))
    metrics.push_back({id, share, {}});
  metrics[0].value = assd;
  metrics[1].value = hd95;
  return metrics;
}

/// Counts over `samples` samples, a quarter of them shadowed in the truth.
inline compare::Counts countsOf(std::size_t samples, double falseShadow, double falseLight) {
  const auto n = static_cast<double>(samples);
  return {0.25 * n - falseLight, falseShadow, falseLight, 0.75 * n - falseShadow, samples};
}

/// Three methods, `lights` lights, one view, three regions ("distant" has no sample).
/// Method "best" has 10 wrong samples of 1000 per light, "close" 12, "rough, \"old\"" 100.
inline study::StudyRecord sampleRecord(int lights = 2) {
  study::StudyRecord record = emptyRecord();
  record.methods = {{"rough, \"old\"", "max-forsyth", "Flat", "Max 1988"},
                    {"close", "onoue-2004", "Curved <b>", "Onoue et al. 2004"},
                    {"best", "resampled-horizon", "Resampled", ""}};
  for (int i = 0; i < lights; ++i) {
    const std::string light = "elevation " + std::to_string(15 + 15 * i) + "°";
    record.truth.flips.push_back(
        {"camera", light, 0.002 + 0.002 * (i == 0 ? 0 : 1), 0.01, boundaries(0.25, 1.0, 0.75)});
    const auto add = [&](const std::string& method, double falseShadow, double falseLight) {
      const compare::Counts all = countsOf(1000, falseShadow, falseLight);
      record.results.push_back(result(method, light, "camera", "all", all));
      record.results.back().lengths =
          method == "close" ? compare::ShadowLengths{12, {}, {}, {}, {}}
                            : compare::ShadowLengths{400, 1 + falseShadow / 100, 0.5, 2.0, 8.0};
      record.results.back().boundaries = boundaries(falseShadow / 8, falseShadow / 2, 0.5);
      const compare::Counts lit{0, falseShadow, 0, 750 - falseShadow, 750};
      record.results.push_back(result(method, light, "camera", "lit", lit));
      record.results.push_back(result(method, light, "camera", "distant", compare::Counts{}));
    };
    add("rough, \"old\"", 80, 20);
    add("close", 4, 8);
    add("best", 5, 5);
  }
  // Of the shadow tests alone: as much false shadow, and 20 samples of false light more.
  for (std::size_t i = 0, drawn = record.results.size(); i < drawn; ++i) {
    study::ResultRecord test = record.results[i];
    if (test.region != "all") continue;
    test.answer = study::Answer::test;
    test.counts = countsOf(1000, test.counts.falsePositive, test.counts.falseNegative + 20);
    record.results.push_back(std::move(test));
  }
  record.cost = {{"best", 960, 524'288, 16'384, 1.25}, {"close", 960, 1'048'576, 0, std::nullopt}};
  record.timings = {{"truth", 1.5}, {"render", 0.25}};
  record.judgements = {
      study::judge({"best", "elevation 15°", "camera", "all", "error_rate", {}, 0.02},
                   {"error_rate", 0.01, {}}),
      study::judge({"close", "elevation 15°", "camera", "distant", "iou", 0.5, {}},
                   {"iou", {}, "no samples"})};
  record.claims = {{"As long as in <i>the</i> displaced mesh", "the paper's section 4",
                    study::Verdict::held, "ratio 0.99"},
                   {"Closer than the flat one", "", study::Verdict::failed, "1.2 % against 1.0 %"},
                   {"No worse at noon", "", study::Verdict::notDistinguishable, ""},
                   {"Faster", "", study::Verdict::notEvaluated, ""}};
  return record;
}

/// Gives a record the differences of all its methods in every view: all lights together and each,
/// with intervals as wide as is asked for on either side.
inline void addDifferences(study::StudyRecord& record, double half) {
  record.differences.clear();
  const std::vector<std::string> methods = study::methodsOf(record);
  for (std::size_t a = 0; a < methods.size(); ++a) {
    for (std::size_t b = a + 1; b < methods.size(); ++b) {
      std::vector<study::DifferenceRecord> lights;
      for (const study::Case& which : study::casesOf(record)) {
        const study::ResultRecord* first = study::findResult(record, methods[a], which);
        const study::ResultRecord* second = study::findResult(record, methods[b], which);
        if (first == nullptr || second == nullptr) continue;
        const double difference = compare::rate(first->counts, "error_rate").value.value_or(0) -
                                  compare::rate(second->counts, "error_rate").value.value_or(0);
        const compare::Interval interval{difference - half, difference + half};
        const double uncertainty = study::uncertaintyOf(record, which).value_or(0);
        lights.push_back({which.view, which.light, methods[a], methods[b], difference, interval, "",
                          uncertainty, study::distinguish({difference, interval, uncertainty})});
      }
      if (lights.empty()) continue;
      // One view is enough for the tests.
      study::DifferenceRecord all = study::meanDifference(lights);
      all.light = study::allLights;
      record.differences.push_back(all);
      record.differences.insert(record.differences.end(), lights.begin(), lights.end());
    }
  }
}

}  // namespace gnomon::test
