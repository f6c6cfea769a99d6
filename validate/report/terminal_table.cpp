#include "report/terminal_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "report/cases.h"
#include "report/names.h"
#include "report/number_text.h"
#include "report/text_width.h"
#include "study/result_metrics.h"

namespace gnomon {
namespace {

constexpr std::size_t pageWidth = 100;
constexpr std::size_t indent = 2;
constexpr std::size_t lightWidth = 16;
constexpr std::size_t lightsInOwnBlocks = 3;

struct Column {
  std::string_view metric;
  std::string_view title;
  std::size_t width;
  std::string (*text)(std::optional<double>) = percentText;
};

constexpr std::array<Column, 6> columns = {{{"error_rate", "error", 8},
                                            {"false_shadow", "false shadow", 14},
                                            {"false_light", "false light", 13},
                                            {"iou", "IoU", 9},
                                            {"ber", "BER", 9},
                                            {"shadow_length_ratio", "length", 9, ratioText}}};
constexpr std::size_t markWidth = 2;

constexpr std::size_t labelRoom() {
  std::size_t width = pageWidth - indent - markWidth;
  for (const Column& column : columns) width -= column.width;
  return width;
}

class Page {
 public:
  explicit Page(bool colours) : colours_(colours) {}

  void line(const std::string& text) { text_ += text + "\n"; }
  void blank() { text_ += "\n"; }

  /// Text of any length, broken to the page's width.
  void paragraph(std::string_view text, std::size_t margin = 0) {
    for (const std::string& part : wrapText(text, pageWidth - margin)) {
      line(std::string(margin, ' ') + part);
    }
  }
  void heading(std::string_view text) {
    for (const std::string& part : wrapText(text, pageWidth)) line(styled(part, "1"));
  }
  [[nodiscard]] std::string styled(const std::string& text, const char* code) const {
    return colours_ ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : text;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  bool colours_;
  std::string text_;
};

/// How wide the two name columns of a block are; `light` is 0 where the heading names the light.
struct NameWidths {
  std::size_t light = 0;
  std::size_t method = 0;
};

std::string nameCells(const NameWidths& widths, std::string_view light, std::string_view method) {
  std::string cells(indent, ' ');
  if (widths.light > 0) cells += fitLeft(light, widths.light) + "  ";
  return cells + fitLeft(method, widths.method);
}

std::string tableHead(const NameWidths& widths) {
  std::string head = nameCells(widths, "light", "method");
  for (const Column& column : columns) head += fitRight(column.title, column.width);
  return head;
}

std::string tableRow(const NameWidths& widths, std::string_view light, const ResultRecord& result,
                     bool closeToBest) {
  std::string row = nameCells(widths, light, result.method);
  for (const Column& column : columns) {
    row += fitRight(column.text(metricOf(result, column.metric).value), column.width);
  }
  return closeToBest ? row + " ≈" : row;
}

NameWidths nameWidths(const std::vector<std::string>& methods, const std::vector<Case>& cases,
                      bool withLight) {
  NameWidths widths;
  widths.method = displayWidth("method");
  for (const std::string& method : methods) {
    widths.method = std::max(widths.method, displayWidth(method));
  }
  if (withLight) {
    widths.light = displayWidth("light");
    for (const Case& which : cases) {
      widths.light = std::min(lightWidth, std::max(widths.light, displayWidth(which.light)));
    }
  }
  const std::size_t taken = withLight ? widths.light + 2 : 0;
  widths.method = std::min(widths.method, labelRoom() - taken);
  return widths;
}

/// One case's rows, and which method's error is the smallest.
struct CaseRows {
  std::vector<const ResultRecord*> rows;
  const ResultRecord* best = nullptr;
};

std::optional<double> errorOf(const ResultRecord& result) {
  return metricOf(result, "error_rate").value;
}

bool isBetter(const ResultRecord& a, const ResultRecord& b) {
  return errorOf(a) && (!errorOf(b) || *errorOf(a) < *errorOf(b));
}

CaseRows rowsOf(const StudyRecord& record, const std::vector<std::string>& methods,
                const Case& which) {
  CaseRows found;
  for (const std::string& method : methods) {
    const ResultRecord* row = findResult(record, method, which);
    if (row == nullptr) continue;
    found.rows.push_back(row);
    if (found.best == nullptr || isBetter(*row, *found.best)) found.best = row;
  }
  return found;
}

void appendCase(Page& page, const StudyRecord& record, const std::vector<std::string>& methods,
                const Case& which, const NameWidths& widths) {
  const std::optional<double> uncertainty = uncertaintyOf(record, which);
  const CaseRows found = rowsOf(record, methods, which);
  std::string_view light = which.light;
  for (const ResultRecord* row : found.rows) {
    const bool close =
        row != found.best && notDistinguishable(errorOf(*row), errorOf(*found.best), uncertainty);
    page.line(tableRow(widths, light, *row, close));
    if (widths.light > 0) light = "";
  }
}

std::string uncertaintyText(std::optional<double> uncertainty) {
  return uncertainty ? "truth ± " + percentText(uncertainty) : "truth's uncertainty not measured";
}

/// A block of its own for each light.
void appendLightBlocks(Page& page, const StudyRecord& record, const std::vector<Case>& cases) {
  const std::vector<std::string> methods = methodsOf(record);
  const NameWidths widths = nameWidths(methods, cases, false);
  for (const Case& which : cases) {
    page.blank();
    page.heading(fmt::format("{} · {} ({})", which.view, which.light,
                             uncertaintyText(uncertaintyOf(record, which))));
    page.line(tableHead(widths));
    appendCase(page, record, methods, which, widths);
  }
}

/// One block for all lights of a view.
void appendViewBlock(Page& page, const StudyRecord& record, const std::vector<Case>& cases) {
  std::optional<double> largest;
  for (const Case& which : cases) {
    if (const auto u = uncertaintyOf(record, which)) largest = std::max(largest.value_or(0), *u);
  }
  const std::vector<std::string> methods = methodsOf(record);
  const NameWidths widths = nameWidths(methods, cases, true);
  page.blank();
  page.heading(fmt::format("{} · {} lights ({}{})", cases.front().view, cases.size(),
                           uncertaintyText(largest), largest ? " at most" : ""));
  page.line(tableHead(widths));
  for (const Case& which : cases) appendCase(page, record, methods, which, widths);
}

void appendResults(Page& page, const StudyRecord& record) {
  std::vector<Case> left = casesOf(record);
  if (left.empty()) return;
  page.paragraph(
      "Rates in percent of the samples; length is that of the cast shadows over the truth's, the "
      "median. ≈ not distinguishable from the best of its light.");
  while (!left.empty()) {
    const std::string view = left.front().view;
    const auto rest = std::stable_partition(left.begin(), left.end(),
                                            [&](const Case& c) { return c.view == view; });
    const std::vector<Case> ofView(left.begin(), rest);
    left.erase(left.begin(), rest);
    if (ofView.size() > lightsInOwnBlocks) {
      appendViewBlock(page, record, ofView);
    } else {
      appendLightBlocks(page, record, ofView);
    }
  }
}

const char* verdictColour(Verdict verdict) {
  return verdict == Verdict::held ? "32" : verdict == Verdict::failed ? "31" : "33";
}

void appendClaims(Page& page, const StudyRecord& record) {
  if (record.claims.empty()) return;
  constexpr std::size_t margin = indent + 21;
  page.blank();
  page.heading("Claims");
  for (const ClaimRecord& claim : record.claims) {
    const std::string verdict = fitLeft(verdictName(claim.verdict), margin - indent);
    std::vector<std::string> lines = wrapText(claim.text, pageWidth - margin);
    if (lines.empty()) lines.emplace_back();
    page.line(std::string(indent, ' ') + page.styled(verdict, verdictColour(claim.verdict)) +
              lines.front());
    for (std::size_t i = 1; i < lines.size(); ++i) page.line(std::string(margin, ' ') + lines[i]);
    page.paragraph(claim.detail, margin);
  }
}

std::string failureText(const ThresholdRecord& threshold) {
  std::string text =
      fmt::format("{}, {}, {}, region {}: {} is {}", threshold.method, threshold.light,
                  threshold.view, threshold.region, threshold.metric,
                  threshold.value ? exactText(*threshold.value) : "undefined");
  if (threshold.maximum) text += fmt::format(", at most {} allowed", exactText(*threshold.maximum));
  if (threshold.minimum)
    text += fmt::format(", at least {} required", exactText(*threshold.minimum));
  return text;
}

void appendThresholds(Page& page, const StudyRecord& record) {
  if (record.thresholds.empty()) return;
  const auto failed = std::count_if(record.thresholds.begin(), record.thresholds.end(),
                                    [](const auto& threshold) { return !threshold.passed; });
  page.blank();
  page.heading(fmt::format("Thresholds: {} of {} met",
                           record.thresholds.size() - static_cast<std::size_t>(failed),
                           record.thresholds.size()));
  for (const ThresholdRecord& threshold : record.thresholds) {
    if (threshold.passed) continue;
    page.line(std::string(indent, ' ') + page.styled("failed", "31"));
    page.paragraph(failureText(threshold), 2 * indent);
  }
}

/// Where the time went: the stages that took a hundredth of a second or more.
void appendTimings(Page& page, const StudyRecord& record) {
  if (record.timings.empty()) return;
  double total = 0;
  std::string stages;
  for (const TimingRecord& timing : record.timings) {
    total += timing.seconds;
    if (timing.seconds < 0.01) continue;
    stages += fmt::format("{}{} {:.2f}", stages.empty() ? "" : ", ", timing.stage, timing.seconds);
  }
  page.blank();
  page.paragraph(fmt::format("Time {:.2f} s: {}", total, stages));
}

}  // namespace

std::string resultTable(const StudyRecord& record, bool colours) {
  Page page(colours);
  page.heading(record.title.empty() ? record.name : record.title);
  page.paragraph(record.source);
  appendResults(page, record);
  appendClaims(page, record);
  appendThresholds(page, record);
  appendTimings(page, record);
  return page.text();
}

}  // namespace gnomon
