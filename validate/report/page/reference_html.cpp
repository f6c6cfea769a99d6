#include "report/page/reference_html.h"

#include <algorithm>
#include <vector>

#include "report/page/html_figures.h"
#include "report/page/html_page.h"
#include "report/tables/formats/html_format.h"
#include "report/tables/gate_table.h"

namespace gnomon::report {
namespace {

Html changePicture(const std::string& path, std::string_view title,
                   const std::filesystem::path& folder) {
  if (path.empty()) return {};
  return html("<figure><img alt=\"{}\" src=\"{}\"><figcaption>{}</figcaption></figure>\n", title,
              pngAddress(folder / path), title);
}

Html changePictures(const study::ReferencePictures& row, const std::filesystem::path& folder) {
  return html(
      "<h3>{}, {}, {}</h3>\n<div class=\"changes\">\n{}{}{}</div>\n{}", row.method, row.view,
      row.light, changePicture(row.before, "as committed, against its truth", folder),
      changePicture(row.after, "now, against the truth", folder),
      changePicture(row.change, "what changed: orange has become darker, blue lighter", folder),
      htmlNote(row.note));
}

/// "3 of 4 thresholds met", or nothing without any.
std::string passedText(std::span<const study::Judgement> judgements, const char* noun,
                       const char* verb) {
  if (judgements.empty()) return "";
  const auto passed = std::count_if(judgements.begin(), judgements.end(), [](const auto& one) {
    return one.verdict == study::GateVerdict::passed;
  });
  return fmt::format("{} of {} {}", passed, plural(judgements.size(), noun), verb);
}

}  // namespace

Html referenceSection(const study::StudyRecord& record, const std::filesystem::path& folder) {
  Html content;
  for (const study::ProblemRecord& problem : record.problems) {
    if (problem.part == "method") continue;  // a notice names it
    content += html("<p><span class=\"tag failed\">error</span> {}</p>\n", problem.message);
  }
  const std::vector<study::Judgement> references = study::byOrigin(record.judgements).references;
  if (!references.empty()) {
    std::vector<study::Judgement> faults;
    std::vector<study::Judgement> others;
    std::partition_copy(references.begin(), references.end(), std::back_inserter(faults),
                        std::back_inserter(others),
                        [](const study::Judgement& judgement) { return judgement.isFault(); });
    content += html(
        "<p class=\"note\">Committed values in <code>{}</code>, which may not have become worse by "
        "more than their tolerance.</p>\n",
        record.baseline);
    if (!faults.empty()) content += htmlTable(gateTable(faults));
    for (const study::ReferencePictures& row : record.referencePictures) {
      content += changePictures(row, folder);
    }
    if (!others.empty()) {
      content += html("<details><summary>{} of {} hold</summary>\n{}</details>\n", others.size(),
                      plural(references.size(), "reference"), htmlTable(gateTable(others)));
    }
  }
  return htmlSection("references", "References", content);
}

Html statusHtml(study::RunStatus status, std::span<const study::Judgement> judgements,
                std::size_t problems, const std::string& more) {
  if (judgements.empty() && problems == 0) return html("{} no thresholds set", htmlStatus(status));
  const auto [thresholds, references, options] = study::byOrigin(judgements);
  std::string text;
  for (const std::string& part :
       {passedText(thresholds, "threshold", "met"),
        passedText(references, "reference", references.size() == 1 ? "holds" : "hold"),
        problems > 0 ? plural(problems, "error") : "", more}) {
    if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
  }
  return html("{} {}", htmlStatus(status), text);
}

}  // namespace gnomon::report
