#include "report/page/picture_html.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/lists.h"
#include "compare/counts.h"
#include "image/image_file.h"
#include "image/images.h"
#include "image/mask_picture.h"
#include "report/plotted_methods.h"
#include "report/text/glossary.h"
#include "report/text/number_text.h"
#include "study/judge/study_means.h"
#include "study/record/cases.h"
#include "study/run/stages/truth_pictures.h"

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

// ---- the worst places

namespace {

using PictureKind = study::PictureRecord::Kind;

const study::PictureRecord* pictureOfKind(const study::PanelRecord& panel,
                                          const std::string& method,
                                          PictureKind kind = PictureKind::shaded) {
  const auto found = std::find_if(panel.pictures.begin(), panel.pictures.end(),
                                  [&](const study::PictureRecord& picture) {
                                    return picture.method == method && picture.kind == kind;
                                  });
  return found == panel.pictures.end() ? nullptr : &*found;
}

/// The panel in which a method's error is largest; null without any.
const study::PanelRecord* worstPanel(const study::StudyRecord& record, const std::string& method) {
  const study::PanelRecord* worst = nullptr;
  double largest = -1;
  for (const study::PanelRecord& panel : record.panels) {
    if (pictureOfKind(panel, method) == nullptr) continue;
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

/// A square of a picture's file.
class PictureSquare {
 public:
  explicit PictureSquare(const fs::path& file) {
    image::ImageFile picture(file);
    const image::ImageWindow window = picture.facts().display;
    image_ = {window.width, window.height, {}};
    constexpr int channels = 3;
    image_.rgb.resize(static_cast<std::size_t>(window.width) *
                      static_cast<std::size_t>(window.height) * channels);
    picture.readPlaced(0, channels, [&](const float* values, int column, int row, int count) {
      for (int i = 0; i < count * channels; ++i) {
        image_.rgb[placeOf(column, row) + static_cast<std::size_t>(i)] =
            static_cast<std::uint8_t>(std::lround(255 * values[i]));
      }
    });
  }

  /// As the address of an image; nothing where the square does not lie in the picture.
  [[nodiscard]] Html address(const study::WorstPlace& place) const {
    if (place.left + place.side > image_.width || place.top + place.side > image_.height) return {};
    image::Image square{place.side, place.side, {}};
    for (int row = 0; row < place.side; ++row) {
      const auto from =
          image_.rgb.begin() + static_cast<std::ptrdiff_t>(placeOf(place.left, place.top + row));
      square.rgb.insert(square.rgb.end(), from, from + 3 * static_cast<std::ptrdiff_t>(place.side));
    }
    return pictureAddress("image/png", image::pngOf(square));
  }

 private:
  [[nodiscard]] std::size_t placeOf(int column, int row) const {
    return 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image_.width) +
                static_cast<std::size_t>(column));
  }

  image::Image image_;
};

Html tileHtml(std::string_view about, const Html& address) {
  return html("<img alt=\"{}\" src=\"{}\">", about, address);
}

/// A method's worst places, the worst first.
struct WorstOf {
  std::string method;
  const study::PanelRecord* panel = nullptr;
  const std::vector<study::WorstPlace>* places = nullptr;
  std::vector<std::string> alike = {};  ///< methods that err at the same places
};

bool overlap(const study::WorstPlace& a, const study::WorstPlace& b) {
  const int across = std::max(0, a.side - std::abs(a.left - b.left));
  const int down = std::max(0, a.side - std::abs(a.top - b.top));
  return 2 * across * down > a.side * a.side;
}

/// Whether the places of two methods are the same by more than half.
bool areAlike(const WorstOf& a, const WorstOf& b) {
  return a.panel == b.panel && std::equal(a.places->begin(), a.places->end(), b.places->begin(),
                                          b.places->end(), overlap);
}

std::vector<WorstOf> worstPlaces(const study::StudyRecord& record,
                                 const std::vector<std::string>& methods) {
  std::vector<WorstOf> all;
  for (const std::string& method : methods) {
    WorstOf own{method, worstPanel(record, method)};
    if (own.panel == nullptr) continue;
    own.places = &pictureOfKind(*own.panel, method)->worst;
    if (own.places->empty()) continue;
    const auto same = std::find_if(all.begin(), all.end(),
                                   [&](const WorstOf& other) { return areAlike(own, other); });
    if (same == all.end()) {
      all.push_back(std::move(own));
    } else {
      same->alike.push_back(method);
    }
  }
  return all;
}

/// The worst place, or the others.
Html placesHtml(const study::StudyRecord& record, const WorstOf& worst, bool isFirst,
                const fs::path& folder) {
  const auto* row =
      study::findResult(record, worst.method, {worst.panel->view, worst.panel->light});
  const bool isSoftRow = row != nullptr && !row->shares.empty();
  const study::PictureRecord* difference =
      pictureOfKind(*worst.panel, worst.method, PictureKind::difference);
  std::optional<PictureSquare> signedPicture;
  if (difference != nullptr) signedPicture.emplace(folder / difference->path);
  const std::string panel = record.panels.size() > 1
                                ? fmt::format("{} · {}, ", worst.panel->view, worst.panel->light)
                                : "";
  const std::string alike =
      worst.alike.empty() ? "" : fmt::format(". Also {}", fmt::join(worst.alike, ", "));
  Html content;
  for (std::size_t i = isFirst ? 0 : 1; i < (isFirst ? 1 : worst.places->size()); ++i) {
    const study::WorstPlace& place = worst.places->at(i);
    const Html signedTile = signedPicture ? signedPicture->address(place) : Html();
    content += html(
        "<figure><div class=\"tiles\">{}{}{}</div><figcaption><b>{}</b> {} <small>{}at {}, {}{}"
        "</small></figcaption></figure>\n",
        tileHtml(worst.method, pictureAddress("image/webp", place.answer)),
        tileHtml("the truth", pictureAddress("image/webp", place.truth)),
        signedTile.empty() ? Html() : tileHtml("the difference", signedTile), worst.method,
        errorText(place, isSoftRow), panel, place.left, place.top, alike);
  }
  return content;
}

}  // namespace

PageSection worstSection(const study::StudyRecord& record, const fs::path& folder) {
  const std::vector<WorstOf> worst = worstPlaces(record, plottedMethods(study::studyMeans(record)));
  if (worst.empty()) return {};
  Html first;
  Html others;
  for (const WorstOf& one : worst) {
    first += placesHtml(record, one, true, folder);
    others += placesHtml(record, one, false, folder);
  }
  const auto list = [](const Html& figures) {
    return figures.empty() ? figures : html("<div class=\"worst\">\n{}</div>\n", figures);
  };
  return {
      "worst", "Where each method is wrong",
      html("<p class=\"note\">The square of {} × {} pixels with the largest error, enlarged: the "
           "method, the truth, and the difference: <i class=\"chip shadow\"></i> {}, <i "
           "class=\"chip light\"></i> {}. A method that draws its own mesh is shown as a mask: "
           "white is lit.</p>\n{}{}",
           study::worstPlaceSide, study::worstPlaceSide, htmlTerm("false shadow"),
           htmlTerm("false light"), list(first),
           htmlFold("The next worst squares of each method", list(others)))};
}

}  // namespace gnomon::report
