#include "viewer/session/shader_watch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "support/temporary_folder.h"

namespace gnomon::app {
namespace {

class ShaderWatchTest : public TemporaryFolder {
 protected:
  void write(const char* name) const { std::ofstream(folder() / name) << "text"; }
  /// Another time than the file has, whatever the clock's steps are.
  void touch(const char* name) const {
    const auto path = folder() / name;
    std::filesystem::last_write_time(
        path, std::filesystem::last_write_time(path) + std::chrono::seconds(1));
  }
  static bool noticed(ShaderWatch& watch) {
    std::this_thread::sleep_for(std::chrono::milliseconds(550));
    return watch.changed();
  }
};

TEST_F(ShaderWatchTest, NoticesFilesThatChangeComeAndGo) {
  write("a.glsl");
  ShaderWatch watch(folder());
  EXPECT_FALSE(noticed(watch));
  touch("a.glsl");
  EXPECT_TRUE(noticed(watch));
  EXPECT_FALSE(noticed(watch));
  write("b.glsl");
  EXPECT_TRUE(noticed(watch));
  std::filesystem::remove(folder() / "b.glsl");
  EXPECT_TRUE(noticed(watch));
}

TEST_F(ShaderWatchTest, NoticesFilesElsewhere) {
  std::filesystem::create_directory(folder() / "shaders");
  write("mine.glsl");
  ShaderWatch watch(folder() / "shaders");
  watch.watch({folder() / "mine.glsl"});
  EXPECT_FALSE(noticed(watch));
  touch("mine.glsl");
  EXPECT_TRUE(noticed(watch));
}

}  // namespace
}  // namespace gnomon::app
