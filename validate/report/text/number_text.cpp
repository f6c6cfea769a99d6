#include "report/text/number_text.h"

#include <fmt/core.h>

#include <cmath>

#include "common/error.h"

namespace gnomon::report {

double requireFinite(double value, std::string_view what) {
  if (!std::isfinite(value)) {
    throw InternalError(fmt::format("{}: {} found, a finite number expected", what, value));
  }
  return value;
}

std::string percentText(std::optional<double> share) {
  if (!share) return "–";
  const double percent = 100 * requireFinite(*share, "rate");
  if (percent > 0 && percent < 0.005) return "<0.01";
  if (percent < 100 && percent > 99.995) return ">99.99";
  return fmt::format("{:.2f}", percent);
}

const char* errorWhole(bool isSoft) {
  return isSoft ? "the light" : "the samples";
}

const char* leastErrorText(bool isSoft) {
  return isSoft ? "the smallest error" : "the fewest wrong samples";
}

std::string errorAxis(bool isSoft) {
  return fmt::format("error rate, percent of {}", errorWhole(isSoft));
}

std::string binErrorAxis(bool isSoft) {
  return fmt::format("wrong, percent of the bin’s {}", isSoft ? "light" : "samples");
}

std::string signedPercent(double share) {
  if (share == 0) return "0.00";
  return (share < 0 ? "−" : "+") + percentText(std::abs(share));
}

std::string correlationText(std::optional<double> value) {
  if (!value) return "–";
  const double correlation = requireFinite(*value, "correlation");
  if (correlation < 1 && correlation > 0.9995) return ">0.999";
  if (correlation > -1 && correlation < -0.9995) return "<−0.999";
  const std::string digits = fmt::format("{:.3f}", std::abs(correlation));
  return correlation < 0 && digits != "0.000" ? "−" + digits : digits;
}

std::string ratioText(std::optional<double> value) {
  if (!value) return "–";
  const double ratio = requireFinite(*value, "ratio");
  return ratio > 0 && ratio < 0.005 ? "<0.01" : fmt::format("{:.2f}", ratio);
}

std::string exactText(double value) {
  return fmt::format("{}", requireFinite(value, "value"));
}

std::string exactText(std::optional<double> value) {
  return value ? exactText(*value) : "";
}

std::string binText(const std::optional<double>& low, const std::optional<double>& high) {
  if (!low && !high) return "all";
  if (!low) return "below " + exactText(*high);
  if (!high) return exactText(*low) + " and more";
  return fmt::format("{} to {}", exactText(*low), exactText(*high));
}

std::string groupedText(std::uint64_t value) {
  std::string digits = fmt::format("{}", value);
  for (std::size_t place = digits.size(); place > 3; place -= 3) digits.insert(place - 3, "\u202f");
  return digits;
}

std::string_view runStatusName(study::RunStatus status) {
  switch (status) {
    case study::RunStatus::pass:
      return "pass";
    case study::RunStatus::fail:
      return "fail";
    case study::RunStatus::notJudged:
      return "not judged";
  }
  throw InternalError("status of a run: not one of its three values");
}

std::string_view inputKindName(study::InputRecord::Kind kind) {
  switch (kind) {
    case study::InputRecord::Kind::study:
      return "study";
    case study::InputRecord::Kind::mesh:
      return "mesh";
    case study::InputRecord::Kind::image:
      return "image";
    case study::InputRecord::Kind::shader:
      return "shader";
    case study::InputRecord::Kind::mask:
      return "mask";
  }
  throw InternalError("input: not one of its five kinds");
}

std::string_view differenceVerdictName(study::DifferenceVerdict verdict) {
  switch (verdict) {
    case study::DifferenceVerdict::better:
      return "better";
    case study::DifferenceVerdict::worse:
      return "worse";
    case study::DifferenceVerdict::equal:
      return "equal";
    case study::DifferenceVerdict::notDistinguishable:
      return "not distinguishable";
    case study::DifferenceVerdict::noInterval:
      return "no interval";
  }
  throw InternalError("verdict of a difference: not one of its five values");
}

std::string_view pictureKindName(study::PictureRecord::Kind kind) {
  switch (kind) {
    case study::PictureRecord::Kind::shaded:
      return "shaded";
    case study::PictureRecord::Kind::difference:
      return "difference";
    case study::PictureRecord::Kind::displaced:
      return "displaced";
  }
  throw InternalError("picture: not one of its three kinds");
}

}  // namespace gnomon::report
