// What a reader has to know before the figures stands in all that a run leaves, in the same words.

#include <gmock/gmock.h>

#include <algorithm>

#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;

/// A cube of 16 units about the origin, every face the whole map.
std::string cubeObj(bool isInsideOut) {
  std::string obj =
      "v -8 -8 -8\nv 8 -8 -8\nv -8 8 -8\nv 8 8 -8\nv -8 -8 8\nv 8 -8 8\nv -8 8 8\nv 8 8 8\n"
      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
  const int faces[6][4] = {{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5},
                           {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}};
  for (const auto& face : faces) {
    obj += "f";
    for (int k = 0; k < 4; ++k) {
      const int corner = isInsideOut ? 3 - k : k;
      obj += " " + std::to_string(face[corner]) + "/" + std::to_string(corner + 1);
    }
    obj += "\n";
  }
  return obj;
}

class Notices : public EndToEnd {
 protected:
  /// Runs a study and expects its notices to be told the same everywhere.
  [[nodiscard]] std::vector<std::string> noticesOf(const std::string& text,
                                                   const std::vector<std::string>& options = {}) {
    write("small.toml", text);
    std::vector<std::string> arguments = {"run", "small.toml"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = gnomon(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const std::vector<std::string> notices = summary("small").at("notices");
    const std::string report = read("out/small/report.html");
    for (const std::string& notice : notices) {
      std::string head = notice.substr(0, 60);
      for (auto at = head.find('\''); at != std::string::npos; at = head.find('\'', at + 1)) {
        head.replace(at, 1, "&#39;");
      }
      EXPECT_THAT(report, HasSubstr("<b>Notice:</b> " + head));
      // The terminal breaks lines.
      EXPECT_THAT(outcome.out, HasSubstr("Notice: " + notice.substr(0, 60)));
    }
    if (notices.empty()) {
      EXPECT_EQ(report.find("Notice:"), std::string::npos);
      EXPECT_EQ(outcome.out.find("Notice:"), std::string::npos);
    }
    return notices;
  }
  /// The small study on a cube.
  [[nodiscard]] std::string onCube(bool isInsideOut) const {
    write("cube.obj", cubeObj(isInsideOut));
    const std::string text = replaced(
        smallStudy(), "shape = \"plane\"\nquads = [4, 4]\nsize = [32, 32]", "mesh = \"cube.obj\"");
    return replaced(replaced(text, "height = 4\n", "height = 0.4\n"), "step = 0.25",
                    "step = 0.125");
  }
};

TEST_F(Notices, ASoundStudyHasNone) {
  EXPECT_EQ(noticesOf(replaced(smallStudy(), "step = 0.25", "step = 0.05")).size(), 0U);
}

TEST_F(Notices, AnUncertainTruthSaysSoAndTheStepThatItNamesMendsIt) {
  const std::string rough = replaced(smallStudy(), "step = 0.25", "step = 0.5");
  const std::vector<std::string> notices = noticesOf(rough);
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_THAT(notices[0], HasSubstr("Set truth.step = 0.25 (now 0.5)."));
  EXPECT_GT(summary("small").at("truth").at("uncertainty"), 0.003);
  // A check says it as well.
  write("gated.toml", rough + "\n[[threshold]]\nmethod = \"max-forsyth\"\nmax = 0.9\n");
  EXPECT_THAT(gnomon({"check", "gated.toml"}).out, HasSubstr("Notice: gated.toml: The truth"));
  EXPECT_THAT(gnomon({"truth", "small.toml"}).out, HasSubstr("Notice: " + notices[0]));
}

TEST_F(Notices, AClosedMeshInsideOutIsNoticed) {
  const auto tellsIt = [](const std::vector<std::string>& notices) {
    return !notices.empty() && notices[0].find("turned inside out") != std::string::npos;
  };
  const auto prevalence = [this]() -> double {
    return resultOf(summary("small"), "max-forsyth", "evening", "camera").at("prevalence");
  };
  EXPECT_FALSE(tellsIt(noticesOf(onCube(false))));
  EXPECT_LT(prevalence(), 0.9);
  EXPECT_TRUE(tellsIt(noticesOf(onCube(true))));
  EXPECT_EQ(prevalence(), 1);
}

TEST_F(Notices, PiecesTooCoarseForTheMapAreNoticedAndThoseItNamesAreNot) {
  // A single face under 32 × 32 texels.
  const std::string arch = replaced(replaced(smallStudy(), "quads = [4, 4]", "quads = [1, 1]"),
                                    "step = 0.25", "step = 0.05") +
                           "\n[[method]]\nname = \"shadow-volume\"\n";
  const std::vector<std::string> notices = noticesOf(arch);
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_THAT(notices[0], HasSubstr("shadow-volume: "));
  EXPECT_THAT(notices[0], HasSubstr("3.6 texels"));
  EXPECT_THAT(notices[0], HasSubstr("base.subdivisions = 32 "));
  const double coarse =
      resultOf(summary("small"), "shadow-volume", "evening", "camera").at("error_rate");
  // The same relief on finer texels is as well met by the same pieces.
  EXPECT_EQ(noticesOf(replaced(arch, "[relief]\n", "[relief]\nresample = 3\n")), notices);
  EXPECT_EQ(noticesOf(arch + "base = { subdivisions = 32 }\n").size(), 0U);
  EXPECT_LT(resultOf(summary("small"), "shadow-volume", "evening", "camera").at("error_rate"),
            coarse / 2);
  const std::string light =
      replaced(arch, "name = \"shadow-volume\"\n",
               "name = \"two-scales\"\nparameters = { light_pieces = 9, depth_side = 256 }\n");
  const std::vector<std::string> ofLight = noticesOf(light);
  ASSERT_EQ(ofLight.size(), 1U);
  EXPECT_THAT(ofLight[0], HasSubstr("two-scales: the pieces of the displaced mesh that the light"));
  EXPECT_EQ(noticesOf(replaced(light, "pieces = 9", "pieces = 32")).size(), 0U);
}

TEST_F(Notices, ChartsThatOverlapAreNoticedWithTheirShareAndRefusedForSolids) {
  // Two squares side by side, each half under the other in the texture.
  write("two.obj",
        "v -16 -16 0\nv 0 -16 0\nv 16 -16 0\nv -16 16 0\nv 0 16 0\nv 16 16 0\n"
        "vt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nvt 0.25 0\nvt 0.75 0\nvt 0.75 1\nvt 0.25 1\n"
        "f 1/1 2/2 5/3 4/4\nf 2/5 3/6 6/7 5/8\n");
  const std::string onTwo =
      replaced(replaced(smallStudy(), "shape = \"plane\"\nquads = [4, 4]\nsize = [32, 32]",
                        "mesh = \"two.obj\""),
               "step = 0.25", "step = 0.05");
  const std::vector<std::string> notices =
      noticesOf(onTwo + "[[method]]\nname = \"surface-march\"\n");
  ASSERT_EQ(notices.size(), 2U);
  EXPECT_THAT(notices[0], HasSubstr("Charts of the texture overlap: 50 % of the surface's area"));
  EXPECT_THAT(notices[1], HasSubstr("“surface-march” at "));
  const nlohmann::json found = summary("small");
  EXPECT_EQ(found.at("texture").at("charts"), 2);
  EXPECT_EQ(found.at("texture").at("charts_overlap"), true);
  EXPECT_NEAR(found.at("texture").at("shared_area"), 0.5, 1e-12);
  EXPECT_EQ(found.at("methods").at(0).at("other_chart_share"), 0);
  EXPECT_GT(found.at("methods").at(2).at("other_chart_share"), 0.2);
  EXPECT_LT(found.at("methods").at(2).at("other_chart_share"), 0.5);

  const std::string patternOf = onTwo.substr(onTwo.find("pattern ="));
  const std::string pattern = patternOf.substr(0, patternOf.find("height ="));
  write("solid.toml",
        replaced(onTwo, pattern, "solid = \"noise\"\nperiod = 8\ntexels = [32, 32]\n"));
  const Outcome refused = gnomon({"run", "solid.toml"});
  EXPECT_EQ(refused.status, 3);
  // 8 of 24 columns of texels.
  EXPECT_THAT(refused.err, HasSubstr("33.3 % of the surface's texels are asked for two heights"));
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
}

TEST_F(Notices, ALightThatRanksNothingIsNoticed) {
  const std::string sound = replaced(smallStudy(), "step = 0.25", "step = 0.05");
  const std::vector<std::string> night =
      noticesOf(replaced(sound, "elevation = 30", "elevation = -5"));
  ASSERT_EQ(night.size(), 1U);
  EXPECT_THAT(night[0], HasSubstr("Under evening the whole surface is turned from the light"));
  const std::vector<std::string> noon =
      noticesOf(replaced(sound, "elevation = 30", "elevation = 90"));
  ASSERT_EQ(noon.size(), 1U);
  EXPECT_THAT(noon[0], HasSubstr("are lit in the truth"));
}

TEST_F(Notices, TheQuickFormSaysThatItIsNotFinal) {
  const std::vector<std::string> notices =
      noticesOf(replaced(smallStudy(), "step = 0.25", "step = 0.05"), {"--quick"});
  ASSERT_FALSE(notices.empty());
  EXPECT_THAT(notices[0], HasSubstr("--quick"));
  EXPECT_THAT(notices[0], HasSubstr("not final"));
}

TEST_F(Notices, AMapThatRepeatsOverAnOpenMeshIsNoticedAndNotTheDefault) {
  // A bowl, out of which no ray to the light finds by itself.
  std::string obj;
  for (int j = 0; j <= 4; ++j) {
    for (int i = 0; i <= 4; ++i) {
      const int x = 8 * i - 16;
      const int y = 8 * j - 16;
      obj += "v " + std::to_string(x) + " " + std::to_string(y) + " " +
             std::to_string((x * x + y * y) / 16.0) + "\nvt " + std::to_string(i / 4.0) + " " +
             std::to_string(j / 4.0) + "\n";
    }
  }
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      obj += "f";
      for (const int corner : {5 * j + i + 1, 5 * j + i + 2, 5 * j + i + 7, 5 * j + i + 6}) {
        obj += " " + std::to_string(corner) + "/" + std::to_string(corner);
      }
      obj += "\n";
    }
  }
  write("bowl.obj", obj);
  const std::string bowl = replaced(
      smallStudy(), "shape = \"plane\"\nquads = [4, 4]\nsize = [32, 32]", "mesh = \"bowl.obj\"");
  const auto tellsIt = [](const std::vector<std::string>& notices) {
    return std::any_of(notices.begin(), notices.end(), [](const std::string& notice) {
      return notice.find("The map repeats past the border") != std::string::npos;
    });
  };
  const auto wrap = [this]() -> std::string {
    return summary("small").at("study").at("settings").at("relief").at("wrap");
  };
  EXPECT_FALSE(tellsIt(noticesOf(bowl)));
  EXPECT_EQ(wrap(), "clamp");
  EXPECT_TRUE(tellsIt(noticesOf(replaced(bowl, "[relief]\n", "[relief]\nwrap = \"repeat\"\n"))));
  EXPECT_EQ(wrap(), "repeat");
}

TEST_F(Notices, ASweepTellsEachOnceAndWhereItHolds) {
  write("small.toml", smallStudy() + "\n[sweep]\nkey = \"truth.step\"\nvalues = [0.05, 0.5]\n");
  const Outcome outcome = gnomon({"run", "small.toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Notice: At truth.step = 0.5: The truth itself"));
  EXPECT_THAT(read("out/small/report.html"),
              HasSubstr("<b>Notice:</b> At truth.step = 0.5: The truth itself"));
}

}  // namespace
}  // namespace gnomon::test
