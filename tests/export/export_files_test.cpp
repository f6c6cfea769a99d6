#include "export/truth_files.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <array>
#include <set>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "export/mesh_files.h"
#include "image/grey_picture.h"
#include "image/images.h"
#include "report/view_images.h"
#include "support/temporary_folder.h"

namespace gnomon::exporting {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::StartsWith;

class ExportFiles : public TemporaryFolder {};

TEST_F(ExportFiles, ChannelsComeBackByTheirNames) {
  const std::vector<float> values = {1, -2.5F, 1e-30F, 3e30F, 0.1F, 7};
  image::writeExr(file("c.exr"), image::ChannelImage{3, 1, {"point.X", "face"}, values},
                  {{"about", "a test"}});
  EXPECT_THAT(image::readGreyPicture(file("c.exr"), "point.X").values,
              ElementsAre(1, 1e-30F, 0.1F));
  EXPECT_THAT(image::readGreyPicture(file("c.exr"), "face").values, ElementsAre(-2.5F, 3e30F, 7));
  const auto image = OIIO::ImageInput::open(file("c.exr").string());
  EXPECT_EQ(image->spec().get_string_attribute("about"), "a test");
  EXPECT_THROW(image::writeExr(file("d.exr"), image::ChannelImage{4, 2, {"Y"}, values}),
               InternalError);
  EXPECT_THROW(image::writeExr(file("d.exr"), image::ChannelImage{3, 3, {"Y"}, values}),
               InternalError);
  EXPECT_FALSE(std::filesystem::exists(file("d.exr")));
}

TEST_F(ExportFiles, TheFirstRowOfTheHeightsIsTheLargestV) {
  report::RunFolder run(folder(), {"export.json"});
  writeHeights(run, relief::HeightField(2, 3, {0, 1, 2, 3, 4, 5}, relief::Wrap::repeat));
  EXPECT_THAT(image::readGreyPicture(file("heights.exr"), "height").values,
              ElementsAre(4, 5, 2, 3, 0, 1));
}

TEST_F(ExportFiles, PlyHasAHeaderAndThirteenBytesATriangle) {
  displaced::WeldedMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5F}};
  mesh.triangles = {0, 1, 2, 3, 2, 1};
  writePly(file("m.ply"), mesh, "two triangles");
  const std::string bytes = readFile(file("m.ply"));
  const std::string end = "end_header\n";
  const std::size_t body = bytes.find(end) + end.size();
  EXPECT_THAT(bytes, StartsWith("ply\nformat binary_"));
  EXPECT_EQ(bytes.size() - body, 4U * 12U + 2U * 13U);
  EXPECT_EQ(bytes[body + 48], 3);
  EXPECT_EQ(bytes[body + 48 + 13], 3);
  EXPECT_NE(bytes.find("comment two triangles\nelement vertex 4\n"), std::string::npos);
  EXPECT_NE(bytes.find("element face 2\n"), std::string::npos);
}

TEST_F(ExportFiles, ObjHasUvAndNormalsAndCountsFromOne) {
  surface::BaseMesh mesh;
  for (const Vec2& at : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}) {
    surface::BaseVertex vertex{};
    vertex.frame.position = Vec3(at, 0.1);
    vertex.frame.normal = Vec3(0, 0, 1);
    vertex.frame.texel = 8.0 * at;
    mesh.vertices.push_back(vertex);
  }
  mesh.triangles = {0, 1, 2};
  writeObj(file("m.obj"), mesh, Vec2(16, 32), "one triangle");
  EXPECT_EQ(readFile(file("m.obj")),
            "# one triangle\nv 0 0 0.1\nvt 0 0\nvn 0 0 1\nv 1 0 0.1\nvt 0.5 0\nvn 0 0 1\n"
            "v 0 1 0.1\nvt 0 0.25\nvn 0 0 1\nf 1/1/1 2/2/2 3/3/3\n");
}

TEST_F(ExportFiles, WhatCannotBeWrittenIsAnError) {
  writeTextAtomically(file("taken"), "a file");
  EXPECT_THROW(writePly(file("taken") / "m.ply", {}, ""), InputError);
  EXPECT_THROW(writeObj(file("taken") / "m.obj", {}, Vec2(1), ""), InputError);
  EXPECT_THROW(image::writeExr(file("taken") / "m.exr", image::ChannelImage{1, 1, {"Y"}, {0}}),
               InputError);
  EXPECT_THAT(readFile(file("taken")), EndsWith("a file"));
}

TEST(RegionImage, EveryRegionHasAColourOfItsOwn) {
  std::set<image::Rgb> colours = {report::regionColour(truth::Region::none)};
  for (const truth::Region region : truth::reportedRegions)
    colours.insert(report::regionColour(region));
  EXPECT_EQ(colours.size(), truth::reportedRegions.size() + 1);
  truth::Truth truth;
  truth.mask = {2, 1, {Shade::shadowed, Shade::none}};
  truth.regions = {truth::Region::cast, truth::Region::none};
  const image::Image image = image::unfolded(report::regionImage(truth));
  EXPECT_EQ(image.width, 2);
  const image::Rgb cast = report::regionColour(truth::Region::cast);
  EXPECT_EQ(std::vector(image.rgb.begin(), image.rgb.begin() + 3),
            std::vector(cast.begin(), cast.end()));
}

}  // namespace
}  // namespace gnomon::exporting
