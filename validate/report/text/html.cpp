#include "report/text/html.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "common/error.h"
#include "image/images.h"
#include "report/tables/confidence.h"
#include "report/terminal_page.h"

namespace gnomon::report {

Html escapeHtml(std::string_view text) {
  const std::string clean = xmlText(text);
  std::string html;
  html.reserve(clean.size());
  for (const char c : clean) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += c;
    }
  }
  return Html(std::move(html));
}

Html htmlLiteral(HtmlLiteral literal) {
  return Html(std::string(literal.text()));
}

Html pictureAddress(std::string_view type, const std::string& bytes) {
  return Html(image::dataAddress(type, bytes));
}

namespace {

constexpr auto terms = std::to_array<Term>({
    {"truth",
     "The right answer: rays traced toward the light over a very fine mesh of the surface with its "
     "bumps as real geometry."},
    {"sample",
     "A point of the surface at which every method and the truth are asked whether it is lit: one "
     "a pixel in a camera view, a regular grid over the surface in an atlas view."},
    {"case", "One view under one light."},
    {"wrong",
     "A sample is wrong where the method's picture is dark and the truth is lit, or the picture is "
     "lit and the truth is dark."},
    {"control",
     "A method that must score badly, as bump mapping without any shadows. If it does not, the "
     "measurement is worthless."},
    {"flat horizon map",
     "The table method of Max (1988) and Forsyth (2003), max-forsyth: for each texel and compass "
     "direction it stores how high the bumps around rise, as if the surface were flat."},
    {"Error", "The share of wrong samples, of all samples. 0 is perfect."},
    {"false shadow", "The samples that the method draws dark although the light reaches them."},
    {"false light", "The samples that the method draws lit although they are in shadow."},
    {"Test",
     "The error of the method's shadow test alone. The picture is also shaded, which darkens what "
     "faces away from the light and so hides some mistakes of the test."},
    {"drawn", "The answer that a method's picture shows: its shadow test together with shading."},
    {"95 %", intervalMeaning},
    {"not distinguishable",
     "Marked ≈: the two errors may differ by chance alone. The interval of their difference "
     "contains 0, or the difference is no larger than the truth's own uncertainty."},
    {"equal", "Marked =: both methods give the same answer at every sample."},
    {"no interval",
     "Marked ?: the difference of the two errors has no interval, so that nothing can be said. The "
     "reason stands below the table."},
    {"uncertainty of the truth",
     "Marked ±: the share of samples whose answer changes when the truth is traced again at half "
     "its resolution. Smaller differences mean nothing."},
    {"IoU",
     "Intersection over union of the shadows: the samples dark in both, divided by those dark in "
     "either. 100 % is perfect."},
    {"F1",
     "Another measure of how far both shadows overlap: twice the samples dark in both, divided by "
     "the dark samples of the one plus those of the other. 100 % is perfect."},
    {"BER",
     "Balanced error rate: the mean of the error among lit samples and the error among shadowed "
     "samples, so that neither outweighs the other."},
    {"MCC",
     "Matthews correlation between the two answers: 1 where they agree everywhere, 0 for guessing, "
     "−1 where they are opposite."},
    {"Length",
     "The length of the method's cast shadows divided by the truth's: 1.10 is 10 % too long. The "
     "median over all shadows that can be measured."},
    {"To best", "The method's error less that of the best method."},
    {"region",
     "The samples that are lit, or dark, for the same reason. Each sample is in one of the "
     "regions; seam and the parts of a surface overlap them."},
    {"all", "All samples, whatever their region."},
    {"lit", "The region of samples that the light reaches."},
    {"attached", "The region of samples on a slope that faces away from the light."},
    {"cast",
     "The region of samples in the shadow of something within the search radius: the ordinary "
     "shadow of a bump."},
    {"distant",
     "The region of samples shadowed only by something beyond the search radius, which no table "
     "knows of."},
    {"global",
     "The region of samples shadowed by another part of the body, which no method that searches "
     "the bump map alone can know of."},
    {"beyond-terminator",
     "The region where the surface without its bumps faces away from the light, so that only bumps "
     "could catch it."},
    {"seam",
     "Samples whose way to the light crosses a border where the texture does not continue."},
    {"search radius",
     "How far from a sample, in texels of the map, tables and marches look for what may shadow "
     "it."},
    {"umbra", "Where no part of a light with a disc, as the sun, is seen."},
    {"penumbra", "The soft rim of a shadow, where a part of the light's disc is seen."},
    {"visibility",
     "V, the share of the light's disc that a sample sees: 0 in umbra, 1 in full "
     "light. Errors are then mean differences of V."},
    {"threshold", "A limit that the study's author set; a run that exceeds it fails."},
    {"reference",
     "A value committed earlier; a check fails where a run is worse by more than a "
     "tolerance."},
    {"Triangles", "Those that the method draws in a frame, each mesh once."},
    {"Memory", "Of the tables and of the height map, where the method reads it while it draws."},
    {"Tables", "Memory of the tables and textures that the method makes."},
    {"Height map", "Memory of the bump map itself, where the method reads it while it draws."},
    {"Texels read",
     "How many texels of tables, maps and textures the method reads to answer for one sample, on "
     "average: a measure of its cost that is the same on every machine."},
    {"Passes", "How often a frame is drawn over before it is finished."},
    {"Frame", "The median time that one frame takes."},
    {"Light still",
     "The time of a frame while the light does not move, so that what depends on "
     "the light alone is kept."},
    {"To max-forsyth", "The time of a frame divided by that of the flat horizon map."},
    {"Cause", "An approximation of the method that is corrected in this step."},
    {"Forward", "The error that is gone when causes are corrected from the first to the last."},
    {"Backward", "The same, corrected from the last to the first."},
    {"Samples that change",
     "The uncertainty of the truth: the share of samples that change at half "
     "its resolution."},
    {"Micro-triangles", "The triangles of the truth's mesh."},
    {"Step", "The longest side of the truth's triangles along the map."},
    {"Worst 5 %", "The mean over the twentieth of the scenes on which the method is worst."},
    {"SHA-256", "A check sum: two files with the same one hold the same bytes."},
});

/// Other spellings of a term, in headings.
struct Spelling {
  std::string_view written, name;
};

constexpr auto spellings = std::to_array<Spelling>({{"error_rate", "Error"},
                                                    {"samples", "sample"},
                                                    {"False shadow", "false shadow"},
                                                    {"False light", "false light"},
                                                    {"≈", "not distinguishable"},
                                                    {"=", "equal"},
                                                    {"?", "no interval"},
                                                    {"±", "uncertainty of the truth"},
                                                    {"Truth ±", "uncertainty of the truth"},
                                                    {"Region", "region"},
                                                    {"Cases", "case"},
                                                    {"Case", "case"},
                                                    {"Search radius", "search radius"}});

}  // namespace

std::span<const Term> glossary() {
  return terms;
}

std::optional<std::size_t> findTerm(std::string_view name) {
  for (const Spelling& other : spellings) {
    if (other.written == name) name = other.name;
  }
  const auto found =
      std::find_if(terms.begin(), terms.end(), [&](const Term& term) { return term.name == name; });
  if (found == terms.end()) return std::nullopt;
  return static_cast<std::size_t>(found - terms.begin());
}

namespace {

Html termButton(std::size_t place, std::string_view text) {
  return html(
      "<button type=\"button\" class=\"term\" popovertarget=\"term-{}\" title=\"{}\">{}"
      "</button>",
      place, glossary()[place].meaning, text);
}

}  // namespace

Html htmlTerm(std::string_view name, std::string_view text) {
  const auto place = findTerm(name);
  if (!place) throw InternalError(fmt::format("{}: not in the glossary", name));
  return termButton(*place, text.empty() ? name : text);
}

Html htmlHeading(std::string_view text) {
  const auto place = findTerm(text);
  return place ? termButton(*place, text) : escapeHtml(text);
}

Html htmlGlossary(const Html& page) {
  Html entries;
  std::size_t count = 0;
  for (std::size_t place = 0; place < glossary().size(); ++place) {
    const std::string link = fmt::format("popovertarget=\"term-{}\"", place);
    if (page.text().find(link) == std::string::npos) continue;
    const Term& term = glossary()[place];
    ++count;
    // Outside of any fold, or it could not open.
    entries += html("<div popover id=\"term-{}\"><dt>{}</dt><dd>{}</dd></div>\n", place, term.name,
                    term.meaning);
  }
  if (entries.empty()) return {};
  return html(
      "<details class=\"index\"><summary>All {} words</summary></details>\n<dl class=\"terms\">\n"
      "{}</dl>\n",
      count, entries);
}

}  // namespace gnomon::report
