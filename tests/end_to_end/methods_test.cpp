#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "end_to_end/support/program.h"
#include "support/image_files.h"

// A method is one GLSL file and no C++: files of this folder run as the built-in ones do.
// `[[method]] masks`: masks that another program drew are measured as a method's are.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class OwnMethod : public SharedRuns {
 protected:
  void prepare() override {
    write("mine.glsl", R"(/* gnomon-method
title = "Always dark"
citation = "a test"
*/
bool isShadowed(Pixel pixel, LocalLight light) { return true; }
)");
    runStudy("small",
             smallStudy() + method("biased-horizon") +
                 method("biased-horizon", "label = \"dark\"\nparameters = {bias = 2.0}\n") +
                 method("biased-horizon", "label = \"light\"\nparameters = {bias = -2}\n") +
                 method("inverted-max-forsyth") + method("texture-checks") +
                 "\n[[method]]\nfile = \"mine.glsl\"\n");
  }
  [[nodiscard]] static std::string method(const std::string& file, const std::string& more = {}) {
    return "\n[[method]]\nfile = \"" GNOMON_OWN_METHODS "/" + file + ".glsl\"\n" + more;
  }
  [[nodiscard]] double error(const std::string& label, const std::string& answer = "drawn") const {
    return resultOf(summary("small"), label, "evening", "camera", "all", answer).at("error_rate");
  }
};

TEST_F(OwnMethod, RunsWithItsParameter) {
  EXPECT_EQ(error("biased-horizon"), error("max-forsyth")) << "without bias they are the same";
  EXPECT_EQ(mask("small", "camera_evening_biased-horizon").pixels,
            mask("small", "camera_evening_max-forsyth").pixels);
  // The light's slope is tan 30°, so a horizon raised by 2 hides it everywhere; nor can a horizon
  // lowered by 2 hide it at the foot of a column 4 high, but in the last texel.
  const nlohmann::json dark = resultOf(summary("small"), "dark", "evening", "camera");
  EXPECT_EQ(dark.at("fn"), 0);
  EXPECT_EQ(dark.at("tn"), 0);
  const nlohmann::json light = resultOf(summary("small"), "light", "evening", "camera");
  EXPECT_LT(
      light.at("tp"),
      0.5 * resultOf(summary("small"), "max-forsyth", "evening", "camera").at("tp").get<double>());
}

TEST_F(OwnMethod, IsDescribedByItsOwnDeclaration) {
  const nlohmann::json described = summary("small").at("methods").at(2);
  EXPECT_EQ(described.at("name"), "biased-horizon");
  EXPECT_EQ(described.at("title"), "Flat horizon map with a bias");
  EXPECT_EQ(described.at("citation"), "a user's own file");
}

TEST_F(OwnMethod, ThatAnswersTheOppositeHasTheOppositeError) {
  EXPECT_DOUBLE_EQ(error("inverted-max-forsyth", "test"), 1 - error("max-forsyth", "test"));
  EXPECT_GT(error("inverted-max-forsyth", "test"), 0.5);
  // On the masks themselves, too.
  const GreyImage plain = mask("small", "test/camera_evening_max-forsyth");
  const GreyImage inverted = mask("small", "test/camera_evening_inverted-max-forsyth");
  for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
    ASSERT_EQ(plain.pixels[i] + inverted.pixels[i], plain.pixels[i] == 128 ? 256 : 255) << i;
  }
}

TEST_F(OwnMethod, IsFoundBesideTheStudy) {
  const nlohmann::json result = resultOf(summary("small"), "mine", "evening", "camera");
  EXPECT_EQ(result.at("fnr"), 0);
  EXPECT_EQ(result.at("fpr"), 1);
  // It declares no table, so none is charged to it.
  EXPECT_EQ(summary("small").at("cost").at(7).at("table_bytes"), 0);
}

TEST_F(OwnMethod, HasATexturePassOfItsOwn) {
  const GreyImage image = mask("small", "test/camera_evening_texture-checks");
  std::size_t seen = 0;
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const unsigned char pixel =
          image.pixels[static_cast<std::size_t>(row * image.width + column)];
      if (pixel == 128) continue;
      // The camera stands 80 above a plane of 32 × 32 texels, one world unit each.
      const double reach = 80 * std::tan(15 * 3.14159265358979 / 180);
      const double x = 16 + reach * (2 * (column + 0.5) / image.width - 1);
      const double y = 16 + reach * (1 - 2 * (row + 0.5) / image.height);
      const auto nearEdge = [](double at) { return std::abs(at / 8 - std::round(at / 8)) < 0.07; };
      if (nearEdge(x) || nearEdge(y)) continue;  // between texels the value is bilinear
      ++seen;
      const bool dark = static_cast<int>(std::floor(x / 8) + std::floor(y / 8)) % 2 == 1;
      ASSERT_EQ(pixel, dark ? 0 : 255) << column << " " << row;
    }
  }
  EXPECT_GT(seen, 1000U);
  // 32² texels, each a value and a mark, in floats.
  EXPECT_EQ(summary("small").at("cost").at(6).at("table_bytes"), 32 * 32 * 8);
}

TEST_F(OwnMethod, AllWithAnotherBaseMeshThanTheStudys) {
  runStudy("other", replaced(smallStudy(), "\"small\"", "\"other\""),
           {"--set", "method.0.base.subdivisions=2", "--set", "method.1.base.subdivisions=3"});
  EXPECT_EQ(summary("other").at("cost").at(0).at("polygons"), 4 * 4 * 2 * 4);
  EXPECT_EQ(summary("other").at("cost").at(1).at("polygons"), 4 * 4 * 2 * 9);
}

class GivenMasks : public EndToEnd {
 protected:
  static std::string given(const std::string& masks, const std::string& label) {
    return "\n[[method]]\nmasks = \"" + masks + "\"\nlabel = \"" + label + "\"\n";
  }
  void exportSmall() const {
    write("small.toml", smallStudy());
    const Outcome outcome = gnomon({"export", "small.toml"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  /// A picture of grey values, 0 to 255.
  void writeGrey(const std::string& name, const GreyImage& image) const {
    fs::create_directories(file(name).parent_path());
    std::vector<float> values;
    for (const unsigned char pixel : image.pixels) values.push_back(float(pixel) / 255);
    writePicture(file(name), {image.width, image.height, {"Y"}, values, OIIO::TypeDesc::UINT8});
  }
  [[nodiscard]] GreyImage exportedTruth() const {
    return readGrey(file("out/small/export/masks/camera_evening_truth.png"));
  }
  [[nodiscard]] nlohmann::json row(const std::string& label) const {
    return resultOf(summary("small"), label, "evening", "camera");
  }
  void expectRefusal(const std::string& study, const std::vector<std::string>& mentions) const {
    write("small.toml", study);
    const Outcome outcome = gnomon({"run", "small.toml"});
    EXPECT_EQ(outcome.status, 3);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& text : mentions) EXPECT_THAT(outcome.err, HasSubstr(text));
  }
};

TEST_F(GivenMasks, OfTheTruthAreNeverWrongAndTheirComplementAlwaysIs) {
  exportSmall();
  GreyImage opposite = exportedTruth();
  for (unsigned char& pixel : opposite.pixels) {
    if (pixel != 128) pixel = static_cast<unsigned char>(255 - pixel);
  }
  writeGrey("opposite/camera_evening.png", opposite);
  fs::rename(file("out/small/export/masks"), file("exported"));
  runStudy("small", smallStudy() + given("exported", "right") + given("opposite/", "wrong"));
  EXPECT_EQ(row("right").at("error_rate"), 0);
  EXPECT_EQ(row("right").at("iou"), 1);
  EXPECT_EQ(row("wrong").at("error_rate"), 1);
  EXPECT_EQ(row("wrong").at("iou"), 0);
  ASSERT_GT(row("max-forsyth").at("error_rate"), 0) << "the methods beside them still are wrong";
}

TEST_F(GivenMasks, OfAMethodGiveTheMethodsOwnFigures) {
  runStudy("small", smallStudy());
  fs::create_directories(file("other"));
  fs::copy_file(file("out/small/masks/camera_evening_max-forsyth.png"),
                file("other/camera_evening.png"));
  runStudy("small", smallStudy() + given("other", "copy"));
  const nlohmann::json all = summary("small");
  std::size_t regions = 0;
  for (nlohmann::json own : all.at("results")) {
    if (own.at("method") != "max-forsyth" || own.at("answer") != "drawn") continue;
    own["method"] = "copy";
    EXPECT_EQ(resultOf(all, "copy", "evening", "camera", own.at("region")), own);
    ++regions;
  }
  EXPECT_GT(regions, 1U);
  const auto interval = [&](const std::string& label) {
    for (nlohmann::json row : all.at("confidence")) {
      if (row.at("method") == label) return row.erase("method"), row;
    }
    return nlohmann::json();
  };
  EXPECT_EQ(interval("copy"), interval("max-forsyth"));
  EXPECT_FALSE(interval("copy").is_null());
  EXPECT_EQ(mask("small", "camera_evening_copy").pixels,
            mask("small", "camera_evening_max-forsyth").pixels);
  EXPECT_TRUE(fs::exists(file("out/small/images/camera_evening_copy_difference.png")));
}

TEST_F(GivenMasks, AreJudgedAndRecordedButNotTimed) {
  exportSmall();
  write("small.toml",
        smallStudy() + given("out/small/export/masks", "other") +
            "\n[[threshold]]\nmethod = \"other\"\nmetric = \"error_rate\"\nmax = 0.01\n"
            "\n[[threshold]]\nmethod = \"unshadowed\"\nmetric = \"error_rate\"\n"
            "max = 0.01\n");
  EXPECT_EQ(gnomon({"run", "small.toml", "--out", "judged"}).status, 0);
  const nlohmann::json all = summary("small", "judged");
  EXPECT_EQ(all.at("thresholds").at(0).at("passed"), true);
  EXPECT_EQ(all.at("thresholds").at(1).at("passed"), false) << "the control fails";
  for (const nlohmann::json& cost : all.at("cost")) EXPECT_NE(cost.at("method"), "other");
  EXPECT_THAT(all.at("notices").dump(), HasSubstr("other: another program drew the masks"));
  const auto& inputs = all.at("study").at("inputs");
  EXPECT_TRUE(std::any_of(inputs.begin(), inputs.end(), [](const nlohmann::json& input) {
    return input.at("kind") == "mask" &&
           input.at("file") == "../../out/small/export/masks/camera_evening_truth.png";
  })) << inputs.dump();
  // The study's copy finds them again.
  EXPECT_EQ(gnomon({"run", "judged/small/small.toml", "--out", "again"}).status, 0);
  EXPECT_EQ(summary("small", "again").at("results"), all.at("results"));
}

TEST_F(GivenMasks, ThatDoNotFitAreRefusedWithTheirFile) {
  exportSmall();
  const std::string study = smallStudy() + given("mine", "mine");
  expectRefusal(study, {"mine: No such file or directory, a folder of masks expected"});
  fs::create_directories(file("mine"));
  expectRefusal(study,
                {"mine/camera_evening.png: missing", "view \"camera\"", "light \"evening\""});
  GreyImage truth = exportedTruth();
  writeGrey("mine/camera_evening.png",
            {truth.width, 1, {truth.pixels.begin(), truth.pixels.begin() + truth.width}});
  expectRefusal(study, {"mine/camera_evening.png: 64 × 1 pixels found, 64 × 64 expected"});
  const auto first = std::find_if(truth.pixels.begin(), truth.pixels.end(),
                                  [](unsigned char pixel) { return pixel != 128; });
  ASSERT_NE(first, truth.pixels.end());
  *first = 128;
  const auto at = first - truth.pixels.begin();
  writeGrey("mine/camera_evening.png", truth);
  expectRefusal(study, {"mine/camera_evening.png: no answer at 1 of the",
                        "column " + std::to_string(at % 64) + ", row " + std::to_string(at / 64)});
  writeGrey("mine/camera_evening_truth.tif", truth);
  expectRefusal(study, {"mine/camera_evening.png: camera_evening_truth.tif found beside it"});
}

// Each case of a sweep is told by its own folder: the truth's masks are right in each, and would be
// wrong in the other.
TEST_F(GivenMasks, OfASweepHaveAFolderForEachCase) {
  const std::string sweep = "\n[sweep]\nkey = \"relief.height\"\nvalues = [2, 4]\n";
  write("small.toml", smallStudy() + sweep);
  ASSERT_EQ(gnomon({"export", "small.toml"}).status, 0);
  for (const std::string one : {"2", "4"}) {
    fs::create_directories(file("mine"));
    fs::rename(file("out/small/" + one + "/export/masks"), file("mine/" + one));
  }
  EXPECT_NE(read("mine/2/camera_evening_truth.png"), read("mine/4/camera_evening_truth.png"));
  runStudy("small", smallStudy() + given("mine", "right") + sweep);
  for (const std::string one : {"2", "4"}) {
    const nlohmann::json found = summary("small/" + one);
    EXPECT_EQ(resultOf(found, "right", "evening", "camera").at("error_rate"), 0) << one;
    EXPECT_GT(resultOf(found, "unshadowed", "evening", "camera").at("error_rate"), 0);
    EXPECT_EQ(found.at("methods").back().at("name"), "mine");
  }
  // The copies of the sweep and of a case find them, too.
  EXPECT_EQ(gnomon({"run", "out/small/4/small-4.toml", "--out", "one"}).status, 0);
  EXPECT_EQ(gnomon({"run", "out/small/small.toml", "--out", "again"}).status, 0);
  EXPECT_EQ(summary("small/4", "again").at("results"), summary("small/4").at("results"));
  const auto exchanged = file("mine/3");
  fs::rename(file("mine/2"), exchanged);
  fs::rename(file("mine/4"), file("mine/2"));
  fs::rename(exchanged, file("mine/4"));
  runStudy("small", smallStudy() + given("mine", "right") + sweep);
  EXPECT_GT(resultOf(summary("small/2"), "right", "evening", "camera").at("error_rate"), 0);
}

TEST_F(GivenMasks, OfASweepAreAllThereBeforeItsFirstCase) {
  const std::string sweep = "\n[sweep]\nkey = \"relief.height\"\nvalues = [2, 4]\n";
  write("small.toml", smallStudy() + sweep);
  ASSERT_EQ(gnomon({"export", "small.toml"}).status, 0);
  fs::create_directories(file("mine"));
  fs::rename(file("out/small/2/export/masks"), file("mine/2"));
  fs::remove_all(file("out"));
  const std::string study = smallStudy() + given("mine", "mine") + sweep;
  expectRefusal(study, {"small.toml: small/4: ",
                        "mine/4: No such file or directory, a folder of masks expected"});
  EXPECT_FALSE(fs::exists(file("out/small/2/summary.json"))) << "no case has run";
  fs::create_directories(file("mine/4"));
  expectRefusal(study, {"small.toml: small/4: ", "mine/4/camera_evening.png: missing"});
}

/// Columns on a small sphere; occluders farther than 8 texels are distant.
std::string budgetStudy() {
  return R"([study]
name = "budget"
title = "Columns"
source = "a test"
frames = 0
[surface]
shape = "sphere"
curvature = 0.02
size = [48, 48]
quads = [24, 24]

[relief]
pattern = "columns"
texels = [48, 48]
period = 16
radius = 4
height = 5
height_space = "world"
wrap = "clamp"

[bake]
azimuths = 8
radius = 8

[[view]]
type = "atlas"
samples = 7

[[light]]
azimuth = 20
elevation = [40, 15]

[[method]]
name = "max-forsyth"

[[method]]
name = "onoue-2004"
)";
}

std::string ladderOf(const std::string& method, const std::string& start) {
  return "\n[[ladder]]\nmethod = \"" + method + "\"\nfile = \"" + GNOMON_SCENES +
         "/methods/horizon-ladder.glsl\"\n" + start + R"(
[[ladder.rung]]
cause = "azimuths"
set = { bake = { azimuths = 64 } }

[[ladder.rung]]
cause = "interpolation"
set = { parameters = { resampled = 1 } }

[[ladder.rung]]
cause = "mesh"
set = { base = { subdivisions = 2 } }
)";
}

double shareOf(const nlohmann::json& part) {
  return part.at("share").get<double>();
}

/// One run of two ladders and of the state in which the first one ends, as a method of its own.
class BudgetRun : public SharedRuns {
 protected:
  void prepare() override {
    const std::string states = std::string("\n[[method]]\nlabel = \"end\"\nfile = \"") +
                               GNOMON_SCENES +
                               "/methods/horizon-ladder.glsl\"\nbake = { azimuths = 64 }\n"
                               "parameters = { resampled = 1 }\nbase = { subdivisions = 2 }\n";
    runStudy("budget", budgetStudy() + states + ladderOf("onoue-2004", "") +
                           ladderOf("max-forsyth", "parameters = { curved = 0 }"));
  }
};

TEST_F(BudgetRun, AddsUpToTheErrorOfTheMethod) {
  const nlohmann::json json = summary("budget");
  // Both lights together, then each of them.
  ASSERT_EQ(json.at("budget").size(), 6U);
  std::vector<double> ofLights;
  for (const nlohmann::json& budget : json.at("budget")) {
    const std::string light = budget.at("light");
    const double total = shareOf(budget.at("total"));
    for (const char* way : {"forward", "backward"}) {
      double sum = 0;
      for (const char* rest : {"global", "distant", "seam", "other"}) {
        sum += shareOf(budget.at(rest));
      }
      for (const nlohmann::json& cause : budget.at("causes")) sum += shareOf(cause.at(way));
      EXPECT_NEAR(sum, total, 1e-15) << light << " " << way;
    }
    // As few as give 144 of equal weight; those at the border may be slivers.
    EXPECT_GE(budget.at("blocks"), 144);
    EXPECT_LE(budget.at("blocks"), 256);
    if (budget.at("method") != "onoue-2004") continue;
    if (light == "all") continue;
    ofLights.push_back(total);
    EXPECT_NEAR(total, resultOf(json, "onoue-2004", light, "atlas").at("error_rate").get<double>(),
                1e-12);
  }
  ASSERT_EQ(ofLights.size(), 2U);
  EXPECT_NEAR(shareOf(json.at("budget").at(0).at("total")), (ofLights[0] + ofLights[1]) / 2, 1e-12);
  // Of 8 azimuths and linear tables, something is the tables' fault.
  const nlohmann::json& causes = json.at("budget").at(0).at("causes");
  EXPECT_GT(shareOf(causes.at(1).at("forward")), 0.005);
  EXPECT_EQ(causes.at(1).at("forward").at("distinguishable"), true);
}

/// What is left at the end is what the last state's own run leaves, region by region.
TEST_F(BudgetRun, EveryStateIsAMethodOfItsOwn) {
  const nlohmann::json json = summary("budget");
  nlohmann::json budget;
  for (const nlohmann::json& each : json.at("budget")) {
    if (each.at("method") == "onoue-2004" && each.at("light") != "all") budget = each;
  }
  const std::string light = budget.at("light");
  const nlohmann::json end = resultOf(json, "end", light, "atlas");
  const auto rate = [&](const char* name) { return end.at(name).get<double>(); };
  const nlohmann::json& last = budget.at("forward_states").at(3);
  for (const char* name : {"error_rate", "false_shadow", "false_light"}) {
    EXPECT_NEAR(last.at(name).get<double>(), rate(name), 1e-12) << name;
    EXPECT_EQ(last.at(name), budget.at("backward_states").at(3).at(name));
  }
  const nlohmann::json distant = resultOf(json, "end", light, "atlas", "distant");
  const double all = end.at("tp").get<double>() + end.at("fp").get<double>() +
                     end.at("fn").get<double>() + end.at("tn").get<double>();
  ASSERT_GT(distant.at("fn").get<double>(), 0);
  EXPECT_NEAR(shareOf(budget.at("distant")), distant.at("fn").get<double>() / all, 1e-12);
  EXPECT_EQ(filesBelow("out/budget/masks/ladders").size(), 2U * 2U * 6U);
}

TEST_F(BudgetRun, IsInEveryReport) {
  EXPECT_THAT(read("out/budget/budget.csv"), HasSubstr("\nonoue-2004,atlas,all,interpolation,"));
  const std::string page = read("out/budget/report.html");
  const std::size_t section = page.find("<section id=\"budget\">");
  ASSERT_NE(section, std::string::npos);
  EXPECT_THAT(page.substr(section, page.find("</section>", section) - section),
              HasSubstr("interpolation"));
}

TEST_F(BudgetRun, ALadderMustBeginAtItsMethod) {
  write("budget.toml", budgetStudy() + ladderOf("max-forsyth", ""));
  const Outcome outcome = gnomon({"run", "budget.toml", "--out", "wrong"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("budget.toml: ladder \"max-forsyth\": its first state"),
                                 HasSubstr("samples, none expected")));
}

}  // namespace
}  // namespace gnomon::test
