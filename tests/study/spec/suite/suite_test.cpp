#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "common/files/atomic_file.h"
#include "common/vec.h"
#include "study/spec/study_file.h"
#include "study/spec/suite/drawn_suite.h"
#include "study/spec/suite/drawn_surface.h"
#include "study/spec/suite/suite_file.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"
#include "surface/cage/shapes.h"
#include "surface/curvature.h"
#include "surface/texel_frame.h"

namespace gnomon::study {
namespace {

using ::testing::HasSubstr;

Distribution drawnFrom(const std::string& value) {
  const toml::table table = parseTomlText("x = " + value, "suite.toml");
  return readDistribution(TomlReader(table, "suite.toml", ""), "x");
}

TEST(Distribution, StepsAreTheirDecimals) {
  const std::vector<double> values = drawnFrom("{ from = -0.3, to = 0.3, step = 0.1 }").values();
  EXPECT_EQ(values, (std::vector<double>{-0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3}));
}

TEST(Distribution, ProgressionIsGeometricAndEndsWhereItSays) {
  const std::vector<double> values = drawnFrom("{ log = [0.005, 0.2] }").values();
  ASSERT_EQ(values.size(), 1025U);
  EXPECT_EQ(values.front(), 0.005);
  EXPECT_EQ(values.back(), 0.2);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double exact = 0.005 * std::pow(40, static_cast<double>(k) / 1024);
    EXPECT_NEAR(values[k], exact, 6e-4 * exact);
    EXPECT_EQ(values[k], roundedNumber(values[k]));
  }
}

TEST(Distribution, ValuesAreEquallyProbable) {
  const Distribution three = drawnFrom("{ among = [1, 2, 4] }");
  RandomStream random(1);
  std::map<double, int> counts;
  for (int i = 0; i < 30000; ++i) ++counts[three.draw(random)];
  ASSERT_EQ(counts.size(), 3U);
  // Four standard deviations of a count.
  for (const auto& [value, count] : counts) EXPECT_NEAR(count, 10000, 4 * 82) << value;
}

TEST(Distribution, RefusesWhatIsNone) {
  const auto said = [](const std::string& value) {
    return messageOf<InputError>([&] { (void)drawnFrom(value); });
  };
  EXPECT_THAT(said("{ log = [0, 1] }"), HasSubstr("suite.toml:1: x.log"));
  EXPECT_THAT(said("{ log = [2, 1] }"), HasSubstr("two rising numbers expected"));
  EXPECT_THAT(said("{ from = 0, to = 1, step = 0.3 }"), HasSubstr("whole number of steps"));
  EXPECT_THAT(said("{ from = 0, to = 1 }"), HasSubstr("x.step"));
  EXPECT_THAT(said("{ amog = [1] }"), HasSubstr("unknown key"));
  EXPECT_THAT(said("\"3\""), HasSubstr("number"));
}

TEST(RoundedNumber, HasFourDigits) {
  EXPECT_EQ(roundedNumber(0.0123456), 0.01235);
  EXPECT_EQ(roundedNumber(-98765.4), -98770);
  EXPECT_EQ(roundedNumber(3), 3);
  EXPECT_FALSE(std::signbit(roundedNumber(-0.0)));
}

/// The generator's published numbers: splitmix64 from 0, and xoshiro256** from 1, 2, 3, 4.
TEST(RandomStream, IsTheOneThatItSays) {
  RandomStream random({1, 2, 3, 4});
  EXPECT_EQ(random.next(), 11520U);
  EXPECT_EQ(random.next(), 0U);
  EXPECT_EQ(random.next(), 1509978240U);
  EXPECT_EQ(random.next(), 1215971899390074240U);
  RandomStream filled(
      {0xE220A8397B1DCDAFU, 0x6E789E6AA1B965F4U, 0x06C45D188009454FU, 0xF88BB8A8724C81ECU});
  RandomStream seeded(std::uint64_t{0});
  for (int i = 0; i < 10; ++i) EXPECT_EQ(seeded.next(), filled.next());
}

TEST(RandomStream, CountsAndShares) {
  RandomStream random(7);
  double sum = 0;
  for (int i = 0; i < 10000; ++i) {
    EXPECT_LT(random.below(3), 3U);
    const double unit = random.unit();
    EXPECT_GE(unit, 0);
    EXPECT_LT(unit, 1);
    sum += unit;
  }
  EXPECT_NEAR(sum / 10000, 0.5, 0.012);
}

TEST(ExactDegrees, AgreeWithTheLibrary) {
  for (double degrees = -720; degrees <= 720; degrees += 0.5) {
    const SineCosine exact = sineCosine(degrees);
    EXPECT_NEAR(exact.sine, std::sin(radians(degrees)), 3e-15) << degrees;
    EXPECT_NEAR(exact.cosine, std::cos(radians(degrees)), 3e-15) << degrees;
  }
  EXPECT_EQ(sineCosine(90).cosine, 0);
  EXPECT_EQ(sineCosine(180).sine, 0);
}

TEST(SuiteText, ReadsBackAndIsWrittenOneWay) {
  const toml::table study = toml::parse(R"([relief]
height = 0.1
name = 'a "b" \c'
texels = [4, 8]
flag = true
whole = 3.0
points = [[0.5, 1], [2, -3e-7]]
[[method]]
name = "a"
bake = { azimuths = 8 }
[[method]]
"odd key" = "tab\there"
)");
  const std::string text = suiteText(study, {"relief", "none", "method"});
  EXPECT_EQ(text, R"([relief]
flag = true
height = 0.1
name = "a \"b\" \\c"
points = [
  [0.5, 1],
  [2, -3e-07],
]
texels = [4, 8]
whole = 3.0

[[method]]
bake = { azimuths = 8 }
name = "a"

[[method]]
"odd key" = "tab\u0009here"
)");
  EXPECT_EQ(toml::parse(text), study);
}

const SuiteSpec& firstSuite() {
  static const SuiteSpec read = readSuite(standardSuiteFile());
  return read;
}

const SuiteMethods& suiteMethods() {
  static const SuiteMethods read = readSuiteMethods(standardMethodsFile(), {});
  return read;
}

DrawnSuite suiteOf(SuiteSplit split, const std::string& seed, int count) {
  return drawSuite(firstSuite(), suiteMethods(), split, seed, count);
}

TEST(DrawnSuite, SceneDoesNotDependOnHowManyThereAre) {
  const DrawnSuite few = suiteOf(SuiteSplit::test, "1", 5);
  const DrawnSuite more = suiteOf(SuiteSplit::test, "1", 9);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(few.studies[i].text, more.studies[i].text);
  EXPECT_NE(few.sha256, more.sha256);
}

/// Seeds and splits have no scene in common.
TEST(DrawnSuite, SeedsAndSplitsAreDisjoint) {
  std::set<std::string> scenes;
  std::size_t count = 0;
  for (const SuiteSplit split : {SuiteSplit::train, SuiteSplit::test}) {
    for (const char* seed : {"1", "2", "1 "}) {
      for (int number = 1; number <= 10; ++number) {
        DrawnScene scene = drawScene(firstSuite(), split, seed, number);
        scene.study.erase("study");  // which names it
        std::ostringstream text;
        text << scene.study;
        scenes.insert(text.str());
        ++count;
      }
    }
  }
  EXPECT_EQ(scenes.size(), count);
}

double factOf(const DrawnScene& scene, const char* name) {
  return scene.facts[name].value<double>().value();
}

/// The limits hold in what is written, measured on the study itself.
TEST(DrawnSuite, KeepsItsLimits) {
  std::set<std::string> surfaces;
  std::set<std::string> reliefs;
  int cameras = 0;
  constexpr int count = 150;
  for (int number = 1; number <= count; ++number) {
    const DrawnScene scene = drawScene(firstSuite(), SuiteSplit::test, "limits", number);
    surfaces.insert(scene.facts["surface"].value<std::string>().value());
    reliefs.insert(scene.facts["relief"].value<std::string>().value());
    cameras += scene.facts["view"] == "camera" ? 1 : 0;
    EXPECT_NEAR(factOf(scene, "height"),
                factOf(scene, "height_over_feature") * factOf(scene, "feature"),
                1e-3 * factOf(scene, "height"));
    if (scene.facts.contains("kappa_height") && scene.facts["surface"] != "plane") {
      EXPECT_GE(factOf(scene, "kappa_height"), 0.0049) << number;
      EXPECT_LE(factOf(scene, "kappa_height"), 0.251) << number;
    }
    // The stretch of shadow, by the library's tangent.
    for (const SuiteRelief& relief : firstSuite().reliefs) {
      const std::string name = (relief.form == "solid" ? "solid " : "") + relief.name;
      const auto surface = scene.facts["surface"].value<std::string>().value();
      const bool isClosed = surface != "plane" && surface != "cylinder" && surface != "sphere" &&
                            surface != "inside-sphere" && surface != "bezier" &&
                            surface != "b-spline";
      if (scene.facts["relief"] != name || isClosed) continue;
      const double shadow =
          factOf(scene, "height_over_feature") / std::tan(radians(factOf(scene, "elevation")));
      EXPECT_GE(shadow, relief.shadow.x * (1 - 1e-9)) << number;
      EXPECT_LE(shadow, relief.shadow.y * (1 + 1e-9)) << number;
    }
  }
  EXPECT_EQ(surfaces.size(), firstSuite().surfaces.size());
  EXPECT_EQ(reliefs.size(), firstSuite().reliefs.size());
  // Two of three, within four standard deviations.
  EXPECT_NEAR(cameras, count * 2 / 3, 4 * std::sqrt(count * 2.0 / 9));
}

/// How many methods of a list stand in a study of a point of light.
std::size_t underPoints(const SuiteMethods& methods) {
  return static_cast<std::size_t>(
      std::count_if(methods.methods.begin(), methods.methods.end(),
                    [](const toml::table& method) { return !method.contains("disc"); }));
}

class WrittenSuite : public TemporaryFolder {};

/// suite-2 is suite-1 but for its name and its suns; methods with `disc` stand in its studies
/// alone.
TEST_F(WrittenSuite, LikeAnotherHasItsLightsAsDiscs) {
  const SuiteSpec second = readSuite(standardSuiteFile().parent_path() / "suite-2.toml");
  EXPECT_EQ(second.surfaces.size(), firstSuite().surfaces.size());
  const DrawnSuite drawn = drawSuite(second, suiteMethods(), SuiteSplit::test, "1", 40);
  writeSuite(drawn, "{}\n", file("suite"));
  std::set<double> radii;
  for (const SuiteStudy& study : drawn.studies) {
    const StudySpec read = readStudy(file("suite") / study.file);
    EXPECT_TRUE(read.name.starts_with("suite-2-test-"));
    const double radius = degreesOf(read.lights.front().radius);
    EXPECT_NEAR(radius, study.facts["radius"].value<double>().value(), 1e-9);
    EXPECT_GE(radius, 0.2659);
    EXPECT_LE(radius, 3.0001);
    radii.insert(radius);
    const auto ofDiscs = std::count_if(read.methods.begin(), read.methods.end(),
                                       [](const MethodSpec& method) { return method.disc; });
    EXPECT_EQ(static_cast<std::size_t>(ofDiscs),
              suiteMethods().methods.size() - underPoints(suiteMethods()));
  }
  EXPECT_GT(radii.size(), 30U);
}

/// suite-3: where charts share the texture a relief lies in the plane, in periods of texels;
/// elsewhere it is a solid. Its scenes are read from where they were written.
TEST_F(WrittenSuite, SharedTextureHasPatternsOfThePlane) {
  const SuiteSpec third = readSuite(standardSuiteFile().parent_path() / "suite-3.toml");
  const DrawnSuite drawn = drawSuite(third, suiteMethods(), SuiteSplit::test, "1", 60);
  writeSuite(drawn, "{}\n", file("suite"));
  std::set<std::string> surfaces;
  for (const SuiteStudy& study : drawn.studies) {
    const std::string surface = study.facts["surface"].value<std::string>().value();
    const std::string relief = study.facts["relief"].value<std::string>().value();
    const auto of = std::find_if(third.surfaces.begin(), third.surfaces.end(),
                                 [&](const SuiteSurface& one) { return one.name == surface; });
    ASSERT_NE(of, third.surfaces.end());
    EXPECT_EQ(relief.starts_with("solid "), !of->shared) << study.file;
    EXPECT_NO_THROW(readStudy(file("suite") / study.file));
    if (of->shared) {
      const double texel = of->texel * 1000 / study.facts["texels"][0].value<double>().value();
      const double feature = study.facts["feature"].value<double>().value() / texel;
      const toml::table written = toml::parse(study.text);
      const double period = written["relief"]["period"].value<double>().value();
      EXPECT_GE(feature, third.fewestTexels);
      EXPECT_NEAR(period, relief == "cells" ? feature : 3 * feature, 2e-3 * period);
    }
    surfaces.insert(surface);
  }
  EXPECT_EQ(surfaces.size(), third.surfaces.size());
}

TEST_F(WrittenSuite, LikeAnotherIsRefusedWithOneLine) {
  const auto messageFor = [&](const std::string& text) {
    std::ofstream(file("like.toml")) << text;
    return messageOf<InputError>([&] { readSuite(file("like.toml")); });
  };
  const std::string folder = standardSuiteFile().parent_path().string() + "/";
  const std::string light = "[light]\nradius = 1\n";
  const auto header = [&](const std::string& other) {
    return "[suite]\nname = \"s\"\nlike = \"" + folder + other + "\"\n";
  };
  EXPECT_THAT(messageFor(header("suite-2.toml") + light),
              HasSubstr("suite-2.toml found, a file with distributions of its own expected"));
  EXPECT_THAT(messageFor(header("suite-1.toml")), HasSubstr("light"));
  EXPECT_THAT(messageFor(header("suite-1.toml") + "[light]\nradius = 20\n"), HasSubstr("radius"));
  EXPECT_THAT(messageFor(header("suite-1.toml") + light + "[map]\nside = 64\n"), HasSubstr("map"));
  EXPECT_THAT(messageFor(header("suite-1.toml") + light + "elevation = 5\n"),
              HasSubstr("elevation"));
}

/// Every study is read from where it was written, by itself.
TEST_F(WrittenSuite, StandsOnItsOwn) {
  const DrawnSuite suiteOfTen = suiteOf(SuiteSplit::test, "1", 12);
  writeSuite(suiteOfTen, "{}\n", file("suite"));
  for (const SuiteStudy& study : suiteOfTen.studies) {
    const StudySpec read = readStudy(file("suite") / study.file);
    EXPECT_EQ(read.name + ".toml", study.file);
    EXPECT_EQ(read.lights.size(), 1U);
    EXPECT_EQ(read.views.size(), 1U);
    const bool isAtlas = std::holds_alternative<AtlasSpec>(read.views.front().kind);
    const std::set<std::string> ofCameras{"screen-space", "shadow-volume"};
    EXPECT_EQ(read.methods.size(), underPoints(suiteMethods()) - (isAtlas ? ofCameras.size() : 0));
    for (const MethodSpec& method : read.methods) {
      EXPECT_FALSE(method.disc);
      EXPECT_FALSE(isAtlas && ofCameras.count(method.label) > 0);
    }
    EXPECT_TRUE(study.text.starts_with(study.scene + "\n" + std::string(methodsMark)));
  }
  EXPECT_THAT(messageOf<InputError>([&] { writeSuite(suiteOfTen, "{}\n", file("suite")); }),
              HasSubstr("files found"));
}

/// What a table of facts says of curvature is what the surface has.
TEST_F(WrittenSuite, CurvatureIsThatOfItsSurface) {
  int compared = 0;
  const DrawnSuite some = suiteOf(SuiteSplit::test, "1", 30);
  writeSuite(some, "{}\n", file("suite"));
  for (const SuiteStudy& study : some.studies) {
    if (!study.facts.contains("kappa_height")) continue;
    const std::string kind = study.facts["surface"].value<std::string>().value();
    if (kind != "bezier" && kind != "b-spline") continue;
    const StudySpec read = readStudy(file("suite") / study.file);
    const surface::LimitSurface surface(read.cage);
    double largest = 0;
    for (int face = 0; face < surface.faceCount(); ++face) {
      const surface::LimitPoint point = surface.evaluate(face, 0.5, 0.5);
      const surface::TexelFrame frame = surface::texelFrame(point, read.relief.texelsPerUv());
      const surface::PrincipalCurvatures bends = surface::principalCurvatures(point);
      largest = std::max(largest, std::max(std::abs(bends.k1), std::abs(bends.k2)) *
                                      relief::worldPerHeight(read.relief.space, frame) *
                                      read.reliefSection.height);
    }
    // Middles of faces miss the extremes, which lie at corners.
    EXPECT_LE(largest, 1.01 * study.facts["kappa_height"].value<double>().value()) << study.file;
    EXPECT_GE(largest, 0.6 * study.facts["kappa_height"].value<double>().value()) << study.file;
    ++compared;
  }
  EXPECT_GE(compared, 4);
}

TEST_F(WrittenSuite, TrainVariesOneSettingAtATimeAndTestHasTheChosenOnes) {
  std::ofstream(file("chosen.toml")) << "[[method]]\nname = \"max-forsyth\"\n"
                                        "bake = { azimuths = 64 }\n";
  const SuiteMethods chosen = readSuiteMethods(standardMethodsFile(), file("chosen.toml"));
  DrawnScene scene;
  scene.study = toml::parse("base = { subdivisions = 3 }");
  scene.facts = toml::parse("view = 'camera'");
  const toml::array train = methodsOf(chosen, scene, SuiteSplit::train);
  const toml::array test = methodsOf(chosen, scene, SuiteSplit::test);
  EXPECT_EQ(train.size(), underPoints(chosen) + chosen.varied.size());
  EXPECT_EQ(test.size(), underPoints(chosen) + 1);
  const toml::table& last = *test.back().as_table();
  EXPECT_EQ(last["label"].value<std::string>(), "max-forsyth, chosen");
  EXPECT_EQ(last["bake"]["azimuths"].value<int>(), 64);
  std::set<std::string> labels;
  for (const toml::node& node : train) {
    const toml::table& method = *node.as_table();
    const auto label = method["label"].value<std::string>();
    labels.insert(label.value_or(method["name"].value<std::string>().value()));
    if (method["name"] == "shadow-volume" && !label) {
      EXPECT_EQ(method["base"]["subdivisions"].value<int>(), 27);
    }
    if (method["name"] == "two-scales" && !label) {
      EXPECT_EQ(method["base"]["subdivisions"].value<int>(), 12);
      EXPECT_EQ(method["parameters"]["light_pieces"].value<int>(), 27);
    }
  }
  EXPECT_EQ(labels.size(), train.size());
  EXPECT_TRUE(labels.contains("max-forsyth, azimuths 16"));
  EXPECT_TRUE(labels.contains("shadow-map, width 1.5"));
}

TEST(DrawnSurface, RefinedPointsAreTheSameSurface) {
  RandomStream random(3);
  std::vector<Vec3> points;
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 6; ++i) points.emplace_back(i, j, random.unit());
  }
  const surface::LimitSurface coarse(surface::makeBSpline(points, 6, 5));
  const surface::LimitSurface fine(surface::makeBSpline(refinedPoints(points, 6), 9, 7));
  ASSERT_EQ(coarse.faceCount(), 6);
  ASSERT_EQ(fine.faceCount(), 24);
  for (const Vec2 at : {Vec2(0.1, 0.2), Vec2(0.7, 0.4), Vec2(0.5, 0.9)}) {
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 3; ++column) {
        const Vec2 half = 2.0 * at;
        const glm::ivec2 which(half);
        const Vec3 expected = coarse.evaluate(row * 3 + column, at.x, at.y).position;
        const int face = (2 * row + which.y) * 6 + 2 * column + which.x;
        const Vec3 found = fine.evaluate(face, half.x - which.x, half.y - which.y).position;
        EXPECT_LT(glm::length(found - expected), 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::study
