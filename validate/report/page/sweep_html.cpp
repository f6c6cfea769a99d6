#include "report/page/sweep_html.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <span>

#include "report/page/html_page.h"
#include "report/page/reference_html.h"
#include "report/tables/html_matrix.h"
#include "report/tables/html_tables.h"
#include "report/text/html_text.h"
#include "study/judge/study_ranking.h"
#include "study/spec/sweep.h"

namespace gnomon {
namespace {

std::string verdictHtml(const SweepRecord& sweep) {
  std::vector<Judgement> judgements;
  std::size_t problems = 0;
  for (const StudyRecord& step : sweep.steps) {
    judgements.insert(judgements.end(), step.judgements.begin(), step.judgements.end());
    problems += step.problems.size();
  }
  return statusHtml(sweep.status(), judgements, problems, "over all values");
}

std::string header(const SweepRecord& sweep) {
  return fmt::format(
      "<header>\n<p class=\"kicker\">Gnomon · how right are the shadows?</p>\n<h1>{}</h1>\n"
      "<p class=\"source\">{}</p>\n<p class=\"verdict\">{}</p>\n"
      "<p class=\"lead\">One study at {} of <code>{}</code>.</p>\n{}</header>\n",
      escapeHtml(sweep.title.empty() ? sweep.name : sweep.title), escapeHtml(sweep.source),
      verdictHtml(sweep), plural(sweep.values.size(), "value"), escapeHtml(sweep.key),
      htmlNotices(sweep.notices()));
}

std::string valueTable(const SweepRecord& sweep) {
  std::vector<StudyMeans> steps;
  std::vector<std::string> labels;
  std::vector<std::string> heads;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    steps.push_back(studyMeans(sweep.steps[i]));
    heads.push_back(fmt::format("<a href=\"{0}/report.html\">{0}</a>",
                                escapeHtml(sweepValueText(sweep.values.at(i)))));
  }
  for (const MethodMeans& method : studyMeans(sweep).methods) labels.push_back(method.label);
  return errorMatrix(labels, steps, heads);
}

std::string costSection(std::span<const DrawnPlot> plots) {
  std::string content;
  for (const DrawnPlot& plot : plots) {
    content +=
        "<h3>" + escapeHtml(plot.sheet.title) + "</h3>\n" + htmlPlot(plot.svg, plot.sheet.about);
  }
  return content.empty() ? "" : htmlSection("cost", "What the values cost", content);
}

/// What kept a check from judging the values, and where the references that do not hold are.
std::string referenceSection(const SweepRecord& sweep) {
  std::string content;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    const StudyRecord& step = sweep.steps[i];
    const std::vector<Judgement> references = withOrigin<Reference>(step.judgements);
    if (runStatus(references, step.problems) != RunStatus::fail) continue;
    const std::string value = escapeHtml(sweepValueText(sweep.values.at(i)));
    content += fmt::format("<p>{}</p>\n<p><a href=\"{}/report.html#references\">{} = {}</a></p>\n",
                           statusHtml(RunStatus::fail, references, step.problems.size()), value,
                           escapeHtml(sweep.key), value);
  }
  return htmlSection("references", "References that do not hold", content);
}

/// The gates that failed, a table a value.
std::string failedSection(const SweepRecord& sweep) {
  std::string content;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    std::vector<Judgement> failed = withOrigin<Threshold>(sweep.steps[i].judgements);
    std::erase_if(failed, [](const Judgement& judgement) { return !judgement.isFault(); });
    if (failed.empty()) continue;
    content += fmt::format("<h3>{} = {}</h3>\n", escapeHtml(sweep.key),
                           escapeHtml(sweepValueText(sweep.values.at(i)))) +
               thresholdTable(failed);
  }
  return htmlSection("thresholds", "Thresholds that failed", content);
}

}  // namespace

std::string sweepHtml(const SweepRecord& sweep, const std::vector<DrawnPlot>& plots) {
  return htmlHead(sweep.title.empty() ? sweep.name : sweep.title) + "<body>\n" + header(sweep) +
         "<main>\n" +
         htmlSection("plot", "Error against " + escapeHtml(sweep.axis),
                     "<p class=\"note\">Percent of the samples, mean over all lights and views. "
                     "The grey band is the truth’s own uncertainty: differences as small as it say "
                     "nothing.</p>\n" +
                         htmlPlot(plots.front().svg, plots.front().sheet.about)) +
         costSection(std::span(plots).subspan(1)) +
         htmlSection("values", "Error by value",
                     "<p class=\"note\">The stronger the tint, the larger the error. Each value "
                     "leads to its own report." +
                         fewerCasesNote(std::array{studyMeans(sweep)}) + "</p>\n" +
                         valueTable(sweep)) +
         htmlClaims(sweep.claims) + failedSection(sweep) + referenceSection(sweep) +
         htmlSection("reproduce", "Run it again",
                     fmt::format("<pre><code>{}</code></pre>\n<dl>\n", escapeHtml(sweep.command)) +
                         htmlFact("Study", sweep.file) +
                         htmlFact("With the options, in this folder", sweep.copy) + "</dl>\n") +
         "</main>\n</body>\n</html>\n";
}

}  // namespace gnomon
