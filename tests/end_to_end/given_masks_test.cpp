#include <gmock/gmock.h>

#include <filesystem>

#include "end_to_end/support/program.h"
#include "support/image_files.h"

// `[[method]] masks`: masks that another program drew are measured as a method's are.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

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

TEST_F(GivenMasks, HaveNoSettings) {
  expectRefusal(smallStudy() + given("mine", "mine") + "filter = \"exact\"\n",
                {"filter: unknown key, expected label, masks"});
  expectRefusal(smallStudy() + "\n[[method]]\nmasks = \"mine\"\nname = \"unshadowed\"\n",
                {"`name` found beside it"});
}

}  // namespace
}  // namespace gnomon::test
