#include "report/tables/html_matrix.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/tables/html_cells.h"
#include "report/text/html_text.h"
#include "report/text/number_text.h"

namespace gnomon {
namespace {

double worstOf(std::span<const StudyMeans> studies) {
  double worst = 0;
  for (const StudyMeans& study : studies) {
    for (const MethodMeans& method : study.methods) {
      worst = std::max(worst, method.errorRate.value_or(0));
    }
  }
  return worst;
}

std::string errorCell(const MethodMeans* means, double worst) {
  if (means == nullptr) return numberCell("", "not evaluated");
  if (!means->errorRate) return numberCell("–", "not defined");
  std::string about = fmt::format("false shadow {} %, false light {} %",
                                  percentText(means->falseShadow), percentText(means->falseLight));
  if (!means->isInEveryCase()) {
    about += fmt::format(", {} of {} cases", means->cases(), means->caseErrors.size());
  }
  return heatCell(*means->errorRate, worst, about, means->isInEveryCase() ? "" : fewerCasesMark);
}

}  // namespace

std::string errorMatrix(const std::vector<std::string>& labels, std::span<const StudyMeans> studies,
                        const std::vector<std::string>& heads) {
  std::string head = "<th>Method</th>";
  for (const std::string& text : heads) head += fmt::format("<th class=\"n\">{}</th>", text);
  std::string body;
  for (const std::string& label : labels) {
    body += fmt::format("<tr><td class=\"method\">{}</td>", escapeHtml(label));
    for (const StudyMeans& study : studies) {
      body += errorCell(findMeans(study, label), worstOf(studies));
    }
    body += "</tr>\n";
  }
  body += "<tr><td class=\"method\"><small>the truth’s uncertainty</small></td>";
  for (const StudyMeans& study : studies) body += numberCell(rateText(largestUncertainty(study)));
  return htmlTable("regions", head, body + "</tr>\n");
}

std::string fewerCasesNote(std::span<const StudyMeans> studies) {
  for (const StudyMeans& study : studies) {
    for (const MethodMeans& method : study.methods) {
      if (!method.isInEveryCase()) return fmt::format(" {}", fewerCasesMeaning);
    }
  }
  return "";
}

}  // namespace gnomon
