#include "report/html_figures.h"

#include <OpenImageIO/strutil.h>
#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "common/atomic_file.h"
#include "common/error.h"
#include "compare/rates.h"
#include "report/cases.h"
#include "report/html_text.h"
#include "report/images.h"
#include "report/names.h"
#include "report/number_text.h"

namespace gnomon {
namespace {

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

std::string pngAsBase64(const std::filesystem::path& path) {
  const std::string bytes = readFile(path);
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n")) {
    throw InternalError(fmt::format("{}: the report can embed PNG only", path.string()));
  }
  return OIIO::Strutil::base64_encode(bytes);
}

std::string alternativeText(const PictureRecord& picture) {
  const bool difference = picture.kind == PictureRecord::Kind::difference;
  return difference ? picture.method + ": signed difference from the truth" : picture.caption;
}

std::string pictureHtml(const PictureRecord& picture, const PanelRecord& panel,
                        const std::filesystem::path& folder) {
  return fmt::format(
      "<img class=\"{}\" alt=\"{}\" width=\"{}\" height=\"{}\" "
      "src=\"data:image/png;base64,{}\">\n",
      pictureKindName(picture.kind), escapeHtml(alternativeText(picture)), panel.width,
      panel.height, pngAsBase64(folder / picture.path));
}

/// "error 9.80 %", for the truth its uncertainty, or nothing where the case has no such result.
std::string rateHtml(const StudyRecord& record, const Case& which, const std::string& method) {
  if (method == truthMethod) {
    const auto uncertainty = uncertaintyOf(record, which);
    if (!uncertainty) return "";
    return fmt::format("<span class=\"rate\">uncertain by {}&#8239;%</span>",
                       escapeHtml(percentText(uncertainty)));
  }
  const ResultRecord* row = findResult(record, method, which);
  if (row == nullptr) return "";
  const Metric error = rate(row->counts, "error_rate");
  return fmt::format("<span class=\"rate\" title=\"{}\">error {}&#8239;%</span>",
                     escapeHtml(error.reason), escapeHtml(percentText(error.value)));
}

std::string captionHtml(const Figure& figure, std::size_t index, const std::string& rate) {
  std::string html = fmt::format("<figcaption><b>({})</b> {} {}", letters(index),
                                 escapeHtml(figure.pictures.front()->caption), rate);
  for (std::size_t i = 1; i < figure.pictures.size(); ++i) {
    // The legend explains all differences at once.
    if (figure.pictures[i]->kind == PictureRecord::Kind::difference) continue;
    html += fmt::format("<small>Below: {}</small>", escapeHtml(figure.pictures[i]->caption));
  }
  return html + "</figcaption>\n";
}

std::string figureHtml(const StudyRecord& record, const PanelRecord& panel, const Figure& figure,
                       std::size_t index, const std::filesystem::path& folder) {
  std::string pictures;
  for (const PictureRecord* picture : figure.pictures) {
    pictures += pictureHtml(*picture, panel, folder);
  }
  const std::string rate = rateHtml(record, {panel.view, panel.light}, figure.method);
  return fmt::format("<figure data-method=\"{}\">\n{}{}</figure>\n", escapeHtml(figure.method),
                     pictures, captionHtml(figure, index, rate));
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

std::string panelFigures(const StudyRecord& record, const PanelRecord& panel,
                         const std::filesystem::path& folder) {
  std::string html = fmt::format("<div class=\"panel\" data-view=\"{}\" data-light=\"{}\">\n",
                                 escapeHtml(panel.view), escapeHtml(panel.light));
  const std::vector<Figure> figures = figuresOf(panel);
  for (std::size_t i = 0; i < figures.size(); ++i) {
    html += figureHtml(record, panel, figures[i], i, folder);
  }
  const bool signedOnes = std::any_of(figures.begin(), figures.end(), [](const Figure& figure) {
    return has(figure, PictureRecord::Kind::difference);
  });
  return html + "</div>\n" + (signedOnes ? differenceLegend() : "");
}

std::string differenceProperties() {
  return fmt::format(
      ":root{{--false-shadow:{};--false-light:{};--both-lit:{};--both-shadowed:{}}}\n",
      cssColour(DifferenceColours::falseShadow), cssColour(DifferenceColours::falseLight),
      cssColour(DifferenceColours::bothLit), cssColour(DifferenceColours::bothShadowed));
}

}  // namespace gnomon
