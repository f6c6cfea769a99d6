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
#include "image/share_picture.h"
#include "image/web_picture.h"
#include "report/highlights.h"
#include "report/page/html_page.h"
#include "report/page/worst_windows.h"
#include "report/text/number_text.h"
#include "study/record/cases.h"

namespace gnomon::report {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t mostPlaces = 3;
constexpr int windowSide = 64;
constexpr const char* truthMethod = "truth";

const study::PictureRecord* shadedPicture(const study::PanelRecord& panel,
                                          const std::string& method) {
  for (const study::PictureRecord& picture : panel.pictures) {
    if (picture.method == method && picture.kind == study::PictureRecord::Kind::shaded) {
      return &picture;
    }
  }
  return nullptr;
}

/// Whether the answers of a method in a panel can be compared with the truth pixel by pixel.
bool isComparable(const study::PanelRecord& panel, const std::string& method) {
  const study::PictureRecord* own = shadedPicture(panel, method);
  return own != nullptr && own->truth && !own->mask.empty() &&
         shadedPicture(panel, truthMethod) != nullptr;
}

/// The panel in which a method's error is largest; null without any.
const study::PanelRecord* worstPanel(const study::StudyRecord& record, const std::string& method) {
  const study::PanelRecord* worst = nullptr;
  double largest = -1;
  for (const study::PanelRecord& panel : record.panels) {
    if (!isComparable(panel, method)) continue;
    const auto error = study::rateOf(record, method, {panel.view, panel.light},
                                     study::Answer::drawn, "error_rate");
    if (error.value_or(-1) <= largest) continue;
    largest = *error;
    worst = &panel;
  }
  return worst;
}

/// By how much a method's answer is wrong at each pixel: 0 or 1, under a light with a disc |ΔV|; 0
/// where there is no sample.
std::vector<float> errorsOf(const Visibility& own, const Visibility& truth) {
  std::vector<float> errors(own.shares.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const float error = std::abs(own.shares[i] - truth.shares.at(i));
    errors[i] = std::isnan(error) ? 0 : error;
  }
  return errors;
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
  std::string channel = {};  ///< to show; a mask has one alone
};

PairPaths pairPaths(const study::PanelRecord& panel, const std::string& method) {
  const study::PictureRecord& own = *shadedPicture(panel, method);
  const study::PictureRecord& truth = *shadedPicture(panel, truthMethod);
  return own.truth->mask == truth.mask ? PairPaths{own.path, truth.path, "R"}
                                       : PairPaths{own.mask, own.truth->mask};
}

/// How wrong a window is: "1 203 of 4 096 pixels wrong"; under a light with a disc the mean of
/// |ΔV|.
std::string errorText(const Window& window, bool isSoft) {
  const double pixels = static_cast<double>(window.side) * window.side;
  if (isSoft) return fmt::format("mean |ΔV| {}\u202f%", percentText(window.error / pixels));
  return fmt::format("{} of {} pixels wrong", groupedText(static_cast<std::uint64_t>(window.error)),
                     groupedText(static_cast<std::uint64_t>(pixels)));
}

Html placeHtml(const std::string& method, const Window& window, bool isSoft,
               const image::GreyPicture& own, const image::GreyPicture& truth) {
  return html(
      "<figure><div class=\"pair\"><img alt=\"{}\" src=\"{}\"><img alt=\"the truth\" "
      "src=\"{}\"></div><figcaption>{}, at {}, {}</figcaption></figure>\n",
      method, cropAddress(own, window), cropAddress(truth, window), errorText(window, isSoft),
      window.left, window.top);
}

void requireSize(const fs::path& path, std::size_t found, const Visibility& truth) {
  if (found == truth.size()) return;
  throw InputError(fmt::format("{}: {} × {} pixels expected, as the truth has", path.string(),
                               truth.width, truth.height));
}

Html methodHtml(const study::StudyRecord& record, const std::string& method,
                const fs::path& folder) {
  const study::PanelRecord* panel = worstPanel(record, method);
  if (panel == nullptr) return {};
  const study::PictureRecord& picture = *shadedPicture(*panel, method);
  const Visibility answer = image::readSharePicture(folder / picture.mask);
  const Visibility right = image::readSharePicture(folder / picture.truth->mask);
  requireSize(folder / picture.mask, answer.size(), right);
  const std::vector<Window> windows =
      worstWindows(errorsOf(answer, right), right.width, right.height, windowSide, mostPlaces);
  if (windows.empty()) return {};
  const PairPaths paths = pairPaths(*panel, method);
  const image::GreyPicture own = image::readGreyPicture(folder / paths.method, paths.channel);
  const image::GreyPicture truth = image::readGreyPicture(folder / paths.truth, paths.channel);
  requireSize(folder / paths.method, own.values.size(), right);
  requireSize(folder / paths.truth, truth.values.size(), right);
  const auto* row = study::findResult(record, method, {panel->view, panel->light});
  const bool isSoft = row != nullptr && !row->shares.empty();
  Html places;
  for (const Window& window : windows) places += placeHtml(method, window, isSoft, own, truth);
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
      html("<p class=\"note\">Enlarged: for each method the {} squares of {} × {} pixels with the "
           "largest error, in the view and under the light where the method is most wrong. The "
           "method is on the left, the truth on the right. A method that draws its own mesh is "
           "shown as a mask: white is lit.{}</p>\n{}",
           mostPlaces, windowSide, windowSide,
           methods.size() < ranked.size()
               ? fmt::format(" These are the {} of {} methods that the plots highlight.",
                             methods.size(), ranked.size())
               : "",
           content));
}

}  // namespace gnomon::report
