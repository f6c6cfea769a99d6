#include <gmock/gmock.h>

#include <cmath>

#include "end_to_end/support/program.h"
#include "support/image_files.h"

namespace gnomon::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class Compare : public EndToEnd {
 protected:
  /// Two pictures of 8 × 4 pixels: the truth's left half in shadow, the candidate's a column more.
  void writeTwo() const {
    std::vector<float> truth, candidate;
    for (int i = 0; i < 32; ++i) {
      truth.push_back(i % 8 < 4 ? 0.0F : 1.0F);
      candidate.push_back(i % 8 < 5 ? 0.0F : 1.0F);
    }
    writePicture(file("truth.png"), {8, 4, {"Y"}, truth, OIIO::TypeDesc::UINT8});
    writePicture(file("mine.exr"), {8, 4, {"Y"}, candidate});
  }
  [[nodiscard]] nlohmann::json figures(std::vector<std::string> arguments, int status = 0) const {
    arguments.insert(arguments.begin(), "compare");
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome outcome = gnomon(arguments);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return nlohmann::json::parse(outcome.out);
  }
  void expectRefusal(std::vector<std::string> arguments, int status,
                     const std::vector<std::string>& mentions) const {
    arguments.insert(arguments.begin(), "compare");
    const Outcome outcome = gnomon(arguments);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, StartsWith("gnomon: "));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& text : mentions) EXPECT_THAT(outcome.err, HasSubstr(text));
  }
};

TEST_F(Compare, AStudysOwnMasksGiveItsOwnFigures) {
  runStudy("small", smallStudy());
  const nlohmann::json own = resultOf(summary("small"), "max-forsyth", "evening", "camera");
  const nlohmann::json found = figures({"out/small/masks/camera_evening_max-forsyth.png",
                                        "out/small/masks/camera_evening_truth.png"});
  ASSERT_GT(own.at("error_rate"), 0);
  for (const char* key : {"samples", "tp", "fp", "fn", "tn", "error_rate", "ber", "iou", "mcc",
                          "assd", "hd95", "boundary_iou_1", "surface_dice_1"}) {
    EXPECT_EQ(found.at(key), own.at(key)) << key;
  }
  EXPECT_EQ(found.at("without_sample").get<int>() + found.at("samples").get<int>(), 64 * 64);
  // And its interval, by the same blocks.
  for (const nlohmann::json& row : summary("small").at("confidence")) {
    if (row.at("method") != "max-forsyth") continue;
    EXPECT_FALSE(row.at("low").is_null());
    for (const char* key : {"low", "high", "reason", "blocks"}) {
      EXPECT_EQ(found.at("confidence").at(key), row.at(key)) << key;
    }
  }
}

TEST_F(Compare, TheTruthsUncertaintyIsTheExportsOrTheCommands) {
  writeTwo();
  write("small.toml", smallStudy());
  ASSERT_EQ(gnomon({"export", "small.toml"}).status, 0);
  const auto exported = nlohmann::json::parse(read("out/small/export/export.json"));
  const nlohmann::json stated = exported.at("views").at(0).at("masks").at(0).at("uncertainty");
  ASSERT_GT(stated, 0);
  const std::string truth = "out/small/export/masks/camera_evening_truth.png";
  EXPECT_EQ(figures({truth, truth}).at("uncertainty"), stated);
  EXPECT_EQ(figures({truth, truth, "--uncertainty", "0.3 %"}).at("uncertainty"), 0.003);
  EXPECT_TRUE(figures({"mine.exr", "truth.png"}).at("uncertainty").is_null());
  EXPECT_THAT(gnomon({"compare", "mine.exr", "truth.png", "--uncertainty", "0.05"}).out,
              HasSubstr("The truth is uncertain by 5.00 %"));
  for (const char* share : {"x", "2"}) {
    expectRefusal({"mine.exr", "truth.png", std::string("--uncertainty=") + share}, 2,
                  {"--uncertainty", "a share expected"});
  }
}

TEST_F(Compare, FoldersAreComparedNameByName) {
  writeTwo();
  const std::vector<std::string> one = {"mine.exr", "truth.png"};
  for (const char* folder : {"mine", "truths"}) std::filesystem::create_directory(file(folder));
  const auto copy = [&](const char* from, const char* to) {
    std::filesystem::copy_file(file(from), file(to));
  };
  copy("mine.exr", "mine/first.exr");
  copy("truth.png", "truths/first_truth.png");
  copy("truth.png", "mine/second.png");
  copy("truth.png", "truths/second.png");
  const nlohmann::json found = figures({"mine", "truths"});
  EXPECT_EQ(found.at("schema"), "gnomon-comparisons/1");
  ASSERT_EQ(found.at("pairs").size(), 2U);
  nlohmann::json alone = figures(one);
  for (const char* key : {"error_rate", "fp", "tn", "iou", "hd95", "confidence"}) {
    EXPECT_EQ(found.at("pairs").at(0).at(key), alone.at(key)) << key;
  }
  EXPECT_EQ(found.at("pairs").at(0).at("name"), "first");
  EXPECT_EQ(found.at("pairs").at(1).at("error_rate"), 0);
  EXPECT_EQ(found.at("all").at("samples"), 64);
  EXPECT_EQ(found.at("all").at("fp"), 4);
  EXPECT_EQ(found.at("all").at("error_rate"), 4.0 / 64);
  const Outcome table = gnomon({"compare", "mine", "truths", "--max", "error_rate=10 %"});
  EXPECT_EQ(table.status, 1);
  EXPECT_THAT(table.out, AllOf(HasSubstr("first"), HasSubstr("12.50"), HasSubstr("all 2"),
                               HasSubstr("6.25"), HasSubstr("Gates: 1 of 2 met"),
                               HasSubstr("first: error_rate is 12.5 %, at most 10 % allowed")));
}

TEST_F(Compare, FoldersOfTwoLightsHaveTheIntervalOfTheRun) {
  const std::string second = "\n[[light]]\nname = \"noon\"\nazimuth = 100\nelevation = 45\n";
  runStudy("small", smallStudy() + second);
  for (const char* light : {"evening", "noon"}) {
    for (const char* who : {"max-forsyth", "truth"}) {
      std::filesystem::create_directories(file(who));
      std::filesystem::copy_file(
          file(std::string("out/small/masks/camera_") + light + "_" + who + ".png"),
          file(std::string(who) + "/" + light + ".png"));
    }
  }
  const nlohmann::json all = figures({"max-forsyth", "truth"}).at("all");
  for (const nlohmann::json& row : summary("small").at("confidence")) {
    if (row.at("method") != "max-forsyth" || row.at("light") != "all") continue;
    EXPECT_EQ(all.at("error_rate"), row.at("error_rate"));
    ASSERT_FALSE(row.at("low").is_null());
    for (const char* key : {"low", "high", "blocks"}) {
      EXPECT_EQ(all.at("confidence").at(key), row.at(key)) << key;
    }
  }
}

// A result in the place of what was compared would be read as a mask the next time.
TEST_F(Compare, ResultsReplaceNothingThatIsRead) {
  writeTwo();
  namespace fs = std::filesystem;
  for (const char* folder : {"export", "export/masks", "mine"}) fs::create_directory(file(folder));
  fs::copy_file(file("truth.png"), file("export/masks/a.png"));
  fs::copy_file(file("truth.png"), file("mine/a.png"));
  write("export/export.json", "{\"views\": []}");
  fs::copy_file(file("truth.png"), file("roi.png"));
  fs::create_symlink("truth.png", file("link.json"));
  const std::string before = read("truth.png");
  const std::vector<std::string> two = {"mine.exr", "truth.png", "--roi", "roi.png"};
  const auto refuse = [&](std::vector<std::string> words, const std::string& option,
                          const std::string& output) {
    words.insert(words.end(), {option, output});
    expectRefusal(words, 2, {option + " " + output + ": the command reads this file"});
  };
  for (const char* output : {"truth.png", "./mine.exr", "roi.png", "link.json"}) {
    refuse(two, "--json", output);
  }
  refuse(two, "--difference", "truth.png");
  refuse(two, "--difference", "roi.png");
  refuse({"mine", "export/masks"}, "--json", "mine/a.png");
  refuse({"mine", "export/masks"}, "--json", "export/export.json");
  expectRefusal({"mine.exr", "truth.png", "--json", "./d.png", "--difference", "d.png"}, 2,
                {"--json ./d.png: --difference writes this file too"});
  EXPECT_EQ(read("truth.png"), before);
  EXPECT_EQ(read("export/export.json"), "{\"views\": []}");
  EXPECT_FALSE(fs::exists(file("d.png")));
}

TEST_F(Compare, WhatFileManagersLeaveInAFolderIsNoMask) {
  writeTwo();
  for (const char* folder : {"mine", "truths"}) {
    std::filesystem::create_directory(file(folder));
    std::filesystem::copy_file(file("truth.png"), file(std::string(folder) + "/a.png"));
  }
  for (const char* name : {"mine/Thumbs.db", "mine/desktop.ini", "truths/.DS_Store",
                           "truths/._a.png", "truths/DESKTOP.INI"}) {
    write(name, "no picture");
  }
  EXPECT_EQ(figures({"mine", "truths"}).at("pairs").size(), 1U);
}

TEST_F(Compare, FoldersMustHoldTheSameNames) {
  writeTwo();
  for (const char* folder : {"mine", "truths", "none"}) {
    std::filesystem::create_directory(file(folder));
  }
  std::filesystem::copy_file(file("mine.exr"), file("mine/a.exr"));
  std::filesystem::copy_file(file("truth.png"), file("truths/b_truth.png"));
  expectRefusal({"mine", "truths"}, 3, {"mine lacks b_truth.png", "truths lacks a.exr"});
  expectRefusal({"none", "none"}, 3, {"none: no mask found"});
  expectRefusal({"mine", "truth.png"}, 3, {"mine: a folder found", "two pictures or two folders"});
  expectRefusal({"mine", "truths", "--difference", "d.png"}, 2, {"--difference", "two folders"});
  std::filesystem::copy_file(file("truth.png"), file("mine/a.png"));
  expectRefusal({"mine", "truths"}, 3, {"mine/a.exr: a.png found beside it"});
}

TEST_F(Compare, FiguresOfTwoFormatsByHand) {
  writeTwo();
  const nlohmann::json found = figures({"mine.exr", "truth.png"});
  EXPECT_EQ(found.at("error_rate"), 4.0 / 32);
  EXPECT_EQ(found.at("false_shadow"), 4.0 / 32);
  EXPECT_EQ(found.at("false_light"), 0);
  EXPECT_EQ(found.at("iou"), 16.0 / 20);
  EXPECT_EQ(found.at("assd"), 1);
  EXPECT_EQ(found.at("surface_dice_1"), 1);
  EXPECT_EQ(found.at("status"), "pass");
  EXPECT_THAT(found.at("command").get<std::string>(), StartsWith("gnomon compare mine.exr"));
  // What shadows everything that is lit and the other way round is always wrong.
  EXPECT_EQ(figures({"mine.exr", "truth.png", "--invert"}).at("error_rate"), 28.0 / 32);
}

TEST_F(Compare, GatesDecideTheExitStatus) {
  writeTwo();
  const auto status = [&](const std::vector<std::string>& gates) {
    std::vector<std::string> arguments = {"compare", "mine.exr", "truth.png"};
    arguments.insert(arguments.end(), gates.begin(), gates.end());
    return gnomon(arguments).status;
  };
  EXPECT_EQ(status({"--max", "error_rate=0.125"}), 0);
  EXPECT_EQ(status({"--min", "iou=0.8", "--max", "assd=1"}), 0);
  EXPECT_EQ(status({"--min", "iou=0.81", "--max", "assd=1"}), 1);
  // A gate on what is not defined fails: the region holds no shadow of the truth's.
  std::vector<float> right(32, 1);
  for (std::size_t i = 0; i < 32; i += 8) std::fill_n(right.begin() + std::ptrdiff_t(i), 4, 0.0F);
  writePicture(file("roi.png"), {8, 4, {"Y"}, right});
  EXPECT_EQ(status({"--roi", "roi.png", "--max", "fnr=0.9"}), 1);
}

TEST_F(Compare, WritesTheTableTheFiguresAndTheDifference) {
  writeTwo();
  const Outcome outcome = gnomon({"compare", "mine.exr", "truth.png", "--json", "f/figures.json",
                                  "--difference", "f/difference.png", "--max", "iou=0.5"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("mine.exr against truth.png"), HasSubstr("12.5 %"),
                                 HasSubstr("iou is 80 %, at most 50 % allowed")));
  EXPECT_EQ(nlohmann::json::parse(read("f/figures.json")).at("status"), "fail");
  const GreyImage red = readGrey(file("f/difference.png"));
  EXPECT_EQ(red.pixels[4], 230) << "false shadow is orange";
  EXPECT_EQ(red.pixels[3], 92);
  EXPECT_EQ(red.pixels[5], 226);
  EXPECT_EQ(filesBelow("f"), (std::vector<std::string>{"difference.png", "figures.json"}));
}

TEST_F(Compare, PicturesThatCannotBeComparedAreBadInput) {
  writeTwo();
  writePicture(file("small.png"), {4, 4, {"Y"}, std::vector<float>(16), OIIO::TypeDesc::UINT8});
  writePicture(file("dark.png"), {8, 4, {"Y"}, std::vector<float>(32), OIIO::TypeDesc::UINT8});
  std::vector<float> soft;
  for (int i = 0; i < 32; ++i) soft.push_back(static_cast<float>(i % 8) / 7);
  writePicture(file("soft.exr"), {8, 4, {"Y"}, soft});
  expectRefusal({"none.exr", "truth.png"}, 3, {"none.exr", "no such file"});
  expectRefusal({"small.png", "truth.png"}, 3, {"small.png against truth.png", "4 × 4", "8 × 4"});
  expectRefusal({"mine.exr", "truth.png", "--roi", "dark.png"}, 3,
                {"region of interest: no pixel is white"});
  expectRefusal({"soft.exr", "truth.png"}, 3,
                {"soft.exr", "24 of 32 pixels", "column 1, row 0", "--binarise"});
  EXPECT_EQ(figures({"soft.exr", "truth.png", "--binarise", "0.5"}).at("error_rate"), 0);
  expectRefusal({"mine.exr", "truth.png", "--channel", "Z"}, 3, {"no channel \"Z\", it has Y"});
}

TEST_F(Compare, WhatIsAskedForWronglyIsAUsageError) {
  writeTwo();
  expectRefusal({"mine.exr"}, 2, {"TRUTH"});
  expectRefusal({"mine.exr", "truth.png", "--max", "eror_rate=1"}, 2,
                {"\"eror_rate\"", "error_rate, false_shadow", "surface_dice_4"});
  expectRefusal({"mine.exr", "truth.png", "--max", "iou"}, 2, {"METRIC=VALUE"});
  for (const char* value : {"iou=x", "iou=nan"}) {
    expectRefusal({"mine.exr", "truth.png", "--min", value}, 2, {"a number expected"});
  }
  for (const char* value : {"0", "nan"}) {
    expectRefusal({"mine.exr", "truth.png", std::string("--binarise=") + value}, 2, {"--binarise"});
  }
  expectRefusal({"mine.exr", "truth.png", "--difference", "d.jpg"}, 2, {".png"});
}

}  // namespace
}  // namespace gnomon::test
