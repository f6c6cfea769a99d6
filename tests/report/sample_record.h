#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compare/boundaries.h"
#include "compare/rates.h"
#include "study/judge/distinguish.h"
#include "study/judge/gates.h"
#include "study/record/cases.h"
#include "study/record/record.h"

namespace gnomon::test {

/// A made-up run: every field is set, figures are round so that expectations can be worked out by
/// hand, and the text holds what writers must escape.
inline StudyRecord emptyRecord() {
  StudyRecord record;
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

inline ResultRecord result(const std::string& method, const std::string& light,
                           const std::string& view, const std::string& region,
                           const Counts& counts) {
  return {method, light, view, region, counts};
}

/// Two distances, and one share for each of the others.
inline std::vector<Metric> boundaries(double assd, double hd95, double share) {
  std::vector<Metric> metrics;
  for (const std::string_view name : boundaryMetricNames()) metrics.push_back({name, share, {}});
  metrics[0].value = assd;
  metrics[1].value = hd95;
  return metrics;
}

/// Counts over `samples` samples, a quarter of them shadowed in the truth.
inline Counts countsOf(std::size_t samples, double falseShadow, double falseLight) {
  const auto n = static_cast<double>(samples);
  return {0.25 * n - falseLight, falseShadow, falseLight, 0.75 * n - falseShadow, samples};
}

/// Three methods, `lights` lights, one view, three regions ("distant" has no sample).
/// Method "best" has 10 wrong samples of 1000 per light, "close" 12, "rough, \"old\"" 100.
inline StudyRecord sampleRecord(int lights = 2) {
  StudyRecord record = emptyRecord();
  record.methods = {{"rough, \"old\"", "max-forsyth", "Flat", "Max 1988"},
                    {"close", "onoue-2004", "Curved <b>", "Onoue et al. 2004"},
                    {"best", "resampled-horizon", "Resampled", ""}};
  for (int i = 0; i < lights; ++i) {
    const std::string light = "elevation " + std::to_string(15 + 15 * i) + "°";
    record.truth.flips.push_back(
        {"camera", light, 0.002 + 0.002 * (i == 0 ? 0 : 1), 0.01, boundaries(0.25, 1.0, 0.75)});
    const auto add = [&](const std::string& method, double falseShadow, double falseLight) {
      const Counts all = countsOf(1000, falseShadow, falseLight);
      record.results.push_back(result(method, light, "camera", "all", all));
      record.results.back().lengths =
          method == "close" ? ShadowLengths{12, {}, {}, {}, {}}
                            : ShadowLengths{400, 1 + falseShadow / 100, 0.5, 2.0, 8.0};
      record.results.back().boundaries = boundaries(falseShadow / 8, falseShadow / 2, 0.5);
      const Counts lit{0, falseShadow, 0, 750 - falseShadow, 750};
      record.results.push_back(result(method, light, "camera", "lit", lit));
      record.results.push_back(result(method, light, "camera", "distant", Counts{}));
    };
    add("rough, \"old\"", 80, 20);
    add("close", 4, 8);
    add("best", 5, 5);
  }
  // Of the shadow tests alone: as much false shadow, and 20 samples of false light more.
  for (std::size_t i = 0, drawn = record.results.size(); i < drawn; ++i) {
    ResultRecord test = record.results[i];
    if (test.region != "all") continue;
    test.answer = Answer::test;
    test.counts = countsOf(1000, test.counts.falsePositive, test.counts.falseNegative + 20);
    record.results.push_back(std::move(test));
  }
  record.cost = {{"best", 960, 524'288, 16'384, 1.25}, {"close", 960, 1'048'576, 0, std::nullopt}};
  record.timings = {{"truth", 1.5}, {"render", 0.25}};
  record.judgements = {judge({"best", "elevation 15°", "camera", "all", "error_rate", {}, 0.02},
                             {"error_rate", 0.01, {}}),
                       judge({"close", "elevation 15°", "camera", "distant", "iou", 0.5, {}},
                             {"iou", {}, "no samples"})};
  record.claims = {{"As long as in <i>the</i> displaced mesh", "the paper's section 4",
                    Verdict::held, "ratio 0.99"},
                   {"Closer than the flat one", "", Verdict::failed, "1.2 % against 1.0 %"},
                   {"No worse at noon", "", Verdict::notDistinguishable, ""},
                   {"Faster", "", Verdict::notEvaluated, ""}};
  return record;
}

/// Gives a record the differences of all its methods in every view: all lights together and each,
/// with intervals as wide as is asked for on either side.
inline void addDifferences(StudyRecord& record, double half) {
  record.differences.clear();
  const std::vector<std::string> methods = methodsOf(record);
  for (std::size_t a = 0; a < methods.size(); ++a) {
    for (std::size_t b = a + 1; b < methods.size(); ++b) {
      std::vector<DifferenceRecord> lights;
      for (const Case& which : casesOf(record)) {
        const ResultRecord* first = findResult(record, methods[a], which);
        const ResultRecord* second = findResult(record, methods[b], which);
        if (first == nullptr || second == nullptr) continue;
        const double difference = rate(first->counts, "error_rate").value.value_or(0) -
                                  rate(second->counts, "error_rate").value.value_or(0);
        const Interval interval{difference - half, difference + half};
        const double uncertainty = uncertaintyOf(record, which).value_or(0);
        lights.push_back({which.view, which.light, methods[a], methods[b], difference, interval, "",
                          uncertainty, distinguish({difference, interval, uncertainty})});
      }
      if (lights.empty()) continue;
      // One view is enough for the tests.
      DifferenceRecord all = meanDifference(lights);
      all.light = allLights;
      record.differences.push_back(all);
      record.differences.insert(record.differences.end(), lights.begin(), lights.end());
    }
  }
}

}  // namespace gnomon::test
