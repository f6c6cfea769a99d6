#include "report/page/reference_html.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "common/files/atomic_file.h"
#include "report/page/html_figures.h"
#include "report/page/html_page.h"
#include "report/tables/html_cells.h"
#include "report/text/gate_text.h"
#include "report/text/html_text.h"
#include "report/text/names.h"
#include "report/text/number_text.h"
#include "study/judge/baseline.h"

namespace gnomon {
namespace {

std::string referenceRow(const Judgement& judgement) {
  const Gate& gate = judgement.gate;
  const double committed = referenceOf(gate).committed;
  const std::string change =
      judgement.value ? fmt::format("{:+.3g}", *judgement.value - committed) : "–";
  return fmt::format("<tr><td><span class=\"tag {}\">{}</span></td>{}{}{}{}{}{}{}{}</tr>\n",
                     judgement.isFault() ? "failed" : "held", gateVerdictName(judgement.verdict),
                     textCell(gate.method), textCell(gate.view), textCell(gate.light),
                     textCell(gate.metric), gateValueCell(committed, ""),
                     gateValueCell(judgement.value, judgement.reason), numberCell(change),
                     numberCell(escapeHtml(limitText(gate))));
}

std::string referenceTable(const std::vector<Judgement>& references) {
  std::string body;
  for (const Judgement& judgement : references) body += referenceRow(judgement);
  return htmlTable(
      "references",
      headCells({"", "Method", "View", "Light", "Metric"}, {"Committed", "Now", "Change", "Limit"}),
      body);
}

/// "3 of 4 thresholds met", or nothing without any.
std::string passedText(const std::vector<Judgement>& judgements, const char* noun,
                       const char* verb) {
  if (judgements.empty()) return "";
  const auto passed = std::count_if(judgements.begin(), judgements.end(), [](const auto& one) {
    return one.verdict == GateVerdict::passed;
  });
  return fmt::format("{} of {} {}", passed, plural(judgements.size(), noun), verb);
}

std::string pictureHtml(const std::string& path, const std::string& title,
                        const std::filesystem::path& folder) {
  if (path.empty()) return "";
  return fmt::format("<figure><img alt=\"{0}\" src=\"{1}\"><figcaption>{0}</figcaption></figure>\n",
                     escapeHtml(title), pngAddress(folder / path));
}

std::string picturesHtml(const ReferencePictures& row, const std::filesystem::path& folder) {
  std::string html =
      fmt::format("<h3>{}, {}, {}</h3>\n<div class=\"changes\">\n", escapeHtml(row.method),
                  escapeHtml(row.view), escapeHtml(row.light));
  html += pictureHtml(row.before, "as committed, against its truth", folder) +
          pictureHtml(row.after, "now, against the truth", folder) +
          pictureHtml(row.change, "what changed: orange has become dark, blue lit", folder) +
          "</div>\n";
  if (!row.note.empty()) html += "<p class=\"note\">" + escapeHtml(row.note) + "</p>\n";
  return html;
}

}  // namespace

std::string referenceSection(const StudyRecord& record, const std::filesystem::path& folder) {
  std::string html;
  for (const ProblemRecord& problem : record.problems) {
    if (problem.part == "method") continue;  // a notice names it
    html += fmt::format("<p><span class=\"tag failed\">error</span> {}</p>\n",
                        escapeHtml(problem.message));
  }
  const std::vector<Judgement> references = withOrigin<Reference>(record.judgements);
  if (!references.empty()) {
    const auto isFault = [](const Judgement& judgement) { return judgement.isFault(); };
    std::vector<Judgement> faults;
    std::vector<Judgement> others;
    std::partition_copy(references.begin(), references.end(), std::back_inserter(faults),
                        std::back_inserter(others), isFault);
    html += fmt::format(
        "<p class=\"note\">Committed values in <code>{}</code>, which may not have "
        "become worse by more than their tolerance.</p>\n",
        escapeHtml(record.baseline));
    if (!faults.empty()) html += referenceTable(faults);
    for (const ReferencePictures& row : record.referencePictures) {
      html += picturesHtml(row, folder);
    }
    if (!others.empty()) {
      html +=
          fmt::format("<details><summary>{} of {} hold</summary>\n{}</details>\n", others.size(),
                      plural(references.size(), "reference"), referenceTable(others));
    }
  }
  return htmlSection("references", "References", html);
}

std::string statusHtml(RunStatus status, std::span<const Judgement> judgements,
                       std::size_t problems, const std::string& more) {
  const std::string name(runStatusName(status));
  if (judgements.empty() && problems == 0) {
    return "<span class=\"tag open\">" + name + "</span> no thresholds set";
  }
  const std::vector<Judgement> references = withOrigin<Reference>(judgements);
  std::string text;
  for (const std::string& part :
       {passedText(withOrigin<Threshold>(judgements), "threshold", "met"),
        passedText(references, "reference", references.size() == 1 ? "holds" : "hold"),
        problems > 0 ? plural(problems, "error") : "", more}) {
    if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
  }
  const char* tag = status == RunStatus::pass   ? "held"
                    : status == RunStatus::fail ? "failed"
                                                : "open";
  return fmt::format("<span class=\"tag {}\">{}</span> {}", tag, name, text);
}

}  // namespace gnomon
