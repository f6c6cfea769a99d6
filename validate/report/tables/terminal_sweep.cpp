#include "report/tables/terminal_sweep.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/text/gate_text.h"
#include "report/text/number_text.h"
#include "report/text/terminal_page.h"
#include "report/text/text_width.h"
#include "study/judge/study_ranking.h"
#include "study/spec/sweep.h"

namespace gnomon {
namespace {

constexpr std::size_t mostLabel = 30;
constexpr std::size_t leastNumber = 9;
constexpr std::size_t mostNumber = 26;  // the longest text of a number, and a space

/// How wide the labels and the figures are.
struct SweepWidths {
  std::size_t label = 0;
  std::size_t number = leastNumber;
};

SweepWidths widthsFor(const SweepRecord& sweep, const std::vector<std::string>& labels) {
  SweepWidths widths;
  for (const std::string& label : labels) {
    widths.label = std::min(mostLabel, std::max(widths.label, displayWidth(label)));
  }
  for (const double value : sweep.values) {
    const std::size_t width = displayWidth(sweepValueText(value)) + 2;
    widths.number = std::min(mostNumber, std::max(widths.number, width));
  }
  return widths;
}

/// One row of the table; `text(i)` is the cell of value i, for those from `first` to before `last`.
template <typename Text>
std::string rowText(const SweepWidths& widths, const std::string& label, std::size_t first,
                    std::size_t last, const Text& text) {
  std::string row = std::string(terminalIndent, ' ') + fitLeft(label, widths.label);
  for (std::size_t i = first; i < last; ++i) row += fitRight(text(i), widths.number);
  return row;
}

void appendValues(TerminalPage& page, const SweepRecord& sweep) {
  constexpr const char* truth = "truth ±";
  std::vector<StudyMeans> steps;
  for (const StudyRecord& step : sweep.steps) steps.push_back(studyMeans(step));
  std::vector<std::string> labels;
  bool isMarked = false;
  for (const MethodMeans& method : studyMeans(sweep).methods) {
    labels.push_back(method.label);
    isMarked = isMarked || !method.isInEveryCase();
  }
  std::vector<std::string> all = labels;
  all.emplace_back(truth);
  const SweepWidths widths = widthsFor(sweep, all);
  const std::size_t columns = (terminalWidth - terminalIndent - widths.label) / widths.number;
  for (std::size_t first = 0; first < steps.size(); first += columns) {
    const std::size_t last = std::min(steps.size(), first + columns);
    const auto line = [&](const std::string& label, const auto& text) {
      page.line(rowText(widths, label, first, last, text));
    };
    page.blank();
    line("", [&](std::size_t i) { return sweepValueText(sweep.values.at(i)); });
    for (const std::string& label : labels) {
      line(label, [&](std::size_t i) {
        const MethodMeans* means = findMeans(steps[i], label);
        if (means == nullptr || !means->errorRate) return percentText(std::nullopt);
        return percentText(means->errorRate) + (means->isInEveryCase() ? "" : fewerCasesMark);
      });
    }
    line(truth, [&](std::size_t i) { return percentText(largestUncertainty(steps[i])); });
  }
  if (isMarked) page.paragraph(fewerCasesMeaning, terminalIndent);
}

void appendFailures(TerminalPage& page, const SweepRecord& sweep) {
  std::size_t gates = 0;
  std::vector<std::string> failures;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    for (Judgement& judgement : withOrigin<Threshold>(sweep.steps[i].judgements)) {
      ++gates;
      if (!judgement.isFault()) continue;
      judgement.gate.step = sweep.name;  // whose value is told already
      failures.push_back(fmt::format("{} = {}: {}", sweep.key, sweepValueText(sweep.values.at(i)),
                                     gateFaultText(judgement)));
    }
  }
  page.met("Thresholds", gates, failures);
}

}  // namespace

std::string sweepTable(const SweepRecord& sweep, bool colours) {
  TerminalPage page(colours);
  page.heading(sweep.title.empty() ? sweep.name : sweep.title);
  page.paragraph(sweep.source);
  page.notices(sweep.notices());
  page.paragraph(
      fmt::format("Error rate in percent, mean over lights and views, by {}", sweep.axis));
  appendValues(page, sweep);
  page.claims(sweep.claims);
  appendFailures(page, sweep);
  return page.text();
}

}  // namespace gnomon
