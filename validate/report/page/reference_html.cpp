#include "report/page/reference_html.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <vector>

#include "report/page/html_page.h"
#include "report/page/picture_html.h"
#include "report/tables/case_tables.h"
#include "report/tables/formats/html_format.h"
#include "report/tables/ranked_table.h"
#include "report/text/number_text.h"
#include "report/text/ranking_text.h"
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

}  // namespace gnomon::report
