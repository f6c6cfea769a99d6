#include "report/page/sweep_html.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "report/page/html_page.h"
#include "report/page/opening_html.h"
#include "report/page/reference_html.h"
#include "report/plots/sweep_plots.h"
#include "report/tables/case_tables.h"
#include "report/tables/formats/html_format.h"
#include "report/tables/ranked_table.h"
#include "report/tables/sweep_tables.h"
#include "report/text/glossary.h"
#include "report/text/number_text.h"
#include "report/text/ranking_text.h"
#include "study/judge/ranking.h"

namespace gnomon::report {
namespace {

Html sweepStatus(const study::SweepRecord& sweep) {
  std::vector<study::Judgement> judgements;
  std::size_t problems = 0;
  for (const study::StudyRecord& step : sweep.steps) {
    judgements.insert(judgements.end(), step.judgements.begin(), step.judgements.end());
    problems += step.problems.size();
  }
  return statusHtml(sweep.status(), judgements, problems, "over all values");
}

/// Which method is closest to the truth over all cases, how close, how certain the truth is, and
/// which others it is not distinguishable from; of those that have all cases.
Html sweepAnswer(const study::SweepRecord& sweep) {
  const std::array whole = {study::studyMeans(sweep)};
  std::vector<study::RankedOverStudies> ranked = study::rankOverStudies(whole);
  std::erase_if(ranked, [](const auto& method) { return !method.rank; });
  if (ranked.empty()) return {};
  const study::RankedOverStudies& best = ranked.front();
  const std::vector<ErrorSpread> spreads = errorSpreads(sweep);
  const auto spread = std::find_if(spreads.begin(), spreads.end(),
                                   [&](const auto& each) { return each.method == best.label; });
  study::LikeMethods like;
  for (const study::RankedOverStudies& method : ranked) {
    if (method.toBest) like.add(method.label, method.toBest->verdict);
  }
  Html text = html("Of {}, <b>{}</b> is closest to the {}: {} on average, from {} to {}&#8239;%.",
                   plural(ranked.size(), "method"), best.label, htmlTerm("truth"),
                   errorHtml(study::isSoft(sweep), best.meanError), percentText(spread->least),
                   percentText(spread->largest));
  const std::string alike = likeText(like);
  if (!alike.empty()) text += html(" Its comparisons: {}.", alike);
  if (best.uncertainty) {
    text += html(" The truth itself is {} by {}&#8239;%.",
                 htmlTerm("uncertainty of the truth", "uncertain"), percentText(best.uncertainty));
  }
  return html("<p class=\"lead\">{}</p>\n", text);
}

Html sweepHeader(const study::SweepRecord& sweep) {
  return html(
      "<h1>{}</h1>\n<p class=\"source\">{}</p>\n<p class=\"verdict\">{}</p>\n"
      "<p class=\"lead\">One study {} of <code>{}</code>.</p>\n{}{}",
      sweep.heading(), sweep.source, sweepStatus(sweep),
      sweep.keys.size() == 1 ? "at " + plural(sweep.cases.size(), "value")
                             : "in " + plural(sweep.cases.size(), "case"),
      study::keysText(sweep.keys), sweepAnswer(sweep), htmlNotices(sweep.notices()));
}

/// What kept a check from judging the values, and where the references that do not hold are.
Html faultyReferences(const study::SweepRecord& sweep) {
  Html content;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    const study::StudyRecord& step = sweep.steps[i];
    const std::vector<study::Judgement> references = study::byOrigin(step.judgements).references;
    if (study::runStatus(references, step.problems) != study::RunStatus::fail) continue;
    content += html("<p>{}</p>\n<p><a href=\"{}/report.html#references\">{}</a></p>\n",
                    statusHtml(study::RunStatus::fail, references, step.problems.size()),
                    sweep.cases.at(i).name, study::caseText(sweep.keys, sweep.cases.at(i)));
  }
  return htmlSection("references", "References that do not hold", content);
}

/// The gates that failed, a table a value.
Html failedThresholds(const study::SweepRecord& sweep) {
  Html content;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    std::vector<study::Judgement> failed = study::byOrigin(sweep.steps[i].judgements).thresholds;
    std::erase_if(failed, [](const study::Judgement& judgement) { return !judgement.isFault(); });
    if (failed.empty()) continue;
    content += html("<h3>{}</h3>\n{}", study::caseText(sweep.keys, sweep.cases.at(i)),
                    htmlTable(gateTable(failed)));
  }
  return htmlSection("thresholds", "Thresholds that failed", content);
}

/// The plots, or why there are none.
Html errorPlots(const study::SweepRecord& sweep, const std::vector<DrawnPlot>& plots) {
  const Html drawn = htmlPlots(plots, sweepErrorSection);
  if (drawn.text().empty()) {
    return html(
        "<p class=\"note\">No plot can show these {}: they vary too many settings at once. "
        "<code>cases.csv</code> has every figure.</p>\n",
        plural(sweep.cases.size(), "case"));
  }
  return htmlNote(
             fmt::format("Percent of {}, mean over all lights and views. The grey band is how "
                         "uncertain the truth itself is: smaller differences mean nothing. Bars "
                         "are 95 % intervals.",
                         errorWhole(study::isSoft(sweep)))) +
         htmlNote(plotReading) + drawn;
}

std::string plotHeading(const study::SweepRecord& sweep) {
  return "Error against " +
         (sweep.keys.size() == 1 ? sweep.keys.front().axis : study::keysText(sweep.keys));
}

Html valuesNote(const study::SweepRecord& sweep) {
  const char* one = sweep.keys.size() == 1 ? "value" : "case";
  return html("<p class=\"note\">The stronger the tint, the larger the error. {}{}</p>\n",
              sweep.hasStepReports ? fmt::format("Each {} leads to its own report.", one) : "",
              fewerCasesNote(std::array{study::studyMeans(sweep)}));
}

}  // namespace

Html sweepHtml(const study::SweepRecord& sweep, const std::vector<DrawnPlot>& plots) {
  Html claims;
  for (const study::ClaimRecord& claim : sweep.claims) claims += htmlClaim(claim);
  constexpr std::size_t mostColumns = 24;
  constexpr std::size_t mostRows = 1000;
  const Html values =
      valuesNote(sweep) + htmlTable(readableSweepTable(sweep, mostColumns, mostRows));
  const Html facts = html("<dl>\n{}{}</dl>\n", htmlFact("Study", sweep.file),
                          htmlFact("With the options, in this folder", sweep.copy));
  return htmlPage(
      sweep.heading(), sweepHeader(sweep),
      htmlSection("plot", plotHeading(sweep), errorPlots(sweep, plots)) +
          htmlSection("cost", "What the values cost", htmlPlots(plots, sweepCostSection)) +
          htmlSection("values", sweep.keys.size() == 1 ? "Error by value" : "Error by case",
                      values) +
          htmlClaims(claims) + failedThresholds(sweep) + faultyReferences(sweep) +
          htmlReproduction(sweep.command, facts));
}

}  // namespace gnomon::report
