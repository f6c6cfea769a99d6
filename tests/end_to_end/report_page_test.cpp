#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "end_to_end/support/report_page.h"

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST_F(ReportPage, LoadsFromDiskWithoutErrorOrRequest) {
  Browser browser(folder());
  browser.open(page());
  settle(browser);
  EXPECT_EQ(browser.complaints(), noComplaints);
  EXPECT_EQ(browser.requests(), std::vector<std::string>{"file://" + page().string()});
  EXPECT_FALSE(browser.evaluate("document.querySelector('.viewer').hidden"));
  EXPECT_EQ(browser.evaluate("[...document.images].filter((i) => !i.hasAttribute('alt')).length"),
            0);
  EXPECT_EQ(browser.evaluate("[...document.querySelectorAll('figure img')]"
                             ".filter((i) => i.alt === '').length"),
            0);
  EXPECT_EQ(browser.evaluate("[...document.images].filter((i) => !i.naturalWidth).length"), 0);

  // That the browser would have told: a page that does ask and does complain.
  write("bad.html",
        "<img src='http://127.0.0.1:9/x.png'><script>console.error('no'); nosuch()</script>");
  browser.open(file("bad.html"));
  EXPECT_GE(browser.complaints().size(), 2U);
  EXPECT_THAT(browser.requests().back(), StartsWith("http://127.0.0.1:9/"));
}

TEST_F(ReportPage, RunsNoScriptButItsOwn) {
  write("out/small/evil.html", replaced(read("out/small/report.html"), "</main>",
                                        "</main><script>window.evil=1</script>"));
  Browser browser(folder());
  browser.open(file("out/small/evil.html"));
  settle(browser);
  EXPECT_EQ(browser.evaluate("typeof window.evil"), "undefined");
  EXPECT_FALSE(browser.complaints().empty());
}

TEST_F(ReportPage, WipesBlinksAndComposesTheRunsOwnMasks) {
  Browser browser(folder());
  openAndFocus(browser, page());
  const GreyImage flat = mask("small", "camera_evening_max-forsyth");
  const GreyImage truth = mask("small", "camera_evening_truth");
  // Figures: (a) unshadowed, (b) max-forsyth, (c) shadow-map, (d) truth.
  press(browser, "b");  // from the truth on to the picture after it
  change(browser, "a", "1");
  change(browser, "b",
         "[...document.querySelector('.viewer [name=b]').options]"
         ".findIndex((o) => o.text === '(d) truth')");
  // Composed of their layers, the shadings are the run's own pictures, as far as WebP keeps them.
  change(browser, "wipe", "100");
  EXPECT_LT(meanDistance(browser, readGrey(picture("max-forsyth"))), 3);
  EXPECT_GT(meanDistance(browser, readGrey(picture("unshadowed"))), 3);
  change(browser, "wipe", "50");
  change(browser, "masks", "true");
  EXPECT_THAT(text(browser, ".tip.a"), HasSubstr("A (b) max-forsyth, error "));

  EXPECT_LT(shareUnlike(browser, flat, 0, 126), 0.001);
  EXPECT_LT(shareUnlike(browser, truth, 130, 256), 0.001);
  EXPECT_GT(shareUnlike(browser, flat, 0, 256), 0.004) << "the two masks differ on the right";
  change(browser, "wipe", "100");
  EXPECT_LT(shareUnlike(browser, flat, 0, 253), 0.001);
  change(browser, "wipe", "0");
  EXPECT_LT(shareUnlike(browser, truth, 3, 256), 0.001);
  press(browser, "]");
  EXPECT_EQ(browser.evaluate("document.querySelector('.viewer [name=wipe]').value"), "5");

  browser.moveMouse(2, 2);
  press(browser, "k");
  EXPECT_LT(shareUnlike(browser, flat, 0, 256), 0.001);
  press(browser, " ");
  EXPECT_LT(shareUnlike(browser, truth, 0, 256), 0.001);
  EXPECT_THAT(text(browser, "#viewer-status"), HasSubstr("B is shown"));
  press(browser, " ");
  EXPECT_LT(shareUnlike(browser, flat, 0, 256), 0.001);
  browser.moveMouse(600, 400);
  settle(browser);
  EXPECT_LT(shareUnlike(browser, truth, 0, 256), 0.001) << "hovering shows B";
  browser.moveMouse(2, 2);
  settle(browser);
  EXPECT_LT(shareUnlike(browser, flat, 0, 256), 0.001);

  press(browser, "x");
  EXPECT_THAT(text(browser, ".tip.a"), HasSubstr("A (d) truth"));
  EXPECT_EQ(browser.complaints(), noComplaints);
}

TEST_F(ReportPage, DifferenceIsTheErrorThatTheSummaryHas) {
  Browser browser(folder());
  openAndFocus(browser, page());
  const nlohmann::json record = summary("small");
  const auto expectShares = [&](const std::string& light, const std::string& method) {
    const nlohmann::json row = resultOf(record, method, light, "camera");
    const auto percent = [](const nlohmann::json& share) {
      std::array<char, 32> digits{};
      std::snprintf(digits.data(), digits.size(), "%.2f %%", 100 * share.get<double>());
      return std::string(digits.data());
    };
    const std::string status = text(browser, "#viewer-status");
    EXPECT_THAT(status, HasSubstr("A is dark where B is lit at " + percent(row.at("false_shadow"))))
        << method;
    EXPECT_THAT(status, HasSubstr("and lit where B is dark at " + percent(row.at("false_light"))))
        << method;
    EXPECT_GT(row.at("error_rate"), 0.001) << "there is something to see";
  };
  EXPECT_THAT(text(browser, "#viewer-status"), HasSubstr("(d) truth")) << "beside the best method";
  EXPECT_THAT(text(browser, ".tip.a"), Not(HasSubstr("unshadowed")));
  change(browser, "a", "0");
  press(browser, "d");
  expectShares("evening", "unshadowed");
  press(browser, "a");
  expectShares("evening", "max-forsyth");
  // Of another mesh: held against the truth at its own points.
  press(browser, "a");
  expectShares("evening", "shadow-map");
  press(browser, "n");
  EXPECT_THAT(text(browser, ".tip.b") + text(browser, "#viewer-status"),
              HasSubstr("(c) shadow-map"));
  expectShares("noon", "shadow-map");
  // But not against another method.
  change(browser, "b", "0");
  EXPECT_THAT(text(browser, "#viewer-status"), HasSubstr("No difference"));
  EXPECT_EQ(browser.complaints(), noComplaints);
}

TEST_F(ReportPage, ZoomsAndPansBothPictures) {
  Browser browser(folder());
  openAndFocus(browser, page());
  const auto zoom = [&] { return text(browser, ".viewer output"); };
  const auto picture = [&] {
    return browser.evaluate("document.querySelector('.stage canvas').toDataURL()")
        .get<std::string>();
  };
  EXPECT_EQ(zoom(), "1×");
  const std::string whole = picture();
  press(browser, "+");
  EXPECT_EQ(zoom(), "1.5×");
  const std::string nearer = picture();
  EXPECT_NE(nearer, whole);
  press(browser, "ArrowRight");
  const std::string right = picture();
  EXPECT_NE(right, nearer);
  press(browser, "ArrowLeft");
  EXPECT_EQ(picture(), nearer);
  browser.pressMouse(560, 300);
  browser.moveMouse(500, 300);
  browser.releaseMouse(500, 300);
  settle(browser);
  EXPECT_NE(picture(), nearer);
  browser.wheel(560, 300, -400);
  settle(browser);
  EXPECT_EQ(zoom(), "4.1×");
  press(browser, "0");
  EXPECT_EQ(zoom(), "1×");
  EXPECT_EQ(picture(), whole);
  browser.evaluate("document.querySelector('.viewer [name=in]').click()");
  EXPECT_EQ(zoom(), "1.5×");
}

/// Of the word that the opening explains first, with the touch of a phone, the mouse and keys.
TEST_F(ReportPage, OpensAndClosesTheMeaningOfAWord) {
  Browser browser(folder());
  browser.open(page(), 375);
  settle(browser);
  const auto open = [&] {
    return browser.evaluate(
        "[...document.querySelectorAll('.terms :popover-open dt')]"
        ".map((e) => e.textContent)");
  };
  const auto meaning = [&](const std::string& expression) {
    return browser.evaluate(
        "(() => { const box = document.getElementById(document.querySelector("
        "'.term').getAttribute('popovertarget')).getBoundingClientRect();"
        "return " +
        expression + "; })()");
  };
  EXPECT_EQ(open(), nlohmann::json::array());
  EXPECT_EQ(meaning("box.height"), 0) << "at rest the list at the page's end is folded";
  browser.evaluate("document.querySelector('.index').open = true");
  EXPECT_GT(meaning("box.height"), 20);
  EXPECT_GT(meaning("box.top"), 2000);
  browser.evaluate("document.querySelector('.term').focus()");
  browser.call("Input.dispatchKeyEvent", {{"type", "keyDown"},
                                          {"key", "Enter"},
                                          {"code", "Enter"},
                                          {"windowsVirtualKeyCode", 13},
                                          {"text", "\r"}});
  EXPECT_EQ(open(), nlohmann::json::array({"truth"}));
  EXPECT_TRUE(meaning("box.left >= 0 && box.right <= 375 && box.top >= 0 && box.bottom <= 1000"));
  browser.call("Input.dispatchKeyEvent",
               {{"type", "keyDown"}, {"key", "Escape"}, {"windowsVirtualKeyCode", 27}});
  EXPECT_EQ(open(), nlohmann::json::array());
  const nlohmann::json place = browser.evaluate(
      "(() => { const box = document.querySelector('.term').getBoundingClientRect();"
      "return [(box.left + box.right) / 2, (box.top + box.bottom) / 2]; })()");
  browser.pressMouse(place.at(0), place.at(1));
  browser.releaseMouse(place.at(0), place.at(1));
  EXPECT_EQ(open(), nlohmann::json::array({"truth"}));
  EXPECT_EQ(browser.complaints(), noComplaints);
}

/// Of text against what lies behind it, as WCAG 2 counts: 4.5 is its limit for small text.
TEST_F(ReportPage, WordsStandOutInLightAndDark) {
  Browser browser(folder());
  for (const char* scheme : {"light", "dark"}) {
    browser.call("Emulation.setEmulatedMedia",
                 {{"features", {{{"name", "prefers-color-scheme"}, {"value", scheme}}}}});
    browser.open(page());
    settle(browser);
    const nlohmann::json weak = browser.evaluate(R"((() => {
      document.querySelectorAll('details').forEach((fold) => { fold.open = true; });
      const rgba = (text) => { const n = text.match(/[\d.]+/g).map(Number);
                               return n.length > 3 ? n : [...n, 1]; };
      const over = (a, b) => [0, 1, 2].map((i) => a[3] * a[i] + (1 - a[3]) * b[i]);
      const back = (e) => { const own = rgba(getComputedStyle(e).backgroundColor);
                            return own[3] === 1 || !e.parentElement ? own.slice(0, 3)
                                                : over(own, back(e.parentElement)); };
      const light = (c) => { const l = c.map((v) => { v /= 255;
          return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4; });
        return 0.2126 * l[0] + 0.7152 * l[1] + 0.0722 * l[2]; };
      const found = new Set();
      for (const e of document.querySelectorAll('header *, section *, nav *')) {
        if (![...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim())) continue;
        if (!e.checkVisibility() || e.closest('.tip, .unseen, option, :disabled')) continue;
        const behind = back(e);
        const [a, b] = [light(over(rgba(getComputedStyle(e).color), behind)), light(behind)];
        if ((Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05) < 4.5) {
          found.add(e.tagName + '.' + e.className);
        }
      }
      return [...found];
    })())");
    EXPECT_EQ(weak, nlohmann::json::array()) << scheme;
  }
}

/// The best method, how sure that is, where it errs and what it costs stand before the third
/// screen.
TEST_F(ReportPage, AnswersFirst) {
  Browser browser(folder());
  browser.open(page(), 1280, 800);
  settle(browser);
  for (const char* id : {"ranking", "worst"}) {
    EXPECT_LT(browser.evaluate(std::string("document.getElementById('") + id +
                               "').getBoundingClientRect().top"),
              1600)
        << id;
  }
  EXPECT_EQ(browser.evaluate("document.querySelectorAll('table.ranking').length"), 1);
  EXPECT_EQ(browser.evaluate("[...document.querySelectorAll('nav.contents a')].filter((a) => "
                             "!document.querySelector(a.getAttribute('href'))).length"),
            0);
}

TEST_F(ReportPage, ALinkOpensTheFoldThatItLeadsTo) {
  Browser browser(folder());
  browser.open(page());
  settle(browser);
  const auto isOpen = [&](const std::string& selector) {
    return browser.evaluate("document.querySelector('" + selector + "').open");
  };
  EXPECT_FALSE(isOpen("#truth > details"));
  browser.evaluate("document.querySelector('nav.contents a[href=\"#truth\"]').click()");
  browser.evaluate("new Promise((resolve) => setTimeout(resolve, 50))");
  EXPECT_TRUE(isOpen("#truth > details"));
  // Into a fold, and after it was closed once more.
  const char* link = "document.querySelector('#heat a[href=\"#case-2\"]').click()";
  for (int i = 0; i < 2; ++i) {
    browser.evaluate("document.querySelector('#case-2').closest('details').open = false");
    browser.evaluate(link);
    browser.evaluate("new Promise((resolve) => setTimeout(resolve, 50))");
    EXPECT_TRUE(browser.evaluate("document.querySelector('#case-2').closest('details').open"));
  }
  EXPECT_EQ(browser.complaints(), noComplaints);
}

TEST_F(ReportPage, FitsAPhoneAndPaper) {
  Browser browser(folder());
  openAndFocus(browser, page(), 375);
  EXPECT_EQ(browser.evaluate("document.scrollingElement.scrollWidth"), 375);
  const nlohmann::json wide = browser.evaluate(
      "[...document.querySelectorAll('body *')].filter((e) => !e.closest('.scroll, .stage, "
      ".unseen, figure.plot') "
      "&& e.getBoundingClientRect().right > 376).map((e) => e.tagName + '.' + e.className)");
  EXPECT_EQ(wide, nlohmann::json::array());
  EXPECT_GE(browser.evaluate("Math.min(...[...document.querySelectorAll('.viewer button')].map("
                             "(b) => b.getBoundingClientRect().height))"),
            24);
  const nlohmann::json printed = browser.call("Page.printToPDF", {{"printBackground", true}});
  EXPECT_THAT(printed.at("data").get<std::string>(), StartsWith("JVBERi0"));  // %PDF-
  browser.call("Emulation.setEmulatedMedia", {{"media", "print"}});
  EXPECT_EQ(browser.evaluate("getComputedStyle(document.querySelector('#compare')).display"),
            "none");
  EXPECT_NE(browser.evaluate("getComputedStyle(document.querySelector('figure')).display"), "none");
}

/// The same under a disc, with a method that answers with shares.
class SoftReportPage : public ReportPage {
 protected:
  void prepare() override {
    runStudy("small",
             replaced(reportedStudy(), "elevation = 30\n", "elevation = 30\nradius = 4\n") +
                 "\n[[method]]\nname = \"max-forsyth\"\ndisc = true\n");
  }

  static void choose(Browser& browser, const std::string& side, const std::string& name) {
    change(browser, side,
           "[...document.querySelector('.viewer [name=" + side +
               "]').options].find((o) => o.text.endsWith(') " + name + "')).value");
  }

  /// What the status says of A: percent of the light less than B, and more.
  static std::array<double, 2> differenceSaid(Browser& browser) {
    const nlohmann::json said = browser.evaluate(
        "document.querySelector('#viewer-status').textContent"
        ".match(/sees ([0-9.]+) % less than B .* and ([0-9.]+) % more/).slice(1).map(Number)");
    return {said.at(0), said.at(1)};
  }
};

TEST_F(SoftReportPage, DifferenceIsThatOfTheShares) {
  Browser browser(folder());
  openAndFocus(browser, page());
  press(browser, "d");
  const nlohmann::json record = summary("small");
  choose(browser, "b", "truth");
  // The hard ones answer with 0 and 1; shadow-map has a mesh, and a truth, of its own.
  for (const std::string method :
       {"unshadowed", "max-forsyth", "shadow-map", "max-forsyth + disc"}) {
    choose(browser, "a", method);
    const nlohmann::json row = resultOf(record, method, "evening", "camera");
    const auto said = differenceSaid(browser);
    EXPECT_NEAR(said[0], 100 * row.at("false_shadow").get<double>(), 0.03) << method;
    EXPECT_NEAR(said[1], 100 * row.at("false_light").get<double>(), 0.03) << method;
    EXPECT_GT(said[0] + said[1], 0.1);
  }
  const std::string masks = "out/small/masks/camera_evening_";
  const Outcome outcome =
      gnomon({"compare", masks + "max-forsyth.png", masks + "max-forsyth-disc.png", "--json", "-"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json found = nlohmann::json::parse(outcome.out);
  choose(browser, "a", "max-forsyth");
  choose(browser, "b", "max-forsyth + disc");
  const auto said = differenceSaid(browser);
  EXPECT_NEAR(said[0], 100 * found.at("false_shadow").get<double>(), 0.1);
  EXPECT_NEAR(said[1], 100 * found.at("false_light").get<double>(), 0.1);
  EXPECT_FALSE(browser.evaluate("document.querySelector('.viewer .legend .soft').hidden"));
  choose(browser, "b", "shadow-map");
  EXPECT_THAT(text(browser, "#viewer-status"), HasSubstr("No difference"));
  EXPECT_EQ(browser.complaints(), noComplaints);
}

TEST_F(SoftReportPage, MasksAreTheShares) {
  Browser browser(folder());
  openAndFocus(browser, page());
  const GreyImage shares = readGrey(file("out/small/masks/camera_evening_max-forsyth-disc.png"));
  const GreyImage truth = readGrey(file("out/small/masks/camera_evening_truth.png"));
  const auto between = std::count_if(truth.pixels.begin(), truth.pixels.end(), [](int grey) {
    return grey > 5 && grey < 250 && std::abs(grey - 128) > 1;
  });
  ASSERT_GT(between, 1000);
  choose(browser, "a", "max-forsyth + disc");
  choose(browser, "b", "truth");
  change(browser, "wipe", "100");
  // Its shading is the run's own picture.
  EXPECT_LT(meanDistance(browser, readGrey(picture("max-forsyth-disc"))), 3);
  change(browser, "masks", "true");
  EXPECT_LT(meanDistance(browser, shares), 2) << "but for the line of the wipe";
  EXPECT_GT(meanDistance(browser, truth), 3);
  change(browser, "wipe", "0");
  EXPECT_LT(meanDistance(browser, truth), 2);
  press(browser, "n");
  choose(browser, "a", "max-forsyth");
  choose(browser, "b", "truth");
  EXPECT_LT(shareUnlike(browser, mask("small", "camera_noon_truth"), 3, 256), 0.001)
      << "a hard light beside it";
  EXPECT_EQ(browser.complaints(), noComplaints);
}

class PagePlots : public ReportPage {};

/// Each is drawn, on a wide page and on a narrow one, which does not become wider for it.
TEST_F(PagePlots, AreThereInEveryWidth) {
  Browser browser(folder());
  for (const int width : {390, 1280}) {
    browser.open(page(), width);
    settle(browser);
    EXPECT_GT(browser.evaluate("document.querySelectorAll('figure.plot img').length"), 0);
    EXPECT_TRUE(
        browser.evaluate("[...document.querySelectorAll('figure.plot img')].every((image) => "
                         "image.complete && image.naturalWidth > 0)"));
    EXPECT_TRUE(browser.evaluate("document.documentElement.scrollWidth <= innerWidth"));
  }
  EXPECT_EQ(browser.complaints(), noComplaints);
}

}  // namespace
}  // namespace gnomon::test
