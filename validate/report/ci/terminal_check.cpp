#include "report/ci/terminal_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "report/text/gate_text.h"
#include "report/text/number_text.h"
#include "report/text/terminal_page.h"
#include "report/text/text_width.h"
#include "study/record/cases.h"

namespace gnomon::report {
namespace {

constexpr std::size_t mostMethod = 24;
constexpr std::size_t verdictWidth = 11;

using Cells = std::array<std::string, 7>;
using CheckWidths = std::array<std::size_t, 7>;
enum CheckColumn : std::size_t { method, metric, place, value, limit, margin, verdict };

std::string anyOr(const std::string& name) {
  return name.empty() ? "any" : name;
}

std::string placeText(const study::Gate& gate) {
  std::string text = fmt::format("{}, {}", anyOr(gate.view), anyOr(gate.light));
  if (gate.region != study::wholeRegion) text += ", " + gate.region;
  if (gate.answer != study::Answer::drawn)
    text += fmt::format(", {}", study::answerName(gate.answer));
  const std::string value = study::stepValue(gate.step);
  return value.empty() ? text : value + ", " + text;
}

/// Four decimals; four digits where a limit is so far off that these would fill the table.
std::string marginText(double margin) {
  return std::abs(margin) < 1e4 ? fmt::format("{:+.4f}", margin) : fmt::format("{:+.3e}", margin);
}

Cells cellsOf(const study::Judgement& judgement) {
  const study::Gate& gate = judgement.gate;
  const auto margin = judgement.margin();
  return {anyOr(gate.method),
          std::string(gate.metric.name()),
          placeText(gate),
          judgement.value ? fmt::format("{:.4f}", *judgement.value) : "–",
          limitText(gate),
          margin ? marginText(*margin) : "–",
          gateVerdictName(judgement.verdict)};
}

/// Each column as wide as its widest cell; the method's, then the place's cut to what is left.
CheckWidths widthsOf(const std::vector<Cells>& rows) {
  CheckWidths widths{};
  for (const Cells& cells : rows) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      widths[i] = std::max(widths[i], displayWidth(cells[i]));
    }
  }
  widths[CheckColumn::method] = std::min(widths[CheckColumn::method], mostMethod);
  widths[CheckColumn::verdict] = verdictWidth;
  std::size_t taken = terminalIndent + 2 * (widths.size() - 1);
  for (std::size_t i = 0; i < widths.size(); ++i) taken += i == CheckColumn::place ? 0 : widths[i];
  const std::size_t room = taken < terminalWidth ? terminalWidth - taken : 1;
  widths[CheckColumn::place] = std::min(widths[CheckColumn::place], room);
  return widths;
}

std::string rowText(const Cells& cells, const CheckWidths& widths) {
  std::string row(terminalIndent, ' ');
  for (std::size_t i = 0; i < CheckColumn::verdict; ++i) {
    const bool number = i >= CheckColumn::value;
    row += (number ? fitRight(cells[i], widths[i]) : fitLeft(cells[i], widths[i])) + "  ";
  }
  return row;
}

const char* verdictColour(study::GateVerdict verdict) {
  return verdict == study::GateVerdict::passed ? "32" : "33";
}

std::size_t countOf(std::span<const study::Judgement> judgements, study::GateVerdict verdict) {
  return static_cast<std::size_t>(std::count_if(
      judgements.begin(), judgements.end(),
      [&](const study::Judgement& judgement) { return judgement.verdict == verdict; }));
}

/// Every gate that does not hold, whole, and how to reproduce it.
void appendFaults(TerminalPage& page, const study::CheckRecord& check) {
  if (const std::size_t count = check.problems.size(); count > 0) {
    const std::string errors = fmt::format("{} {}", count, count == 1 ? "error" : "errors");
    page.line(std::string(terminalIndent, ' ') + page.styled(errors, "31") +
              ", told on standard error");
  }
  for (const study::Judgement& judgement : check.judgements) {
    if (!judgement.isFault()) continue;
    const bool failed = judgement.verdict == study::GateVerdict::failed;
    page.fault(failed ? "failed" : "undefined", gateFaultText(judgement));
  }
  if (check.status() == ExitStatus::pass) return;
  page.line(std::string(terminalIndent, ' ') + "Reproduce:");
  page.line(std::string(2 * terminalIndent, ' ') + terminalText(check.command));
}

/// The thresholds that hold or are left out.
void appendTable(TerminalPage& page, std::vector<study::Judgement> judgements) {
  std::erase_if(judgements, [](const study::Judgement& judgement) { return judgement.isFault(); });
  if (judgements.empty()) return;
  std::vector<Cells> rows = {
      {"method", "metric", "view, light", "value", "limit", "margin", "verdict"}};
  for (const study::Judgement& judgement : judgements) rows.push_back(cellsOf(judgement));
  const CheckWidths widths = widthsOf(rows);
  page.line(rowText(rows.front(), widths) + rows.front()[CheckColumn::verdict]);
  for (std::size_t i = 0; i < judgements.size(); ++i) {
    const Cells& cells = rows[i + 1];
    page.line(rowText(cells, widths) +
              page.styled(cells[CheckColumn::verdict], verdictColour(judgements[i].verdict)));
  }
}

void appendReferences(TerminalPage& page, const std::string& file,
                      std::span<const study::Judgement> references) {
  if (references.empty()) return;
  const std::size_t skipped = countOf(references, study::GateVerdict::skipped);
  page.paragraph(fmt::format("{}: {} of {} references hold{}", file,
                             countOf(references, study::GateVerdict::passed), references.size(),
                             skipped > 0 ? fmt::format(", {} skipped", skipped) : ""),
                 terminalIndent);
}

}  // namespace

std::string checkTable(const study::CheckRecord& check, bool colours) {
  TerminalPage page(colours);
  page.heading(fmt::format("{} ({})", check.name, check.file));
  appendFaults(page, check);
  const auto [thresholds, references, options] = study::byOrigin(check.judgements);
  appendTable(page, thresholds);
  appendReferences(page, check.baseline, references);
  return page.text();
}

std::string checkNotices(std::span<const study::CheckRecord> checks) {
  TerminalPage page(false);
  for (const study::CheckRecord& check : checks) {
    for (const study::NoticeRecord& notice : check.notices) {
      const std::string place =
          notice.line > 0 ? fmt::format("{}:{}", check.file, notice.line) : check.file;
      page.paragraph(fmt::format("Notice: {}: {}", place, notice.text));
    }
  }
  return page.text();
}

std::string checkSummary(std::span<const study::CheckRecord> checks, ExitStatus status,
                         bool colours) {
  std::vector<study::Judgement> gates;
  std::size_t problems = 0;
  std::string bad;
  for (const study::CheckRecord& check : checks) {
    gates.insert(gates.end(), check.judgements.begin(), check.judgements.end());
    problems += check.problems.size();
    if (check.status() != ExitStatus::pass) bad += (bad.empty() ? "" : ", ") + check.name;
  }
  TerminalPage page(colours);
  page.paragraph(fmt::format(
      "Check of {} {}: {} of {} gates passed, {} failed, {} undefined, {} skipped, {} {}. Exit "
      "status {}.",
      checks.size(), checks.size() == 1 ? "study" : "studies",
      countOf(gates, study::GateVerdict::passed), gates.size(),
      countOf(gates, study::GateVerdict::failed), countOf(gates, study::GateVerdict::undefined),
      countOf(gates, study::GateVerdict::skipped), problems, problems == 1 ? "error" : "errors",
      static_cast<int>(status)));
  if (!bad.empty()) page.paragraph("Not passed: " + bad);
  return page.text();
}

}  // namespace gnomon::report
