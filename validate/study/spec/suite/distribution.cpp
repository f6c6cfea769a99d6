#include "study/spec/suite/distribution.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace gnomon::study {

namespace {

/// 2¹⁰ steps in geometric progression: the products of the ratio's square root, that one's square
/// root and so on, by the bits of the step.
std::vector<double> progression(double first, double last) {
  std::array<double, 10> roots{};
  double root = last / first;
  for (double& one : roots) one = root = std::sqrt(root);
  constexpr unsigned steps = 1U << roots.size();
  std::vector<double> values;
  for (unsigned k = 0; k < steps; ++k) {
    double value = first;
    for (std::size_t bit = 0; bit < roots.size(); ++bit) {
      if ((k >> (roots.size() - 1 - bit) & 1U) != 0) value *= roots.at(bit);
    }
    values.push_back(roundedNumber(value));
  }
  values.push_back(roundedNumber(last));
  return values;
}

/// In whole millionths, so that each value is the double nearest to its decimal.
std::vector<double> steps(const TomlReader& section) {
  constexpr double millionths = 1e6;
  constexpr double most = 1e9;
  const auto whole = [&](std::string_view key, NumberRange range) {
    const double value = section.number(key, range) * millionths;
    const double rounded = std::round(value);
    if (std::abs(value - rounded) > 1e-3) section.fail(key, "six decimals at most expected");
    return static_cast<std::int64_t>(rounded);
  };
  const std::int64_t from = whole("from", {-most, most});
  const std::int64_t to = whole("to", {-most, most});
  const std::int64_t step = whole("step", {0, most, true});
  constexpr std::int64_t mostSteps = 100000;
  if (step < 1 || to < from || (to - from) / step > mostSteps || (to - from) % step != 0) {
    section.fail("step", fmt::format("a whole number of steps from `from` to `to` expected, at "
                                     "most {}",
                                     mostSteps));
  }
  std::vector<double> values;
  for (std::int64_t value = from; value <= to; value += step) {
    values.push_back(static_cast<double>(value) / millionths);
  }
  return values;
}

std::vector<double> valuesOf(const TomlReader& form, NumberRange range) {
  if (form.has("log")) {
    form.allow({"log"});
    const std::vector<double> ends = form.list("log", positive, 2);
    if (!(ends[0] < ends[1])) form.fail("log", "two rising numbers expected");
    return progression(ends[0], ends[1]);
  }
  if (form.has("among")) {
    form.allow({"among"});
    return form.numbers("among", range);
  }
  form.allow({"from", "to", "step"});
  return steps(form);
}

}  // namespace

double roundedNumber(double value) {
  return std::strtod(fmt::format("{:.3e}", value).c_str(), nullptr) + 0.0;  // no -0
}

double Distribution::draw(RandomStream& random) const {
  return values_[random.below(values_.size())];
}

Distribution readDistribution(const TomlReader& section, std::string_view key, NumberRange range) {
  const toml::node* node = section.find(key);
  if (node == nullptr || !node->is_table()) return Distribution({section.number(key, range)});
  std::vector<double> values = valuesOf(section.table(key), range);
  const auto isOut = [&](double v) {
    return v < range.least || v > range.most || (range.openBelow && v == range.least);
  };
  if (std::any_of(values.begin(), values.end(), isOut)) {
    section.fail(key, expectedNumber(range) + " expected of every value");
  }
  return Distribution(std::move(values));
}

namespace {

/// Σ (-1)^k x^(2k + first) / (2k + first)! for |x| ≤ π/4.
double series(double x, int first) {
  double term = first == 0 ? 1 : x;
  double sum = 0;
  for (int n = first; n < 24; n += 2) {
    sum += term;
    term *= -x * x / ((n + 1.0) * (n + 2.0));
  }
  return sum;
}

}  // namespace

SineCosine sineCosine(double degrees) {
  const double quarters = std::floor(degrees / 90 + 0.5);
  const double x = (degrees - 90 * quarters) * (pi / 180);
  const double sine = series(x, 1);
  const double cosine = series(x, 0);
  switch (static_cast<int>(quarters - 4 * std::floor(quarters / 4))) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

Vec3 exactDirection(double elevation, double azimuth) {
  const SineCosine up = sineCosine(elevation);
  const SineCosine round = sineCosine(azimuth);
  return {up.cosine * round.cosine, up.cosine * round.sine, up.sine};
}

}  // namespace gnomon::study
