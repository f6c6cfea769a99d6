#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "end_to_end/support/browser.h"
#include "end_to_end/support/program.h"

namespace gnomon::test {

/// Two lights; two methods of the base mesh and one of the displaced one.
inline std::string reportedStudy() {
  std::string text = replaced(smallStudy(), "width = 64\nheight = 64", "width = 256\nheight = 256");
  text = replaced(text, "[[method]]\nname = \"unshadowed\"",
                  "[[light]]\nname = \"noon\"\nazimuth = 20\nelevation = 60\n\n"
                  "[[method]]\nname = \"unshadowed\"");
  return text + "\n[[method]]\nname = \"shadow-map\"\nbase = { subdivisions = 8 }\n";
}

inline const std::vector<std::string> noComplaints;

/// The page of a small study, in a browser.
class ReportPage : public SharedRuns {
 protected:
  void prepare() override { runStudy("small", reportedStudy()); }

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

}  // namespace gnomon::test
