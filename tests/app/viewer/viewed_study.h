#pragma once

#include <fstream>
#include <string>

#include "support/temporary_folder.h"
#include "viewer/session/scene_data.h"

namespace gnomon {

/// A test with a small study on a part of a sphere.
class ViewedStudy : public TemporaryFolder {
 protected:
  ViewedStudy() {
    std::ofstream(study()) << R"([study]
name = "ball"
title = "Columns on a sphere"
source = "a test"
[surface]
shape = "sphere"
curvature = 0.02
size = [48, 48]
quads = [20, 20]
[relief]
pattern = "columns"
texels = [48, 48]
period = 16
radius = 4
wall = 1
height = 4
height_space = "world"
[bake]
azimuths = 8
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

  static void tryNone(const MethodSpec& /*method*/, Wrap /*wrap*/) {}

  [[nodiscard]] static std::shared_ptr<const SceneData> made(
      SceneMaker& maker, const std::vector<std::string>& overrides,
      const std::vector<std::string>& shown) {
    SceneRequest request;
    request.options.overrides = overrides;
    request.shown = shown;
    return maker.make(request, [](const std::string&) { return Progress([](double) {}); });
  }
};

}  // namespace gnomon
