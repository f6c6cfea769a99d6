#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "end_to_end/support/bad_input.h"

namespace gnomon::test {
namespace {

using ::testing::StartsWith;

TEST_F(BadInput, CommandLine) {
  writeSmall();
  for (const Failure& failure : std::vector<Failure>{
           {"no arguments",
            {},
            2,
            {"run, plan, merge, gather, check, compare, bake, truth, export, view, cache, suite, "
             "list or init",
             "--help"}},
           {"unknown command", {"rnu", "small.toml"}, 2, {"rnu", "not expected"}},
           {"unknown option", {"run", "small.toml", "--fast"}, 2, {"--fast"}},
           {"unknown option before", {"--fast", "run", "small.toml"}, 2, {"--fast"}},
           {"no study", {"run"}, 2, {"STUDY"}},
           {"two commands", {"list", "check", "small.toml"}, 2, {"--help"}},
           {"option without value", {"run", "small.toml", "--out"}, 2, {"--out"}},
           {"no threads", {"run", "small.toml", "--threads", "0"}, 2, {"--threads", "0"}},
           {"threads in words", {"run", "small.toml", "--threads", "two"}, 2, {"--threads", "two"}},
           {"unknown method",
            {"run", "small.toml", "--method", "x"},
            2,
            {"--method x", "max-forsyth"}},
           {"override without value",
            {"run", "small.toml", "--set", "relief.height"},
            2,
            {"--set relief.height", "KEY=VALUE"}},
           {"override into nothing",
            {"run", "small.toml", "--set", "light.7.azimuth=3"},
            2,
            {"--set light.7.azimuth=3", "`light.7`"}},
           {"override that would add a light",
            {"run", "small.toml", "--set", "light.1.elevation=3"},
            2,
            {"--set light.1.elevation=3", "there is no `light.1`", "light has 1 counted from 0"}},
           {"missing study", {"run", "none.toml"}, 3, {"none.toml: no such file"}},
           {"missing second study",
            {"run", "small.toml", "none.toml"},
            3,
            {"none.toml: no such file"}},
           {"a folder", {"run", "."}, 3, {".: is a folder"}},
           {"a device", {"run", "/dev/zero"}, 3, {"/dev/zero: is a device"}},
           {"the same study twice",
            {"run", "small.toml", "small.toml"},
            3,
            {"study.name", "\"small\"", "another study"}},
           {"an output folder in a file",
            {"run", "small.toml", "--out", "small.toml"},
            3,
            {"small.toml/small", "cannot create the folder"}}}) {
    expectFailure(failure);
  }
}

TEST_F(BadInput, StudyFilesThatAreNone) {
  write("empty.toml", "");
  expectFailure({"empty", {"run", "empty.toml"}, 3, {"empty.toml:1: study: missing"}});
  std::string garbage;
  for (unsigned i = 1; garbage.size() < 5000; i = i * 1664525 + 1013904223) {
    garbage += static_cast<char>(i >> 24);
  }
  write("garbage.toml", garbage);
  expectFailure({"garbage", {"run", "garbage.toml"}, 3, {"garbage.toml:1:"}});
  write("program.toml", std::string("\x7f"
                                    "ELF\x02\x01\x01\0\0",
                                    9));
  expectFailure({"a program", {"run", "program.toml"}, 3, {"program.toml:1:1"}});
  write("cut.toml", smallStudy().substr(0, smallStudy().find("quads") + 9));
  expectFailure({"cut off", {"run", "cut.toml"}, 3, {"cut.toml:8:"}});
}

TEST_F(BadInput, KeysAndValues) {
  write("typo.toml", replaced(smallStudy(), "wall =", "wal ="));
  expectFailure({"unknown key",
                 {"run", "typo.toml"},
                 3,
                 {"typo.toml:16: relief.wal: unknown key, expected", "wall"}});
  write("type.toml", replaced(smallStudy(), "period = 16", "period = \"16\""));
  expectFailure(
      {"wrong type",
       {"run", "type.toml"},
       3,
       {"type.toml:14: relief.period: the string \"16\" found, a number above 0 expected"}});
  write("lines.toml", replaced(smallStudy(), "period = 16", "period = \"1\\n6\\t\""));
  expectFailure({"a value of two lines", {"run", "lines.toml"}, 3, {"relief.period: the string"}});
  writeSmall();
  expectFailureWith({"method.1.name=forsyth"}, 3,
                    {"method.1.name: no method `forsyth`", "max-forsyth"});
  expectFailureWith({"method.1.file=x.glsl"}, 3, {"method.1.file", "`name` found beside it"});
  expectFailureWith({"relief.height=nan"}, 3, {"relief.height: nan found"});
  expectFailureWith({"light.0.elevation=[]"}, 3, {"light.0.elevation: a list of 0 found"});
}

TEST_F(BadInput, HeightImages) {
  writeSmall();
  expectFailure({"missing",
                 {"run", "small.toml", "--set", imageChange("none.png").front()},
                 3,
                 {"none.png: no such file"}});

  const auto refuse = [&](const std::string& image, const std::vector<std::string>& mentions) {
    expectFailure({image, {"run", "small.toml", "--set", imageChange(image).front()}, 3, mentions});
  };
  write("empty.png", "");
  refuse("empty.png", {"empty.png: "});
  write("zero.pgm", "P5\n0 0\n255\n");
  refuse("zero.pgm", {"zero.pgm: "});
  write("text.png", "this is no image");
  refuse("text.png", {"text.png: "});
  write("colours.ppm", "P3\n2 1\n255\n9 9 9 9 8 9\n");
  refuse("colours.ppm", {"colours.ppm: its channels differ", "at column 1, row 0", "`channel`"});

  const auto writeImage = [&](const std::string& name, int side, float odd) {
    const auto image = OIIO::ImageOutput::create(file(name).string());
    ASSERT_TRUE(image);
    ASSERT_TRUE(
        image->open(file(name).string(), OIIO::ImageSpec(side, side, 1, OIIO::TypeDesc::FLOAT)));
    std::vector<float> heights(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = std::sin(static_cast<float>(i));
    heights[1] = odd;
    ASSERT_TRUE(image->write_image(OIIO::TypeDesc::FLOAT, heights.data()) && image->close());
  };
  writeImage("nan.tif", 16, std::numeric_limits<float>::quiet_NaN());
  refuse("nan.tif", {"nan.tif: pixel (1, 0) holds nan", "a finite height expected"});
  writeImage("nan.exr", 16, std::numeric_limits<float>::infinity());
  refuse("nan.exr", {"nan.exr: pixel (1, 0) holds inf", "a finite height expected"});

  // Floats may hold any height: all commands refuse what rays and shaders cannot compute with.
  write("high.pfm", "Pf\n2 1\n-1.0\n" + std::string("\0\0\0\0\xe7\x84\x11\x55", 8));  // 1e13
  for (const char* command : {"run", "bake", "truth", "export"}) {
    expectFailure({command,
                   {command, "small.toml", "--set", imageChange("high.pfm").front()},
                   3,
                   {"relief.height: heights from 0 to 4e+13 found, -1e+06 to 1e+06 expected"}});
  }

  for (const std::string name : {"cut.png", "cut.tif", "cut.exr"}) {
    writeImage(name, 64, 0.5F);
    const std::string whole = read(name);
    write(name, whole.substr(0, whole.size() / 2));
    refuse(name, {name + ": "});
  }
}

/// A square of two faces, as OBJ, with a third on the common edge where asked for.
std::string squareObj(const std::string& more) {
  return "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 1 0 1\nv 1 1 1\n"
         "vt 0 0\nvt 0.5 0\nvt 1 0\nvt 0 1\nvt 0.5 1\nvt 1 1\n"
         "f 1/1 2/2 5/5 4/4\nf 2/2 3/3 6/6 5/5\n" +
         more;
}

TEST_F(BadInput, Meshes) {
  writeSmall();
  const auto refuse = [&](const std::string& name, const std::string& text,
                          const std::vector<std::string>& mentions) {
    write(name, text);
    expectFailure({name, {"run", "small.toml", "--set", meshChange(name).front()}, 3, mentions});
  };
  expectFailure({"missing",
                 {"run", "small.toml", "--set", meshChange("none.obj").front()},
                 3,
                 {"none.obj: no such file"}});
  refuse("empty.obj", "", {"empty.obj"});
  refuse("comment.obj", "# nothing\n", {"comment.obj"});
  refuse("fan.obj", squareObj("f 2/2 7/3 8/6 5/5\n"), {"fan.obj", "edge"});
  refuse("index.obj", squareObj("f 2/2 7/3 99/6 5/5\n"), {"index.obj:17", "99"});
  refuse("uv.obj", squareObj("f 2/2 7/3 8/77 5/5\n"), {"uv.obj:17", "77"});
  refuse("zero.obj", squareObj("f 0/1 7/3 8/6 5/5\n"), {"zero.obj:17", "0"});
  refuse("nan.obj", "v 0 nan 0\n", {"nan.obj:1", "nan", "finite"});
  refuse("nouv.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n",
         {"nouv.obj: no face has texture coordinates"});
  refuse("corners.obj", squareObj("f 1/1 2/2\n"), {"corners.obj:17", "2 corners"});
  refuse("garbage.obj", std::string("\x01\x02\xff\0v\n\xfe f f f", 13), {"garbage.obj"});
}

TEST_F(BadInput, MoreThanMemoryHolds) {
  writeSmall();
  expectFailureWith({"truth.step=1e-7"}, 4, {"truth.step: 1e-07 texels", "needs ", " available"});
  expectFailureWith({"truth.step=1e-300"}, 4, {"truth.step: 1e-300 texels"});
  expectFailureWith({"relief.texels=[4096, 4096]", "bake.radius=100", "bake.azimuths=1024"}, 4,
                    {"bake.azimuths: 1024, with a radius of 100 texels", "needs ", " available"});
  expectFailureWith({"view.0.width=16384", "view.0.height=16384"}, 3,
                    {"view \"camera\": 16384 × 16384 samples found, at most 134217728 expected"});
}

TEST_F(BadInput, ViewsThatShowNothing) {
  writeSmall();
  expectFailureWith({"view.0.target=[0, 0, 160]"}, 3, {"view \"camera\" shows no surface"});
  expectFailureWith({"view.0.eye=[0, 0, -80]"}, 3, {"view \"camera\" shows no surface"});
  expectFailureWith({"view.0.eye=[0, 0, 0]"}, 3, {"lie on one line"});
  expectFailureWith({"view.0.up=[0, 0, 1]"}, 3, {"lie on one line"});
  expectFailureWith({"relief.repeats=[1e-300, 1e-300]"}, 3, {"no sample of a view has a frame"});
}

TEST_F(BadInput, AMethodThatNoViewCanShow) {
  const std::string atlas = replaced(
      smallStudy(), "type = \"camera\"\nwidth = 64\nheight = 64\neye = [0, 0, 80]\nfov = 30",
      "type = \"atlas\"\nsamples = 8");
  write("small.toml", replaced(atlas, "name = \"max-forsyth\"", "name = \"shadow-volume\""));
  expectFailureWith({}, 3, {"method \"shadow-volume\"", "[[view]] of type camera expected"});
  // In an atlas beside a camera it is left out, and in the camera's view it answers.
  const std::string both =
      replaced(smallStudy(), "[[light]]", "[[view]]\ntype = \"atlas\"\nsamples = 8\n\n[[light]]");
  runStudy("small", replaced(both, "name = \"max-forsyth\"", "name = \"shadow-volume\""));
  const nlohmann::json written = summary("small");
  for (const nlohmann::json& result : written.at("results")) {
    if (result.at("method") == "shadow-volume") {
      EXPECT_EQ(result.at("view"), "camera");
    }
  }
  EXPECT_LT(resultOf(written, "shadow-volume", "evening", "camera").at("error_rate"), 0.02);
}

TEST_F(BadInput, ATruthThatCannotTellItsOwnError) {
  // A texel's centre line is always among the micro-mesh's: twice as coarse is the same mesh.
  writeSmall();
  expectFailureWith({"truth.step=1"}, 3, {"truth.step: 1 texels found", "smaller step expected"});
}

TEST_F(BadInput, Shaders) {
  writeSmall();
  const std::string header =
      "/* gnomon-method\ntitle = \"t\"\ncitation = \"c\"\ntables = [\"horizon\"]\n*/\n\n";
  const auto refuse = [&](const std::string& name, const std::string& text, const std::string& more,
                          const std::vector<std::string>& mentions) {
    write(name, text);
    write("own.toml", smallStudy() + "\n[[method]]\nfile = \"" + name + "\"\n" + more);
    expectFailure({name, {"run", "own.toml"}, 3, mentions});
  };
  refuse("broken.glsl",
         header +
             "bool isShadowed(Pixel pixel, LocalLight light) {\n  return pixel.hieght > 0.0;\n}\n",
         "", {"own.toml: ", "broken.glsl:8: ", "hieght"});
  refuse("semicolon.glsl",
         header + "bool isShadowed(Pixel pixel, LocalLight light) {\n  return true\n}\n", "",
         {"semicolon.glsl:9: "});
  refuse("other.glsl",
         header +
             "bool isShadowed(Pixel pixel, LocalLight light) {\n"
             "  return distanceAt(pixel.texel, 0.0) > 1.0;\n}\n",
         "", {"other.glsl:8: ", "distanceAt"});
  refuse("undeclared.glsl", "bool isShadowed(Pixel p, LocalLight l) { return true; }\n", "",
         {"undeclared.glsl:1: ", "declaration expected"});
  refuse("parameters.glsl",
         "/* gnomon-method\ntitle = \"t\"\ncitation = \"c\"\nparameters = 3\n*/\n", "",
         {"parameters.glsl:4: ", "`parameters`: a table expected"});
  refuse("key.glsl", "/* gnomon-method\ntitle = \"t\"\ncitation = \"c\"\nauthor = \"a\"\n*/\n", "",
         {"key.glsl:4: ", "author"});
  expectFailure({"missing",
                 {"run", "small.toml", "--set", "method=[{file=\"none.glsl\"}]"},
                 3,
                 {"none.glsl: no such file"}});

  const std::string biased = GNOMON_OWN_METHODS "/biased-horizon.glsl";
  const auto refuseParameter = [&](const std::string& parameters,
                                   const std::vector<std::string>& mentions) {
    write("own.toml", smallStudy() + "\n[[method]]\nfile = \"" + biased +
                          "\"\nparameters = " + parameters + "\n");
    expectFailure({parameters, {"run", "own.toml"}, 3, mentions});
  };
  refuseParameter("{bias = 2.5}",
                  {"own.toml:", "method.2.parameters.bias: 2.5 found, -2 to 2 expected"});
  refuseParameter("{bais = 1}",
                  {"own.toml:", "method.2.parameters.bais: biased-horizon has no such parameter"});
  refuseParameter("3", {"own.toml:", "method.2.parameters: 3 found, a table expected"});
  refuseParameter("{bias = \"big\"}", {"own.toml:", "parameters.bias: the string \"big\" found"});
}

TEST_F(BadInput, ShaderFolderThatIsNone) {
  writeSmall();
  const Outcome outcome = gnomon({"run", "small.toml"}, {"GNOMON_SHADERS=/nonexistent"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, StartsWith("gnomon: GNOMON_SHADERS: /nonexistent holds no folder"));
}

TEST_F(BadInput, LeavesNoOldFiguresBesideNewPictures) {
  runStudy("small", smallStudy());
  ASSERT_TRUE(std::filesystem::exists(file("out/small/report.html")));
  // Fails after the truth's pictures were drawn.
  expectFailureWith({"truth.step=1"}, 3, {"truth.step"});
}

}  // namespace
}  // namespace gnomon::test
