// Whole runs on a mesh from a file: the same surface in every format, and a face without texture.

#include <gtest/gtest.h>

#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

/// The small study on a mesh, in a camera and in an atlas of 7 × 7 samples a face.
std::string studyOf(const std::string& mesh, const std::string& name) {
  std::string text = replaced(smallStudy(), "shape = \"plane\"\nquads = [4, 4]\nsize = [32, 32]",
                              "mesh = \"" + mesh + "\"");
  text = replaced(text, "name = \"small\"", "name = \"" + name + "\"");
  return replaced(text, "[[light]]", "[[view]]\ntype = \"atlas\"\nsamples = 7\n\n[[light]]");
}

/// Two squares side by side, the second bent upward; its corners as given.
std::string objOf(const std::string& second) {
  return "v -16 -16 0\nv 0 -16 0\nv 16 -16 3\nv -16 16 0\nv 0 16 0\nv 16 16 3\n"
         "vt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nvt 1 0\nvt 1 1\n"
         "f 1/1 2/2 5/3 4/4\nf " +
         second + "\n";
}

/// The same, its vertices cut apart where the squares meet.
const std::string cutPly =
    "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
    "property float z\nproperty float s\nproperty float t\nelement face 2\n"
    "property list uchar int vertex_indices\nend_header\n"
    "-16 -16 0 0 0\n0 -16 0 0.5 0\n0 16 0 0.5 1\n-16 16 0 0 1\n"
    "0 -16 0 0.5 0\n16 -16 3 1 0\n16 16 3 1 1\n0 16 0 0.5 1\n4 0 1 2 3\n4 4 5 6 7\n";

class MeshFiles : public EndToEnd {};

TEST_F(MeshFiles, AnObjAndAPlyOfTheSameMeshGiveTheSameFigures) {
  write("mesh.obj", objOf("2/2 3/5 6/6 5/3"));
  write("mesh.ply", cutPly);
  runStudy("from-obj", studyOf("mesh.obj", "from-obj"));
  runStudy("from-ply", studyOf("mesh.ply", "from-ply"));
  const nlohmann::json obj = summary("from-obj");
  const nlohmann::json ply = summary("from-ply");
  EXPECT_EQ(obj.at("results"), ply.at("results"));
  EXPECT_EQ(obj.at("undefined_samples"), 0);
  EXPECT_GT(resultOf(obj, "unshadowed", "evening", "camera").at("prevalence"), 0.02);
}

TEST_F(MeshFiles, SamplesOfAFaceWithoutTextureAreCountedAndLeftOut) {
  write("whole.obj", objOf("2/2 3/5 6/6 5/3"));
  write("half.obj", objOf("2 3 6 5"));
  runStudy("whole", studyOf("whole.obj", "whole"));
  runStudy("half", studyOf("half.obj", "half"));
  const auto samples = [](const nlohmann::json& summary, const std::string& view) {
    return resultOf(summary, "max-forsyth", "evening", view).at("samples").get<int>();
  };
  EXPECT_EQ(samples(summary("whole"), "atlas"), 2 * 7 * 7);
  EXPECT_EQ(samples(summary("half"), "atlas"), 7 * 7);
  const int missing = samples(summary("whole"), "camera") - samples(summary("half"), "camera");
  EXPECT_GT(missing, samples(summary("half"), "camera") / 2);
  EXPECT_EQ(summary("half").at("undefined_samples"), 7 * 7 + missing);
  // What is left has its shadows still: those of the same relief.
  EXPECT_GT(resultOf(summary("half"), "unshadowed", "evening", "atlas").at("prevalence"), 0.02);
  EXPECT_LT(resultOf(summary("half"), "max-forsyth", "evening", "atlas").at("error_rate"), 0.2);
}

}  // namespace
}  // namespace gnomon::test
