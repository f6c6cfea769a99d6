// A corpus of broken meshes and pictures: each is refused in one line that names the file, with
// status 3, and nothing is left behind.

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <cstring>

#include "end_to_end/support/bad_input.h"

namespace gnomon::test {
namespace {

/// A file's bytes, and what the one line must say beside its name.
struct Broken {
  std::string what;
  std::string bytes;
  std::string says;
};

class BrokenFiles : public BadInput {
 protected:
  void SetUp() override {
    BadInput::SetUp();
    writeSmall();
  }
  void refuseMeshes(const std::string& ending, const std::vector<Broken>& corpus) const {
    for (const Broken& broken : corpus) {
      const std::string name = "broken" + ending;
      write(name, broken.bytes);
      expectFailure({broken.what,
                     {"run", "small.toml", "--set", meshChange(name).front()},
                     3,
                     {name, broken.says}});
      EXPECT_EQ(filesBelow("."), (std::vector<std::string>{name, "small.toml"})) << broken.what;
    }
  }
};

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
const std::string face = "f 1/1 2/2 3/3 4/4\n";

TEST_F(BrokenFiles, Objs) {
  refuseMeshes(
      ".obj",
      {{"a vertex of two numbers", "v 1 2\n", ":1: 'v' with 2 numbers, expected 3"},
       {"a coordinate in words", "v one 2 3\n", ":1: coordinate 1 is 'one'"},
       {"a coordinate out of range", "v 1e400 2 3\n", "'1e400'"},
       {"an infinite coordinate", "v 0 0 -inf\n", "'-inf'"},
       {"a huge coordinate", "v 1e300 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n", "1e+300"},
       {"a texture coordinate of one number", square + "vt 3\n" + face, ":9: 'vt' with 1"},
       {"a comma for a point", "v 0,5 0 0\n", "'0,5'"},
       {"a face of one corner", square + "f 1/1\n", ":9: face with 1 corners"},
       {"corners of three slashes", square + "f 1/1/1/1 2/2 3/3 4/x\n", ":9:"},
       {"a negative index too far", square + "f -9/1 2/2 3/3\n", "index -9"},
       {"an index of letters", square + "f a/b c/d e/f\n", "'a'"},
       {"an index beyond all", square + "f 1/1 2/2 4294967297/3\n", "'4294967297'"},
       {"some corners without texture", square + "f 1/1 2 3/3 4/4\n", ":9: face with 4 corners, 3"},
       {"no texture", square + "f 1 2 3 4\n", "unwrap"},
       {"a corner twice", square + "f 1/1 2/2 2/3 4/4\n", ":9: face 1 has vertex 2 twice"},
       {"a face twice", square + face + face, "opposite directions"},
       {"a Moebius band",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nvt 0 0\nvt 1 0\nvt 1 1\n"
        "f 1/1 2/2 3/3 4/1\nf 4/1 3/2 6/3 5/1\nf 5/1 6/2 1/3 2/1\n",
        "direction"},
       {"two fans at a vertex",
        square + "v 2 1 0\nv 2 2 0\nv 1 2 0\n" + face + "f 3/1 5/2 6/3 7/4\n", "one fan"},
       {"an unknown tag", square + face + "t smooth 1/0/0 1\n", ":10: tag 'smooth'"},
       {"a crease that is no edge", square + face + "t crease 2/1/0 0 2 3\n", "no edge"},
       {"a crease without sharpness", square + face + "t crease 2/0/0 0 1\n", ":10: crease"},
       {"half a file", (square + face).substr(0, 50), ":7: 'vt' with 1 numbers"},
       {"zeros", std::string(1000, '\0'), "no faces"},
       {"a PLY by another name", "ply\nformat ascii 1.0\n",
        "is a PLY: a name that ends in .ply expected"}});
}

TEST_F(BrokenFiles, TexturesWithoutArea) {
  write("point.obj", square + "f 1/1 2/1 3/1 4/1\n");
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
  write("speck.obj", replaced(replaced(triangle, "vt 1 0", "vt 1e-6 0"), "vt 0 1", "vt 0 1e-6"));
  write("dust.obj", replaced(replaced(triangle, "vt 1 0", "vt 1e-9 0"), "vt 0 1", "vt 0 1e-9"));
  write("mote.obj",
        replaced(replaced(triangle, "v 1 0 0", "v 1e-9 0 0"), "v 1 1 0", "v 1e-9 1e-9 0"));
  write("far.obj",
        replaced(replaced(replaced(triangle, "v 0 0 0", "v 1e9 0 0"), "v 1 0 0", "v 1.0001e9 0 0"),
                 "v 1 1 0", "v 1.0001e9 1e5 0"));
  expectFailureWith(meshChange("point.obj"), 3, {"no area"});
  // Nor is there a step that would make enough of them.
  write("small.toml", replaced(smallStudy(), "[truth]\nstep = 0.25\n", ""));
  expectFailureWith(meshChange("point.obj"), 3, {"truth.step", "no area"});
  expectFailureWith(meshChange("speck.obj"), 3, {"truth.step", "too few texels"});
  expectFailureWith(meshChange("dust.obj"), 3, {"surface: a texel is", "wide on average"});
  expectFailureWith(meshChange("mote.obj"), 3, {"surface: a texel is", "wide on average"});
  expectFailureWith(meshChange("far.obj"), 3, {"surface: it reaches 1.0001e+09", "floats are"});
  expectFailureWith({"relief.repeats=[1e-300, 1e-300]"}, 3, {"truth.step", "no area"});
}

/// An ASCII PLY of one square with the given parts in the place of sound ones.
std::string ply(const std::string& faceRow,
                const std::string& faceProperties = "property list uchar int vertex_indices\n",
                const std::string& format = "ascii 1.0", const std::string& vertices = "4") {
  return "ply\nformat " + format + "\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty float s\n"
         "property float t\nelement face 1\n" +
         faceProperties + "end_header\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n" + faceRow;
}

TEST_F(BrokenFiles, TextPlys) {
  const std::string list = "property list uchar int vertex_indices\n";
  refuseMeshes(
      ".ply",
      {{"an empty file", "", ":1: not a PLY"},
       {"another format", "solid cube\n", "is an STL: export the mesh as OBJ or PLY"},
       {"a header without end", "ply\nformat ascii 1.0\nelement vertex 1\n", "end_header"},
       {"no format", "ply\nelement vertex 1\n", ":2: expected 'format"},
       {"an unknown format", ply("4 0 1 2 3\n", list, "utf8 1.0"), ":2: format 'utf8'"},
       {"an unknown version", ply("4 0 1 2 3\n", list, "ascii 3.0"), ":2: version '3.0'"},
       {"an unknown keyword", "ply\nformat ascii 1.0\nelemnt vertex 3\n", ":3: 'elemnt'"},
       {"a negative count", ply("4 0 1 2 3\n", list, "ascii 1.0", "-4"), ":3: count '-4'"},
       {"more vertices than there are", ply("", list, "ascii 1.0", "4000000000"),
        "element 'vertex'"},
       {"fewer vertices than there are", ply("4 0 1 2 3\n", list, "ascii 1.0", "3"), ":15:"},
       {"an unknown type", ply("4 0 1 2 3\n", "property list byte int vertex_indices\n"), "'byte'"},
       {"a list without type", ply("4 0 1 2 3\n", "property list vertex_indices\n"), ":10:"},
       {"no list of corners", ply("7\n", "property int material\n"), "vertex_indices"},
       {"too few corners", ply("4 0 1 2\n"), ":16: list 'vertex_indices' of 4 values"},
       {"too many corners", ply("4 0 1 2 3 0\n"), ":16: 1 values more"},
       {"a corner of letters", ply("4 0 1 2 x\n"), ":16: 'vertex_indices' is 'x'"},
       {"a corner that there is not", ply("4 0 1 2 4\n"), ":16: face 0 refers to vertex 4"},
       {"a negative corner", ply("4 0 1 2 -1\n"), ":16: vertex index -1"},
       {"a line for a face", ply("2 0 1\n"), ":16: face 0 has 2 corners"},
       {"no row for the face", ply(""), "element 'face'"},
       {"a row too many", ply("4 0 1 2 3\n3 0 1 2\n"), "after the last row"},
       {"texture of three corners",
        ply("4 0 1 2 3 6 0 0 1 0 1 1\n", list + "property list uchar float texcoord\n"),
        ":17: 'texcoord' has 6 values"},
       {"texture of no corner", ply("4 0 1 2 3 0\n", list + "property list uchar float texcoord\n"),
        "unwrap"},
       {"texture at infinity",
        ply("4 0 1 2 3 8 0 0 1 0 1 1 0 inf\n", list + "property list uchar float texcoord\n"),
        "finite"}});
}

TEST_F(BrokenFiles, BinaryPlys) {
  const auto number = [](auto value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
  };
  const auto file = [&](const std::string& count, const std::string& corners,
                        const std::string& order = "little") {
    std::string bytes = "ply\nformat binary_" + order +
                        "_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                        "property float z\nproperty float s\nproperty float t\nelement face 1\n"
                        "property list int int vertex_indices\nend_header\n";
    for (const float x : {0.F, 0.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 1.F, 0.F,
                          1.F, 1.F, 0.F, 1.F, 1.F, 0.F, 1.F, 0.F, 0.F, 1.F}) {
      bytes += number(x);
    }
    return bytes + count + corners;
  };
  const std::string corners = number(0) + number(1) + number(2) + number(3);
  const std::string sound = file(number(4), corners);
  refuseMeshes(".ply",
               {{"cut in the header", sound.substr(0, 60), "header"},
                {"cut in a vertex", sound.substr(0, sound.size() - 60), "element 'vertex'"},
                {"cut in a face", sound.substr(0, sound.size() - 3), "element 'face', row 0"},
                {"bytes left over", sound + "abc", "3 bytes after the last row"},
                {"a negative count", file(number(-4), corners), "of -4 values"},
                {"an endless count", file(number(2147483647), corners), "holds 4 more"},
                {"the other order", file(number(4), corners, "big"), "'face', row 0"},
                {"a corner of no number", file(number(4), number(-1) + corners.substr(4)),
                 "vertex index -1"}});
}

/// A picture as its file's bytes.
class BrokenPictures : public BadInput {
 protected:
  std::string picture(const std::string& ending, OIIO::TypeDesc type) const {
    const std::string name = "sound" + ending;
    const auto out = OIIO::ImageOutput::create(file(name).string());
    EXPECT_TRUE(out && out->open(file(name).string(), OIIO::ImageSpec(32, 32, 1, type)));
    std::vector<float> values(32 * 32);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = 0.5F + 0.5F * std::sin(0.37F * static_cast<float>(i * i));
    }
    EXPECT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()) && out->close());
    std::string bytes = read(name);
    std::filesystem::remove(file(name));
    return bytes;
  }
  static std::string changed(std::string bytes, std::size_t at, const std::string& by) {
    return bytes.replace(at, by.size(), by);
  }
  std::vector<Broken> corpus() const {
    const std::string png = picture(".png", OIIO::TypeDesc::UINT16);
    const std::string exr = picture(".exr", OIIO::TypeDesc::HALF);
    const std::string tif = picture(".tif", OIIO::TypeDesc::UINT8);
    return {{".png", "", ""},
            {".png", png.substr(0, 8), ""},
            {".png", png.substr(0, 30), ""},
            {".png", png.substr(0, png.size() / 2), ""},
            {".png", changed(png, 16, std::string(4, '\0')), ""},        // no width
            {".png", changed(png, 16, "\x7f\xff\xff\xff"), ""},          // a width beyond all
            {".png", changed(png, 24, "\x07"), ""},                      // no such depth of bits
            {".png", changed(png, png.size() / 2, "\xaa\x55\xaa"), ""},  // data
            {".png", "\x89PNG\r\n\x1a\n", ""},
            {".exr", exr.substr(0, 4), ""},
            {".exr", exr.substr(0, exr.size() / 3), ""},
            {".exr", exr.substr(0, exr.size() - 20), ""},
            {".exr", changed(exr, 4, "\xff\xff\xff\xff"), ""},  // version
            {".tif", tif.substr(0, 8), ""},
            {".tif", tif.substr(0, tif.size() / 2), ""},
            {".tif", changed(tif, 4, "\xff\xff\xff\x7f"), ""},  // where its directory begins
            {".pgm", "P5\n", ""},
            {".pgm", "P5\n0 3\n255\n", ""},
            {".pgm", "P9\n3 3\n255\n", ""},
            {".pgm", "P5\n-3 3\n255\n123456789", ""},
            {".jpg", "\xff\xd8\xff\xe0 and no more", ""},
            {".hdr", "#?RADIANCE\n", ""},
            {".xyz", "a format that there is not", ""}};
  }
};

TEST_F(BrokenPictures, AsHeights) {
  writeSmall();
  int number = 0;
  for (const Broken& broken : corpus()) {
    const std::string name = "broken" + std::to_string(number++) + broken.what;
    write(name, broken.bytes);
    expectFailure({name, {"run", "small.toml", "--set", imageChange(name).front()}, 3, {name}});
  }
}

TEST_F(BrokenPictures, AsMasks) {
  write("sound.pgm", "P5\n2 2\n255\n" + std::string("\xff\0\0\xff", 4));
  int number = 0;
  for (const Broken& broken : corpus()) {
    const std::string name = "broken" + std::to_string(number++) + broken.what;
    write(name, broken.bytes);
    expectFailure({name, {"compare", name, "sound.pgm"}, 3, {name}});
  }
}

}  // namespace
}  // namespace gnomon::test
