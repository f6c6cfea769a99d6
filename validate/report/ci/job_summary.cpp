#include "report/ci/job_summary.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/text/one_line.h"
#include "report/ci/mosaic.h"
#include "report/text/gate_text.h"
#include "report/text/html.h"
#include "study/judge/baseline.h"

namespace gnomon::report {
namespace fs = std::filesystem;
namespace {

constexpr int mosaicColumns = 40;

/// A name that ends no cell and is no markup.
std::string cell(const std::string& text) {
  std::string result;
  const Html escaped = escapeHtml(oneLine(text));
  for (const char c : escaped.text()) {
    if (std::string_view("|`*_[]\\~").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

std::string faultRow(const study::CheckRecord& check, const study::Judgement& judgement) {
  const study::Gate& gate = judgement.gate;
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.4f}", *value) : "–";
  };
  const GatePlace place = faultPlace(check, gate);
  const std::string answer = gate.answer == study::Answer::drawn
                                 ? ""
                                 : fmt::format(", {}", study::answerName(gate.answer));
  return fmt::format("| {} | {} | {} | {}, {}{} | {} | {} | {} | {} |\n", cell(check.name),
                     cell(gate.method), cell(std::string(gate.metric.name())), cell(gate.view),
                     cell(gate.light), answer, number(judgement.value),
                     number(study::committedValue(gate)), cell(limitText(gate, 4)),
                     cell(place.file));
}

std::string faultTable(std::span<const study::CheckRecord> checks) {
  std::string rows;
  for (const study::CheckRecord& check : checks) {
    for (const study::Judgement& judgement : check.judgements) {
      if (judgement.isFault()) rows += faultRow(check, judgement);
    }
  }
  if (rows.empty()) return "";
  return "| study | method | metric | view, light | value | committed | limit | shader or file |\n"
         "|---|---|---|---|---|---|---|---|\n" +
         rows + "\n";
}

std::string picture(const char* title, const fs::path& file) {
  if (file.empty()) return "";
  return fmt::format("**{}** (`{}`)\n\n```\n{}```\n\n", title, file.generic_string(),
                     mosaicOf(file, mosaicColumns));
}

std::string worstText(const WorstCase& worst) {
  std::string text = fmt::format("### Worst case: {}, {}, {}, {}\n\n", cell(worst.study),
                                 cell(worst.method), cell(worst.view), cell(worst.light));
  text +=
      "🟧 shadow where the truth is lit, 🟦 light where it is shadowed; in the change: 🟧 "
      "now "
      "shadowed, 🟦 now lit. 🟫 lies outside the surface.\n\n";
  text += picture("Before", worst.before) + picture("After", worst.after) +
          picture("Change", worst.change);
  if (!worst.note.empty()) text += cell(worst.note) + "\n\n";
  return text;
}

}  // namespace

std::optional<WorstCase> worstCase(std::span<const study::StudyRecord> records,
                                   const fs::path& out) {
  std::optional<WorstCase> worst;
  bool worstIsShare = false;
  for (const study::StudyRecord& record : records) {
    const fs::path folder = out / record.name;
    const auto in = [&](const std::string& file) {
      return file.empty() ? fs::path() : folder / file;
    };
    for (const study::ReferencePictures& row : record.referencePictures) {
      for (const study::Judgement& judgement : study::byOrigin(record.judgements).references) {
        const study::Gate& gate = judgement.gate;
        const std::optional<double> margin = judgement.margin();
        const bool isOfRow =
            gate.method == row.method && gate.view == row.view && gate.light == row.light;
        if (!isOfRow || !judgement.isFault() || !margin) continue;
        const bool isShare = gate.metric.unit() == compare::MetricUnit::share;
        const bool isWorse = !worst || (isShare && !worstIsShare) ||
                             (isShare == worstIsShare && *margin < worst->margin);
        if (!isWorse) continue;
        worstIsShare = isShare;
        worst = {record.name,    row.method,    row.view,       row.light, *margin,
                 in(row.before), in(row.after), in(row.change), row.note};
      }
    }
  }
  return worst;
}

std::string jobSummary(std::span<const study::CheckRecord> checks,
                       const std::optional<WorstCase>& worst, const std::string& accept) {
  std::size_t passed = 0;
  std::size_t faults = 0;
  std::string problems;
  for (const study::CheckRecord& check : checks) {
    for (const study::Judgement& judgement : check.judgements) {
      passed += judgement.verdict == study::GateVerdict::passed ? 1 : 0;
      faults += judgement.isFault() ? 1 : 0;
    }
    for (const study::ProblemRecord& problem : check.problems) {
      problems += fmt::format("- {}: {}\n", cell(check.name), cell(problem.message));
    }
  }
  const bool isWhole = std::ranges::all_of(
      checks, [](const study::CheckRecord& check) { return check.status() == ExitStatus::pass; });
  std::string text =
      fmt::format("## Shadows: {}\n\n{} limits hold, {} {} not.\n\n", isWhole ? "pass" : "fail",
                  passed, faults, faults == 1 ? "does" : "do");
  text += faultTable(checks);
  if (!problems.empty()) text += problems + "\n";
  if (worst) text += worstText(*worst);
  if (!isWhole && !accept.empty()) {
    text += fmt::format(
        "To accept what was measured, run this and commit its files:\n\n```\n{}\n"
        "```\n",
        oneLine(accept));
  }
  return text;
}

}  // namespace gnomon::report
