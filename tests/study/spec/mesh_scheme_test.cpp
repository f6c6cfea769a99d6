#include <filesystem>
#include <fstream>

#include "study/spec/study_file_fixture.h"
#include "study/spec/toml_reader.h"

// What becomes of a mesh file is named: see `[surface] scheme`.

namespace gnomon::study {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class MeshScheme : public StudyFile {
 protected:
  void SetUp() override {
    std::ofstream(file("square.obj"))
        << "v -16 -16 0\nv 16 -16 0\nv 16 16 0\nv -16 16 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
           "f 1/1 2/2 3/3 4/4\n";
    std::ofstream(file("triangles.obj"))
        << "v -16 -16 0\nv 16 -16 0\nv 16 16 0\nv -16 16 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
           "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
  }
  static std::string with(const std::string& surface, const std::string& header = "") {
    std::string text =
        test::replaced(plainStudy, "shape = \"plane\"\nquads = [4, 2]\nsize = [64, 32]", surface);
    return test::replaced(text, "[study]\n", "[study]\n" + header);
  }
};

TEST_F(MeshScheme, IsRequiredAndTheMessageTellsOfTheFile) {
  const std::string squares = failure(with("mesh = \"square.obj\""));
  EXPECT_THAT(squares,
              HasSubstr("surface.scheme: missing, \"catmull-clark\", \"loop\" or \"none\""));
  EXPECT_THAT(squares, HasSubstr("1 quadrilateral: catmull-clark would round it"));
  EXPECT_THAT(squares, HasSubstr("loop cannot take"));
  const std::string triangles = failure(with("mesh = \"triangles.obj\""));
  EXPECT_THAT(triangles, HasSubstr("2 triangles: catmull-clark would round them"));
  EXPECT_THAT(triangles, HasSubstr("loop too; none keeps them"));
}

TEST_F(MeshScheme, EachIsAnotherSurface) {
  using surface::SubdivisionScheme;
  const auto cage = [&](const char* mesh, const char* scheme) {
    return read(with(std::string("mesh = \"") + mesh + "\"\nscheme = \"" + scheme + "\"")).cage;
  };
  EXPECT_EQ(cage("square.obj", "catmull-clark").scheme, SubdivisionScheme::catmullClark);
  EXPECT_EQ(cage("triangles.obj", "loop").scheme, SubdivisionScheme::loop);
  EXPECT_EQ(cage("triangles.obj", "none").scheme, SubdivisionScheme::none);
  EXPECT_EQ(cage("triangles.obj", "none").faceCount(), 6);
}

// Published suites are older than the key, and their files must not change.
TEST_F(MeshScheme, OfAStudyDrawnFromASuiteIsCatmullClarkWhereItIsNotNamed) {
  const StudySpec drawn = read(with("mesh = \"square.obj\"", "suite = \"suite-1-test\"\n"));
  EXPECT_EQ(drawn.cage.scheme, surface::SubdivisionScheme::catmullClark);
  const StudySpec named =
      read(with("mesh = \"square.obj\"\nscheme = \"none\"", "suite = \"suite-1-test\"\n"));
  EXPECT_EQ(named.cage.scheme, surface::SubdivisionScheme::none);
}

TEST_F(MeshScheme, PolygonsHaveNoCurvatureOfALimit) {
  const std::string polygons = "mesh = \"square.obj\"\nscheme = \"none\"\n";
  EXPECT_EQ(read(with(polygons)).base.curvature, surface::CurvatureSource::vertices);
  EXPECT_EQ(read(with(polygons)).methods.front().base.curvature,
            surface::CurvatureSource::vertices);
  EXPECT_EQ(read(with(polygons + "[base]\ncurvature = \"vertices\"\n")).base.curvature,
            surface::CurvatureSource::vertices);
  const std::string refused = failure(with(polygons + "[base]\ncurvature = \"limit\"\n"));
  EXPECT_THAT(refused, HasSubstr("base.curvature: \"limit\" found"));
  EXPECT_THAT(refused, HasSubstr("\"vertices\" expected"));
  const std::string ofMethod =
      failure(test::replaced(with(polygons), "name = \"max-forsyth\"",
                             "name = \"max-forsyth\"\nbase = { curvature = \"limit\" }"));
  EXPECT_THAT(ofMethod, HasSubstr("method.0.base.curvature: \"limit\" found"));
}

TEST(MeshSchemes, AllCommittedStudiesNameTheirs) {
  int meshes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(GNOMON_SCENES)) {
    if (entry.path().extension() != ".toml") continue;
    const toml::table study = parseToml(entry.path());
    const toml::table* surface = study["surface"].as_table();
    if (surface == nullptr || !surface->contains("mesh")) continue;
    ++meshes;
    EXPECT_TRUE(surface->contains("scheme")) << entry.path();
  }
  EXPECT_GT(meshes, 10);
}

}  // namespace
}  // namespace gnomon::study
