#include "report/page/ranking_html.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/page/html_page.h"
#include "report/tables/html_cells.h"
#include "report/tables/html_matrix.h"
#include "report/text/html_text.h"
#include "report/text/names.h"
#include "report/text/ranking_text.h"

namespace gnomon {
namespace {

using Ranking = std::vector<RankedOverStudies>;

std::string studyLink(const StudyMeans& study) {
  return fmt::format("<a href=\"{0}/report.html\" title=\"{1}\">{0}</a>", escapeHtml(study.name),
                     escapeHtml(study.title));
}

std::string verdictHtml(std::span<const StudyMeans> studies) {
  const auto count = [&](RunStatus status) {
    return std::count_if(studies.begin(), studies.end(),
                         [&](const StudyMeans& study) { return study.status == status; });
  };
  const RunStatus all = statusOf(studies);
  const char* tag = all == RunStatus::pass ? "held" : all == RunStatus::fail ? "failed" : "open";
  return fmt::format(
      "<span class=\"tag {}\">{}</span> of {} studies {} passed, {} failed, {} not judged", tag,
      runStatusName(all), studies.size(), count(RunStatus::pass), count(RunStatus::fail),
      count(RunStatus::notJudged));
}

std::string leadHtml(const Ranking& ranking, std::size_t studies) {
  if (ranking.empty() || !ranking.front().rank) {
    return "No method was measured in every case of every study, so that none can be called the "
           "best.";
  }
  const RankedOverStudies& best = ranking.front();
  return fmt::format(
      "Over {} studies <b>{}</b> is closest to the truth: <b>{}&#8239;%</b> of the samples wrong "
      "on "
      "average, {}&#8239;% at worst, on {}.",
      studies, escapeHtml(labelWithName(best)), rateText(best.meanError), rateText(best.worstError),
      escapeHtml(best.worstStudy));
}

std::string notes(const RankedOverStudies& method, const RankedOverStudies& best) {
  if (method.rank) {
    return method.closeToBest
               ? fmt::format("<small class=\"same\">not distinguishable from {}: {}</small>",
                             escapeHtml(best.label), escapeHtml(*method.closeToBest))
               : "";
  }
  return fmt::format(
      "<small class=\"same\">{}</small>",
      escapeHtml(fewerCasesText(method.cases, method.allCases, best.label, method.leaderError)));
}

std::string rankedRow(const RankedOverStudies& method, const RankedOverStudies& best) {
  return fmt::format(
      "<tr><td class=\"rank\">{}</td><td class=\"method\">{}{}</td>{}{}{}</tr>\n",
      method.rank ? fmt::format("{}", *method.rank) : "–", escapeHtml(labelWithName(method)),
      notes(method, best),
      numberCell("<b>" + withUncertainty(method.meanError, method.uncertainty) + "</b>"),
      numberCell(fmt::format("{} <small class=\"same\">{}</small>", rateText(method.worstError),
                             escapeHtml(method.worstStudy))),
      numberCell(fmt::format("{} of {}", method.cases, method.allCases)));
}

std::string rankedTable(const Ranking& ranking) {
  std::string body;
  for (const RankedOverStudies& method : ranking) {
    body += rankedRow(method, ranking.front());
  }
  return htmlTable("ranking", headCells({"", "Method"}, {"Mean error", "Worst", "Cases"}), body);
}

std::string matrix(std::span<const StudyMeans> studies, const Ranking& ranking) {
  std::vector<std::string> labels;
  std::vector<std::string> heads;
  for (const RankedOverStudies& method : ranking) labels.push_back(method.label);
  for (const StudyMeans& study : studies) heads.push_back(studyLink(study));
  return errorMatrix(labels, studies, heads);
}

std::string claimsSection(std::span<const StudyMeans> studies) {
  std::string items;
  for (const StudyMeans& study : studies) {
    for (const ClaimRecord& claim : study.claims) items += htmlClaim(claim, studyLink(study));
  }
  if (items.empty()) return "";
  return htmlSection("claims", "What was claimed", "<ul class=\"claims\">\n" + items + "</ul>\n");
}

}  // namespace

std::string rankingHtml(std::span<const StudyMeans> studies, std::string_view command) {
  const Ranking ranking = rankOverStudies(studies);
  return htmlHead("Methods over all studies") + "<body>\n" +
         fmt::format(
             "<header>\n<p class=\"kicker\">Gnomon · how right are the shadows?</p>\n"
             "<h1>Methods over {} studies</h1>\n<p class=\"verdict\">{}</p>\n"
             "<p class=\"lead\">{}</p>\n</header>\n<main>\n",
             studies.size(), verdictHtml(studies), leadHtml(ranking, studies.size())) +
         htmlSection(
             "ranking", "Methods, best first",
             "<p class=\"note\">Percent of the samples: in each study the mean over its "
             "lights and views, then the mean over the studies, each with the same weight. "
             "A case is a view under a light; a method that lacks one has no rank. <b>±</b> "
             "is the truth’s own uncertainty.</p>\n" +
                 rankedTable(ranking)) +
         htmlSection("matrix", "Error by study",
                     "<p class=\"note\">The stronger the tint, the larger the error." +
                         fewerCasesNote(studies) + "</p>\n" + matrix(studies, ranking)) +
         claimsSection(studies) +
         htmlSection("reproduce", "Run it again",
                     fmt::format("<pre><code>{}</code></pre>\n", escapeHtml(command))) +
         "</main>\n</body>\n</html>\n";
}

}  // namespace gnomon
