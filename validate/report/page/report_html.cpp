#include "report/page/report_html.h"

#include <algorithm>
#include <array>

#include "common/lists.h"
#include "common/system/memory.h"
#include "report/page/case_html.h"
#include "report/page/html_page.h"
#include "report/page/opening_html.h"
#include "report/page/reference_html.h"
#include "report/tables/budget_table.h"
#include "report/tables/case_tables.h"
#include "report/tables/cost_table.h"
#include "report/tables/formats/html_format.h"
#include "report/tables/ranked_table.h"
#include "report/text/confidence_text.h"
#include "report/text/glossary.h"
#include "report/text/number_text.h"
#include "report/text/ranking_text.h"
#include "study/judge/distinguish.h"
#include "study/judge/ranking.h"

namespace gnomon::report {

namespace {

Html rankingSection(const study::StudyRecord& record,
                    const std::vector<study::RankedMethod>& ranked) {
  if (ranked.empty()) return {};
  return htmlSection(
      "ranking", "Methods, best first",
      html("<p class=\"note\">Percent of {}, mean over all lights and views. The bar shows "
           "the two parts of the error, <i class=\"chip shadow\"></i> {} and "
           "<i class=\"chip light\"></i> {}; round its end the {} "
           "<i class=\"chip truth\"></i> and the 95 % interval <i class=\"chip whisker\"></i>. "
           "Compared with the best: {}. A method that does not answer in every {} has no "
           "rank.</p>\n{}",
           errorWhole(study::isSoft(record)), htmlTerm("false shadow"), htmlTerm("false light"),
           htmlTerm("uncertainty of the truth"), signMeaning, htmlTerm("case"),
           htmlTable(rankedTable(record, ranked))));
}

Html thresholdSection(const study::StudyRecord& record) {
  const std::vector<study::Judgement> thresholds = study::byOrigin(record.judgements).thresholds;
  if (thresholds.empty()) return {};
  return htmlSection("thresholds", "Thresholds", htmlTable(gateTable(thresholds)));
}

Html costSection(const study::StudyRecord& record, std::span<const DrawnPlot> plots) {
  if (record.cost.empty()) return {};
  const std::string rates = publishedRates(record);
  return htmlSection(
      "cost", "What each method costs",
      htmlNote("One frame of the first camera view, drawn on this machine. Times compare methods "
               "here; another graphics card has others.") +
          htmlTable(costTable(record)) + htmlNote(keptFrames(record)) +
          (rates.empty() ? Html() : html("<p>{}</p>\n", rates)) + htmlPlots(plots, "cost"));
}

std::string bytesText(std::uint64_t bytes) {
  return formatBytes(static_cast<double>(bytes));
}

Html truthSection(const study::StudyRecord& record) {
  const study::TruthRecord& truth = record.truth;
  const bool measured = !truth.flips.empty() || truth.uncertainty > 0;
  const Html facts =
      htmlFact("Micro-triangles", groupedText(truth.microTriangles)) +
      htmlFact("Longest side of a triangle", stepText(truth.stepTexels) + " texels") +
      htmlFact("Largest uncertainty", measured ? percentText(truth.uncertainty) + " % of " +
                                                     errorWhole(study::isSoft(record))
                                               : "not measured") +
      htmlFact("Search radius", radiusText(record.radius)) +
      htmlFact("Memory for tracing rays", bytesText(truth.bvhBytes.value_or(0))) +
      htmlFact("Memory of the mesh", bytesText(truth.meshBytes)) +
      htmlFact("Left out", fmt::format("{} samples, where the texture has no directions",
                                       groupedText(record.undefinedSamples)));
  Html content = html("<dl>\n{}</dl>\n", facts);
  if (!truth.flips.empty()) {
    content += htmlNote(truthErrorText(truth)) + htmlTable(flipTable(truth.flips));
  }
  return htmlSection("truth", "The truth", content);
}

Html timingSection(const std::vector<study::TimingRecord>& timings) {
  if (timings.empty()) return {};
  return htmlSection("timings", "Where the time went", htmlTable(timingTable(timings)));
}

Html citations(const std::vector<study::MethodRecord>& methods) {
  Html items;
  for (const study::MethodRecord& method : methods) {
    items += html("<dt>{}</dt><dd>{}{}<code>{}</code><small>{}</small></dd>\n", method.label,
                  method.title, method.title.empty() ? "" : " ", method.name, method.citation);
  }
  return items.empty() ? Html()
                       : htmlSection("methods", "The methods", html("<dl>\n{}</dl>\n", items));
}

/// Each file that the run was made of, folded away.
Html inputFiles(const std::vector<study::InputRecord>& inputs) {
  if (inputs.empty()) return {};
  return html("<details><summary>{} of the run, with their SHA-256</summary>\n{}</details>\n",
              plural(inputs.size(), "file"), htmlTable(inputTable(inputs)));
}

Html reproduceSection(const study::StudyRecord& record) {
  const study::EnvironmentRecord& e = record.environment;
  const std::string cpu =
      e.threads > 0
          ? fmt::format("{}, {}", e.cpu, plural(static_cast<std::size_t>(e.threads), "thread"))
          : e.cpu;
  const Html facts = htmlFact("Study", record.file) +
                     htmlFact("With every setting, in this folder", record.reproduction.file) +
                     htmlFact("Gnomon", e.gnomonVersion) + htmlFact("Commit", e.commit) +
                     htmlFact("CPU", cpu) + htmlFact("OpenGL", e.glRenderer) +
                     htmlFact("Frame times by", e.frameClock) +
                     htmlFact("OpenGL version", e.glVersion) + htmlFact("Embree", e.embreeVersion) +
                     htmlFact("OpenSubdiv", e.openSubdivVersion);
  return htmlReproduction(record.command,
                          html("<dl>\n{}</dl>\n{}", facts, inputFiles(record.reproduction.inputs)));
}

Html plotSection(std::span<const DrawnPlot> plots) {
  const Html content = htmlPlots(plots, "plots");
  if (content.empty()) return {};
  return htmlSection(
      "plots", "Where the error grows",
      html("<p class=\"note\">{} The folder <code>plots/</code> beside this page has "
           "each plot as SVG and PDF.</p>\n{}",
           plotReading, content));
}

}  // namespace

Html confidenceSection(const study::StudyRecord& record) {
  Html content;
  for (const std::string& view : confidenceViews(record)) {
    const Table table = confidenceTable(record, view);
    if (table.rows.empty()) continue;
    content += html("<h3>{}</h3>\n<p><b>{}</b></p>\n{}{}", view, verdictText(record, view),
                    htmlNote(confidenceNote(record, view)), htmlTable(table));
  }
  return htmlSection("confidence", "How sure the error rates are", content);
}

Html budgetSection(const study::StudyRecord& record) {
  if (record.budgets.empty()) return {};
  Html content = htmlNote(budgetNote(record.budgets.front(), study::isSoft(record)));
  const std::vector<std::string> lights = budgetLights(record);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    Html part;
    for (const study::BudgetRecord& budget : budgetsOf(record, lights[i])) {
      part +=
          html("<h3>{}</h3>\n{}{}", budget.method,
               htmlNote(orderText(budget, study::isSoft(record))), htmlTable(budgetTable(budget)));
    }
    content +=
        i == 0 ? part : html("<details><summary>{}</summary>\n{}</details>\n", lights[i], part);
  }
  return htmlSection("budget", "Where the error comes from", content);
}

Html reportHtml(const study::StudyRecord& record, const std::filesystem::path& folder,
                std::span<const DrawnPlot> plots) {
  const std::vector<study::RankedMethod> ranked = study::rankMethods(record);
  const bool hasPictures = holdsPictures(record, folder);
  Html claims;
  for (const study::ClaimRecord& claim : record.claims) claims += htmlClaim(claim);
  Html main = htmlClaims(claims) + rankingSection(record, ranked) + thresholdSection(record) +
              referenceSection(record, folder) + (hasPictures ? viewerMarkup() : Html());
  main += caseSections(record, ranked, folder);
  main += worstSection(record, ranked);
  main += confidenceSection(record) + plotSection(plots) + budgetSection(record) +
          costSection(record, plots) + truthSection(record) + citations(record.methods) +
          timingSection(record.timings) + reproduceSection(record);
  return htmlPage(record.heading(), openingHtml(record, ranked), main,
                  hasPictures ? viewerScript() : Html());
}

Table flipTable(const std::vector<study::UncertaintyRecord>& flips) {
  Table table{.kind = "flips",
              .columns = {{"View", "view"},
                          {"Light", "light"},
                          {"Samples that change", "flip_rate", Quantity::percent}}};
  for (const study::UncertaintyRecord& flip : flips) {
    table.rows.push_back({{textCell(flip.view), textCell(flip.light), valueCell(flip.flipRate)}});
  }
  return table;
}

Table timingTable(const std::vector<study::TimingRecord>& timings) {
  Table table{.kind = "timings",
              .columns = {{"Stage", "stage"}, {"Seconds", "seconds", Quantity::decimals}}};
  for (const study::TimingRecord& timing : timings) {
    table.rows.push_back({{textCell(timing.stage), valueCell(timing.seconds)}});
  }
  return table;
}

Table inputTable(const std::vector<study::InputRecord>& inputs) {
  Table table{
      .kind = "inputs",
      .columns = {{"Kind", "kind"}, {"File", "file"}, {"SHA-256", "sha256", Quantity::code}}};
  for (const study::InputRecord& input : inputs) {
    table.rows.push_back({{textCell(std::string(inputKindName(input.kind))), textCell(input.file),
                           textCell(input.sha256)}});
  }
  return table;
}

}  // namespace gnomon::report
