#include "report/sweep_html.h"

#include <OpenImageIO/strutil.h>
#include <fmt/core.h>

#include <algorithm>

#include "report/html_cells.h"
#include "report/html_page.h"
#include "report/html_tables.h"
#include "report/html_text.h"
#include "report/number_text.h"
#include "report/study_ranking.h"
#include "study/sweep.h"

namespace gnomon {
namespace {

std::string verdictHtml(const SweepRecord& sweep) {
  std::size_t gates = 0;
  std::size_t met = 0;
  for (const StudyRecord& step : sweep.steps) {
    gates += step.thresholds.size();
    met += static_cast<std::size_t>(
        std::count_if(step.thresholds.begin(), step.thresholds.end(),
                      [](const ThresholdRecord& threshold) { return threshold.passed; }));
  }
  if (gates == 0) return "<span class=\"tag open\">no thresholds set</span>";
  return fmt::format("<span class=\"tag {}\">{}</span> {} of {} met, over all values",
                     sweep.passed() ? "held" : "failed", sweep.passed() ? "pass" : "fail", met,
                     plural(gates, "threshold"));
}

std::string header(const SweepRecord& sweep) {
  return fmt::format(
      "<header>\n<p class=\"kicker\">Gnomon · how right are the shadows?</p>\n<h1>{}</h1>\n"
      "<p class=\"source\">{}</p>\n<p class=\"verdict\">{}</p>\n"
      "<p class=\"lead\">One study at {} of <code>{}</code>.</p>\n</header>\n",
      escapeHtml(sweep.title.empty() ? sweep.name : sweep.title), escapeHtml(sweep.source),
      verdictHtml(sweep), plural(sweep.values.size(), "value"), escapeHtml(sweep.key));
}

std::string plotFigure(const SweepRecord& sweep, const std::string& plot) {
  return fmt::format(
      "<figure class=\"plot\"><img alt=\"Error rate of each method against {}\" "
      "src=\"data:image/svg+xml;base64,{}\"></figure>\n",
      escapeHtml(sweep.axis), OIIO::Strutil::base64_encode(plot));
}

std::string cell(const MethodMeans* means, double worst) {
  if (means == nullptr) return numberCell("", "not in this step");
  if (!means->errorRate) return numberCell("–", "not defined");
  return heatCell(*means->errorRate, worst,
                  fmt::format("false shadow {} %, false light {} %",
                              percentText(means->falseShadow), percentText(means->falseLight)));
}

double worstOf(const std::vector<StudyMeans>& steps) {
  double worst = 0;
  for (const StudyMeans& step : steps) {
    for (const MethodMeans& method : step.methods) {
      worst = std::max(worst, method.errorRate.value_or(0));
    }
  }
  return worst;
}

std::string valueTable(const SweepRecord& sweep) {
  std::vector<StudyMeans> steps;
  std::string head = "<th>Method</th>";
  std::string uncertainties;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    steps.push_back(studyMeans(sweep.steps[i]));
    const std::string value = escapeHtml(sweepValueText(sweep.values.at(i)));
    head += fmt::format("<th class=\"n\"><a href=\"{0}/report.html\">{0}</a></th>", value);
    uncertainties += numberCell(rateText(largestUncertainty(steps.back())));
  }
  std::string body;
  for (const MethodMeans& method : studyMeans(sweep).methods) {
    body += fmt::format("<tr><td class=\"method\">{}</td>", escapeHtml(method.label));
    for (const StudyMeans& step : steps) {
      body += cell(findMeans(step, method.label), worstOf(steps));
    }
    body += "</tr>\n";
  }
  body += "<tr><td class=\"method\"><small>the truth’s uncertainty</small></td>" + uncertainties +
          "</tr>\n";
  return htmlTable("regions", head, body);
}

/// The gates that failed, a table a value.
std::string failedSection(const SweepRecord& sweep) {
  std::string content;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    std::vector<ThresholdRecord> failed = sweep.steps[i].thresholds;
    std::erase_if(failed, [](const ThresholdRecord& threshold) { return threshold.passed; });
    if (failed.empty()) continue;
    content += fmt::format("<h3>{} = {}</h3>\n", escapeHtml(sweep.key),
                           escapeHtml(sweepValueText(sweep.values.at(i)))) +
               thresholdTable(failed);
  }
  return htmlSection("thresholds", "Thresholds that failed", content);
}

}  // namespace

std::string sweepHtml(const SweepRecord& sweep, const std::string& plot) {
  return htmlHead(sweep.title.empty() ? sweep.name : sweep.title) + "<body>\n" + header(sweep) +
         "<main>\n" +
         htmlSection("plot", "Error against " + escapeHtml(sweep.axis),
                     "<p class=\"note\">Percent of the samples, mean over all lights and views. "
                     "The grey band is the truth’s own uncertainty: differences as small as it say "
                     "nothing.</p>\n" +
                         plotFigure(sweep, plot)) +
         htmlSection("values", "Error by value",
                     "<p class=\"note\">The stronger the tint, the larger the error. Each value "
                     "leads to its own report.</p>\n" +
                         valueTable(sweep)) +
         htmlClaims(sweep.claims) + failedSection(sweep) +
         htmlSection("reproduce", "Run it again",
                     fmt::format("<pre><code>{}</code></pre>\n<dl>\n", escapeHtml(sweep.command)) +
                         htmlFact("Study", sweep.file) + "</dl>\n") +
         "</main>\n</body>\n</html>\n";
}

}  // namespace gnomon
