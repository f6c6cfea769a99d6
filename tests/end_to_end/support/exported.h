#pragma once

#include <string>
#include <vector>

#include "end_to_end/support/other_renderer.h"
#include "end_to_end/support/program.h"

namespace gnomon::test {

/// A closed surface with a relief in the texture's own height units, seen by a camera and asked
/// everywhere, under two lights.
inline std::string torusStudy() {
  return R"([study]
name = "ring"
title = "Bumps on a torus"
source = "a test"
frames = 0
[surface]
shape = "torus"
major = 40
minor = 15
quads = [64, 60]

[relief]
pattern = "cosine"
texels = [256, 120]
period = 16
height = 3
height_space = "texture"

[bake]
azimuths = 8

[truth]
step = 0.5

[[view]]
name = "above"
type = "camera"
width = 120
height = 90
eye = [20, 60, 130]
fov = 50

[[view]]
name = "atlas"
type = "atlas"
samples = 3

[[light]]
name = "high"
azimuth = 40
elevation = 60

[[light]]
name = "low"
azimuth = 250
elevation = 20

[[method]]
name = "unshadowed"
)";
}

inline Point pointOf(const nlohmann::json& list) {
  return {list.at(0), list.at(1), list.at(2)};
}

/// Tests that export studies.
class ExportEndToEnd : public SharedRuns {
 protected:
  /// What an earlier export says of itself.
  [[nodiscard]] nlohmann::json aboutOf(const std::string& name) const {
    return nlohmann::json::parse(read("out/" + name + "/export/export.json"));
  }
  nlohmann::json exported(const std::string& name, const std::string& text,
                          const std::vector<std::string>& options = {}) const {
    write(name + ".toml", text);
    std::vector<std::string> arguments = {"export", name + ".toml"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = gnomon(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return aboutOf(name);
  }
};

}  // namespace gnomon::test
