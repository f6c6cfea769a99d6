#include "report/page/report_html.h"

#include <algorithm>
#include <array>

#include "common/system/memory.h"
#include "report/page/case_html.h"
#include "report/page/html_page.h"
#include "report/page/opening_html.h"
#include "report/page/picture_html.h"
#include "report/page/reference_html.h"
#include "report/plotted_methods.h"
#include "report/tables/budget_table.h"
#include "report/tables/case_tables.h"
#include "report/tables/cost_table.h"
#include "report/tables/formats/html_format.h"
#include "report/tables/ranked_table.h"
#include "report/text/confidence_text.h"
#include "report/text/glossary.h"
#include "report/text/number_text.h"
#include "report/text/ranking_text.h"
#include "study/record/cases.h"

namespace gnomon::report {

namespace {

PageSection rankingSection(const study::StudyRecord& record,
                           const std::vector<study::RankedMethod>& ranked) {
  if (ranked.empty()) return {};
  const bool areSeveral = study::comparedCases(record).size() > 1;
  const std::vector<std::string> views = confidenceViews(record);
  return {
      "ranking", "Which method is closest to the truth",
      html("<p class=\"note\">Percent of {}{}. Bars: <i class=\"chip shadow\"></i> {}, <i "
           "class=\"chip light\"></i> {}, <i class=\"chip truth\"></i> {}, <i class=\"chip "
           "whisker\"></i> {} interval. Compared with the best: ≈ {}, = {}, ? {}.{}</p>\n{}",
           errorWhole(study::isSoft(record)), areSeveral ? ", mean over all lights and views" : "",
           htmlTerm("false shadow"), htmlTerm("false light"), htmlTerm("uncertainty of the truth"),
           htmlTerm("95 %"), htmlTerm("not distinguishable"), htmlTerm("equal", "the same answers"),
           htmlTerm("no interval"),
           areSeveral
               ? html(" A method that does not answer in every {} has no rank.", htmlTerm("case"))
           : views.size() == 1 ? html(" {}", blocksText(record, views.front()))
                               : Html(),
           htmlTable(rankedTable(record, ranked))),
      html("{}", plural(ranked.size(), "method"))};
}

/// "surface-march: 63 % of its error in “cast”": the region that holds most of a method's error.
Html mainRegion(const study::StudyRecord& record, const std::string& method) {
  std::vector<std::pair<std::string, double>> wrong;
  double all = 0;
  for (const study::ResultRecord& row : record.results) {
    if (row.method != method || row.answer != study::Answer::drawn) continue;
    const auto error = compare::rate(row.counts, compare::metrics::errorRate).value;
    const double samples = error.value_or(0) * static_cast<double>(row.counts.samples);
    if (row.region == study::wholeRegion) {
      all += samples;
      continue;
    }
    const auto known = std::find_if(wrong.begin(), wrong.end(),
                                    [&](const auto& one) { return one.first == row.region; });
    if (known == wrong.end()) {
      wrong.emplace_back(row.region, samples);
    } else {
      known->second += samples;
    }
  }
  const auto most = std::max_element(
      wrong.begin(), wrong.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == wrong.end() || !(most->second > 0)) return {};
  return html("{}: {:.0f}&#8239;% of its error in the region “{}”", method,
              100 * most->second / all, most->first);
}

/// What the best method costs.
Html costHint(const study::StudyRecord& record, const std::string& method) {
  const study::CostRecord* cost = costOf(record, method);
  if (cost == nullptr) return {};
  const std::string frame =
      cost->frameMs ? fmt::format(", {:.1f} ms a frame", requireFinite(*cost->frameMs, "frame_ms"))
                    : "";
  return html("{}: {}{}", method, formatBytes(static_cast<double>(memoryBytes(*cost))), frame);
}

PageSection thresholdSection(const study::StudyRecord& record) {
  const std::vector<study::Judgement> thresholds = study::byOrigin(record.judgements).thresholds;
  if (thresholds.empty()) return {};
  const bool isMet = std::none_of(thresholds.begin(), thresholds.end(),
                                  [](const study::Judgement& one) { return one.isFault(); });
  return {"thresholds",
          "Whether it meets the study’s thresholds",
          htmlTable(gateTable(thresholds)),
          {},
          isMet};
}

PageSection costSection(const study::StudyRecord& record, const std::optional<std::string>& best,
                        std::span<const DrawnPlot> plots) {
  if (record.cost.empty()) return {};
  const std::string rates = publishedRates(record);
  const bool isTimed = std::any_of(record.cost.begin(), record.cost.end(),
                                   [](const auto& cost) { return cost.frameMs.has_value(); });
  return {
      "cost", "What each method costs",
      htmlNote(isTimed ? "One frame of the first camera view, drawn on this machine: times "
                         "compare methods here, another graphics card has others."
                       : "No frame was timed. The ranking has the memory of each method.") +
          htmlPlots(plots, "cost") +
          htmlFold("Triangles, memory, passes and times of every method",
                   htmlTable(costTable(record)) + htmlNote(keptFrames(record)) + htmlNote(rates)),
      best ? costHint(record, *best) : Html()};
}

std::string bytesText(std::uint64_t bytes) {
  return formatBytes(static_cast<double>(bytes));
}

PageSection truthSection(const study::StudyRecord& record) {
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
  if (!truth.flips.empty()) content += htmlNote(truthErrorText(truth));
  if (truth.flips.size() > 1) content += htmlTable(flipTable(truth.flips));
  return {"truth", "How far the truth can be trusted", content,
          html("{} triangles", groupedText(truth.microTriangles)), true};
}

PageSection methodSection(const std::vector<study::MethodRecord>& methods) {
  Html items;
  for (const study::MethodRecord& method : methods) {
    items += html("<dt>{}</dt><dd>{}{}<code>{}</code><small>{}</small></dd>\n", method.label,
                  method.title, method.title.empty() ? "" : " ", method.name, method.citation);
  }
  return {"methods",
          "What the methods are",
          items.empty() ? Html() : html("<dl>\n{}</dl>\n", items),
          {},
          true};
}

PageSection runSection(const study::StudyRecord& record) {
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
  const std::vector<study::InputRecord>& inputs = record.reproduction.inputs;
  return reproduceSection(
      record.command,
      htmlFold("Program and machine", html("<dl>\n{}</dl>\n", facts)) +
          (inputs.empty() ? Html()
                          : htmlFold(plural(inputs.size(), "file") + ", with their SHA-256",
                                     htmlTable(inputTable(inputs)))) +
          (record.timings.empty()
               ? Html()
               : htmlFold("Where the time went", htmlTable(timingTable(record.timings)))));
}

PageSection plotSection(const study::StudyRecord& record, std::span<const DrawnPlot> plots) {
  const Html content = htmlPlots(plots, "plots");
  if (content.empty()) return {};
  Html tables;
  for (const Table& table : binErrorTables(record)) {
    tables += html("<p><b>{}</b></p>\n{}", table.title, htmlTable(table));
  }
  return {"plots", "Where the error grows",
          html("<p class=\"note\">{} The folder <code>plots/</code> has each plot as SVG and "
               "PDF.</p>\n{}{}",
               plotReading, content, htmlFold("The figures of every method", tables))};
}

}  // namespace

PageSection confidenceSection(const study::StudyRecord& record) {
  Html content;
  const std::vector<std::string> views = confidenceViews(record);
  if (views.size() < 2) return {};
  for (const std::string& view : views) {
    const Table table = confidenceTable(record, view);
    if (table.rows.empty()) continue;
    content +=
        html("<h3>{}</h3>\n{}{}", view, htmlNote(confidenceNote(record, view)), htmlTable(table));
  }
  return {"confidence", "How sure the error rates are", content, {}, true};
}

PageSection budgetSection(const study::StudyRecord& record) {
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
    content += i == 0 ? part : htmlFold(lights[i], part);
  }
  return {"budget", "Where the error comes from", content};
}

Html reportHtml(const study::StudyRecord& record, const std::filesystem::path& folder,
                std::span<const DrawnPlot> plots) {
  const std::vector<study::RankedMethod> ranked = study::rankMethods(record);
  const std::optional<std::string> best = bestMethod(ranked);
  std::vector<PageSection> sections = {rankingSection(record, ranked),
                                       worstSection(record, folder)};
  sections.back().hint = best ? mainRegion(record, *best) : Html();
  sections.push_back(costSection(record, best, plots));
  sections.push_back(claimSection(record.claims));
  sections.push_back(thresholdSection(record));
  sections.push_back(referenceSection(record, folder));
  if (holdsPictures(record, folder)) sections.push_back(viewerSection());
  for (PageSection& section : caseSections(record, ranked, folder)) {
    sections.push_back(std::move(section));
  }
  sections.push_back(plotSection(record, plots));
  sections.push_back(budgetSection(record));
  sections.push_back(confidenceSection(record));
  sections.push_back(truthSection(record));
  sections.push_back(methodSection(record.methods));
  sections.push_back(runSection(record));
  return htmlPage(record.heading(), openingHtml(record, ranked), sections);
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
