#include "report/page/worst_html.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/error.h"
#include "common/lists.h"
#include "common/parallel.h"
#include "image/grey_picture.h"
#include "image/images.h"
#include "image/web_picture.h"
#include "report/highlights.h"
#include "report/page/html_page.h"
#include "report/page/worst_windows.h"
#include "report/text/number_text.h"
#include "study/record/cases.h"

namespace gnomon::report {
namespace {

namespace fs = std::filesystem;
using Kind = study::PictureRecord::Kind;

constexpr std::size_t mostPlaces = 3;
constexpr int windowSide = 64;

const study::PictureRecord* pictureOf(const study::PanelRecord& panel, const std::string& method,
                                      Kind kind) {
  for (const study::PictureRecord& picture : panel.pictures) {
    if (picture.method == method && picture.kind == kind) return &picture;
  }
  return nullptr;
}

/// Whether the pictures of a method in a panel can be compared pixel by pixel.
bool isComparable(const study::StudyRecord& record, const study::PanelRecord& panel,
                  const std::string& method) {
  const auto* row = study::findResult(record, method, {panel.view, panel.light});
  return row != nullptr && row->shares.empty() &&
         pictureOf(panel, method, Kind::difference) != nullptr &&
         pictureOf(panel, method, Kind::shaded) != nullptr &&
         pictureOf(panel, "truth", Kind::shaded) != nullptr;
}

/// The panel in which a method's error is largest; null without any.
const study::PanelRecord* worstPanel(const study::StudyRecord& record, const std::string& method) {
  const study::PanelRecord* worst = nullptr;
  double largest = -1;
  for (const study::PanelRecord& panel : record.panels) {
    if (!isComparable(record, panel, method)) continue;
    const auto error = study::rateOf(record, method, {panel.view, panel.light},
                                     study::Answer::drawn, "error_rate");
    if (error.value_or(-1) <= largest) continue;
    largest = *error;
    worst = &panel;
  }
  return worst;
}

/// 1 where a signed difference shows an error: its red part tells.
std::vector<std::uint8_t> wrongPixels(const image::GreyPicture& difference) {
  using Colours = image::DifferenceColours;
  std::vector<std::uint8_t> wrong;
  wrong.reserve(difference.values.size());
  for (const float value : difference.values) {
    const long red = std::lround(255 * value);
    wrong.push_back(red == Colours::falseShadow[0] || red == Colours::falseLight[0] ? 1 : 0);
  }
  return wrong;
}

/// A square of a picture as a page embeds it, in grey.
Html cropAddress(const image::GreyPicture& picture, const Window& window) {
  image::Image crop{window.side, window.side, {}};
  for (int y = window.top; y < window.top + window.side; ++y) {
    for (int x = window.left; x < window.left + window.side; ++x) {
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                      static_cast<std::size_t>(x);
      const auto grey = static_cast<std::uint8_t>(std::lround(255 * picture.values.at(at)));
      crop.rgb.insert(crop.rgb.end(), 3, grey);
    }
  }
  return pictureAddress("image/webp", image::webPicture(crop, image::fineQuality));
}

/// The method's picture and the truth's, both at the method's own samples.
struct PairPaths {
  std::string method, truth;
};

PairPaths pairPaths(const study::PanelRecord& panel, const std::string& method) {
  const study::PictureRecord& own = *pictureOf(panel, method, Kind::shaded);
  const study::PictureRecord& truth = *pictureOf(panel, "truth", Kind::shaded);
  const bool hasOwnSamples = own.truth && own.truth->mask != truth.mask;
  return hasOwnSamples ? PairPaths{own.mask, own.truth->mask} : PairPaths{own.path, truth.path};
}

Html placeHtml(const std::string& method, const Window& window, const image::GreyPicture& own,
               const image::GreyPicture& truth) {
  return html(
      "<figure><div class=\"pair\"><img alt=\"{}\" src=\"{}\"><img alt=\"the truth\" "
      "src=\"{}\"></div><figcaption>{} of {} pixels wrong, at {}, {}</figcaption></figure>\n",
      method, cropAddress(own, window), cropAddress(truth, window), groupedText(window.wrong),
      groupedText(static_cast<std::uint64_t>(window.side) *
                  static_cast<std::uint64_t>(window.side)),
      window.left, window.top);
}

Html methodHtml(const study::StudyRecord& record, const std::string& method,
                const fs::path& folder) {
  const study::PanelRecord* panel = worstPanel(record, method);
  if (panel == nullptr) return {};
  const image::GreyPicture difference =
      image::readGreyPicture(folder / pictureOf(*panel, method, Kind::difference)->path, "R");
  const std::vector<Window> windows = worstWindows(wrongPixels(difference), difference.width,
                                                   difference.height, windowSide, mostPlaces);
  if (windows.empty()) return {};
  const PairPaths paths = pairPaths(*panel, method);
  const image::GreyPicture own = image::readGreyPicture(folder / paths.method, "R");
  const image::GreyPicture truth = image::readGreyPicture(folder / paths.truth, "R");
  if (own.values.size() != difference.values.size() ||
      truth.values.size() != difference.values.size()) {
    throw InputError(fmt::format("{}: {} × {} pixels expected, as its difference has",
                                 (folder / paths.method).string(), difference.width,
                                 difference.height));
  }
  Html places;
  for (const Window& window : windows) places += placeHtml(method, window, own, truth);
  return html("<h3>{} <small>{} · {}</small></h3>\n<div class=\"worst\">\n{}</div>\n", method,
              panel->view, panel->light, places);
}

}  // namespace

Html worstSection(const study::StudyRecord& record, const std::vector<study::RankedMethod>& ranked,
                  const fs::path& folder) {
  const std::vector<std::string> methods = highlights(study::studyMeans(record));
  std::vector<Html> parts(methods.size());
  parallelFor(0, methods.size(),
              [&](std::size_t i) { parts[i] = methodHtml(record, methods[i], folder); });
  Html content;
  for (const Html& part : parts) content += part;
  if (content.empty()) return {};
  return htmlSection(
      "worst", "Where each method errs most",
      html("<p class=\"note\">Enlarged: of each method the {} squares of {} × {} pixels with the "
           "most wrong samples, in the view and under the light where its error is largest. On the "
           "left the method, on the right the truth. A method with a mesh of its own is shown "
           "as a mask, white where lit.{}</p>\n{}",
           mostPlaces, windowSide, windowSide,
           methods.size() < ranked.size()
               ? fmt::format(" Shown are the methods of the first pictures, and the best of the "
                             "others: {} of {}.",
                             methods.size(), ranked.size())
               : "",
           content));
}

}  // namespace gnomon::report
