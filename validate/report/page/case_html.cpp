#include "report/page/case_html.h"

#include <fmt/core.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <system_error>

#include "common/lists.h"
#include "report/page/picture_html.h"
#include "report/tables/case_tables.h"
#include "report/tables/formats/html_format.h"
#include "report/text/glossary.h"
#include "report/text/number_text.h"
#include "study/judge/study_means.h"
#include "study/spec/sections/study_paths.h"

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

}  // namespace gnomon::report
