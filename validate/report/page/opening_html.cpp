#include "report/page/opening_html.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <set>

#include "report/page/html_figures.h"
#include "report/page/html_page.h"
#include "report/page/reference_html.h"
#include "report/plotted_methods.h"
#include "report/tables/cost_table.h"
#include "report/text/confidence_text.h"
#include "report/text/glossary.h"
#include "report/text/number_text.h"
#include "study/judge/distinguish.h"
#include "study/judge/ranking.h"
#include "study/record/cases.h"

namespace gnomon::report {
namespace {

constexpr std::string_view truthLabel = "truth";

std::string nameOf(const study::StudyRecord& record, const std::string& label) {
  for (const study::MethodRecord& method : record.methods) {
    if (method.label == label) return method.name;
  }
  return label;
}

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
  const auto best = std::find_if(ranked.begin(), ranked.end(), [&](const auto& method) {
    return method.rank && nameOf(record, method.label) != controlMethod;
  });
  const study::StudyMeans means = study::studyMeans(record);
  add(labelOf(means.methods, costReference), "flat");
  add(claimedMethod(means.methods, means.claims), "claimed");
  if (best != ranked.end()) add(best->label, "best");
  add(std::string(truthLabel), "truth");
  return figures;
}

Html openingHtml(const study::StudyRecord& record, const std::vector<study::RankedMethod>& ranked) {
  return html(
      "<h1>{}</h1>\n<p class=\"source\">{}</p>\n<p class=\"lead\">Which method draws the shadows "
      "of these bumps as they really fall?</p>\n<p class=\"lead\">{}</p>\n{}{}{}"
      "<p class=\"verdict\">{}</p>\n",
      record.heading(), record.source, answerHtml(record, ranked), figuresHtml(record, ranked),
      comparedMethods(record), htmlNotices(record.notices),
      statusHtml(record.status(), record.judgements, record.problems.size()));
}

}  // namespace gnomon::report
