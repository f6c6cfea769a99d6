#include <gmock/gmock.h>

#include "end_to_end/support/report_page.h"

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;

class PagePlots : public ReportPage {};

/// Of the plot with the most values: under the pointer, by keys, and with a method that a reader
/// picks.
TEST_F(PagePlots, PlotsTellTheirValues) {
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
  EXPECT_EQ(browser.complaints(), noComplaints);
}

/// Lines and symbols against the page, as WCAG 2 asks of graphics: 3.
TEST_F(PagePlots, PlotsStandOutInLightAndDark) {
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

}  // namespace
}  // namespace gnomon::test
