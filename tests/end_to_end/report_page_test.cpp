#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include "end_to_end/support/browser.h"
#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::vector<std::string> nothing;

/// Two lights; two methods of the base mesh and one of the displaced one.
std::string studyText() {
  std::string text = replaced(smallStudy(), "width = 64\nheight = 64", "width = 256\nheight = 256");
  text = replaced(text, "[[method]]\nname = \"unshadowed\"",
                  "[[light]]\nname = \"noon\"\nazimuth = 20\nelevation = 60\n\n"
                  "[[method]]\nname = \"unshadowed\"");
  return text + "\n[[method]]\nname = \"shadow-map\"\nbase = { subdivisions = 8 }\n";
}

class ReportPage : public EndToEnd {
 protected:
  void SetUp() override { runStudy("small", studyText()); }

  [[nodiscard]] std::filesystem::path page() const { return file("out/small/report.html"); }

  [[nodiscard]] std::filesystem::path picture(const std::string& method) const {
    return file("out/small/images/camera_evening_" + method + ".png");
  }

  /// Waits until the viewer has drawn what it was last asked for.
  static void settle(Browser& browser) {
    browser.evaluate(R"((async () => {
      const {dataset} = document.querySelector('.viewer');
      for (let i = 0; dataset.asked !== dataset.drawn; ++i) {
        if (i > 2000) throw new Error('the viewer never drew');
        await new Promise((resolve) => setTimeout(resolve, 10));
      }
    })())");
  }

  static void change(Browser& browser, const std::string& name, const std::string& value) {
    browser.evaluate("(() => { const c = document.querySelector('.viewer [name=\"" + name +
                     "\"]'); if (c.type === 'checkbox') c.checked = " + value +
                     "; else c.value = " + value +
                     "; c.dispatchEvent(new Event('input', {bubbles: true})); })()");
    settle(browser);
  }

  static void openAndFocus(Browser& browser, const std::filesystem::path& path, int width = 1200) {
    browser.open(path, width, 1000);
    settle(browser);
    browser.evaluate(
        "document.querySelector('.stage').scrollIntoView({block: 'start', behavior: 'instant'});"
        "document.querySelector('.stage').focus()");
  }

  static void press(Browser& browser, const std::string& key) {
    browser.key(key);
    settle(browser);
  }

  static std::string text(Browser& browser, const std::string& selector) {
    return browser.evaluate("document.querySelector('" + selector + "').textContent");
  }

  /// The red values of the stage's canvas at the middles of the picture's 256 × 256 pixels.
  static std::vector<int> shown(Browser& browser) {
    return browser.evaluate(
        "(() => { const c = document.querySelector('.stage canvas').cloneNode();"
        "const to = c.getContext('2d', {willReadFrequently: true});"
        "to.drawImage(document.querySelector('.stage canvas'), 0, 0);"
        "const d = to.getImageData(0, 0, c.width, c.height).data; const values = [];"
        "for (let y = 0; y < 256; ++y) for (let x = 0; x < 256; ++x) {"
        "  values.push(d[4 * (Math.floor((y + 0.5) * c.height / 256) * c.width"
        "      + Math.floor((x + 0.5) * c.width / 256))]); } return values; })()");
  }

  /// By how much the canvas differs from a picture, mean over the pixels, of 255.
  static double meanDistance(Browser& browser, const GreyImage& expected) {
    const std::vector<int> values = shown(browser);
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += std::abs(values[i] - expected.pixels[i]);
    return sum / static_cast<double>(values.size());
  }

  /// What share of the pixels, whose neighbours are all alike in the expected mask, differ from it,
  /// in columns [from, to).
  static double shareUnlike(Browser& browser, const GreyImage& expected, int from, int to) {
    const std::vector<int> values = shown(browser);
    double unlike = 0;
    double seen = 0;
    for (int y = 1; y < 255; ++y) {
      for (int x = std::max(1, from); x < std::min(255, to); ++x) {
        const auto at = [&](int column, int row) {
          return expected.pixels[static_cast<std::size_t>(256 * row + column)];
        };
        bool plain = true;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) plain = plain && at(x + dx, y + dy) == at(x, y);
        }
        if (!plain) continue;
        ++seen;
        unlike += std::abs(values[static_cast<std::size_t>(256 * y + x)] - at(x, y)) > 60;
      }
    }
    EXPECT_GT(seen, 1000);
    return unlike / seen;
  }
};

TEST_F(ReportPage, LoadsFromDiskWithoutErrorOrRequest) {
  Browser browser(folder());
  browser.open(page());
  settle(browser);
  EXPECT_EQ(browser.complaints(), nothing);
  EXPECT_EQ(browser.requests(), std::vector<std::string>{"file://" + page().string()});
  EXPECT_FALSE(browser.evaluate("document.querySelector('#compare').hidden"));
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
  write("out/small/report.html", replaced(read("out/small/report.html"), "</main>",
                                          "</main><script>window.evil=1</script>"));
  Browser browser(folder());
  browser.open(page());
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
  EXPECT_EQ(browser.complaints(), nothing);
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
  EXPECT_EQ(browser.complaints(), nothing);
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
  browser.pressMouse(500, 600);
  browser.moveMouse(440, 600);
  browser.releaseMouse(440, 600);
  settle(browser);
  EXPECT_NE(picture(), nearer);
  browser.wheel(500, 500, -400);
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
  EXPECT_GT(meaning("box.height"), 20) << "at rest it stands in the list at the page's end";
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
  EXPECT_EQ(browser.complaints(), nothing);
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

/// Of the plot with the most values: under the pointer, by keys, and with a method that a reader
/// picks.
TEST_F(ReportPage, PlotsTellTheirValues) {
  Browser browser(folder());
  for (const int width : {390, 1280}) {
    browser.open(page(), width);
    settle(browser);
    browser.evaluate(
        "[...document.querySelectorAll('figure.two')].sort((a, b) => "
        "b.querySelectorAll('.value').length - a.querySelectorAll('.value').length)[0].id = "
        "'most'");
    const std::string plot = width == 390 ? "#most .narrow svg" : "#most .wide svg";
    EXPECT_TRUE(browser.evaluate("document.querySelector('" + plot + "').checkVisibility()"));
    EXPECT_FALSE(browser.evaluate(std::string("document.querySelector('#most ") +
                                  (width == 390 ? ".wide" : ".narrow") +
                                  " svg').checkVisibility()"));
    browser.evaluate("document.querySelector('" + plot +
                     "').scrollIntoView({block: 'center', behavior: 'instant'})");
    const auto reading = [&] {
      return browser
          .evaluate("(() => { const tip = document.querySelector('" + plot +
                    "').parentNode.querySelector('.reading');"
                    "return tip.hidden ? '' : tip.textContent; })()")
          .get<std::string>();
    };
    EXPECT_EQ(reading(), "");
    const nlohmann::json place =
        browser.evaluate("(() => { const b = document.querySelector('" + plot +
                         " .value').getBoundingClientRect();"
                         "return [(b.left + b.right) / 2, (b.top + b.bottom) / 2]; })()");
    browser.moveMouse(place.at(0), place.at(1));
    const std::string hovered = reading();
    EXPECT_THAT(hovered, HasSubstr("% wrong"));
    browser.moveMouse(2, 2);
    EXPECT_EQ(reading(), "");
    browser.evaluate("document.querySelector('" + plot + "').focus()");
    browser.key("ArrowRight");
    const std::string first = reading();
    EXPECT_THAT(first, HasSubstr("% wrong"));
    browser.key("ArrowRight");
    EXPECT_NE(reading(), first);
    EXPECT_EQ(reading().substr(0, reading().find(':')), first.substr(0, first.find(':')))
        << "the same method";
    browser.key("ArrowLeft");
    EXPECT_EQ(reading(), first);
    // The table behind it has the same figure.
    const std::string figure =
        first.substr(first.find(": ") + 2, first.find(" %") - first.find(": ") - 2);
    EXPECT_TRUE(
        browser.evaluate("[...document.querySelectorAll('figure.two table.values td')].some((c) => "
                         "c.textContent === '" +
                         figure + "')"))
        << first;
  }
  // In all plots at once.
  const auto colours = [&] {
    return browser.evaluate(
        "[...document.querySelectorAll('figure[data-families]')].map((f) => "
        "getComputedStyle(f.querySelector('.keys svg')).color)");
  };
  const nlohmann::json before = colours();
  ASSERT_GE(before.size(), 2U);
  browser.evaluate("document.querySelector('.keys button').click()");
  EXPECT_EQ(browser.evaluate("document.querySelector('.keys button').ariaPressed"), "false");
  const nlohmann::json grey = colours();
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NE(grey[i], before[i]) << i;
  browser.evaluate("document.querySelector('.keys button').click()");
  EXPECT_EQ(colours(), before);
  EXPECT_EQ(browser.complaints(), nothing);
}

/// Lines and symbols against the page, as WCAG 2 asks of graphics: 3.
TEST_F(ReportPage, PlotsStandOutInLightAndDark) {
  Browser browser(folder());
  std::vector<nlohmann::json> inks;
  for (const char* scheme : {"light", "dark"}) {
    browser.call("Emulation.setEmulatedMedia",
                 {{"features", {{{"name", "prefers-color-scheme"}, {"value", scheme}}}}});
    browser.open(page());
    settle(browser);
    inks.push_back(browser.evaluate(
        "getComputedStyle(document.querySelector('figure.two .wide text').parentNode).fill"));
    const nlohmann::json weak = browser.evaluate(R"((() => {
      const light = (text) => { const l = text.match(/[\d.]+/g).map(Number).slice(0, 3).map((v) => { v /= 255;
          return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4; });
        return 0.2126 * l[0] + 0.7152 * l[1] + 0.0722 * l[2]; };
      const behind = light(getComputedStyle(document.body).backgroundColor);
      const marks = [...document.querySelectorAll('figure.plot g[data-method] use, figure.plot .wide text')];
      const colour = (e) => e.tagName === 'text' ? getComputedStyle(e).fill : getComputedStyle(e).color;
      if (marks.length < 10) return 'no marks';
      return marks.map((e) => [colour(e), light(colour(e))])
          .filter(([, a]) => (Math.max(a, behind) + 0.05) / (Math.min(a, behind) + 0.05) < 3).map(([c]) => c);
    })())");
    EXPECT_EQ(weak, nlohmann::json::array()) << scheme;
  }
  EXPECT_NE(inks[0], inks[1]) << "plots follow the scheme";
}

TEST_F(ReportPage, FitsAPhoneAndPaper) {
  Browser browser(folder());
  openAndFocus(browser, page(), 375);
  EXPECT_EQ(browser.evaluate("document.scrollingElement.scrollWidth"), 375);
  const nlohmann::json wide = browser.evaluate(
      "[...document.querySelectorAll('body *')].filter((e) => !e.closest('.scroll, .stage, "
      ".unseen') "
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
  void SetUp() override {
    runStudy("small", replaced(studyText(), "elevation = 30\n", "elevation = 30\nradius = 4\n") +
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
  EXPECT_EQ(browser.complaints(), nothing);
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
  EXPECT_EQ(browser.complaints(), nothing);
}

}  // namespace
}  // namespace gnomon::test
