#include <fmt/core.h>
#include <gmock/gmock.h>

#include "app/viewer/viewer_window.h"

// A light path, recorded without a window.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Recording : public EndToEnd {
 protected:
  void SetUp() override {
    EndToEnd::SetUp();
    write("ball.toml", ballStudy());
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
  EXPECT_EQ(gnomon({"view", "ball.toml", "--light-path", "around", "--screenshot", "x.png"}).status,
            2)
      << "a path that nothing records";
  EXPECT_FALSE(fs::exists(folder() / "none"));
}

}  // namespace
}  // namespace gnomon::test
