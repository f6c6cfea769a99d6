#include "report/plots/budget_bars.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/text/html_text.h"
#include "report/text/number_text.h"
#include "report/text/text_width.h"

namespace gnomon {
namespace {

/// Paul Tol's "muted" scheme in an order that sets light beside dark, and one of his oranges; then
/// what is left.
constexpr std::array<const char*, 10> colours = {"#332288", "#88ccee", "#117733", "#ddcc77",
                                                 "#cc6677", "#44aa99", "#882255", "#999933",
                                                 "#aa4499", "#ee7733"};
constexpr const char* distantColour = "#5f5f5f";
constexpr const char* otherColour = "#bbbbbb";
constexpr const char* distantName = "left: distant occluders";
constexpr const char* otherName = "left: other";

constexpr double pageWidth = 1000;
constexpr double labelWidth = 240;
constexpr double valueWidth = 70;
constexpr double barHeight = 24;
constexpr double rowHeight = 30;
constexpr double groupGap = 16;
constexpr double axisHeight = 34;

std::size_t partOf(const std::vector<BudgetPart>& parts, const std::string& name) {
  const auto found = std::find_if(parts.begin(), parts.end(),
                                  [&](const BudgetPart& part) { return part.name == name; });
  return static_cast<std::size_t>(found - parts.begin());
}

/// The shares of a bar, one a part, not placed yet.
std::vector<BudgetBox> sharesOf(const BudgetRecord& budget, const std::vector<BudgetPart>& parts,
                                BudgetShare BudgetCause::*way) {
  std::vector<BudgetBox> boxes;
  for (const BudgetCause& cause : budget.causes) {
    boxes.push_back({partOf(parts, cause.name), (cause.*way).value});
  }
  boxes.push_back({partOf(parts, distantName), budget.distant.value});
  boxes.push_back({partOf(parts, otherName), budget.other.value});
  return boxes;
}

/// The ends of a bar: the sums of the shares below 0 and above it.
struct Span {
  double low = 0;
  double high = 0;

  void add(double share) { (share < 0 ? low : high) += share; }
};

Span spanOf(std::span<const BudgetRecord> budgets, const std::vector<BudgetPart>& parts) {
  Span all;
  for (const BudgetRecord& budget : budgets) {
    for (const auto way : {&BudgetCause::forward, &BudgetCause::backward}) {
      Span bar;
      for (const BudgetBox& box : sharesOf(budget, parts, way)) bar.add(box.share);
      all = {std::min(all.low, bar.low), std::max(all.high, bar.high)};
    }
  }
  return all;
}

/// 1, 2 or 5 times a power of ten, so that a range has some six ticks.
double tickStep(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 6)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power * 7 >= range) return factor * power;
  }
  return 10 * power;
}

class Chart {
 public:
  Chart(std::span<const BudgetRecord> budgets, const std::vector<BudgetPart>& parts)
      : parts_(parts), span_(spanOf(budgets, parts)) {
    if (!(span_.high > span_.low)) span_.high = span_.low + 0.01;
    scale_ = (pageWidth - labelWidth - valueWidth) / (span_.high - span_.low);
    height_ = static_cast<double>(budgets.size()) * (2 * rowHeight + groupGap) + axisHeight;
    axis();
    double top = 0;
    for (const BudgetRecord& budget : budgets) {
      bar(budget, &BudgetCause::forward, "forward", top);
      bar(budget, &BudgetCause::backward, "backward", top + rowHeight);
      top += 2 * rowHeight + groupGap;
    }
  }

  [[nodiscard]] std::string svg() const {
    return fmt::format(
        "<svg class=\"budget\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"Error of "
        "each "
        "method by cause; the table holds the same figures\">\n{}</svg>\n",
        pageWidth, height_, content_);
  }

 private:
  [[nodiscard]] double place(double share) const {
    return labelWidth + (share - span_.low) * scale_;
  }

  void text(double x, double y, const char* kind, const std::string& content) {
    content_ += fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", kind, x, y,
                            escapeHtml(content));
  }

  void line(const char* kind, double x, double top, double bottom) {
    content_ += fmt::format(
        "<line class=\"{0}\" x1=\"{1:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{3:.1f}\"/>\n", kind,
        x, top, bottom);
  }

  void axis() {
    const double bottom = height_ - axisHeight;
    const double step = tickStep(span_.high - span_.low);
    for (double k = std::ceil(span_.low / step); k * step <= span_.high; ++k) {
      line(k == 0 ? "zero" : "tick", place(k * step), 0, bottom);
      text(place(k * step), bottom + 16, "number",
           fmt::format("{:g} %", k == 0 ? 0 : 100 * k * step));
    }
  }

  void bar(const BudgetRecord& budget, BudgetShare BudgetCause::*way, const std::string& order,
           double top) {
    const double middle = top + barHeight / 2 + 5;
    if (way == &BudgetCause::forward) text(0, middle, "method", fitted(budget.method));
    text(labelWidth - 10, middle, "order", order);
    double end = 0;
    for (const BudgetBox& box : budgetBoxes(budget, parts_, way)) {
      end = std::max(end, box.to);
      rectangle(box, top);
    }
    line("total", place(budget.total.value), top - 2, top + barHeight + 2);
    text(place(end) + 8, middle, "value", percentText(budget.total.value));
  }

  void rectangle(const BudgetBox& box, double top) {
    const double width = (box.to - box.from) * scale_;
    if (width < 0.05) return;
    const BudgetPart& part = parts_.at(box.part);
    content_ += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{:.0f}\" fill=\"{}\">"
        "<title>{}: {:+.2f} %</title></rect>\n",
        place(box.from), top, width, barHeight, part.colour, escapeHtml(part.name),
        100 * requireFinite(box.share, "budget.share"));
    constexpr double roomForNumber = 16;
    if (width < roomForNumber) return;
    content_ +=
        fmt::format("<text class=\"part\" x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\">{}</text>\n",
                    place(box.from) + width / 2, top + barHeight / 2 + 5,
                    isDark(part.colour) ? "#fff" : "#000", box.part + 1);
  }

  static bool isDark(const std::string& colour) {
    const auto channel = [&](std::size_t at) {
      return std::stoi(colour.substr(at, 2), nullptr, 16);
    };
    return 299 * channel(1) + 587 * channel(3) + 114 * channel(5) < 128'000;
  }

  static std::string fitted(const std::string& label) {
    constexpr std::size_t longest = 20;
    return displayWidth(label) > longest ? fitLeft(label, longest) : label;
  }

  const std::vector<BudgetPart>& parts_;
  Span span_;
  double scale_ = 1;
  double height_ = 0;
  std::string content_;
};

}  // namespace

std::vector<BudgetPart> budgetParts(std::span<const BudgetRecord> budgets) {
  std::vector<BudgetPart> parts;
  for (const BudgetRecord& budget : budgets) {
    for (const BudgetCause& cause : budget.causes) {
      if (partOf(parts, cause.name) < parts.size()) continue;
      parts.push_back({cause.name, colours.at(parts.size() % colours.size())});
    }
  }
  parts.push_back({distantName, distantColour});
  parts.push_back({otherName, otherColour});
  return parts;
}

std::vector<BudgetBox> budgetBoxes(const BudgetRecord& budget, const std::vector<BudgetPart>& parts,
                                   BudgetShare BudgetCause::*way) {
  std::vector<BudgetBox> boxes = sharesOf(budget, parts, way);
  Span drawn;
  for (BudgetBox& box : boxes) {
    const double end = box.share < 0 ? drawn.low : drawn.high;
    drawn.add(box.share);
    box.from = std::min(end, end + box.share);
    box.to = std::max(end, end + box.share);
  }
  return boxes;
}

std::string budgetBars(std::span<const BudgetRecord> budgets,
                       const std::vector<BudgetPart>& parts) {
  return Chart(budgets, parts).svg();
}

std::string budgetKey(const std::vector<BudgetPart>& parts) {
  std::string items;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    items += fmt::format("<li><i style=\"background:{}\"></i>{} {}</li>\n", parts[i].colour, i + 1,
                         escapeHtml(parts[i].name));
  }
  return "<ul class=\"legend\">\n" + items + "</ul>\n";
}

}  // namespace gnomon
