// Whole runs on a mesh from a file: the same surface in every format, and a face without texture.

#include <gmock/gmock.h>

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

using ::testing::HasSubstr;
using ::testing::Not;

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

TEST_F(MeshFiles, AnObjThatIsCutApartIsTheSameSurfaceAndSaysSo) {
  write("whole.obj", objOf("2/2 3/5 6/6 5/3"));
  write("cut.obj", replaced(objOf("7/2 3/5 6/6 8/3"), "vt 0 0\n", "v 0 -16 0\nv 0 16 0\nvt 0 0\n"));
  runStudy("whole", studyOf("whole.obj", "whole"));
  runStudy("cut", studyOf("cut.obj", "cut"));
  EXPECT_EQ(summary("cut").at("results"), summary("whole").at("results"));
  const std::string notice = "2 vertices of the mesh file lie in the same place as another";
  EXPECT_THAT(summary("cut").at("notices").dump(), HasSubstr(notice));
  EXPECT_THAT(summary("whole").at("notices").dump(), Not(HasSubstr("in the same place")));
}

// A clamped map goes on beyond its sides as they are: a face there is flat, and was 0.00 % wrong.
TEST_F(MeshFiles, FacesOutsideAClampedMapAreTold) {
  const std::string inside = "f 1/1 2/2 5/3 4/4\nf 2/2 3/5 6/6 5/3\n";
  const auto meshWith = [&](const std::string& faces) {
    return replaced(objOf("2/2 3/5 6/6 5/3"), inside, "vt 2 0\nvt 3 0\nvt 3 1\nvt 2 1\n" + faces);
  };
  write("half.obj", meshWith("f 1/1 2/2 5/3 4/4\nf 2/7 3/8 6/9 5/10\n"));
  write("none.obj", meshWith("f 1/7 2/8 5/9 4/10\nf 2/7 3/8 6/9 5/10\n"));
  runStudy("half", studyOf("half.obj", "half"), {"--set", "relief.wrap=clamp"});
  EXPECT_THAT(summary("half").at("notices").dump(),
              HasSubstr("1 of 2 faces have texture coordinates outside the map"));
  runStudy("half", studyOf("half.obj", "half"), {"--set", "relief.wrap=repeat"});
  EXPECT_THAT(summary("half").at("notices").dump(), Not(HasSubstr("outside the map")));
  write("none.toml", studyOf("none.obj", "none"));
  const Outcome refused = gnomon({"run", "none.toml", "--set", "relief.wrap=clamp"});
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, HasSubstr("relief.wrap: clamp found, but the texture coordinates of all "
                                     "faces lie outside the map"));
  EXPECT_EQ(gnomon({"run", "none.toml", "--set", "relief.wrap=repeat"}).status, 0);
}

TEST_F(MeshFiles, AGroupThatIsNamedAsARegionIsToBeRenamed) {
  const std::string mesh = objOf("2/2 3/5 6/6 5/3");
  for (const char* name : {"all", "lit", "seam", "beyond-terminator"}) {
    write("mesh.obj", replaced(mesh, "f 2/2", std::string("g ") + name + "\nf 2/2"));
    write("mesh.toml", studyOf("mesh.obj", "mesh"));
    const Outcome refused = gnomon({"run", "mesh.toml"});
    EXPECT_EQ(refused.status, 3);
    EXPECT_THAT(refused.err,
                HasSubstr(std::string("surface.mesh: an object or group of the file is named \"") +
                          name + "\", as a region of the truth is: rename it"));
  }
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
