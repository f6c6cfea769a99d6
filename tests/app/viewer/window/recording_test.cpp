#include <fmt/core.h>
#include <gmock/gmock.h>

#include "app/viewer/viewer_window.h"

// A light path, played in the window and recorded with it and without.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Recording : public ViewerWindow {
 protected:
  void SetUp() override {
    ViewerWindow::SetUp();
    fs::create_directory(folder() / "bin");
  }
  /// A program in place of ffmpeg, the only one on the PATH.
  void installFfmpeg(const std::string& script) const {
    write("bin/ffmpeg", "#!/bin/sh\n" + script);
    fs::permissions(folder() / "bin/ffmpeg", fs::perms::owner_all);
  }
  [[nodiscard]] std::string path() const { return "PATH=" + (folder() / "bin").string(); }
  /// Three frames from azimuth 20 and elevation 30 to 60 and 50.
  [[nodiscard]] Outcome record(const std::string& into) const {
    return gnomon({"view", "ball.toml", "--no-panel", "--show", "max-forsyth", "--width", "240",
                   "--height", "200", "--set", "bake.radius=40", "--light-path", "20,30,60,50",
                   "--light-frames", "3", "--record", into},
                  {path()});
  }
};

TEST_F(Recording, HasAPictureOfEveryLightAndAFilmWhereFfmpegIs) {
  // It tells what it was asked for, in the file that it is to write.
  installFfmpeg(
      "for last; do :; done\necho \"$@\" > \"${last#file:}\"\n/bin/ls >> \"${last#file:}\"\n");
  const Outcome outcome = record("film");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "saved 3 pictures and light.webm in film\n");
  EXPECT_THAT(filesBelow("film"),
              ElementsAre("frame-0001.png", "frame-0002.png", "frame-0003.png", "light.webm"));
  EXPECT_THAT(read("film/light.webm"), HasSubstr("-framerate 12 -i frame-%04d.png"));
  EXPECT_THAT(read("film/light.webm"), HasSubstr("frame-0003.png")) << "begun before the last one";

  // Each picture is what the viewer shows under that light. By itself a study of that light would
  // search horizons less far.
  const Outcome middle =
      gnomon({"view", "ball.toml", "--no-panel", "--show", "max-forsyth", "--width", "240",
              "--height", "200", "--set", "light.0.azimuth=40", "--set", "light.0.elevation=40",
              "--set", "bake.radius=40", "--screenshot", "middle.png"});
  ASSERT_EQ(middle.status, 0) << middle.err;
  EXPECT_EQ(differingPixels(folder() / "film/frame-0002.png", folder() / "middle.png"), 0U);
  EXPECT_GT(differingPixels(folder() / "film/frame-0001.png", folder() / "middle.png"), 100U);

  // What is there is not mixed with another recording.
  const std::string film = read("film/light.webm");
  const Outcome again = record("film");
  EXPECT_EQ(again.status, 3);
  EXPECT_THAT(again.err, HasSubstr("film: holds files"));
  EXPECT_EQ(read("film/light.webm"), film);
}

TEST_F(Recording, KeepsItsPicturesWhereThereIsNoFilm) {
  const Outcome without = record("without");
  EXPECT_EQ(without.status, 0) << without.err;
  EXPECT_EQ(without.out, "saved 3 pictures in without; no film, since ffmpeg was not found\n");
  EXPECT_EQ(filesBelow("without").size(), 3U);

  installFfmpeg(
      "for last; do :; done\necho half > \"${last#file:}\"\necho no such codec >&2\n"
      "exit 1\n");
  const Outcome failed = record("failed");
  EXPECT_EQ(failed.status, 0) << failed.err;
  EXPECT_EQ(failed.out, "saved 3 pictures in failed; no film: ffmpeg: no such codec\n");
  EXPECT_EQ(filesBelow("failed"), filesBelow("without")) << "half a film";

  const Outcome wrong = gnomon({"view", "ball.toml", "--light-path", "1,2,3", "--record", "none"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("--light-path 1,2,3"));
  EXPECT_FALSE(fs::exists(folder() / "none"));
}

TEST_F(Recording, IsMadeAndPlayedInTheWindow) {
  installFfmpeg("exit 1\n");
  DrivenViewer viewer = open(
      {"--width", "700", "--height", "700", "--light-path", "20,30,60,50", "--light-frames", "3"},
      {path()});
  ASSERT_TRUE(viewer.waitUntilComplete()) << viewer.output();
  const json before = viewer.status();
  viewer.clickControl("path");
  ASSERT_TRUE(
      viewer.waitFor([](const json& now) { return now.at("controls").contains("path.record"); }));
  viewer.clickControl("path.record");
  EXPECT_TRUE(viewer.waitFor([](const json& now) {
    return now.at("notice").at("text").get<std::string>().starts_with(
        "saved 3 pictures in out/ball/view/path-1; no film: ffmpeg: ");
  })) << viewer.status().dump(2);
  EXPECT_THAT(filesBelow("out/ball/view/path-1"),
              ElementsAre("frame-0001.png", "frame-0002.png", "frame-0003.png"));
  EXPECT_GT(differingPixels(folder() / "out/ball/view/path-1/frame-0001.png",
                            folder() / "out/ball/view/path-1/frame-0003.png"),
            1000U);
  EXPECT_TRUE(viewer.waitFor([&](const json& now) {
    return now.at("light") == before.at("light") && now.at("complete").get<bool>();
  })) << "the light is where it was";
  EXPECT_FALSE(viewer.status().at("can_undo").get<bool>()) << "a recording is no change";

  // Played, the light ends where the path ends: one step.
  viewer.moveTo(100, 650);
  viewer.key("space");
  EXPECT_TRUE(viewer.waitFor([](const json& now) {
    return !now.at("playing").get<bool>() && now.at("light").at("azimuth") == 60 &&
           now.at("light").at("elevation") == 50 && now.at("can_undo").get<bool>();
  })) << viewer.status().dump(2);
  viewer.clickControl("undo");
  EXPECT_TRUE(
      viewer.waitFor([&](const json& now) { return now.at("light") == before.at("light"); }));
  viewer.key("q");
  EXPECT_EQ(viewer.waitForEnd(), 0) << viewer.output();
}

}  // namespace
}  // namespace gnomon::test
