#include "report/page/report_html.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "image/images.h"
#include "report/page/case_html.h"
#include "report/page/page.h"
#include "report/sample_record.h"

namespace gnomon::report {
namespace {

namespace fs = std::filesystem;
using test::sampleRecord;
using ::testing::ElementsAre;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A decoder written from RFC 4648, bit by bit.
std::string fromBase64(const std::string& text) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : text.substr(0, text.find('='))) {
    bits = (bits << 6) | static_cast<unsigned>(alphabet.find(c));
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>((bits >> held) & 0xFF);
  }
  return bytes;
}

std::string reportText(const study::StudyRecord& record, const fs::path& folder) {
  return reportHtml(record, folder).text();
}

class ReportHtml : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("gnomon-" + std::string(test->name()) + std::to_string(::getpid()));
    fs::create_directories(folder_ / "images");
  }
  void TearDown() override { fs::remove_all(folder_); }

  study::PictureRecord picture(study::PictureRecord::Kind kind, const std::string& method) {
    const std::string path = "images/" + std::to_string(++pictures_) + ".png";
    const auto grey = static_cast<std::uint8_t>(pictures_);
    image::writePng(folder_ / path, image::Image{1, 1, {grey, grey, grey}});
    const std::string embedded = kind == study::PictureRecord::Kind::difference
                                     ? ""
                                     : "picture " + std::to_string(pictures_);
    return {kind, method, "Caption <" + method + ">", path, "", embedded};
  }

  study::StudyRecord recordWithPanel() {
    using Kind = study::PictureRecord::Kind;
    study::StudyRecord record = sampleRecord();
    record.panels = {
        {"camera",
         "elevation 15°",
         1,
         1,
         {picture(Kind::shaded, "rough, \"old\""), picture(Kind::shaded, "best"),
          picture(Kind::displaced, "truth"), picture(Kind::shaded, "truth"),
          picture(Kind::difference, "rough, \"old\""), picture(Kind::difference, "best")}}};
    return record;
  }

  fs::path folder_;
  int pictures_ = 0;
};

TEST_F(ReportHtml, LoadsNothing) {
  const std::string html = reportText(recordWithPanel(), folder_);
  EXPECT_FALSE(holds(html, "http://"));
  EXPECT_FALSE(holds(html, "https://"));
  EXPECT_FALSE(holds(html, "<link"));
  EXPECT_EQ(count(html, "<script"), 1U);
  EXPECT_EQ(count(html, "<script>" + viewerScript().text() + "</script>"), 1U);
  EXPECT_TRUE(holds(html, "script-src " + viewerScriptHash().text()));
  EXPECT_FALSE(holds(reportText(sampleRecord(), folder_), "<script"))
      << "without pictures there is nothing to compare";
  EXPECT_FALSE(holds(html, "@import"));
  EXPECT_FALSE(holds(html, "url("));
  EXPECT_TRUE(holds(html, "default-src 'none'"));
  EXPECT_EQ(count(html, " src=\""), count(html, " src=\"data:image/png;base64,") +
                                        count(html, " src=\"data:image/webp;base64,"));
}

/// The bytes of all embedded pictures of a type.
std::vector<std::string> embedded(const std::string& html, const std::string& type) {
  std::vector<std::string> pictures;
  const std::string opening = "src=\"data:image/" + type + ";base64,";
  for (std::size_t at = html.find(opening); at != std::string::npos; at = html.find(opening, at)) {
    at += opening.size();
    pictures.push_back(fromBase64(html.substr(at, html.find('"', at) - at)));
  }
  return pictures;
}

TEST_F(ReportHtml, EmbedsEveryDifferenceByteForByteAndAnyOtherPictureOnce) {
  const study::StudyRecord record = recordWithPanel();
  const std::string html = reportText(record, folder_);
  const auto exact = embedded(html, "png");
  EXPECT_EQ(exact.size(), 2U);
  for (const study::PictureRecord& picture : record.panels[0].pictures) {
    const bool isDifference = picture.kind == study::PictureRecord::Kind::difference;
    EXPECT_EQ(std::count(exact.begin(), exact.end(), readFile(folder_ / picture.path)),
              isDifference ? 1 : 0)
        << picture.path;
  }
  // The opening shows three of them once more: flat, best and truth.
  EXPECT_THAT(embedded(html, "webp"),
              ElementsAre("picture 1", "picture 2", "picture 4", "picture 1", "picture 2",
                          "picture 4", "picture 3"));
}

TEST_F(ReportHtml, EmbedsTheLayersOfEveryMeshAndTheTruthsMask) {
  study::StudyRecord record = recordWithPanel();
  study::PanelRecord& panel = record.panels[0];
  image::writePng(folder_ / "shadowed.png", image::maskImage(Mask{1, 1, {Shade::shadowed}}));
  panel.layers = {{"lit 0", "dark 0"}, {"lit 1", "dark 1"}};
  panel.pictures[0].layers = 0;
  panel.pictures[1].layers = 1;
  panel.pictures[3].layers = 0;
  panel.pictures[3].mask = "shadowed.png";
  const std::string html = reportText(record, folder_);
  EXPECT_EQ(count(html, "<img class=\"truth\" data-mesh=\"0\""), 1U);
  EXPECT_TRUE(holds(html,
                    "data-name=\"Caption &lt;best&gt;\" data-rate=\"error 1.00\u202f%\" "
                    "data-mesh=\"1\">"));
  EXPECT_EQ(count(html, " whole\""), 1U) << "the displaced surface";
  const auto exact = embedded(html, "png");
  EXPECT_EQ(std::count(exact.begin(), exact.end(), readFile(folder_ / "shadowed.png")), 1);
  for (const std::size_t mesh : {0U, 1U}) {
    for (const std::string kind : {"lit", "dark"}) {
      const std::string image =
          "<img class=\"" + kind + "\" data-mesh=\"" + std::to_string(mesh) + "\"";
      ASSERT_EQ(count(html, image), 1U) << image;
      EXPECT_EQ(embedded(html.substr(html.find(image)), "webp").front(),
                kind + " " + std::to_string(mesh));
    }
  }
}

TEST_F(ReportHtml, ShowsThePlacesWhereAMethodErrsMost) {
  study::StudyRecord record = recordWithPanel();
  EXPECT_EQ(count(reportText(record, folder_), "id=\"worst\""), 0U);
  record.panels[0].pictures[1].worst = {{3, 5, 64, 1203, "its answer", "what is right"}};
  const std::string html = reportText(record, folder_);
  EXPECT_EQ(count(html, "id=\"worst\""), 1U);
  const std::string section = html.substr(html.find("id=\"worst\""));
  EXPECT_TRUE(holds(section, "<h3>best <small>camera · elevation 15°</small></h3>"));
  EXPECT_TRUE(holds(section, "1\u202f203 of 4\u202f096 pixels wrong, at 3, 5"));
  const auto pictures = embedded(section, "webp");
  ASSERT_GE(pictures.size(), 2U);
  EXPECT_EQ(pictures[0], "its answer");
  EXPECT_EQ(pictures[1], "what is right");
}

TEST_F(ReportHtml, EscapesAllText) {
  study::StudyRecord record = recordWithPanel();
  const std::string evil = "<script>'\"&";
  const auto spoil = [&](std::string& text) { text = evil; };
  for (study::MethodRecord& m : record.methods) spoil(m.title), spoil(m.citation), spoil(m.name);
  for (study::ResultRecord& r : record.results) {
    spoil(r.light), spoil(r.view);
    r.method += evil;
    if (r.region != "all") r.region += evil;
  }
  for (study::CostRecord& c : record.cost) spoil(c.method);
  for (study::TimingRecord& t : record.timings) spoil(t.stage);
  for (study::Judgement& judgement : record.judgements) {
    study::Gate& gate = judgement.gate;
    spoil(gate.method), spoil(gate.light), spoil(gate.view), spoil(gate.region);
    spoil(gate.metric);
  }
  for (study::ClaimRecord& c : record.claims) spoil(c.text), spoil(c.source), spoil(c.detail);
  for (study::UncertaintyRecord& f : record.truth.flips) spoil(f.view), spoil(f.light);
  for (study::PanelRecord& p : record.panels) {
    spoil(p.view), spoil(p.light);
    for (study::PictureRecord& picture : p.pictures) spoil(picture.method), spoil(picture.caption);
  }
  study::EnvironmentRecord& e = record.environment;
  for (std::string* text : {&record.name, &record.title, &record.source, &record.file,
                            &record.command, &e.gnomonVersion, &e.commit, &e.cpu, &e.glRenderer,
                            &e.glVersion, &e.embreeVersion, &e.openSubdivVersion, &e.frameClock}) {
    spoil(*text);
  }
  const std::string html = reportText(record, folder_);
  EXPECT_EQ(count(html, "<script"), 1U) << "the page's own";
  EXPECT_FALSE(holds(html, "'\"&"));
  EXPECT_GT(count(html, "&lt;script&gt;&#39;&quot;&amp;"), 40U);
}

TEST_F(ReportHtml, TagsAreBalanced) {
  const std::string html = reportText(recordWithPanel(), folder_);
  for (const std::string tag :
       {"table",      "thead",  "tbody",    "tr",     "td",     "section", "figure", "div",
        "figcaption", "ul",     "li",       "dl",     "dt",     "dd",      "span",   "small",
        "b",          "p",      "main",     "header", "style",  "pre",     "code",   "i",
        "svg",        "select", "fieldset", "label",  "button", "kbd",     "script"}) {
    EXPECT_EQ(count(html, "<" + tag + ">") + count(html, "<" + tag + " "),
              count(html, "</" + tag + ">"))
        << tag;
  }
  EXPECT_GT(count(html, "<tr>"), 20U);
}

TEST_F(ReportHtml, LegendAndPicturesShareTheirColours) {
  const std::string html = reportText(recordWithPanel(), folder_);
  EXPECT_TRUE(holds(html, "--false-shadow:rgb(230 97 0)"));
  EXPECT_EQ(image::DifferenceColours::falseShadow, (image::Rgb{230, 97, 0}));
  EXPECT_TRUE(holds(html, "--false-light:rgb(26 133 255)"));
  EXPECT_EQ(image::DifferenceColours::falseLight, (image::Rgb{26, 133, 255}));
}

/// What stands between the ends of each such element.
std::vector<std::string> contents(const std::string& html, const std::string& opening,
                                  const std::string& closing) {
  std::vector<std::string> found;
  for (std::size_t at = html.find(opening); at != std::string::npos; at = html.find(opening, at)) {
    at = html.find('>', at) + 1;
    found.push_back(html.substr(at, html.find(closing, at) - at));
  }
  return found;
}

TEST_F(ReportHtml, EveryWordOfAHeadingIsPlainOrLeadsToItsMeaning) {
  study::StudyRecord record = recordWithPanel();
  test::addDifferences(record, 1e-6);
  record.confidence = {{"best", "camera", "all", 0.01, {}, "", 9, 4},
                       {"close", "camera", "all", 0.012, {}, "", 9, 4}};
  record.truth.wantedUncertainty = 0.01;
  record.truth.refinement = {{0.5, 1000, {}}};
  record.reproduction.inputs = {{study::InputRecord::Kind::study, "a.toml", "00"}};
  const std::string html = reportText(record, folder_);
  const std::vector<std::string> plain = {"",      "Method", "View",    "Light", "Metric", "Value",
                                          "Limit", "Stage",  "Seconds", "Kind",  "File"};
  std::size_t terms = 0;
  std::vector<std::string> headings = contents(html, "<th>", "</th>");
  for (std::string& heading : contents(html, "<th ", "</th>")) headings.push_back(heading);
  for (const std::string& heading : headings) {
    if (heading.starts_with("<button type=\"button\" class=\"term\"")) {
      ++terms;
    } else {
      EXPECT_NE(std::find(plain.begin(), plain.end(), heading), plain.end()) << heading;
    }
  }
  EXPECT_GT(terms, 20U);
  // Each leads to one entry, and no entry is without a word that leads to it.
  const std::string target = "popovertarget=\"";
  for (const std::string& entry : contents(html, "<dl class=\"terms\"", "</dl>")) {
    EXPECT_GT(count(entry, "<dt>"), 15U);
  }
  for (std::size_t at = html.find(target); at != std::string::npos; at = html.find(target, at)) {
    at += target.size();
    const std::string id = html.substr(at, html.find('"', at) - at);
    EXPECT_EQ(count(html, "<div popover id=\"" + id + "\">"), 1U) << id;
  }
  EXPECT_EQ(count(html, "<dl class=\"terms\""), 1U);
}

TEST_F(ReportHtml, ManyLightsAreATableAndFoldedAway) {
  study::StudyRecord record = sampleRecord(5);
  const std::string html = reportText(record, folder_);
  EXPECT_EQ(count(html, "<details class=\"case\">"), 5U);
  EXPECT_EQ(count(html, "<a href=\"#case-5\">camera · elevation 75°</a>"), 1U);
  EXPECT_EQ(count(html, "<div id=\"case-5\">"), 1U);
  const std::string heat = html.substr(html.find("<section id=\"heat\">"));
  EXPECT_LT(heat.find("n heat\" style=\"--heat:1.000\""), heat.find("</section>"));
  EXPECT_TRUE(holds(heat.substr(0, heat.find("</section>")), ">10.00</td>"));
  EXPECT_FALSE(holds(reportText(sampleRecord(3), folder_), "<details class=\"case\">"));
  EXPECT_TRUE(casePages(record, folder_).empty());
}

TEST_F(ReportHtml, OfVeryManyLightsEachHasAPage) {
  const study::StudyRecord record = sampleRecord(9);
  const std::string html = reportText(record, folder_);
  EXPECT_EQ(count(html, "<details class=\"case\">"), 0U);
  const std::vector<CasePage> pages = casePages(record, folder_);
  ASSERT_EQ(pages.size(), 9U);
  for (std::size_t i = 0; i < pages.size(); ++i) {
    EXPECT_EQ(count(html, "<a href=\"" + pages[i].file + "\">"), 1U) << pages[i].file;
    const std::string page = pages[i].page.text();
    EXPECT_TRUE(holds(page, "<a href=\"../report.html\">"));
    EXPECT_EQ(holds(page, ">Before: camera"), i > 0);
    EXPECT_EQ(holds(page, ">Next: camera"), i < 8);
    const std::string table = page.substr(page.find("<h3>All samples</h3>"));
    EXPECT_TRUE(holds(table, "best"));
  }
}

TEST_F(ReportHtml, OfLargePicturesEachCaseHasAPage) {
  study::StudyRecord record = recordWithPanel();
  EXPECT_TRUE(casePages(record, folder_).empty());
  record.panels[0].layers = {{std::string(7'500'000, 'x'), ""}};
  const std::vector<CasePage> pages = casePages(record, folder_);
  ASSERT_EQ(pages.size(), 2U);
  const std::string html = reportText(record, folder_);
  EXPECT_LT(html.size(), 1'000'000U);
  EXPECT_FALSE(holds(html, "<script"));
  for (const CasePage& page : pages) {
    EXPECT_EQ(count(html, "<a href=\"" + page.file + "\">"), 1U) << page.file;
  }
  EXPECT_TRUE(holds(pages[0].page.text(), "<script"));
}

TEST_F(ReportHtml, SmallRecordsDoNotStopIt) {
  EXPECT_TRUE(holds(reportText(study::StudyRecord{}, folder_), "No result has an error rate."));
  study::StudyRecord record = recordWithPanel();
  record.results.clear();
  EXPECT_TRUE(holds(reportText(record, folder_), "<figure"));
}

TEST_F(ReportHtml, RefusesWhatItCannotShow) {
  study::StudyRecord record = recordWithPanel();
  const fs::path difference = folder_ / record.panels[0].pictures[4].path;
  fs::remove(difference);
  EXPECT_THROW(reportText(record, folder_), InputError);
  writeTextAtomically(difference, "GIF89a");
  EXPECT_THROW(reportText(record, folder_), InternalError);
  record = sampleRecord();
  record.cost[0].frameMs = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(reportText(record, folder_), InternalError);
}

}  // namespace
}  // namespace gnomon::report
