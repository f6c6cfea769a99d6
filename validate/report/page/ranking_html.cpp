#include "report/page/ranking_html.h"

#include <algorithm>

#include "report/page/html_page.h"
#include "report/tables/formats/html_format.h"
#include "report/tables/means_table.h"
#include "report/tables/ranked_table.h"
#include "report/text/number_text.h"
#include "report/text/ranking_text.h"

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

Html claimsOfStudies(std::span<const study::StudyMeans> studies) {
  Html claims;
  for (const study::StudyMeans& study : studies) {
    for (const study::ClaimRecord& claim : study.claims) {
      claims += htmlClaim(claim, html("<a href=\"{0}/report.html\" title=\"{1}\">{0}</a>",
                                      study.name, study.title));
    }
  }
  return htmlClaims(claims);
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
      htmlSection(
          "ranking", "Methods, best first",
          html("<p class=\"note\">Percent of {}: in each study the mean over its "
               "lights and views, then the mean over the studies, each with the same "
               "weight. A case is a view under a light; a method that lacks one has no "
               "rank. <b>Truth ±</b> is the truth’s own uncertainty. Compared with the best: "
               "{}.</p>\n{}",
               errorWholeOver(studies), signMeaning,
               htmlTable(rankedOverStudiesTable(studies, ranking)))) +
          htmlSection("matrix", "Error by study",
                      html("<p class=\"note\">The stronger the tint, the larger the error.{}</p>\n"
                           "{}",
                           fewerCasesNote(studies), htmlTable(studyErrorsTable(labels, studies)))) +
          claimsOfStudies(studies) + htmlReproduction(command));
}

}  // namespace gnomon::report
