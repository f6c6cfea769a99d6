#include "report/page/report_html.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "common/system/memory.h"
#include "report/page/case_html.h"
#include "report/page/html_page.h"
#include "report/page/overview_html.h"
#include "report/page/picture_html.h"
#include "report/plots/line_plot.h"
#include "report/tables/case_tables.h"
#include "report/tables/confidence.h"
#include "report/tables/cost_table.h"
#include "report/tables/ranked_table.h"
#include "report/text/html.h"
#include "report/text/number_text.h"
#include "report/text/verdict_text.h"
#include "study/judge/distinguish.h"
#include "study/judge/ranking.h"
#include "study/record/cases.h"

namespace gnomon::report {

namespace {

constexpr std::string_view truthLabel = "truth";

const study::PictureRecord* pictureOf(const study::PanelRecord& panel, const std::string& method) {
  for (const study::PictureRecord& picture : panel.pictures) {
    if (picture.method == method && picture.kind == study::PictureRecord::Kind::shaded &&
        !picture.embedded.empty()) {
      return &picture;
    }
  }
  return nullptr;
}

/// "the view “camera” under the light “noon”", or how many there are.
std::string placesText(const study::StudyRecord& record) {
  const std::vector<study::Case> cases = study::comparedCases(record);
  if (cases.size() == 1) {
    return fmt::format("in the view “{}” under the light “{}”", cases.front().view,
                       cases.front().light);
  }
  std::set<std::string> views, lights;
  for (const study::Case& which : cases) {
    views.insert(which.view);
    lights.insert(which.light);
  }
  return fmt::format("on average over {} and {}", plural(views.size(), "view"),
                     plural(lights.size(), "light"));
}

Html answerHtml(const study::StudyRecord& record, const std::vector<study::RankedMethod>& ranked) {
  if (ranked.empty() || ranked.front().allCases == 0) return html("No result has an error rate.");
  const auto inAllCases = static_cast<std::size_t>(std::count_if(
      ranked.begin(), ranked.end(), [](const auto& method) { return method.rank.has_value(); }));
  if (inAllCases == 0) {
    return html("No method answers in every {}, so none is ranked.", htmlTerm("case"));
  }
  const study::RankedMethod& best = ranked.front();
  const Html text =
      html("Of {}, <b>{}</b> is closest to the {}: {}, {}.", plural(inAllCases, "method"),
           best.label, htmlTerm("truth"), errorHtml(study::isSoft(record), best.means.errorRate),
           placesText(record));
  if (!best.uncertainty) {
    return html("{} How uncertain the truth itself is was not measured.", text);
  }
  const bool isNone =
      !study::isDistinguishable({*best.means.errorRate, best.means.interval, *best.uncertainty});
  return html("{} The truth itself is {} by {}&#8239;%{}.", text,
              htmlTerm("uncertainty of the truth", "uncertain"), percentText(best.uncertainty),
              isNone ? ": so small an error is not distinguishable from none" : "");
}

/// What the best method of each view is better than, and by how much.
Html comparedMethods(const study::StudyRecord& record) {
  const std::vector<std::string> views = confidenceViews(record);
  Html paragraphs;
  for (const std::string& view : views) {
    const std::string verdict = verdictText(record, view);
    if (verdict.empty()) continue;
    paragraphs += html("<p>{}{}</p>\n", views.size() > 1 ? "In " + view + ": " : "", verdict);
  }
  return paragraphs;
}

/// What the roles of the pictures mean, of those that a picture has.
Html rolesHtml(const std::vector<OpeningFigure>& figures) {
  const auto has = [&](const char* role) {
    return std::any_of(figures.begin(), figures.end(), [&](const OpeningFigure& figure) {
      return figure.role.find(role) != std::string::npos;
    });
  };
  Html text;
  if (has("flat")) text += html(" Flat: the {}.", htmlTerm("flat horizon map"));
  if (has("claimed")) text += html(" Claimed: the method that the study’s first claim is about.");
  if (has("best")) {
    text += html(" Best: the lowest error over the whole study, {}s aside.", htmlTerm("control"));
  }
  return text;
}

Html figuresHtml(const study::StudyRecord& record, const std::vector<study::RankedMethod>& ranked) {
  const std::vector<OpeningFigure> shown = openingFigures(record, ranked);
  Html figures;
  for (const OpeningFigure& figure : shown) {
    const study::PanelRecord& panel = record.panels.front();
    const bool isTruth = figure.method == truthLabel;
    figures += html(
        "<figure><img alt=\"{}\" src=\"{}\"><figcaption><b>{}</b> {}{}</figcaption></figure>\n",
        isTruth ? figure.role : figure.role + ": " + figure.method,
        pictureAddress("image/webp", pictureOf(panel, figure.method)->embedded), figure.role,
        isTruth ? "" : figure.method, pictureRate(record, panel, figure.method));
  }
  if (figures.empty()) return {};
  const study::PanelRecord& panel = record.panels.front();
  return html(
      "<div class=\"opening\">\n{}</div>\n<p class=\"note\">View {}, light {}; the errors are "
      "those there.{}</p>\n",
      figures, panel.view, panel.light, rolesHtml(shown));
}

}  // namespace

Html errorHtml(bool isSoft, std::optional<double> errorRate) {
  const std::string error = percentText(errorRate);
  return isSoft ? html("its {} is off by <b>{}&#8239;%</b>",
                       htmlTerm("visibility", "share of the light"), error)
                : html("it is {} at <b>{}&#8239;%</b> of the {}", htmlTerm("wrong"), error,
                       htmlTerm("samples"));
}

std::vector<OpeningFigure> openingFigures(const study::StudyRecord& record,
                                          const std::vector<study::RankedMethod>& ranked) {
  std::vector<OpeningFigure> figures;
  if (record.panels.empty()) return figures;
  const auto add = [&](const std::optional<std::string>& method, const char* role) {
    if (!method || pictureOf(record.panels.front(), *method) == nullptr) return;
    for (OpeningFigure& figure : figures) {
      if (figure.method == *method) return void(figure.role += std::string(" and ") + role);
    }
    figures.push_back({*method, role});
  };
  const study::StudyMeans means = study::studyMeans(record);
  add(labelOf(means.methods, costReference), "flat");
  add(claimedMethod(means.methods, means.claims), "claimed");
  add(bestMethod(ranked), "best");
  add(std::string(truthLabel), "truth");
  return figures;
}

namespace {

/// How a study's page opens: its title, the question, the answer in a sentence or two, whether it
/// passed, and the pictures of `openingFigures`.
Html openingHtml(const study::StudyRecord& record, const std::vector<study::RankedMethod>& ranked) {
  return html(
      "<h1>{}</h1>\n<p class=\"source\">{}</p>\n<p class=\"lead\">Which method draws the shadows "
      "of these bumps as they really fall?</p>\n<p class=\"lead\">{}</p>\n{}{}{}"
      "<p class=\"verdict\">{}</p>\n",
      record.heading(), record.source, answerHtml(record, ranked), figuresHtml(record, ranked),
      comparedMethods(record), htmlNotices(record.notices),
      statusHtml(record.status(), record.judgements, record.problems.size()));
}

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

/// Of a study of several views: for each a table of its methods, ranked with their intervals. Of a
/// single one the ranking has them.
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

/// All lights together, then folded away each light.
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

}  // namespace

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

}  // namespace gnomon::report
