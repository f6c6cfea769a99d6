#include "report/suite/suite_html.h"

#include <algorithm>

#include "report/page/html_page.h"
#include "report/plots/line_plot.h"
#include "report/suite/suite_tables.h"
#include "report/tables/formats/html_format.h"
#include "report/text/interval_text.h"
#include "report/text/number_text.h"
#include "report/text/ranking_text.h"

namespace gnomon::report {
namespace {

constexpr std::size_t mostHardScenes = 10;

/// The methods with a rank that the first is not known to differ from.
study::LikeMethods likeFirst(const study::SuiteStatistics& statistics) {
  study::LikeMethods like;
  const std::string& first = statistics.methods.front().label;
  for (const study::SuiteMethod& method : statistics.methods) {
    const auto pair = method.rank ? study::findPair(statistics, first, method.label) : std::nullopt;
    if (pair) like.add(method.label, pair->verdict);
  }
  return like;
}

Html bestOf(const study::SuiteStatistics& statistics) {
  if (statistics.methods.empty() || !statistics.methods.front().rank) {
    return html("No method was measured on every scene, so that none can be called the best.");
  }
  const study::SuiteMethod& best = statistics.methods.front();
  const std::string alike = likeText(likeFirst(statistics));
  const Html interval =
      best.interval ? html(" (95&#8239;% interval {})", intervalText(best.interval)) : Html();
  return html(
      "<b>{}</b> has {}: <b>{}&#8239;%</b> on average{}, {}&#8239;% on the worst twentieth of the "
      "scenes. {}",
      best.label, leastErrorText(statistics.isSoft), percentText(best.spread.mean), interval,
      percentText(best.spread.worstTwentieth),
      alike.empty() ? html("It is distinguishable from every other ranked method.")
                    : html("Its comparisons: {}.", alike));
}

/// What a figure of the page is.
std::string figureText(const study::SuiteStatistics& statistics) {
  if (!statistics.isSoft)
    return "the share of wrong samples, mean over the scene’s lights and views";
  return "the mean of |ΔV| (mae), by how much of the light’s disc a sample sees too little, false "
         "shadow, or too much, false light, mean over the scene’s lights and views";
}

Html header(const study::SuiteStatistics& statistics) {
  return html(
      "<h1>{}: {} over {}</h1>\n<p class=\"source\">On every scene the methods’ shadows were "
      "compared, sample by sample, with ray tracing of the displaced surface; a figure is {}. "
      "The scenes were drawn from one population and the scene is the unit: intervals and verdicts "
      "hold for further scenes drawn likewise.</p>\n<p class=\"lead\">{}</p>\n",
      statistics.suite, plural(statistics.methods.size(), "method"),
      plural(statistics.table.scenes.size(), "scene"), figureText(statistics), bestOf(statistics));
}

/// A note and what it is about; nothing without that.
Html noted(const Html& note, const Html& content) {
  return content.empty() ? Html() : html("<p class=\"note\">{}</p>\n{}", note, content);
}

Html rankedSection(const study::SuiteStatistics& statistics) {
  return htmlSection(
      "ranking", "Methods, best first",
      noted(
          html("Percent of {}. <b>Worst 5&#8239;%</b> is the mean over the worst "
               "twentieth of the scenes. <b>Ranks</b> are those of 95&#8239;% of the resamples of "
               "the scenes, <b>same rank</b> the share of them in which the rank is the one in "
               "the table. Compared with the first, by Holm’s correction over all {} of methods: "
               "{}.",
               suiteFigure(statistics).of, plural(statistics.comparisons, "pair"), signMeaning),
          htmlTable(suiteRankedTable(statistics))));
}

Html leaderSection(const study::SuiteStatistics& statistics) {
  const Table table = suiteLeaderTable(statistics);
  if (table.rows.empty()) return {};
  return htmlSection(
      "first", "Against " + statistics.methods.front().label,
      noted(html("Paired by scene. A scene on which two methods differ by no more than the truth’s "
                 "uncertainty counts half for each."),
            htmlTable(table)));
}

Html winsSection(const std::vector<DrawnPlot>& plots) {
  return htmlSection(
      "wins", "Who beats whom",
      noted(html("How probable it is, in percent, that the method of the row has a smaller error "
                 "than that of the column on a new scene. Blue above 50, orange below it; "
                 "no colour where the two are not known to differ: ≈ not distinguishable, = the "
                 "same answers, ? no interval."),
            htmlPlots(plots, "wins")));
}

Html binsSection(const study::SuiteStatistics& statistics, const std::vector<DrawnPlot>& plots) {
  Html tables;
  for (const std::string& axis : suiteAxes(statistics)) {
    tables += html("<h3>{}</h3>\n{}", axisTitle(axis), htmlTable(suiteBinsTable(statistics, axis)));
  }
  if (tables.empty()) return {};
  return htmlSection(
      "bins", "Where methods fail",
      noted(
          html("Error among the samples of all scenes that lie in a bin, each scene with the same "
               "weight. Bars are 95&#8239;% intervals over the scenes; errors below "
               "0.01&#8239;% are drawn at 0.01&#8239;%. The tables have all methods."),
          htmlPlots(plots, "bins") +
              html("<details>\n<summary>All methods</summary>\n{}</details>\n", tables)));
}

Html hardSection(const study::SuiteStatistics& statistics) {
  const Table table = suiteScenesTable(statistics, mostHardScenes);
  if (statistics.methods.empty() || !statistics.methods.front().rank) return {};
  return htmlSection("scenes", "The hardest scenes",
                     noted(html("The {} with the largest median of the ranked methods’ errors, "
                                "percent of {}.",
                                plural(table.rows.size(), "scene"), suiteFigure(statistics).of),
                           htmlTable(table)));
}

}  // namespace

Html suiteHtml(const study::SuiteStatistics& statistics, const std::vector<DrawnPlot>& plots,
               std::string_view command) {
  const Html curves = htmlSection(
      "errors", "Share of the scenes with an error below",
      noted(html("The farther up and to the left a curve runs, the better the method. It reaches "
                 "100&#8239;% at the method’s worst scene. Errors below 0.01&#8239;% are drawn at "
                 "0.01&#8239;%. {}",
                 plotReading),
            htmlPlots(plots, "plots")));
  return htmlPage(statistics.suite, header(statistics),
                  rankedSection(statistics) + curves + winsSection(plots) +
                      leaderSection(statistics) + binsSection(statistics, plots) +
                      hardSection(statistics) + htmlReproduction(command));
}

}  // namespace gnomon::report
