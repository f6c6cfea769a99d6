#include "report/page/report_html.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/lists.h"
#include "common/system/memory.h"
#include "report/page/budget_html.h"
#include "report/page/confidence_html.h"
#include "report/page/html_figures.h"
#include "report/page/html_page.h"
#include "report/page/page.h"
#include "report/page/reference_html.h"
#include "report/tables/cost.h"
#include "report/tables/html_cells.h"
#include "report/tables/html_tables.h"
#include "report/text/confidence_text.h"
#include "report/text/html_text.h"
#include "report/text/interval_text.h"
#include "report/text/names.h"
#include "report/text/number_text.h"
#include "report/text/refinement_text.h"
#include "study/judge/distinguish.h"
#include "study/judge/ranking.h"
#include "study/record/cases.h"

namespace gnomon {
namespace {

std::string headingOf(const StudyRecord& record) {
  return escapeHtml(record.title.empty() ? record.name : record.title);
}

/// One sentence: which method is closest to the truth, and how sure the truth is.
std::string leadHtml(const std::vector<RankedMethod>& ranked) {
  if (ranked.empty() || ranked.front().allCases == 0) return "No result has an error rate.";
  const auto inAllCases = static_cast<std::size_t>(std::count_if(
      ranked.begin(), ranked.end(), [](const auto& method) { return method.rank.has_value(); }));
  if (inAllCases == 0) {
    return "No method answers in every case, so that none can be called the best.";
  }
  const RankedMethod& best = ranked.front();
  std::string text = fmt::format(
      "Of {} over {}, <b>{}</b> is closest to the truth: it gets "
      "<b>{}&#8239;%</b> of the samples wrong.",
      plural(inAllCases, "method"), plural(best.cases, "case"), escapeHtml(best.label),
      escapeHtml(percentText(best.errorRate.value)));
  if (!best.uncertainty) return text + " How sure the truth itself is was not measured.";
  text += fmt::format(" The truth itself is uncertain by {}&#8239;%{}.",
                      escapeHtml(percentText(best.uncertainty)),
                      isDistinguishable({*best.errorRate.value, best.interval, *best.uncertainty})
                          ? ""
                          : ": so small an error is not distinguishable from none");
  return text;
}

/// What the best method of each view is better than, and by how much.
std::string comparedHtml(const StudyRecord& record) {
  const std::vector<std::string> views = confidenceViews(record);
  std::string html;
  for (const std::string& view : views) {
    const std::string verdict = verdictText(record, view);
    if (verdict.empty()) continue;
    html +=
        fmt::format("<p class=\"lead\">{}{}</p>\n",
                    views.size() > 1 ? "In " + escapeHtml(view) + ": " : "", escapeHtml(verdict));
  }
  return html;
}

std::string header(const StudyRecord& record, const std::vector<RankedMethod>& ranked) {
  return fmt::format(
      "<header>\n<p class=\"kicker\">Gnomon · how right are the shadows?</p>\n<h1>{}</h1>\n"
      "<p class=\"source\">{}</p>\n<p class=\"verdict\">{}</p>\n<p class=\"lead\">{}</p>\n"
      "{}</header>\n",
      headingOf(record), escapeHtml(record.source),
      statusHtml(record.status(), record.judgements, record.problems.size()), leadHtml(ranked),
      comparedHtml(record) + htmlNotices(record.notices));
}

std::string rankingSection(const std::vector<RankedMethod>& ranked) {
  if (ranked.empty()) return "";
  return htmlSection(
      "ranking", "Methods, best first",
      "<p class=\"note\">Percent of the samples, mean over all lights and views. A method that "
      "does not answer in all of them has no rank. <b>±</b> is the "
      "truth’s own uncertainty: the share of its samples that change at half its resolution. "
      "<b>95&#8239;%</b> is the interval of the mean error. " +
          std::string(intervalMeaning) +
          " <b>Test alone</b>: the error of the shadow test without the shading. The bar shows the "
          "error’s two parts, <i class=\"chip shadow\"></i> false shadow and "
          "<i class=\"chip light\"></i> false light, round its end the truth’s uncertainty "
          "<i class=\"chip truth\"></i> and the interval <i class=\"chip whisker\"></i>.</p>\n" +
          rankingTable(ranked));
}

std::string thresholdSection(const StudyRecord& record) {
  const std::vector<Judgement> thresholds = withOrigin<Threshold>(record.judgements);
  if (thresholds.empty()) return "";
  return htmlSection("thresholds", "Thresholds", thresholdTable(thresholds));
}

std::vector<Case> casesWithPictures(const StudyRecord& record) {
  std::vector<Case> cases = casesOf(record);
  for (const PanelRecord& panel : record.panels) {
    appendOnce(cases, Case{panel.view, panel.light});
  }
  return cases;
}

std::string caseTables(const StudyRecord& record, const Case& which) {
  if (findResult(record, methodsOf(record).empty() ? "" : methodsOf(record).front(), which) ==
          nullptr &&
      regionsOf(record, which).empty()) {
    return "";
  }
  std::string html =
      "<h3>All samples</h3>\n<p class=\"note\">Rates in percent. Shadow length is that of the cast "
      "shadows along the light, over the truth’s: the median.</p>\n" +
      caseTable(record, which);
  const std::string regions = regionTable(record, which);
  if (!regions.empty()) {
    html +=
        "<h3>Error by region</h3>\n<p class=\"note\">Percent of the region’s own samples; the "
        "stronger the tint, the larger the error.</p>\n" +
        regions;
  }
  return html;
}

std::string caseSection(const StudyRecord& record, const Case& which, std::size_t number,
                        const std::filesystem::path& folder) {
  std::string content;
  for (const PanelRecord& panel : record.panels) {
    if (Case{panel.view, panel.light} != which) continue;
    content += panelFigures(record, panel, folder);
  }
  content += caseTables(record, which);
  return htmlSection(fmt::format("case-{}", number),
                     fmt::format("{} <span class=\"light\">{}</span>", escapeHtml(which.view),
                                 escapeHtml(which.light)),
                     content);
}

std::string keptFramesHtml(const StudyRecord& record) {
  const std::string kept = keptFrames(record);
  return kept.empty() ? "" : "<p class=\"note\">" + escapeHtml(kept) + "</p>\n";
}

std::string costSection(const StudyRecord& record) {
  if (record.cost.empty()) return "";
  const std::string rates = publishedRates(record);
  return htmlSection(
      "cost", "What each method costs",
      "<p class=\"note\">Memory of the tables and the height map that a frame reads; drawing "
      "passes a frame; the median time of one frame, and its ratio to that of max-forsyth.</p>\n" +
          costTable(record) + keptFramesHtml(record) +
          (rates.empty() ? "" : "<p>" + escapeHtml(rates) + "</p>\n"));
}

std::string bytesText(std::uint64_t bytes) {
  return formatBytes(static_cast<double>(bytes));
}

std::string truthSection(const StudyRecord& record) {
  const TruthRecord& truth = record.truth;
  const bool measured = !truth.flips.empty() || truth.uncertainty > 0;
  std::string content =
      "<dl>\n" + htmlFact("Micro-triangles", groupedText(truth.microTriangles)) +
      htmlFact("Longest step", stepText(truth.stepTexels) + " texels") +
      htmlFact("Largest uncertainty",
               measured ? percentText(truth.uncertainty) + " % of the samples" : "not measured") +
      htmlFact("Search radius", radiusText(record.radius)) +
      htmlFact("Ray tracing structure", bytesText(truth.bvhBytes)) +
      htmlFact("Mesh", bytesText(truth.meshBytes)) +
      htmlFact("Left out", fmt::format("{} samples where no frame exists",
                                       groupedText(record.undefinedSamples))) +
      "</dl>\n";
  if (!truth.flips.empty()) content += flipTable(truth.flips);
  if (truth.wantedUncertainty) {
    content += "<p class=\"note\">" + escapeHtml(refinementText(truth)) + "</p>\n" +
               refinementTable(truth.refinement);
  }
  return htmlSection("truth", "The truth", content);
}

std::string timingSection(const std::vector<TimingRecord>& timings) {
  if (timings.empty()) return "";
  return htmlSection("timings", "Where the time went", timingTable(timings));
}

std::string citations(const std::vector<MethodRecord>& methods) {
  std::string items;
  for (const MethodRecord& method : methods) {
    items += fmt::format("<dt>{}</dt><dd>{}{}<code>{}</code><small>{}</small></dd>\n",
                         escapeHtml(method.label), escapeHtml(method.title),
                         method.title.empty() ? "" : " ", escapeHtml(method.name),
                         escapeHtml(method.citation));
  }
  return items.empty() ? "" : htmlSection("methods", "The methods", "<dl>\n" + items + "</dl>\n");
}

/// Each file that the run was made of, folded away.
std::string inputTable(const std::vector<InputRecord>& inputs) {
  if (inputs.empty()) return "";
  std::string body;
  for (const InputRecord& input : inputs) {
    body += fmt::format("<tr>{}{}<td><code>{}</code></td></tr>\n",
                        textCell(inputKindName(input.kind)), textCell(input.file), input.sha256);
  }
  return fmt::format(
      "<details><summary>{} of the run, with their SHA-256</summary>\n{}</details>\n",
      plural(inputs.size(), "file"),
      htmlTable("inputs", headCells({"Kind", "File", "SHA-256"}, {}), body));
}

std::string reproduceSection(const StudyRecord& record) {
  const EnvironmentRecord& e = record.environment;
  return htmlSection(
      "reproduce", "Run it again",
      fmt::format("<pre><code>{}</code></pre>\n<dl>\n", escapeHtml(record.command)) +
          htmlFact("Study", record.file) +
          htmlFact("With every setting, in this folder", record.reproduction.file) +
          htmlFact("Gnomon", e.gnomonVersion) + htmlFact("Commit", e.commit) +
          htmlFact("CPU", e.threads > 0
                              ? fmt::format("{}, {}", e.cpu,
                                            plural(static_cast<std::size_t>(e.threads), "thread"))
                              : e.cpu) +
          htmlFact("OpenGL", e.glRenderer) + htmlFact("Frame times by", e.frameClock) +
          htmlFact("OpenGL version", e.glVersion) + htmlFact("Embree", e.embreeVersion) +
          htmlFact("OpenSubdiv", e.openSubdivVersion) + "</dl>\n" +
          inputTable(record.reproduction.inputs));
}

std::string plotSection(std::span<const DrawnPlot> plots) {
  std::string content;
  for (const DrawnPlot& plot : plots) {
    // The page has the budget's own bars, with their table.
    if (plot.sheet.name == "budget") continue;
    content += fmt::format("<h3>{}</h3>\n", escapeHtml(plot.sheet.title)) +
               htmlPlot(plot.svg, plot.sheet.about);
  }
  if (content.empty()) return "";
  return htmlSection("plots", "Where the error grows",
                     "<p class=\"note\">Each plot lies beside this page as SVG and PDF, in "
                     "<code>plots/</code>.</p>\n" +
                         content);
}

/// Links to the cases: with many lights a reader needs them.
std::string navigation(const std::vector<Case>& cases) {
  if (cases.size() < 2) return "";
  std::string links;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    links += fmt::format("<a href=\"#case-{}\">{} · {}</a>\n", i + 1, escapeHtml(cases[i].view),
                         escapeHtml(cases[i].light));
  }
  return "<nav aria-label=\"Cases\">\n" + links + "</nav>\n";
}

}  // namespace

std::string reportHtml(const StudyRecord& record, const std::filesystem::path& folder,
                       std::span<const DrawnPlot> plots) {
  const std::vector<RankedMethod> ranked = rankMethods(record);
  const std::vector<Case> cases = casesWithPictures(record);
  const bool hasPictures = !record.panels.empty();
  std::string html = htmlHead(record.title.empty() ? record.name : record.title,
                              hasPictures ? viewerScriptHash() : "") +
                     "<body>\n" + header(record, ranked) + "<main>\n" + rankingSection(ranked) +
                     htmlClaims(record.claims) + thresholdSection(record) +
                     referenceSection(record, folder) +
                     (hasPictures ? std::string(viewerMarkup()) : "") + navigation(cases);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    html += caseSection(record, cases[i], i + 1, folder);
  }
  html += confidenceSection(record) + plotSection(plots) + budgetSection(record) +
          costSection(record) + truthSection(record) + citations(record.methods) +
          timingSection(record.timings) + reproduceSection(record) + "</main>\n";
  if (hasPictures) html += "<script>" + std::string(viewerScript()) + "</script>\n";
  return html + "</body>\n</html>\n";
}

}  // namespace gnomon
