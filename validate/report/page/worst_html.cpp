#include "report/page/worst_html.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "image/web_picture.h"
#include "report/page/html_page.h"
#include "report/plotted_methods.h"
#include "report/text/number_text.h"
#include "study/record/cases.h"
#include "study/run/stages/worst_places.h"

namespace gnomon::report {
namespace {

const study::PictureRecord* shadedPicture(const study::PanelRecord& panel,
                                          const std::string& method) {
  const auto found = std::find_if(
      panel.pictures.begin(), panel.pictures.end(), [&](const study::PictureRecord& picture) {
        return picture.method == method && picture.kind == study::PictureRecord::Kind::shaded;
      });
  return found == panel.pictures.end() ? nullptr : &*found;
}

/// The panel in which a method's error is largest; null without any.
const study::PanelRecord* worstPanel(const study::StudyRecord& record, const std::string& method) {
  const study::PanelRecord* worst = nullptr;
  double largest = -1;
  for (const study::PanelRecord& panel : record.panels) {
    if (shadedPicture(panel, method) == nullptr) continue;
    const auto error = study::rateOf(record, method, {panel.view, panel.light},
                                     study::Answer::drawn, compare::metrics::errorRate);
    if (error.value_or(-1) <= largest) continue;
    largest = *error;
    worst = &panel;
  }
  return worst;
}

/// How wrong a square is: "1 203 of 4 096 pixels wrong"; under a light with a disc the mean of
/// |ΔV|.
std::string errorText(const study::WorstPlace& place, bool isSoft) {
  const double pixels = static_cast<double>(place.side) * place.side;
  if (isSoft) return fmt::format("mean |ΔV| {}\u202f%", percentText(place.error / pixels));
  return fmt::format("{} of {} pixels wrong", groupedText(static_cast<std::uint64_t>(place.error)),
                     groupedText(static_cast<std::uint64_t>(pixels)));
}

Html placeHtml(const std::string& method, const study::WorstPlace& place, bool isSoft) {
  return html(
      "<figure><div class=\"pair\"><img alt=\"{}\" src=\"{}\"><img alt=\"the truth\" "
      "src=\"{}\"></div><figcaption>{}, at {}, {}</figcaption></figure>\n",
      method, pictureAddress("image/webp", place.answer), pictureAddress("image/webp", place.truth),
      errorText(place, isSoft), place.left, place.top);
}

Html methodHtml(const study::StudyRecord& record, const std::string& method) {
  const study::PanelRecord* panel = worstPanel(record, method);
  if (panel == nullptr) return {};
  const std::vector<study::WorstPlace>& worst = shadedPicture(*panel, method)->worst;
  if (worst.empty()) return {};
  const auto* row = study::findResult(record, method, {panel->view, panel->light});
  const bool isSoft = row != nullptr && !row->shares.empty();
  Html places;
  for (const study::WorstPlace& place : worst) places += placeHtml(method, place, isSoft);
  return html("<h3>{} <small>{} · {}</small></h3>\n<div class=\"worst\">\n{}</div>\n", method,
              panel->view, panel->light, places);
}

}  // namespace

Html worstSection(const study::StudyRecord& record,
                  const std::vector<study::RankedMethod>& ranked) {
  const std::vector<std::string> methods = plottedMethods(study::studyMeans(record));
  Html content;
  for (const std::string& method : methods) content += methodHtml(record, method);
  if (content.empty()) return {};
  return htmlSection(
      "worst", "Where each method errs most",
      html("<p class=\"note\">Enlarged: for each method the {} squares of {} × {} pixels with the "
           "largest error, in the view and under the light where the method is most wrong. The "
           "method is on the left, the truth on the right. A method that draws its own mesh is "
           "shown as a mask: white is lit.{}</p>\n{}",
           study::mostWorstPlaces, study::worstPlaceSide, study::worstPlaceSide,
           methods.size() < ranked.size()
               ? fmt::format(" These are the {} of {} methods that the plots show.", methods.size(),
                             ranked.size())
               : "",
           content));
}

}  // namespace gnomon::report
