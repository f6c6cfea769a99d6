#pragma once

#include <string>

namespace gnomon::test {

/// Columns that are small enough for a map of 32 texels.
inline constexpr const char* thinColumns = "period = 16\nradius = 4\nwall = 1\n";

/// How studies of tests begin, up to `[relief]`: columns of height 4 on a surface, whose map has a
/// texel a world unit. No frame is timed: that takes longer than the rest of a small study.
/// @param shape    of the surface
/// @param keys     of the surface beside its size, a line each
/// @param size     world units and texels, "64, 32"
/// @param columns  their own keys, a line each
inline std::string columnsStudy(const std::string& name, const std::string& shape,
                                const std::string& keys, const std::string& size,
                                const std::string& columns = "") {
  return "[study]\nname = \"" + name + "\"\ntitle = \"Columns on a " + shape +
         "\"\nsource = \"a test\"\nframes = 0\n[surface]\nshape = \"" + shape + "\"\n" + keys +
         "size = [" + size + "]\n\n[relief]\npattern = \"columns\"\ntexels = [" + size + "]\n" +
         columns + "height = 4\nheight_space = \"world\"\n";
}

/// The same on a coarse plane, as studies are that are read and not run.
inline std::string planeStudy(const std::string& name) {
  return columnsStudy(name, "plane", "quads = [4, 2]\n", "64, 32");
}

/// A study that takes no time to run, without lights and methods.
inline std::string smallestStudy(const std::string& name) {
  return columnsStudy(name, "plane", "quads = [4, 4]\n", "32, 32", thinColumns) + R"(
[bake]
azimuths = 8

[truth]
step = 0.25

[[view]]
type = "camera"
width = 64
height = 64
eye = [0, 0, 80]
fov = 30
)";
}

/// The beginning of a study on a part of a sphere.
inline std::string sphereStudy(const std::string& name) {
  return columnsStudy(name, "sphere", "curvature = 0.02\nquads = [20, 20]\n", "48, 48",
                      thinColumns) +
         "\n[bake]\nazimuths = 8\n";
}

}  // namespace gnomon::test
