#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "end_to_end/support/report_page.h"

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;

/// The same under a disc, with a method that answers with shares.
class SoftReportPage : public ReportPage {
 protected:
  void SetUp() override {
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

}  // namespace
}  // namespace gnomon::test
