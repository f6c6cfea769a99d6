#include "report/tables/terminal_ranking.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/text/number_text.h"
#include "report/text/terminal_page.h"
#include "report/text/text_width.h"

namespace gnomon {
namespace {

constexpr std::size_t rankWidth = 4;
constexpr std::size_t numberWidth = 8;
constexpr std::size_t countWidth = 10;
constexpr std::size_t gap = 2;

struct RankingWidths {
  std::size_t method;
  std::size_t study;
};

/// The two names share what the numbers leave, the study having at most what its longest name
/// needs.
RankingWidths widthsFor(const std::vector<RankedOverStudies>& methods) {
  constexpr std::size_t mark = 2;
  constexpr std::size_t room =
      terminalWidth - terminalIndent - rankWidth - 3 * numberWidth - countWidth - 2 * gap - mark;
  RankingWidths widths{displayWidth("method"), displayWidth("worst on")};
  for (const RankedOverStudies& method : methods) {
    widths.method = std::max(widths.method, displayWidth(labelWithName(method)));
    widths.study = std::max(widths.study, displayWidth(method.worstStudy));
  }
  widths.study = std::min(widths.study, std::max(room / 2, room - std::min(room, widths.method)));
  widths.method = std::min(widths.method, room - widths.study);
  return widths;
}

std::string rowText(const RankingWidths& widths, const std::string& rank, const std::string& method,
                    const std::string& mean, const std::string& worst, const std::string& on,
                    const std::string& cases, const std::string& uncertainty) {
  return std::string(terminalIndent, ' ') + fitLeft(rank, rankWidth) +
         fitLeft(method, widths.method) + fitRight(mean, numberWidth) +
         fitRight(worst, numberWidth) + std::string(gap, ' ') + fitLeft(on, widths.study) +
         fitRight(cases, countWidth) + std::string(gap, ' ') + fitRight(uncertainty, numberWidth);
}

std::string methodRow(const RankingWidths& widths, const RankedOverStudies& method) {
  return rowText(widths, method.rank ? fmt::format("{}", *method.rank) : "–", labelWithName(method),
                 percentText(method.meanError), percentText(method.worstError), method.worstStudy,
                 fmt::format("{} of {}", method.cases, method.allCases),
                 percentText(method.uncertainty)) +
         (method.closeToBest ? " ≈" : "");
}

/// Why a method is marked.
void appendReason(TerminalPage& page, const RankedOverStudies& method,
                  const RankedOverStudies& best) {
  if (!method.closeToBest) return;
  page.paragraph(fmt::format("not distinguishable from {}: {}", best.label, *method.closeToBest),
                 terminalIndent + rankWidth);
}

/// What the means of the methods without a rank may be compared with.
void appendLeader(TerminalPage& page, const RankedOverStudies& method,
                  const RankedOverStudies& best) {
  if (!method.leaderError) return;
  page.paragraph(fmt::format("{} has a mean of {} over the same cases", best.label,
                             percentText(method.leaderError)),
                 terminalIndent + rankWidth);
}

}  // namespace

std::string rankingOverStudies(std::span<const StudyMeans> studies, bool colours) {
  TerminalPage page(colours);
  const std::vector<RankedOverStudies> methods = rankOverStudies(studies);
  const RankingWidths widths = widthsFor(methods);
  page.heading(fmt::format("Methods over {} studies", studies.size()));
  page.paragraph(
      "Error rate in percent, each study with the same weight. ≈ not distinguishable from the "
      "best.");
  page.line(rowText(widths, "", "method", "mean", "worst", "worst on", "cases", "truth ±"));
  bool comparable = true;
  for (const RankedOverStudies& method : methods) {
    if (!method.rank && comparable) {
      page.paragraph(
          "Not in every case (a view under a light of a study): no rank, since means over other "
          "cases cannot be compared.",
          terminalIndent);
      comparable = false;
    }
    page.line(methodRow(widths, method));
    appendReason(page, method, methods.front());
    if (!method.rank) appendLeader(page, method, methods.front());
  }
  return page.text();
}

}  // namespace gnomon
