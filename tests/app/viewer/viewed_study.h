#pragma once

#include <fstream>
#include <string>

#include "support/columns_study.h"
#include "support/temporary_folder.h"
#include "viewer/session/scene_data.h"

namespace gnomon::app {

/// A test with a small study on a part of a sphere.
class ViewedStudy : public TemporaryFolder {
 protected:
  ViewedStudy() {
    std::ofstream(study()) << test::sphereStudy("ball") + R"(
[truth]
step = 0.5
[[view]]
type = "camera"
width = 101
height = 67
eye = [0, 0, 140]
[[light]]
elevation = 30
[[method]]
name = "max-forsyth"
[[method]]
name = "sloan-cohen"
[[method]]
name = "ellipse"
)";
  }
  [[nodiscard]] std::filesystem::path study() const { return file("ball.toml"); }

  static void tryNone(const study::MethodSpec& /*method*/, relief::Wrap /*wrap*/) {}

  [[nodiscard]] static std::shared_ptr<const SceneData> made(
      SceneMaker& maker, const std::vector<std::string>& overrides,
      const std::vector<std::string>& shown) {
    SceneRequest request;
    request.options.overrides = overrides;
    request.shown = shown;
    return maker.make(request, [](const std::string&) { return Progress([](double) {}); });
  }
};

}  // namespace gnomon::app
