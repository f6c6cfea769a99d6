#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "image/images.h"
#include "report/page/case_html.h"
#include "report/page/html_page.h"
#include "report/page/report_html.h"
#include "report/sample_record.h"
#include "report/terminal_report.h"
#include "support/lines.h"

namespace gnomon::report {
namespace {

namespace fs = std::filesystem;
using test::sampleRecord;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A record whose only panel shows these methods; "control" is bump mapping alone, and the best.
study::StudyRecord recordWith(const std::vector<std::string>& shown) {
  study::StudyRecord record = test::sampleRecord(1);
  record.methods.push_back({"control", "unshadowed", "", ""});
  record.results.push_back(
      test::result("control", "elevation 15°", "camera", "all", test::countsOf(1000, 1, 0)));
  record.claims = {{"Never judged", "", study::Verdict::notEvaluated, ""},
                   {"Closer than none", "", study::Verdict::held, "ratio 0.5"},
                   {"Closer", "", study::Verdict::held, "ratio 0.12"}};
  record.claims[1].methods = {"rough, \"old\"", "control"};
  record.claims[2].methods = {"close", "rough, \"old\""};
  study::PanelRecord panel{"camera", "elevation 15°", 1, 1, {}};
  for (const std::string& method : shown) {
    panel.pictures.push_back(
        {study::PictureRecord::Kind::shaded, method, method, "", "", "bytes of " + method});
  }
  record.panels = {panel};
  return record;
}

std::vector<std::string> figuresOf(const study::StudyRecord& record) {
  std::vector<std::string> texts;
  for (const OpeningFigure& figure : openingFigures(record, study::rankMethods(record))) {
    texts.push_back(figure.role + ": " + figure.method);
  }
  return texts;
}

TEST(Opening, ShowsFlatClaimedBestAndTruth) {
  EXPECT_THAT(figuresOf(recordWith({"control", "best", "close", "rough, \"old\"", "truth"})),
              ElementsAre("flat: rough, \"old\"", "claimed: close", "best: best", "truth: truth"));
}

TEST(Opening, ShowsFewerWhereAStudyHasNoSuch) {
  EXPECT_THAT(figuresOf(recordWith({"close", "truth"})),
              ElementsAre("claimed: close", "truth: truth"));
  study::StudyRecord record = recordWith({"best", "close", "truth"});
  record.claims.back().methods = {"best"};
  EXPECT_THAT(figuresOf(record), ElementsAre("claimed and best: best", "truth: truth"));
  record.claims.clear();
  EXPECT_THAT(figuresOf(record), ElementsAre("best: best", "truth: truth"));
  EXPECT_THAT(figuresOf(test::sampleRecord()), IsEmpty());
}

/// Columns of a line whose only characters are narrow or CJK: counted from the lead bytes.
std::size_t columnsOf(const std::string& line) {
  std::size_t columns = 0;
  for (const char c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0) == 0x80) continue;              // continues a character
    columns += byte >= 0xE3 && byte <= 0xE9 ? 2 : 1;  // U+3000 to U+9FFF are wide
  }
  return columns;
}

void expectFits(const std::string& text) {
  for (const std::string& line : test::linesOf(text)) {
    EXPECT_LE(columnsOf(line), 100U) << line;
  }
}

std::string lineWith(const std::string& text, const std::string& part) {
  for (const std::string& line : test::linesOf(text)) {
    if (line.find(part) != std::string::npos) return line;
  }
  return "(no line with " + part + ")";
}

TEST(TerminalReport, ShowsWhatTheRecordHolds) {
  const std::string text = terminalReport(sampleRecord(), false);
  EXPECT_NE(text.find("camera · elevation 15° (truth ± 0.20)"), std::string::npos) << text;
  EXPECT_NE(text.find("camera · elevation 30° (truth ± 0.40)"), std::string::npos);
  EXPECT_EQ(lineWith(text, "rough"),
            "  rough, \"old\"  10.00  12.00          8.00         2.00  69.70   9.33    1.80");
  EXPECT_EQ(lineWith(text, "  best"),
            "  best           1.00   3.00          0.50         0.50  96.08   1.33    1.05");
}

TEST(TerminalReport, ManyLightsMakeOneBlockAView) {
  const std::string few = terminalReport(sampleRecord(3), false);
  const std::string many = terminalReport(sampleRecord(4), false);
  EXPECT_NE(few.find("camera · elevation 45° (truth ± 0.40)"), std::string::npos) << few;
  EXPECT_NE(many.find("camera · 4 lights (truth ± 0.40 at most)"), std::string::npos) << many;
  EXPECT_EQ(many.find("camera · elevation"), std::string::npos);
  EXPECT_NE(lineWith(many, "elevation 60°").find("rough"), std::string::npos);
  expectFits(few);
  expectFits(many);
}

TEST(TerminalReport, FitsWhateverTheLabels) {
  for (const int lights : {1, 3, 5}) {
    study::StudyRecord record = sampleRecord(lights);
    std::string label = "影の長さ";
    while (label.size() < 300) label += " 影 and a very long label";
    record.title = record.source = label;
    for (study::ResultRecord& result : record.results) {
      if (result.method == "best") result.method = label;
      result.light += label;
      result.view = label;
    }
    record.claims[0].text = record.claims[0].detail = label + std::string(150, 'x');
    record.judgements[1].gate.method = label;
    expectFits(terminalReport(record, false));
  }
}

TEST(TerminalReport, ColumnsStayAlignedUnderWideLabels) {
  study::StudyRecord record = sampleRecord(1);
  for (study::ResultRecord& result : record.results) {
    if (result.method == "best") result.method = "影の長さ";
  }
  record.truth.flips[0].flipRate = 0;  // no mark at the line's end
  const std::string text = terminalReport(record, false);
  EXPECT_EQ(columnsOf(lineWith(text, "影の")), columnsOf(lineWith(text, "close")));
  EXPECT_EQ(columnsOf(lineWith(text, "影の")), columnsOf(lineWith(text, "IoU  ")));
}

TEST(TerminalReport, ColoursOnlyWhenAsked) {
  EXPECT_EQ(terminalReport(sampleRecord(), false).find('\x1b'), std::string::npos);
  std::string coloured = terminalReport(sampleRecord(), true);
  EXPECT_NE(coloured.find("\x1b[32mheld"), std::string::npos);
  // Without its escape sequences it is the plain table.
  for (std::size_t at = 0; (at = coloured.find('\x1b', at)) != std::string::npos;) {
    coloured.erase(at, coloured.find('m', at) - at + 1);
  }
  EXPECT_EQ(coloured, terminalReport(sampleRecord(), false));
}

TEST(TerminalReport, SmallRecordsDoNotStopIt) {
  EXPECT_EQ(terminalReport(study::StudyRecord{}, false), "");
  study::StudyRecord record = sampleRecord();
  record.results.clear();
  EXPECT_NE(terminalReport(record, false).find("Claims"), std::string::npos);
}

TEST(TerminalReport, RefusesCountsThatAreNotFinite) {
  study::StudyRecord record = sampleRecord();
  record.results[0].counts.falsePositive = std::numeric_limits<double>::infinity();
  EXPECT_THROW(terminalReport(record, false), InternalError);
}

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
  EXPECT_EQ(count(html, "<script>" + pageScript().text() + "</script>"), 1U);
  EXPECT_TRUE(holds(html, "script-src " + pageScriptHash().text()));
  EXPECT_TRUE(holds(html, "class=\"viewer\""));
  EXPECT_FALSE(holds(reportText(sampleRecord(), folder_), "class=\"viewer\""))
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
  EXPECT_TRUE(holds(section, "<b>best</b> 1\u202f203 of 4\u202f096 pixels wrong"));
  EXPECT_TRUE(holds(section, "at 3, 5"));
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
       {"table",  "thead",      "tbody",  "tr",      "td",      "section",  "figure",
        "div",    "figcaption", "ul",     "li",      "dl",      "dt",       "dd",
        "span",   "small",      "b",      "p",       "main",    "header",   "style",
        "pre",    "code",       "i",      "svg",     "select",  "fieldset", "label",
        "button", "kbd",        "script", "details", "summary", "nav",      "h3"}) {
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
  record.reproduction.inputs = {{study::InputRecord::Kind::study, "a.toml", "00"}};
  const std::string html = reportText(record, folder_);
  const std::vector<std::string> plain = {"best",
                                          "close",
                                          "rough, &quot;old&quot;",
                                          "View and light",
                                          "Method",
                                          "View",
                                          "Light",
                                          "Metric",
                                          "Value",
                                          "Limit",
                                          "Stage",
                                          "Seconds",
                                          "Kind",
                                          "File",
                                          "<span class=\"unseen\">rank</span>",
                                          "<span class=\"unseen\">verdict</span>"};
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
  EXPECT_EQ(count(html, "<details class=\"case\""), 5U);
  EXPECT_EQ(count(html, "<details class=\"case\" open>"), 1U);
  EXPECT_EQ(count(html, "<a href=\"#case-5\">camera · elevation 75°</a>"), 1U);
  EXPECT_EQ(count(html, "<div id=\"case-5\">"), 1U);
  const std::string heat = html.substr(html.find("<section id=\"heat\">"));
  EXPECT_LT(heat.find("n heat\" style=\"--heat:1.000\""), heat.find("</section>"));
  EXPECT_TRUE(holds(heat.substr(0, heat.find("</section>")), ">10.00</td>"));
  EXPECT_FALSE(holds(reportText(sampleRecord(1), folder_), "<details class=\"case\""));
  EXPECT_TRUE(casePages(record, folder_).empty());
}

TEST_F(ReportHtml, OfVeryManyLightsEachHasAPage) {
  const study::StudyRecord record = sampleRecord(9);
  const std::string html = reportText(record, folder_);
  EXPECT_EQ(count(html, "<details class=\"case\""), 0U);
  const std::vector<CasePage> pages = casePages(record, folder_);
  ASSERT_EQ(pages.size(), 9U);
  for (std::size_t i = 0; i < pages.size(); ++i) {
    EXPECT_EQ(count(html, "<a href=\"" + pages[i].file + "\">"), 1U) << pages[i].file;
    const std::string page = pages[i].page.text();
    EXPECT_TRUE(holds(page, "<a href=\"../report.html\">"));
    EXPECT_EQ(holds(page, ">Before: camera"), i > 0);
    EXPECT_EQ(holds(page, ">Next: camera"), i < 8);
    const std::string table = page.substr(page.find("id=\"metrics\""));
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
  EXPECT_FALSE(holds(html, "class=\"viewer\""));
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
