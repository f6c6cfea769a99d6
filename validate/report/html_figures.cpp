#include "report/html_figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "common/atomic_file.h"
#include "common/error.h"
#include "common/parallel.h"
#include "compare/rates.h"
#include "report/cases.h"
#include "report/html_text.h"
#include "report/images.h"
#include "report/names.h"
#include "report/number_text.h"
#include "report/picture_layers.h"
#include "report/shrunk_image.h"
#include "report/web_picture.h"
#include "study/cached_fields.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view truthMethod = "truth";
/// Of the small pictures: the page shows them at a quarter of its width, on paper at two inches.
constexpr int smallSide = 600;

/// The pictures that share one caption, the shading first.
struct Figure {
  std::string method;
  std::vector<const PictureRecord*> pictures;
  std::optional<std::size_t> mesh = std::nullopt;  ///< whose layers its shading is composed of
  std::string html = {};                           ///< its pictures
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

/// A picture as it is, byte for byte.
std::string pngAddress(const fs::path& path) {
  const std::string bytes = readFile(path);
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n")) {
    throw InternalError(fmt::format("{}: the report can embed PNG only", path.string()));
  }
  return dataAddress("image/png", bytes);
}

ContentKey keyOfFile(const fs::path& path) {
  return keyOfBytes(readFile(path));
}

/// A picture of a file as WebP: in full, or small.
std::string webAddress(const fs::path& path, bool isSmall, Cache& cache) {
  KeyBuilder key("web picture");
  key.add("file", keyOfFile(path)).add("small", isSmall);
  return cache.remember(key.key(), [&] {
    return isSmall ? webPicture(shrunk(readImage(path), smallSide), smallQuality)
                   : webPicture(readImage(path), fineQuality);
  });
}

std::string alternativeText(const PictureRecord& picture) {
  const bool difference = picture.kind == PictureRecord::Kind::difference;
  return difference ? picture.method + ": signed difference from the truth" : picture.caption;
}

/// A shading that can be composed again is embedded small, a difference as it is, since the viewer
/// reads masks from it, and any other picture in full.
std::string pictureHtml(const PictureRecord& picture, const PanelRecord& panel,
                        const fs::path& folder, Cache& cache) {
  const fs::path path = folder / picture.path;
  const bool isDifference = picture.kind == PictureRecord::Kind::difference;
  const bool isSmall = !isDifference && !picture.mask.empty();
  const std::string address = isDifference ? pngAddress(path) : webAddress(path, isSmall, cache);
  return fmt::format("<img class=\"{}{}\" alt=\"{}\" width=\"{}\" height=\"{}\" src=\"{}\">\n",
                     pictureKindName(picture.kind), isDifference || isSmall ? "" : " whole",
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
                       std::size_t index) {
  const Rate rate = rateOf(record, {panel.view, panel.light}, figure.method);
  const std::string mesh = figure.mesh ? fmt::format(" data-mesh=\"{}\"", *figure.mesh) : "";
  return fmt::format(
      "<figure data-method=\"{}\" data-letter=\"{}\" data-name=\"{}\" data-rate=\"{}\"{}>\n{}{}"
      "</figure>\n",
      escapeHtml(figure.method), letters(index), escapeHtml(figure.pictures.front()->caption),
      escapeHtml(rate.text), mesh, figure.html, captionHtml(figure, index, rate));
}

std::string layerHtml(std::string_view kind, std::size_t mesh, const std::string& address) {
  return fmt::format("<img class=\"{}\" data-mesh=\"{}\" alt=\"\" src=\"{}\">\n", kind, mesh,
                     address);
}

/// The figures whose shadings are taken apart.
std::vector<Figure*> layeredFigures(std::vector<Figure>& figures) {
  std::vector<Figure*> layered;
  for (Figure& figure : figures) {
    const bool answers =
        figure.method == truthMethod || has(figure, PictureRecord::Kind::difference);
    if (!figure.pictures.front()->mask.empty() && answers) layered.push_back(&figure);
  }
  return layered;
}

/// The layers of some shadings, embedded, and whose mesh each of the shadings is.
struct Layers {
  std::vector<std::uint64_t> meshes;
  std::vector<std::string> lit, dark;
};

template <typename Stream, SameAs<Layers> T>
void fields(Stream& stream, T& layers) {
  stream(layers.meshes, layers.lit, layers.dark);
}

std::string layerAddress(const Image& layer, Cache& cache) {
  KeyBuilder key("layer");
  key.add("width", layer.width).add("height", layer.height).add("rgb", layer.rgb);
  return cache.remember(key.key(), [&] { return webPicture(layer, fineQuality); });
}

/// A mask of a file. It is kept, since the layers of many pictures are made anew after one of them
/// has changed.
Mask maskOfFile(const fs::path& path, Cache& cache) {
  KeyBuilder key("mask of a picture");
  key.add("file", keyOfFile(path));
  return cache.remember(key.key(), [&] { return maskFromImage(readImage(path)); });
}

Layers splitShadings(const std::vector<Figure*>& figures, const fs::path& folder, Cache& cache) {
  std::vector<Image> shadings(figures.size());
  std::vector<Mask> masks(figures.size());
  parallelFor(0, figures.size(), [&](std::size_t i) {
    const PictureRecord& picture = *figures[i]->pictures.front();
    masks[i] = maskOfFile(folder / picture.mask, cache);
    shadings[i] = readImage(folder / picture.path);
  });
  LayerBuilder builder;
  Layers layers;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    layers.meshes.push_back(builder.add(shadings[i], masks[i]));
  }
  const std::vector<PictureLayers> split = builder.layers();
  layers.lit.resize(split.size());
  layers.dark.resize(split.size());
  parallelFor(0, 2 * split.size(), [&](std::size_t i) {
    const std::size_t mesh = i / 2;
    const bool isLit = i % 2 == 0;
    (isLit ? layers.lit : layers.dark)[mesh] =
        layerAddress(isLit ? split[mesh].lit : split[mesh].dark, cache);
  });
  return layers;
}

/// Splits the figures' shadings into layers, and embeds these and the truth's mask.
std::string embeddedLayers(std::vector<Figure>& figures, const fs::path& folder, Cache& cache) {
  const std::vector<Figure*> layered = layeredFigures(figures);
  KeyBuilder key("layers");
  for (const Figure* figure : layered) {
    key.add("shading", keyOfFile(folder / figure->pictures.front()->path));
    key.add("mask", keyOfFile(folder / figure->pictures.front()->mask));
  }
  const Layers layers =
      cache.remember(key.key(), [&] { return splitShadings(layered, folder, cache); });
  std::string html;
  for (std::size_t i = 0; i < layered.size(); ++i) {
    Figure& figure = *layered[i];
    figure.mesh = layers.meshes.at(i);
    if (figure.method == truthMethod) {
      html += layerHtml("truth", *figure.mesh, pngAddress(folder / figure.pictures.front()->mask));
    }
  }
  for (std::size_t i = 0; i < layers.lit.size(); ++i) {
    html += layerHtml("lit", i, layers.lit[i]) + layerHtml("dark", i, layers.dark[i]);
  }
  return html.empty() ? "" : "<div class=\"layers\" hidden>\n" + html + "</div>\n";
}

/// Embeds the layers that they are composed of, and the figures' pictures, each for its own figure.
/// All take long to compress, and none needs another.
/// @return the layers
std::string embedPictures(std::vector<Figure>& figures, const PanelRecord& panel,
                          const fs::path& folder, Cache& cache) {
  std::vector<const PictureRecord*> pictures;
  for (const Figure& figure : figures) {
    pictures.insert(pictures.end(), figure.pictures.begin(), figure.pictures.end());
  }
  std::string layers;
  std::vector<std::string> embedded(pictures.size());
  // The layers first: they take the longest.
  parallelFor(0, pictures.size() + 1, [&](std::size_t i) {
    if (i == 0) {
      layers = embeddedLayers(figures, folder, cache);
    } else {
      embedded[i - 1] = pictureHtml(*pictures[i - 1], panel, folder, cache);
    }
  });
  std::size_t next = 0;
  for (Figure& figure : figures) {
    for (std::size_t i = 0; i < figure.pictures.size(); ++i) figure.html += embedded[next++];
  }
  return layers;
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
                         const fs::path& folder, Cache& cache) {
  std::vector<Figure> figures = figuresOf(panel);
  const std::string layers = embedPictures(figures, panel, folder, cache);
  std::string html = fmt::format(
      "<div class=\"panel\" data-title=\"{} · {}\" data-width=\"{}\" data-height=\"{}\">\n",
      escapeHtml(panel.view), escapeHtml(panel.light), panel.width, panel.height);
  for (std::size_t i = 0; i < figures.size(); ++i) {
    html += figureHtml(record, panel, figures[i], i);
  }
  const bool signedOnes = std::any_of(figures.begin(), figures.end(), [](const Figure& figure) {
    return has(figure, PictureRecord::Kind::difference);
  });
  return html + layers + "</div>\n" + (signedOnes ? differenceLegend() : "");
}

std::string differenceProperties() {
  return fmt::format(
      ":root{{--false-shadow:{};--false-light:{};--both-lit:{};--both-shadowed:{}}}\n",
      cssColour(DifferenceColours::falseShadow), cssColour(DifferenceColours::falseLight),
      cssColour(DifferenceColours::bothLit), cssColour(DifferenceColours::bothShadowed));
}

}  // namespace gnomon
