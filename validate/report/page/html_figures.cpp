#include "report/page/html_figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "compare/rates.h"
#include "image/images.h"
#include "image/web_picture.h"
#include "report/text/html_text.h"
#include "report/text/names.h"
#include "report/text/number_text.h"
#include "study/record/cases.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view truthMethod = "truth";

/// The pictures that share one caption, the shading first.
struct Figure {
  std::string method;
  std::vector<const PictureRecord*> pictures;
};

bool has(const Figure& figure, PictureRecord::Kind kind) {
  return std::any_of(figure.pictures.begin(), figure.pictures.end(),
                     [&](const PictureRecord* picture) { return picture->kind == kind; });
}

std::vector<Figure> figuresOf(const PanelRecord& panel) {
  std::vector<Figure> figures;
  for (const PictureRecord& picture : panel.pictures) {
    const auto home = std::find_if(figures.begin(), figures.end(), [&](const Figure& figure) {
      return figure.method == picture.method && !has(figure, picture.kind);
    });
    if (home == figures.end()) {
      figures.push_back({picture.method, {&picture}});
    } else {
      home->pictures.push_back(&picture);
    }
  }
  for (Figure& figure : figures) {
    std::stable_sort(figure.pictures.begin(), figure.pictures.end(),
                     [](const auto* a, const auto* b) { return a->kind < b->kind; });
  }
  return figures;
}

/// a … z, aa, ab …
std::string letters(std::size_t index) {
  const std::string last(1, static_cast<char>('a' + index % 26));
  return index < 26 ? last : letters(index / 26 - 1) + last;
}

std::string alternativeText(const PictureRecord& picture) {
  const bool difference = picture.kind == PictureRecord::Kind::difference;
  return difference ? picture.method + ": signed difference from the truth" : picture.caption;
}

/// A difference is embedded as it is, since the viewer reads masks from it.
std::string pictureHtml(const PictureRecord& picture, const PanelRecord& panel,
                        const fs::path& folder) {
  const bool isDifference = picture.kind == PictureRecord::Kind::difference;
  const bool isWhole = !isDifference && !picture.layers;
  const std::string address = isDifference ? pngAddress(folder / picture.path)
                                           : dataAddress("image/webp", picture.embedded);
  return fmt::format("<img class=\"{}{}\" alt=\"{}\" width=\"{}\" height=\"{}\" src=\"{}\">\n",
                     pictureKindName(picture.kind), isWhole ? " whole" : "",
                     escapeHtml(alternativeText(picture)), panel.width, panel.height, address);
}

/// "error 9.80 %", for the truth its uncertainty, or nothing where the case has no such result.
struct Rate {
  std::string text;
  std::string reason;  ///< where it is not defined
};

Rate rateOf(const StudyRecord& record, const Case& which, const std::string& method) {
  if (method == truthMethod) {
    const auto uncertainty = uncertaintyOf(record, which);
    return uncertainty ? Rate{"uncertain by " + percentText(uncertainty) + "\u202f%", ""} : Rate{};
  }
  const ResultRecord* row = findResult(record, method, which);
  if (row == nullptr) return {};
  const Metric error = rate(row->counts, "error_rate");
  return {"error " + percentText(error.value) + "\u202f%", std::string(error.reason)};
}

std::string rateHtml(const Rate& rate) {
  if (rate.text.empty()) return "";
  return fmt::format("<span class=\"rate\" title=\"{}\">{}</span>", escapeHtml(rate.reason),
                     escapeHtml(rate.text));
}

std::string captionHtml(const Figure& figure, std::size_t index, const Rate& rate) {
  std::string html = fmt::format("<figcaption><b>({})</b> {} {}", letters(index),
                                 escapeHtml(figure.pictures.front()->caption), rateHtml(rate));
  for (std::size_t i = 1; i < figure.pictures.size(); ++i) {
    // The legend explains all differences at once.
    if (figure.pictures[i]->kind == PictureRecord::Kind::difference) continue;
    html += fmt::format("<small>Below: {}</small>", escapeHtml(figure.pictures[i]->caption));
  }
  return html + "</figcaption>\n";
}

std::string figureHtml(const StudyRecord& record, const PanelRecord& panel, const Figure& figure,
                       std::size_t index, const fs::path& folder) {
  const Rate rate = rateOf(record, {panel.view, panel.light}, figure.method);
  const PictureRecord& first = *figure.pictures.front();
  const std::string layers = first.layers ? fmt::format(" data-mesh=\"{}\"", *first.layers) : "";
  std::string pictures;
  for (const PictureRecord* picture : figure.pictures) {
    pictures += pictureHtml(*picture, panel, folder);
  }
  return fmt::format(
      "<figure data-method=\"{}\" data-letter=\"{}\" data-name=\"{}\" data-rate=\"{}\"{}>\n{}{}"
      "</figure>\n",
      escapeHtml(figure.method), letters(index), escapeHtml(first.caption), escapeHtml(rate.text),
      layers, pictures, captionHtml(figure, index, rate));
}

std::string layerHtml(std::string_view kind, std::size_t mesh, const std::string& address) {
  return fmt::format("<img class=\"{}\" data-mesh=\"{}\" alt=\"\" src=\"{}\">\n", kind, mesh,
                     address);
}

/// What shadings are composed of: the layers, and the truth's mask.
std::string layersHtml(const PanelRecord& panel, const fs::path& folder) {
  std::string html;
  for (const PictureRecord& picture : panel.pictures) {
    if (picture.method != truthMethod || !picture.layers) continue;
    html += layerHtml("truth", *picture.layers, pngAddress(folder / picture.mask));
  }
  for (std::size_t i = 0; i < panel.layers.size(); ++i) {
    html += layerHtml("lit", i, dataAddress("image/webp", panel.layers[i].lit)) +
            layerHtml("dark", i, dataAddress("image/webp", panel.layers[i].dark));
  }
  return html.empty() ? "" : "<div class=\"layers\" hidden>\n" + html + "</div>\n";
}

std::string cssColour(const Rgb& colour) {
  return fmt::format("rgb({} {} {})", colour[0], colour[1], colour[2]);
}

std::string legendEntry(std::string_view property, std::string_view text) {
  return fmt::format("<li><i style=\"background:var({})\"></i>{}</li>", property, text);
}

/// What the colours of a signed difference mean.
std::string differenceLegend() {
  return "<ul class=\"legend\"><li>Lower pictures, method against truth:</li>" +
         legendEntry("--false-shadow", "false shadow: dark, but the truth is lit") +
         legendEntry("--false-light", "false light: lit, but the truth is shadowed") +
         legendEntry("--both-lit", "both lit") + legendEntry("--both-shadowed", "both shadowed") +
         "</ul>\n";
}

}  // namespace

std::string pngAddress(const fs::path& path) {
  const std::string bytes = readFile(path);
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n")) {
    throw InternalError(fmt::format("{}: the report can embed PNG only", path.string()));
  }
  return dataAddress("image/png", bytes);
}

std::string panelFigures(const StudyRecord& record, const PanelRecord& panel,
                         const fs::path& folder) {
  const std::vector<Figure> figures = figuresOf(panel);
  std::string html = fmt::format(
      "<div class=\"panel\" data-title=\"{} · {}\" data-width=\"{}\" data-height=\"{}\">\n",
      escapeHtml(panel.view), escapeHtml(panel.light), panel.width, panel.height);
  for (std::size_t i = 0; i < figures.size(); ++i) {
    html += figureHtml(record, panel, figures[i], i, folder);
  }
  const bool signedOnes = std::any_of(figures.begin(), figures.end(), [](const Figure& figure) {
    return has(figure, PictureRecord::Kind::difference);
  });
  return html + layersHtml(panel, folder) + "</div>\n" + (signedOnes ? differenceLegend() : "");
}

std::string differenceProperties() {
  return fmt::format(
      ":root{{--false-shadow:{};--false-light:{};--both-lit:{};--both-shadowed:{}}}\n",
      cssColour(DifferenceColours::falseShadow), cssColour(DifferenceColours::falseLight),
      cssColour(DifferenceColours::bothLit), cssColour(DifferenceColours::bothShadowed));
}

}  // namespace gnomon
