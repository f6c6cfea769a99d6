#include "report/page/picture_html.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/lists.h"
#include "compare/counts.h"
#include "image/images.h"
#include "image/mask_picture.h"
#include "report/plots/line_plot.h"
#include "report/text/html.h"
#include "report/text/number_text.h"
#include "study/judge/ranking.h"
#include "study/record/cases.h"

namespace gnomon::report {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view truthMethod = "truth";

/// The pictures that share one caption, the shading first.
struct Figure {
  std::string method;
  std::vector<const study::PictureRecord*> pictures;
};

bool has(const Figure& figure, study::PictureRecord::Kind kind) {
  return std::any_of(figure.pictures.begin(), figure.pictures.end(),
                     [&](const study::PictureRecord* picture) { return picture->kind == kind; });
}

std::vector<Figure> figuresOf(const study::PanelRecord& panel) {
  std::vector<Figure> figures;
  for (const study::PictureRecord& picture : panel.pictures) {
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

std::string alternativeText(const study::PictureRecord& picture) {
  const bool difference = picture.kind == study::PictureRecord::Kind::difference;
  return difference ? picture.method + ": signed difference from the truth" : picture.caption;
}

/// A difference is embedded as it is, since the viewer reads masks from it.
Html pictureHtml(const study::PictureRecord& picture, const study::PanelRecord& panel,
                 const fs::path& folder) {
  const bool isDifference = picture.kind == study::PictureRecord::Kind::difference;
  const bool isWhole = !isDifference && !picture.layers;
  const Html address = isDifference ? pngAddress(folder / picture.path)
                                    : pictureAddress("image/webp", picture.embedded);
  return html("<img class=\"{}{}\" alt=\"{}\" width=\"{}\" height=\"{}\" src=\"{}\">\n",
              pictureKindName(picture.kind), isWhole ? " whole" : "", alternativeText(picture),
              panel.width, panel.height, address);
}

/// "error 9.80 %", for the truth its uncertainty, or nothing where the case has no such result.
struct Rate {
  std::string text;
  std::string reason;  ///< where it is not defined
};

Rate rateOf(const study::StudyRecord& record, const study::Case& which, const std::string& method) {
  if (method == truthMethod) {
    const auto uncertainty = study::uncertaintyOf(record, which);
    return uncertainty ? Rate{"uncertain by " + percentText(uncertainty) + "\u202f%", ""} : Rate{};
  }
  const study::ResultRecord* row = study::findResult(record, method, which);
  if (row == nullptr) return {};
  const compare::Metric error = compare::rate(row->counts, compare::metrics::errorRate);
  return {"error " + percentText(error.value) + "\u202f%", std::string(error.reason)};
}

Html rateHtml(const Rate& rate) {
  if (rate.text.empty()) return {};
  return html("<span class=\"rate\" title=\"{}\">{}</span>", rate.reason, rate.text);
}

Html captionHtml(const Figure& figure, std::size_t index, const Rate& rate) {
  Html caption =
      html("<b>({})</b> {} {}", letters(index), figure.pictures.front()->caption, rateHtml(rate));
  for (std::size_t i = 1; i < figure.pictures.size(); ++i) {
    // The legend explains all differences at once.
    if (figure.pictures[i]->kind == study::PictureRecord::Kind::difference) continue;
    caption += html("<small>Below: {}</small>", figure.pictures[i]->caption);
  }
  return html("<figcaption>{}</figcaption>\n", caption);
}

/// Whether a panel's light has a disc: its shadings are not composed of layers.
bool isSoft(const study::PanelRecord& panel) {
  return std::any_of(
      panel.pictures.begin(), panel.pictures.end(),
      [](const study::PictureRecord& picture) { return !picture.mask.empty() && !picture.layers; });
}

/// The number of the mesh that a shading shows: that of its layers, or else of the first picture
/// that is held against the same truth. None of other pictures.
std::optional<std::size_t> meshOf(const study::PictureRecord& picture,
                                  const study::PanelRecord& panel) {
  if (picture.layers || !picture.truth) return picture.layers;
  const auto same = std::find_if(panel.pictures.begin(), panel.pictures.end(),
                                 [&](const study::PictureRecord& other) {
                                   return other.truth && other.truth->mask == picture.truth->mask;
                                 });
  return static_cast<std::size_t>(same - panel.pictures.begin());
}

Html figureHtml(const study::StudyRecord& record, const study::PanelRecord& panel,
                const Figure& figure, std::size_t index, const fs::path& folder) {
  const Rate rate = rateOf(record, {panel.view, panel.light}, figure.method);
  const study::PictureRecord& first = *figure.pictures.front();
  const std::optional<std::size_t> place = meshOf(first, panel);
  const Html mesh = place ? html(" data-mesh=\"{}\"", *place) : Html();
  Html pictures;
  for (const study::PictureRecord* picture : figure.pictures) {
    pictures += pictureHtml(*picture, panel, folder);
  }
  return html(
      "<figure data-method=\"{}\" data-letter=\"{}\" data-name=\"{}\" data-rate=\"{}\"{}>\n{}{}"
      "</figure>\n",
      figure.method, letters(index), first.caption, rate.text, mesh, pictures,
      captionHtml(figure, index, rate));
}

Html layerHtml(std::string_view kind, std::size_t mesh, const Html& address) {
  return html("<img class=\"{}\" data-mesh=\"{}\" alt=\"\" src=\"{}\">\n", kind, mesh, address);
}

/// The truth's mask; its shares as a signed difference from themselves, which the viewer reads as
/// it does a method's.
Html truthAddress(const study::PanelRecord& panel, const fs::path& file) {
  if (!isSoft(panel)) return pngAddress(file);
  const Visibility truth = image::readSharePicture(file);
  return pictureAddress("image/png", image::pngOf(image::shareDifferenceImage(truth, truth)));
}

/// What shadings are composed of: the layers, and the truth's mask.
Html layersHtml(const study::PanelRecord& panel, const fs::path& folder) {
  Html layers;
  for (const study::PictureRecord& picture : panel.pictures) {
    const std::optional<std::size_t> mesh = meshOf(picture, panel);
    if (picture.method != truthMethod || !mesh) continue;
    layers += layerHtml("truth", *mesh, truthAddress(panel, folder / picture.mask));
  }
  for (std::size_t i = 0; i < panel.layers.size(); ++i) {
    layers += layerHtml("lit", i, pictureAddress("image/webp", panel.layers[i].lit)) +
              layerHtml("dark", i, pictureAddress("image/webp", panel.layers[i].dark));
  }
  return layers.empty() ? Html() : html("<div class=\"layers\" hidden>\n{}</div>\n", layers);
}

std::string cssColour(const image::Rgb& colour) {
  return fmt::format("rgb({} {} {})", colour[0], colour[1], colour[2]);
}

Html legendEntry(std::string_view property, std::string_view text) {
  return html("<li><i style=\"background:var({})\"></i>{}</li>", property, text);
}

/// What the colours of a signed difference mean.
Html differenceLegend() {
  return html("<ul class=\"legend\">{}{}{}{}</ul>\n", legendEntry("--false-shadow", "false shadow"),
              legendEntry("--false-light", "false light"), legendEntry("--both-lit", "both lit"),
              legendEntry("--both-shadowed", "both shadowed"));
}

/// The same of maps of visibility: a scale, from a whole disc too little to one too much.
Html shareLegend() {
  return html(
      "<ul class=\"legend\"><li>Lower pictures, V of the method less V of the truth, over the grey "
      "of the truth's V:</li>{}{}{}<li><i class=\"scale\" style=\"width:8em;background:"
      "linear-gradient(to right,var(--false-shadow),var(--both-lit),var(--false-light))\"></i>"
      "−1 to 1</li></ul>\n",
      legendEntry("--false-shadow", "−1: dark, but the truth sees the whole disc"),
      legendEntry("--both-lit", "0: the same share"),
      legendEntry("--false-light", "1: lit, but the truth is in umbra"));
}

}  // namespace

Html pngAddress(const fs::path& path) {
  const std::string bytes = readFile(path);
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n")) {
    throw InternalError(fmt::format("{}: the report can embed PNG only", path.string()));
  }
  return pictureAddress("image/png", bytes);
}

ShownMethods shownMethods(const study::StudyRecord& record) {
  return {plottedMethods(study::studyMeans(record)), bestMethod(study::rankMethods(record))};
}

Html panelFigures(const study::StudyRecord& record, const study::PanelRecord& panel,
                  const ShownMethods& shown, const fs::path& folder) {
  std::vector<Figure> figures = figuresOf(panel);
  const auto others =
      std::stable_partition(figures.begin(), figures.end(), [&](const Figure& figure) {
        return figure.method == truthMethod || contains(shown.labels, figure.method);
      });
  const auto group = [&](std::vector<Figure>::iterator from, std::vector<Figure>::iterator to) {
    Html content;
    for (auto at = from; at != to; ++at) {
      const auto place = static_cast<std::size_t>(at - figures.begin());
      content += figureHtml(record, panel, *at, place, folder);
    }
    return content.empty() ? content : html("<div class=\"figures\">\n{}</div>\n", content);
  };
  const bool signedOnes = std::any_of(figures.begin(), figures.end(), [](const Figure& figure) {
    return has(figure, study::PictureRecord::Kind::difference);
  });
  const auto rest = static_cast<std::size_t>(figures.end() - others);
  return html(
      "<div class=\"panel\" data-title=\"{} · {}\" data-width=\"{}\" data-height=\"{}\" "
      "data-best=\"{}\"{}>\n{}{}{}{}</div>\n",
      panel.view, panel.light, panel.width, panel.height, shown.best.value_or(""),
      isSoft(panel) ? html(" data-soft") : Html(),
      !signedOnes     ? Html()
      : isSoft(panel) ? shareLegend()
                      : differenceLegend(),
      group(figures.begin(), others),
      htmlFold("Pictures of " + plural(rest, "more method"), group(others, figures.end())),
      layersHtml(panel, folder));
}

PageSection viewerSection() {
  return {"compare", "Any two pictures", viewerMarkup()};
}

Html pictureRate(const study::StudyRecord& record, const study::PanelRecord& panel,
                 const std::string& method) {
  return rateHtml(rateOf(record, {panel.view, panel.light}, method));
}

Html differenceProperties() {
  return html(":root{{--false-shadow:{};--false-light:{};--both-lit:{};--both-shadowed:{}}}\n",
              cssColour(image::DifferenceColours::falseShadow),
              cssColour(image::DifferenceColours::falseLight),
              cssColour(image::DifferenceColours::bothLit),
              cssColour(image::DifferenceColours::bothShadowed));
}

}  // namespace gnomon::report
