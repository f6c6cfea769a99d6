#include "report/page/overview_html.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "report/page/html_page.h"
#include "report/page/picture_html.h"
#include "report/page/report_html.h"
#include "report/plots/study_plots.h"
#include "report/tables/case_tables.h"
#include "report/tables/ranked_table.h"
#include "report/tables/sweep_tables.h"
#include "report/text/html.h"
#include "report/text/number_text.h"
#include "report/text/verdict_text.h"
#include "study/judge/ranking.h"
#include "study/record/cases.h"

namespace gnomon::report {

namespace {

using Ranking = std::vector<study::RankedOverStudies>;

Html studiesStatus(std::span<const study::StudyMeans> studies) {
  const auto count = [&](study::RunStatus status) {
    return std::count_if(studies.begin(), studies.end(),
                         [&](const study::StudyMeans& study) { return study.status == status; });
  };
  const auto passed = count(study::RunStatus::pass);
  const auto failed = count(study::RunStatus::fail);
  const auto notJudged = count(study::RunStatus::notJudged);
  return html("{} {} of {} studies passed{}{}", htmlStatus(study::statusOf(studies)), passed,
              studies.size(), failed > 0 ? fmt::format(", {} failed", failed) : "",
              notJudged > 0 ? fmt::format(", {} not judged", notJudged) : "");
}

Html bestOverStudies(const Ranking& ranking, std::span<const study::StudyMeans> studies) {
  if (ranking.empty() || !ranking.front().rank) {
    return html("No method was measured in every case of every study, so none is ranked.");
  }
  const study::RankedOverStudies& best = ranking.front();
  const bool isSoft = std::any_of(studies.begin(), studies.end(),
                                  [](const study::StudyMeans& study) { return study.isSoft; });
  return html(
      "Compared with ray tracing the displaced surface in {} studies, <b>{}</b> has {}: "
      "<b>{}&#8239;%</b> on average, {}&#8239;% in its worst study, {}.",
      studies.size(), study::labelWithName(best.label, best.names), leastErrorText(isSoft),
      percentText(best.meanError), percentText(best.worstError), best.worstStudy);
}

PageSection claimsOfStudies(std::span<const study::StudyMeans> studies) {
  Html claims;
  for (const study::StudyMeans& study : studies) {
    for (const study::ClaimRecord& claim : study.claims) {
      claims += htmlClaim(claim, html("<a href=\"{0}/report.html\" title=\"{1}\">{0}</a>",
                                      study.name, study.title));
    }
  }
  return claimSection(claims);
}

}  // namespace

Html rankingHtml(std::span<const study::StudyMeans> studies, std::string_view command) {
  const Ranking ranking = study::rankOverStudies(studies);
  std::vector<std::string> labels;
  for (const study::RankedOverStudies& method : ranking) labels.push_back(method.label);
  const Html header = html(
      "<h1>Methods over {} studies</h1>\n<p class=\"verdict\">{}</p>\n<p class=\"lead\">{}</p>\n",
      studies.size(), studiesStatus(studies), bestOverStudies(ranking, studies));
  return htmlPage(
      "Methods over all studies", header,
      {{"ranking", "Which method is closest to the truth",
        html("<p class=\"note\">Percent of {}: in each study the mean over its "
             "lights and views, then the mean over the studies, each with the same "
             "weight. A case is a view under a light; a method that lacks one has no "
             "rank. <b>Truth ±</b> is the truth’s own uncertainty. Compared with the best: "
             "{}.</p>\n{}",
             errorWholeOver(studies), signMeaning,
             htmlTable(rankedOverStudiesTable(studies, ranking)))},
       {"matrix", "Which study is hard for which method",
        html("<p class=\"note\">The stronger the tint, the larger the error.{}</p>\n"
             "{}",
             fewerCasesNote(studies), htmlTable(studyErrorsTable(labels, studies)))},
       claimsOfStudies(studies),
       reproduceSection(command)});
}

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

PageSection referenceSection(const study::StudyRecord& record,
                             const std::filesystem::path& folder) {
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
      content += htmlFold(
          fmt::format("{} of {} hold", others.size(), plural(references.size(), "reference")),
          htmlTable(gateTable(others)));
    }
  }
  return {"references", "Whether it is as good as its references", content};
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
PageSection faultyReferences(const study::SweepRecord& sweep) {
  Html content;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    const study::StudyRecord& step = sweep.steps[i];
    const std::vector<study::Judgement> references = study::byOrigin(step.judgements).references;
    if (study::runStatus(references, step.problems) != study::RunStatus::fail) continue;
    content += html("<p>{}</p>\n<p><a href=\"{}/report.html#references\">{}</a></p>\n",
                    statusHtml(study::RunStatus::fail, references, step.problems.size()),
                    sweep.cases.at(i).name, study::caseText(sweep.keys, sweep.cases.at(i)));
  }
  return {"references", "References that do not hold", content};
}

/// The gates that failed, a table a value.
PageSection failedThresholds(const study::SweepRecord& sweep) {
  Html content;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    std::vector<study::Judgement> failed = study::byOrigin(sweep.steps[i].judgements).thresholds;
    std::erase_if(failed, [](const study::Judgement& judgement) { return !judgement.isFault(); });
    if (failed.empty()) continue;
    content += html("<h3>{}</h3>\n{}", study::caseText(sweep.keys, sweep.cases.at(i)),
                    htmlTable(gateTable(failed)));
  }
  return {"thresholds", "Thresholds that failed", content};
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
  return htmlNote(fmt::format(
             "Percent of {}, mean over all lights and views. The grey band is how uncertain the "
             "truth itself is: smaller differences mean nothing. Bars are 95 % intervals. {}",
             errorWhole(study::isSoft(sweep)), plotReading)) +
         drawn;
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
  constexpr std::size_t mostColumns = 24;
  constexpr std::size_t mostRows = 1000;
  const Html values =
      valuesNote(sweep) + htmlTable(readableSweepTable(sweep, mostColumns, mostRows));
  const Html facts = html("<dl>\n{}{}</dl>\n", htmlFact("Study", sweep.file),
                          htmlFact("With the options, in this folder", sweep.copy));
  return htmlPage(sweep.heading(), sweepHeader(sweep),
                  {{"plot", plotHeading(sweep), errorPlots(sweep, plots)},
                   {"values", sweep.keys.size() == 1 ? "Error by value" : "Error by case", values},
                   {"cost", "What the values cost", htmlPlots(plots, sweepCostSection)},
                   claimSection(sweep.claims),
                   failedThresholds(sweep),
                   faultyReferences(sweep),
                   reproduceSection(sweep.command, facts)});
}

}  // namespace gnomon::report
