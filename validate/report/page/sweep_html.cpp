#include "report/page/sweep_html.h"

#include <array>
#include <span>

#include "report/page/html_page.h"
#include "report/page/reference_html.h"
#include "report/tables/formats/html_format.h"
#include "report/tables/gate_table.h"
#include "report/tables/means_table.h"
#include "study/judge/study_ranking.h"

namespace gnomon {
namespace {

Html sweepStatus(const SweepRecord& sweep) {
  std::vector<Judgement> judgements;
  std::size_t problems = 0;
  for (const StudyRecord& step : sweep.steps) {
    judgements.insert(judgements.end(), step.judgements.begin(), step.judgements.end());
    problems += step.problems.size();
  }
  return statusHtml(sweep.status(), judgements, problems, "over all values");
}

Html sweepHeader(const SweepRecord& sweep) {
  return html(
      "<h1>{}</h1>\n<p class=\"source\">{}</p>\n<p class=\"verdict\">{}</p>\n"
      "<p class=\"lead\">One study at {} of <code>{}</code>.</p>\n{}",
      sweep.heading(), sweep.source, sweepStatus(sweep), plural(sweep.values.size(), "value"),
      sweep.key, htmlNotices(sweep.notices()));
}

Html sweepCost(std::span<const DrawnPlot> plots) {
  Html content;
  for (const DrawnPlot& plot : plots) {
    content += html("<h3>{}</h3>\n{}", plot.sheet.title, htmlPlot(plot));
  }
  return htmlSection("cost", "What the values cost", content);
}

/// What kept a check from judging the values, and where the references that do not hold are.
Html faultyReferences(const SweepRecord& sweep) {
  Html content;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    const StudyRecord& step = sweep.steps[i];
    const std::vector<Judgement> references = byOrigin(step.judgements).references;
    if (runStatus(references, step.problems) != RunStatus::fail) continue;
    content += html("<p>{0}</p>\n<p><a href=\"{2}/report.html#references\">{1} = {2}</a></p>\n",
                    statusHtml(RunStatus::fail, references, step.problems.size()), sweep.key,
                    sweepValueText(sweep.values.at(i)));
  }
  return htmlSection("references", "References that do not hold", content);
}

/// The gates that failed, a table a value.
Html failedThresholds(const SweepRecord& sweep) {
  Html content;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    std::vector<Judgement> failed = byOrigin(sweep.steps[i].judgements).thresholds;
    std::erase_if(failed, [](const Judgement& judgement) { return !judgement.isFault(); });
    if (failed.empty()) continue;
    content += html("<h3>{} = {}</h3>\n{}", sweep.key, sweepValueText(sweep.values.at(i)),
                    htmlTable(gateTable(failed)));
  }
  return htmlSection("thresholds", "Thresholds that failed", content);
}

}  // namespace

Html sweepHtml(const SweepRecord& sweep, const std::vector<DrawnPlot>& plots) {
  Html claims;
  for (const ClaimRecord& claim : sweep.claims) claims += htmlClaim(claim);
  const Html plot = htmlNote(
                        "Percent of the samples, mean over all lights and views. The grey band is "
                        "the truth’s own "
                        "uncertainty: smaller differences are not meaningful.") +
                    htmlPlot(plots.front());
  const Html values = html(
      "<p class=\"note\">The stronger the tint, the larger the error. Each value leads to its own "
      "report.{}</p>\n{}",
      fewerCasesNote(std::array{studyMeans(sweep)}), htmlTable(sweepErrorsTable(sweep)));
  const Html facts = html("<dl>\n{}{}</dl>\n", htmlFact("Study", sweep.file),
                          htmlFact("With the options, in this folder", sweep.copy));
  return htmlPage(sweep.heading(), sweepHeader(sweep),
                  htmlSection("plot", "Error against " + sweep.axis, plot) +
                      sweepCost(std::span(plots).subspan(1)) +
                      htmlSection("values", "Error by value", values) + htmlClaims(claims) +
                      failedThresholds(sweep) + faultyReferences(sweep) +
                      htmlReproduction(sweep.command, facts));
}

}  // namespace gnomon
