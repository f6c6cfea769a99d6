#include "compare/rates.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "common/error.h"
#include "compare/masks.h"

namespace gnomon::compare {
namespace {

using test::arbitraryComparison;
using test::Comparison;
using test::complement;
using test::row;

Counts counts(double tp, double fp, double fn, double tn, std::size_t samples = 1) {
  return {tp, fp, fn, tn, samples};
}

double value(const Counts& c, MetricId id) {
  const Metric metric = rate(c, id);
  EXPECT_TRUE(metric.value) << id.name() << ": " << metric.reason;
  return metric.value.value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Undefined, and for this reason.
void expectUndefined(const Counts& c, MetricId id, std::string_view reason) {
  const Metric metric = rate(c, id);
  EXPECT_FALSE(metric.value) << id.name();
  EXPECT_EQ(metric.reason, reason) << id.name();
}

Counts arbitraryCounts() {
  const Comparison c = arbitraryComparison();
  return countSamples(c.candidate, c.truth, c.weights);
}

bool near(double a, double b) {
  return std::abs(a - b) <= 1e-12;
}

TEST(Rates, ByHand) {
  const Counts c = counts(3, 2, 1, 4, 10);
  EXPECT_DOUBLE_EQ(value(c, "error_rate"), 0.3);
  EXPECT_DOUBLE_EQ(value(c, "false_shadow"), 0.2);
  EXPECT_DOUBLE_EQ(value(c, "false_light"), 0.1);
  EXPECT_DOUBLE_EQ(value(c, "fpr"), 2.0 / 6);
  EXPECT_DOUBLE_EQ(value(c, "fnr"), 1.0 / 4);
  EXPECT_DOUBLE_EQ(value(c, "ber"), 7.0 / 24);
  EXPECT_DOUBLE_EQ(value(c, "iou"), 0.5);
  EXPECT_DOUBLE_EQ(value(c, "f1"), 2.0 / 3);
  EXPECT_DOUBLE_EQ(value(c, "mcc"), 10 / std::sqrt(5.0 * 4 * 6 * 5));
  EXPECT_DOUBLE_EQ(value(c, "prevalence"), 0.4);
}

TEST(Rates, MaskToRateByHand) {
  // Six samples: one false shadow, one false light.
  const Counts c = countSamples(row("##...#"), row("#.#..#"));
  EXPECT_DOUBLE_EQ(value(c, "error_rate"), 1.0 / 3);
  EXPECT_DOUBLE_EQ(value(c, "iou"), 0.5);
  EXPECT_DOUBLE_EQ(value(c, "mcc"), 1.0 / 3);
}

TEST(Rates, PerfectAndOppositeMasksAreExact) {
  for (const double tp : {1.0, 3.0, 1e-9, 7e8}) {
    const Counts perfect = counts(tp, 0, 0, 5, 8);
    for (const MetricId zero : std::initializer_list<MetricId>{
             "error_rate", "false_shadow", "false_light", "fpr", "fnr", "ber"}) {
      EXPECT_EQ(value(perfect, zero), 0) << zero;
    }
    for (const char* one : {"iou", "f1", "mcc"}) EXPECT_EQ(value(perfect, one), 1) << one;
    const Counts opposite = counts(0, tp, 5, 0, 8);
    EXPECT_EQ(value(opposite, "mcc"), -1);
    EXPECT_EQ(value(opposite, "iou"), 0);
    EXPECT_EQ(value(opposite, "f1"), 0);
    EXPECT_EQ(value(opposite, "ber"), 1);
  }
}

TEST(Rates, AnAnswerThatIgnoresTheTruthScoresAsChance) {
  // Independent masks: candidate shadows 30 %, truth 20 %.
  const Counts c = counts(0.06, 0.24, 0.14, 0.56, 100);
  EXPECT_NEAR(value(c, "mcc"), 0, 1e-15);
  EXPECT_NEAR(value(c, "ber"), 0.5, 1e-15);
}

TEST(Rates, IdentitiesHoldForRandomMasks) {
  EXPECT_TRUE(rc::check([] {
    const Counts c = arbitraryCounts();
    const auto get = [&](std::string_view name) { return rate(c, name).value; };
    const auto error = get("error_rate");
    RC_ASSERT(error.has_value() == (c.total() > 0));
    if (!error) return;
    RC_ASSERT(near(*error, *get("false_shadow") + *get("false_light")));
    const auto iou = get("iou");
    RC_ASSERT(iou.has_value() == get("f1").has_value());
    if (iou) RC_ASSERT(near(*get("f1"), 2 * *iou / (1 + *iou)));
    RC_ASSERT(get("ber").has_value() == (get("fpr") && get("fnr")));
    if (get("ber")) RC_ASSERT(near(*get("ber"), (*get("fpr") + *get("fnr")) / 2));
    const double shadow = *get("prevalence");
    const double ofShadow = get("fnr").value_or(0) * shadow;
    RC_ASSERT(near(*error, get("fpr").value_or(0) * (1 - shadow) + ofShadow));
  }));
}

TEST(Rates, MccIsTheCorrelationOfTheTwoMasks) {
  EXPECT_TRUE(rc::check([] {
    const Comparison c = arbitraryComparison();
    const Counts counted = countSamples(c.candidate, c.truth);
    // Pearson's correlation of 0/1 variables, sample by sample.
    double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    for (std::size_t i = 0; i < c.truth.size(); ++i) {
      if (c.truth.samples[i] == Shade::none) continue;
      const double a = c.candidate.samples[i] == Shade::shadowed ? 1 : 0;
      const double b = c.truth.samples[i] == Shade::shadowed ? 1 : 0;
      n += 1, x += a, y += b, xx += a * a, yy += b * b, xy += a * b;
    }
    const double spread = (n * xx - x * x) * (n * yy - y * y);
    const auto mcc = rate(counted, "mcc").value;
    RC_ASSERT(mcc.has_value() == (spread > 0));
    if (mcc) RC_ASSERT(near(*mcc, (n * xy - x * y) / std::sqrt(spread)));
  }));
}

TEST(Rates, SymmetriesHoldForRandomMasks) {
  EXPECT_TRUE(rc::check([] {
    const Comparison c = arbitraryComparison();
    const Counts ab = countSamples(c.candidate, c.truth, c.weights);
    const Counts ba = countSamples(c.truth, c.candidate, c.weights);
    const Counts inverse = countSamples(complement(c.candidate), complement(c.truth), c.weights);
    const auto same = [](std::optional<double> a, std::optional<double> b) {
      return a.has_value() == b.has_value() && (!a || near(*a, *b));
    };
    for (const MetricId name : std::initializer_list<MetricId>{"error_rate", "iou", "f1", "mcc"}) {
      RC_ASSERT(same(rate(ab, name).value, rate(ba, name).value));
    }
    RC_ASSERT(same(rate(ab, "false_shadow").value, rate(ba, "false_light").value));
    for (const MetricId name : std::initializer_list<MetricId>{"error_rate", "ber", "mcc"}) {
      RC_ASSERT(same(rate(ab, name).value, rate(inverse, name).value));
    }
    RC_ASSERT(same(rate(ab, "fpr").value, rate(inverse, "fnr").value));
  }));
}

TEST(Rates, StayInTheirRange) {
  EXPECT_TRUE(rc::check([] {
    for (const Metric& metric : rates(arbitraryCounts())) {
      RC_ASSERT(metric.value.has_value() == metric.reason.empty());
      if (!metric.value) continue;
      RC_ASSERT(*metric.value <= 1);
      RC_ASSERT(*metric.value >= (metric.id == "mcc" ? -1 : 0));
    }
  }));
}

TEST(Rates, NothingIsDefinedWithoutSamplesOrArea) {
  for (const MetricId id : metricsOfKinds({MetricKind::rate})) {
    expectUndefined(counts(0, 0, 0, 0, 0), id, "no samples");
    expectUndefined(counts(0, 0, 0, 0, 9), id, "the samples have no area");
  }
}

TEST(Rates, UndefinedCasesSayWhy) {
  const Counts noTruthShadow = counts(0, 2, 0, 3);
  expectUndefined(noTruthShadow, "fnr", "the truth has no shadow");
  expectUndefined(noTruthShadow, "ber", "the truth has no shadow");
  expectUndefined(noTruthShadow, "mcc", "the truth has no shadow");
  EXPECT_EQ(value(noTruthShadow, "iou"), 0);
  EXPECT_EQ(value(noTruthShadow, "fpr"), 0.4);

  const Counts noShadow = counts(0, 0, 0, 3);
  expectUndefined(noShadow, "iou", "neither the truth nor the candidate has a shadow");
  expectUndefined(noShadow, "f1", "neither the truth nor the candidate has a shadow");
  EXPECT_EQ(value(noShadow, "error_rate"), 0);

  const Counts noTruthLight = counts(2, 0, 3, 0);
  expectUndefined(noTruthLight, "fpr", "the truth has no lit sample");
  expectUndefined(noTruthLight, "ber", "the truth has no lit sample");
  expectUndefined(noTruthLight, "mcc", "the truth has no lit sample");
  EXPECT_EQ(value(noTruthLight, "fnr"), 0.6);

  expectUndefined(counts(0, 0, 2, 3), "mcc", "the candidate has no shadow");
  expectUndefined(counts(2, 3, 0, 0), "mcc", "the candidate has no lit sample");
}

TEST(Rates, DoNotDependOnTheUnitOfArea) {
  const Counts c = counts(3, 2, 1, 4, 10);
  for (const double unit : {1e-300, 1e-150, 1e150, 1e307}) {
    const Counts scaled = counts(3 * unit, 2 * unit, 1 * unit, 4 * unit, 10);
    for (const MetricId id : metricsOfKinds({MetricKind::rate})) {
      EXPECT_NEAR(value(scaled, id), value(c, id), 1e-14) << id.name() << " at " << unit;
    }
  }
}

TEST(Rates, RefusesCellsThatNoMaskCanHave) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinite, -1.0}) {
    EXPECT_THROW(rates(counts(1, bad, 1, 1)), InternalError);
    EXPECT_THROW(rate(counts(1, 1, 1, bad), "iou"), InternalError);
  }
}

TEST(Rates, AreThoseOfTheTable) {
  const Counts c = counts(3, 2, 1, 4, 10);
  const std::vector<MetricId> ids = metricsOfKinds({MetricKind::rate});
  const std::vector<Metric> metrics = rates(c);
  ASSERT_EQ(metrics.size(), ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    EXPECT_EQ(metrics[i].id, ids[i]);
    EXPECT_EQ(metrics[i].value, rate(c, ids[i]).value);
  }
  EXPECT_THROW(rate(c, "assd"), InternalError);
}

TEST(MetricTable, HasEveryNameOnceByKinds) {
  std::set<std::string_view> names;
  MetricKind last = MetricKind::rate;
  for (const MetricId id : allMetrics()) {
    EXPECT_TRUE(names.insert(id.name()).second) << id.name();
    EXPECT_EQ(MetricId::find(id.name()), id);
    EXPECT_GE(id.kind(), last) << "in the order of columns";
    last = id.kind();
  }
  EXPECT_EQ(MetricId::find("accuracy"), std::nullopt);
  EXPECT_THROW((void)MetricId::of("accuracy"), InternalError);
}

}  // namespace
}  // namespace gnomon::compare
