#include "report/tables/formats/error_bar.h"

#include <algorithm>

#include "report/text/number_text.h"

namespace gnomon::report {

Html htmlErrorBar(const ErrorBar& bar) {
  if (!(bar.scale > 0)) return {};
  // The drawing is stretched over its cell.
  constexpr double width = 1000;
  const auto place = [&](double error) {
    return width * std::clamp(requireFinite(error, "error_rate") / bar.scale, 0.0, 1.0);
  };
  Html content;
  const auto rectangle = [&](HtmlLiteral kind, double from, double to, int top, int bottom) {
    if (!(to > from)) return;
    content += html("<rect class=\"{}\" x=\"{:.2f}\" y=\"{}\" width=\"{:.2f}\" height=\"{}\"/>",
                    htmlLiteral(kind), place(from), top, place(to) - place(from), bottom - top);
  };
  const auto line = [&](double x1, double x2, int top, int bottom) {
    content += html("<line x1=\"{:.2f}\" x2=\"{:.2f}\" y1=\"{}\" y2=\"{}\"/>", place(x1), place(x2),
                    top, bottom);
  };
  rectangle("back", 0, bar.scale, 4, 12);
  rectangle("shadow", 0, bar.falseShadow, 4, 12);
  rectangle("light", bar.falseShadow, bar.falseShadow + bar.falseLight, 4, 12);
  if (bar.uncertainty) {
    rectangle("truth", bar.error - *bar.uncertainty, bar.error + *bar.uncertainty, 1, 15);
  }
  if (bar.interval) {
    const auto [low, high] = *bar.interval;
    line(low, high, 8, 8);
    line(low, low, 4, 12);
    line(high, high, 4, 12);
  }
  return html(
      "<svg class=\"error\" viewBox=\"0 0 {} 16\" preserveAspectRatio=\"none\" "
      "aria-hidden=\"true\">{}</svg>",
      width, content);
}

}  // namespace gnomon::report
