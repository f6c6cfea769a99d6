#include "report/page/case_html.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <span>
#include <system_error>

#include "common/lists.h"
#include "image/image_file.h"
#include "image/images.h"
#include "report/page/html_page.h"
#include "report/page/picture_html.h"
#include "report/plots/line_plot.h"
#include "report/tables/case_tables.h"
#include "report/text/html.h"
#include "report/text/number_text.h"
#include "study/judge/ranking.h"
#include "study/record/cases.h"
#include "study/run/stages/truth_pictures.h"
#include "study/spec/sections/study_files.h"

namespace gnomon::report {
namespace {

constexpr std::size_t mostFoldedCases = 8;
constexpr std::size_t mostPictureBytes = 7'500'000;  // a third more as text of a page

/// The bytes of a file; 0 where it cannot be read, which its reader tells.
std::size_t fileSize(const std::filesystem::path& path) {
  std::error_code failure;
  const std::uintmax_t bytes = std::filesystem::file_size(path, failure);
  return failure ? 0 : bytes;
}

/// The bytes of all pictures that pages embed.
std::size_t pictureBytes(const study::StudyRecord& record, const std::filesystem::path& folder) {
  std::size_t bytes = 0;
  for (const study::PanelRecord& panel : record.panels) {
    for (const study::LayersRecord& layers : panel.layers) {
      bytes += layers.lit.size() + layers.dark.size();
    }
    for (const study::PictureRecord& picture : panel.pictures) {
      bytes += picture.embedded.empty() ? fileSize(folder / picture.path) : picture.embedded.size();
    }
  }
  return bytes;
}

/// Whether each case has a page of its own.
bool haveOwnPages(const study::StudyRecord& record, std::size_t cases,
                  const std::filesystem::path& folder) {
  return cases > mostFoldedCases || pictureBytes(record, folder) > mostPictureBytes;
}

/// A case, and where a page finds it.
struct Place {
  study::Case which;
  std::string link;
};

std::string nameOf(const Place& place) {
  return place.which.view + " · " + place.which.light;
}

struct Places {
  std::vector<Place> all;
  bool areOwnPages = false;
};

Places placesOf(const study::StudyRecord& record, const std::filesystem::path& folder) {
  std::vector<study::Case> cases = study::casesOf(record);
  for (const study::PanelRecord& panel : record.panels) {
    appendOnce(cases, study::Case{panel.view, panel.light});
  }
  std::vector<std::string> names;
  names.reserve(cases.size());
  for (const study::Case& which : cases) names.push_back(which.view + "_" + which.light);
  const std::vector<std::string> files = study::fileNames(names);
  Places places;
  places.areOwnPages = haveOwnPages(record, cases.size(), folder);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    places.all.push_back({cases[i], places.areOwnPages ? fmt::format("cases/{}.html", files[i])
                                                       : fmt::format("#case-{}", i + 1)});
  }
  return places;
}

/// What a page has of a case.
struct CaseParts {
  Html pictures, metrics, regions;
};

CaseParts partsOf(const study::StudyRecord& record, const study::Case& which,
                  const ShownMethods& shown, const std::filesystem::path& folder) {
  CaseParts parts;
  for (const study::PanelRecord& panel : record.panels) {
    if (study::Case{panel.view, panel.light} == which)
      parts.pictures += panelFigures(record, panel, shown, folder);
  }
  const char* whole = errorWhole(study::isSoft(record));
  if (const Table metrics = caseTable(record, std::array{which}); !metrics.rows.empty()) {
    parts.metrics = html("<p class=\"note\">In percent of {}.</p>\n{}", whole, htmlTable(metrics));
  }
  if (const Table regions = regionTable(record, which); !regions.rows.empty()) {
    parts.regions = html(
        "<p class=\"note\">Percent of {} of each {}; the stronger the tint, the larger the "
        "error.</p>\n{}",
        whole, htmlTerm("region"), htmlTable(regions));
  }
  return parts;
}

constexpr std::string_view metricsTitle = "Every metric, of all samples";
constexpr std::string_view regionsTitle = "Error by region";

/// The pictures, and below them the tables, folded.
Html caseContent(const study::StudyRecord& record, const study::Case& which,
                 const ShownMethods& shown, const std::filesystem::path& folder) {
  const CaseParts parts = partsOf(record, which, shown, folder);
  return parts.pictures + htmlFold(regionsTitle, parts.regions) +
         htmlFold(metricsTitle, parts.metrics);
}

/// A link to what is inside opens it.
PageSection foldedCases(const study::StudyRecord& record, std::span<const Place> places,
                        const std::filesystem::path& folder) {
  const ShownMethods shown = shownMethods(record);
  Html content;
  for (std::size_t i = 0; i < places.size(); ++i) {
    content += html(
        "<details class=\"case\"{}><summary><h3>{}</h3></summary>\n<div id=\"case-{}\">\n{}</div>\n"
        "</details>\n",
        i == 0 ? html(" open") : Html(), nameOf(places[i]), i + 1,
        caseContent(record, places[i].which, shown, folder));
  }
  return {"cases", "What each method draws", content};
}

PageSection errorsByLight(const study::StudyRecord& record,
                          const std::vector<study::RankedMethod>& ranked,
                          std::span<const Place> places) {
  std::vector<study::Case> cases;
  std::vector<std::string> links;
  for (const Place& place : places) {
    cases.push_back(place.which);
    links.push_back(place.link);
  }
  const auto tableOf = [&](const std::vector<std::string>& labels) {
    return htmlTable(caseErrorsTable(record, labels, cases, links));
  };
  std::vector<std::string> labels;
  labels.reserve(ranked.size());
  for (const study::RankedMethod& method : ranked) labels.push_back(method.label);
  constexpr std::size_t mostColumns = 12;
  const bool areMany = labels.size() > mostColumns;
  return {"heat", "Under which light each method is wrong",
          htmlNote(fmt::format("Percent of {}; the stronger the tint, the larger the error. Each "
                               "light leads to its pictures and tables.",
                               errorWhole(study::isSoft(record)))) +
              tableOf(areMany ? shownMethods(record).labels : labels) +
              (areMany ? htmlFold("Every method", tableOf(labels)) : Html())};
}

Html stepLink(const Place* place, std::string_view text) {
  // All are in one folder.
  constexpr std::size_t folderLength = std::string_view("cases/").size();
  if (place == nullptr) return {};
  return html("<a href=\"{}\">{}: {}</a>\n", place->link.substr(folderLength), text,
              nameOf(*place));
}

Html casePage(const study::StudyRecord& record, std::span<const Place> places, std::size_t index,
              const ShownMethods& shown, const std::filesystem::path& folder) {
  const Place& place = places[index];
  CaseParts parts = partsOf(record, place.which, shown, folder);
  const Html steps = html(
      "<nav aria-label=\"Cases\">\n<a href=\"../report.html\">The whole report</a>\n{}{}</nav>\n",
      stepLink(index > 0 ? &places[index - 1] : nullptr, "Before"),
      stepLink(index + 1 < places.size() ? &places[index + 1] : nullptr, "Next"));
  const PageSection viewer = record.panels.empty() ? PageSection{} : viewerSection();
  return htmlPage(
      nameOf(place) + " – " + record.heading(),
      html("<h1>{}</h1>\n<p class=\"lead\">{}</p>\n{}", record.heading(), nameOf(place), steps),
      {viewer,
       {"case", "What each method draws", std::move(parts.pictures)},
       {"regions", std::string(regionsTitle), std::move(parts.regions)},
       {"metrics", std::string(metricsTitle), std::move(parts.metrics)}});
}

}  // namespace

bool holdsPictures(const study::StudyRecord& record, const std::filesystem::path& folder) {
  return !record.panels.empty() && !placesOf(record, folder).areOwnPages;
}

std::vector<PageSection> caseSections(const study::StudyRecord& record,
                                      const std::vector<study::RankedMethod>& ranked,
                                      const std::filesystem::path& folder) {
  const Places places = placesOf(record, folder);
  if (places.all.size() == 1 && !places.areOwnPages) {
    const Place& only = places.all.front();
    return {{"case-1", "What each method draws",
             caseContent(record, only.which, shownMethods(record), folder),
             escapeHtml(nameOf(only))}};
  }
  if (places.all.empty()) return {};
  std::vector<PageSection> sections = {errorsByLight(record, ranked, places.all)};
  if (!places.areOwnPages) sections.push_back(foldedCases(record, places.all, folder));
  return sections;
}

std::vector<CasePage> casePages(const study::StudyRecord& record,
                                const std::filesystem::path& folder) {
  const Places places = placesOf(record, folder);
  std::vector<CasePage> pages;
  if (!places.areOwnPages) return pages;
  pages.reserve(places.all.size());
  const ShownMethods shown = shownMethods(record);
  for (std::size_t i = 0; i < places.all.size(); ++i) {
    pages.push_back({places.all[i].link, casePage(record, places.all, i, shown, folder)});
  }
  return pages;
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
