#include "report/plots/error_bars.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/text/number_text.h"

namespace gnomon {
namespace {

/// Of the drawing, which is stretched over its cell.
constexpr double barsWidth = 1000;

class Bar {
 public:
  explicit Bar(double scale) : scale_(scale) {}

  void rectangle(const char* kind, double from, double to, int top, int bottom) {
    if (!(to > from)) return;
    content_ +=
        fmt::format("<rect class=\"{}\" x=\"{:.2f}\" y=\"{}\" width=\"{:.2f}\" height=\"{}\"/>",
                    kind, place(from), top, place(to) - place(from), bottom - top);
  }

  void line(double x1, double x2, int top, int bottom) {
    content_ += fmt::format("<line x1=\"{:.2f}\" x2=\"{:.2f}\" y1=\"{}\" y2=\"{}\"/>", place(x1),
                            place(x2), top, bottom);
  }

  [[nodiscard]] std::string svg() const {
    return fmt::format(
        "<svg class=\"error\" viewBox=\"0 0 {} 16\" preserveAspectRatio=\"none\" "
        "aria-hidden=\"true\">{}</svg>",
        barsWidth, content_);
  }

 private:
  [[nodiscard]] double place(double error) const {
    return barsWidth * std::clamp(requireFinite(error, "error_rate") / scale_, 0.0, 1.0);
  }

  double scale_;
  std::string content_;
};

}  // namespace

double errorBarScale(std::span<const RankedMethod> ranked) {
  double scale = 0;
  for (const RankedMethod& method : ranked) {
    const double error = method.errorRate.value.value_or(0);
    scale = std::max({scale, error + method.uncertainty.value_or(0),
                      method.interval ? method.interval->high : 0});
  }
  return scale;
}

std::string errorBar(const RankedMethod& method, double scale) {
  if (!method.errorRate.value || !(scale > 0)) return "";
  const double error = *method.errorRate.value;
  const double shadow = method.falseShadow.value.value_or(0);
  Bar bar(scale);
  bar.rectangle("back", 0, scale, 4, 12);
  bar.rectangle("shadow", 0, shadow, 4, 12);
  bar.rectangle("light", shadow, shadow + method.falseLight.value.value_or(0), 4, 12);
  if (method.uncertainty) {
    bar.rectangle("truth", error - *method.uncertainty, error + *method.uncertainty, 1, 15);
  }
  if (method.interval) {
    const auto [low, high] = *method.interval;
    bar.line(low, high, 8, 8);
    bar.line(low, low, 4, 12);
    bar.line(high, high, 4, 12);
  }
  return bar.svg();
}

}  // namespace gnomon
