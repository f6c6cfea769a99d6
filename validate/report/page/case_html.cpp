#include "report/page/case_html.h"

#include <fmt/core.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <system_error>

#include "common/lists.h"
#include "report/page/html_figures.h"
#include "report/page/html_page.h"
#include "report/tables/case_tables.h"
#include "report/tables/formats/html_format.h"
#include "report/text/glossary.h"
#include "report/text/number_text.h"
#include "report/text/ranking_text.h"
#include "study/judge/ranking.h"
#include "study/spec/sections/study_files.h"

namespace gnomon::report {
namespace {

constexpr std::size_t mostOpenCases = 3;
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

Html caseTables(const study::StudyRecord& record, const study::Case& which) {
  Html content;
  const Table metrics = caseTable(record, std::array{which});
  if (!metrics.rows.empty()) {
    content += html("<h3>All samples</h3>\n{}{}",
                    htmlNote(fmt::format("In percent of {}. Compared with the best: {}.",
                                         errorWhole(study::isSoft(record)), signMeaning)),
                    htmlTable(metrics));
  }
  const Table regions = regionTable(record, which);
  if (!regions.rows.empty()) {
    content += html("<h3>Error by region</h3>\n{}{}",
                    html("<p class=\"note\">Percent of {} of each {}; the stronger the "
                         "tint, the larger the error.</p>\n",
                         errorWhole(study::isSoft(record)), htmlTerm("region")),
                    htmlTable(regions));
  }
  return content;
}

/// Its pictures and tables.
Html caseContent(const study::StudyRecord& record, const study::Case& which,
                 const std::filesystem::path& folder) {
  Html content;
  for (const study::PanelRecord& panel : record.panels) {
    if (study::Case{panel.view, panel.light} == which)
      content += panelFigures(record, panel, folder);
  }
  return content + caseTables(record, which);
}

/// Links to the cases: with several a reader needs them.
Html navigation(std::span<const Place> places) {
  if (places.size() < 2) return {};
  Html links;
  for (const Place& place : places) {
    links += html("<a href=\"{}\">{}</a>\n", place.link, nameOf(place));
  }
  return html("<nav aria-label=\"Cases\">\n{}</nav>\n", links);
}

Html openCases(const study::StudyRecord& record, std::span<const Place> places,
               const std::filesystem::path& folder) {
  Html content = navigation(places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const study::Case& which = places[i].which;
    content += htmlSection(fmt::format("case-{}", i + 1),
                           html("{} <span class=\"light\">{}</span>", which.view, which.light),
                           caseContent(record, which, folder));
  }
  return content;
}

/// A link to what is inside opens it.
Html foldedCases(const study::StudyRecord& record, std::span<const Place> places,
                 const std::filesystem::path& folder) {
  Html content;
  for (std::size_t i = 0; i < places.size(); ++i) {
    content += html(
        "<details class=\"case\"><summary>{}</summary>\n<div id=\"case-{}\">\n{}</div>\n"
        "</details>\n",
        nameOf(places[i]), i + 1, caseContent(record, places[i].which, folder));
  }
  return htmlSection("cases", "Pictures and tables, light by light", content);
}

Html errorsByLight(const study::StudyRecord& record, const std::vector<study::RankedMethod>& ranked,
                   std::span<const Place> places) {
  std::vector<std::string> labels;
  labels.reserve(ranked.size());
  for (const study::RankedMethod& method : ranked) labels.push_back(method.label);
  std::vector<study::Case> cases;
  std::vector<std::string> links;
  for (const Place& place : places) {
    cases.push_back(place.which);
    links.push_back(place.link);
  }
  return htmlSection(
      "heat", "Error by light",
      htmlNote(fmt::format("Percent of {}; the stronger the tint, the larger the error. Each light "
                           "leads to its pictures and tables.",
                           errorWhole(study::isSoft(record)))) +
          htmlTable(caseErrorsTable(record, labels, cases, links)));
}

Html stepLink(const Place* place, std::string_view text) {
  // All are in one folder.
  constexpr std::size_t folderLength = std::string_view("cases/").size();
  if (place == nullptr) return {};
  return html("<a href=\"{}\">{}: {}</a>\n", place->link.substr(folderLength), text,
              nameOf(*place));
}

Html casePage(const study::StudyRecord& record, std::span<const Place> places, std::size_t index,
              const std::filesystem::path& folder) {
  const Place& place = places[index];
  const Html steps = html(
      "<nav aria-label=\"Cases\">\n<a href=\"../report.html\">The whole report</a>\n{}{}</nav>\n",
      stepLink(index > 0 ? &places[index - 1] : nullptr, "Before"),
      stepLink(index + 1 < places.size() ? &places[index + 1] : nullptr, "Next"));
  const bool hasPictures = !record.panels.empty();
  return htmlPage(
      nameOf(place) + " – " + record.heading(),
      html("<h1>{}</h1>\n<p class=\"lead\">{}</p>\n", record.heading(), nameOf(place)),
      steps + (hasPictures ? viewerMarkup() : Html()) +
          htmlSection("case", "Pictures and tables", caseContent(record, place.which, folder)),
      hasPictures ? viewerScript() : Html());
}

}  // namespace

bool holdsPictures(const study::StudyRecord& record, const std::filesystem::path& folder) {
  return !record.panels.empty() && !placesOf(record, folder).areOwnPages;
}

Html caseSections(const study::StudyRecord& record, const std::vector<study::RankedMethod>& ranked,
                  const std::filesystem::path& folder) {
  const Places places = placesOf(record, folder);
  const bool areOpen = places.all.size() <= mostOpenCases && !places.areOwnPages;
  if (areOpen) return openCases(record, places.all, folder);
  const Html errors = errorsByLight(record, ranked, places.all);
  return places.areOwnPages ? errors : errors + foldedCases(record, places.all, folder);
}

std::vector<CasePage> casePages(const study::StudyRecord& record,
                                const std::filesystem::path& folder) {
  const Places places = placesOf(record, folder);
  std::vector<CasePage> pages;
  if (!places.areOwnPages) return pages;
  pages.reserve(places.all.size());
  for (std::size_t i = 0; i < places.all.size(); ++i) {
    pages.push_back({places.all[i].link, casePage(record, places.all, i, folder)});
  }
  return pages;
}

}  // namespace gnomon::report
