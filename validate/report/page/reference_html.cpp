#include "report/page/reference_html.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "common/files/atomic_file.h"
#include "report/page/html_figures.h"
#include "report/page/html_page.h"
#include "report/tables/html_cells.h"
#include "report/text/gate_text.h"
#include "report/text/html_text.h"
#include "report/text/names.h"
#include "report/text/number_text.h"

namespace gnomon {
namespace {

bool holds(const GateRecord& gate) {
  return gate.verdict == GateVerdict::passed || gate.verdict == GateVerdict::skipped;
}

std::string referenceRow(const GateRecord& gate) {
  const std::string change =
      gate.value && gate.expected ? fmt::format("{:+.3g}", *gate.value - *gate.expected) : "–";
  return fmt::format("<tr><td><span class=\"tag {}\">{}</span></td>{}{}{}{}{}{}{}{}</tr>\n",
                     holds(gate) ? "held" : "failed", gateVerdictName(gate.verdict),
                     textCell(gate.method), textCell(gate.view), textCell(gate.light),
                     textCell(gate.metric), gateValueCell(gate.expected, ""),
                     gateValueCell(gate.value, gate.reason), numberCell(change),
                     numberCell(escapeHtml(limitText(gate))));
}

std::string referenceTable(const std::vector<GateRecord>& gates) {
  std::string body;
  for (const GateRecord& gate : gates) body += referenceRow(gate);
  return htmlTable(
      "references",
      headCells({"", "Method", "View", "Light", "Metric"}, {"Committed", "Now", "Change", "Limit"}),
      body);
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
  if (!record.references.empty()) {
    std::vector<GateRecord> faults = record.references;
    std::vector<GateRecord> others = record.references;
    std::erase_if(faults, holds);
    std::erase_if(others, [](const GateRecord& gate) { return !holds(gate); });
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
                      plural(record.references.size(), "reference"), referenceTable(others));
    }
  }
  return htmlSection("references", "References", html);
}

std::string statusHtml(RunStatus status, const std::vector<GateRecord>& gates, std::size_t problems,
                       const std::string& more) {
  const std::string name(runStatusName(status));
  if (gates.empty() && problems == 0) {
    return "<span class=\"tag open\">" + name + "</span> no thresholds set";
  }
  std::string text;
  for (const GateKind kind : {GateKind::threshold, GateKind::reference}) {
    const auto ofKind = [&](const GateRecord& gate) { return gate.kind == kind; };
    const auto all = static_cast<std::size_t>(std::count_if(gates.begin(), gates.end(), ofKind));
    const auto met = std::count_if(gates.begin(), gates.end(), [&](const GateRecord& gate) {
      return ofKind(gate) && gate.verdict == GateVerdict::passed;
    });
    if (all == 0) continue;
    const bool isThreshold = kind == GateKind::threshold;
    text += fmt::format("{}{} of {} {}", text.empty() ? "" : ", ", met,
                        plural(all, isThreshold ? "threshold" : "reference"),
                        isThreshold ? "met"
                        : all == 1  ? "holds"
                                    : "hold");
  }
  if (problems > 0) text += (text.empty() ? "" : ", ") + plural(problems, "error");
  const char* tag = status == RunStatus::pass   ? "held"
                    : status == RunStatus::fail ? "failed"
                                                : "open";
  return fmt::format("<span class=\"tag {}\">{}</span> {}{}", tag, name, text,
                     more.empty() ? "" : ", " + more);
}

}  // namespace gnomon
