#include "surface/mesh_file.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "common/files/atomic_file.h"
#include "surface/limit_surface.h"
#include "surface/test_surfaces.h"

namespace gnomon::surface {
namespace {

const char* const spotPath = GNOMON_SCENES "/meshes/spot_control_mesh.obj";

Cage readBytes(const std::string& bytes,
               SubdivisionScheme scheme = SubdivisionScheme::catmullClark) {
  const TemporaryMesh file(bytes, ".ply");
  return readMeshFile(file.path(), scheme);
}

void expectBadPly(const std::string& bytes, const std::vector<std::string>& messages) {
  expectInputError([&] { readBytes(bytes); }, messages);
}

/// A PLY in any of its formats: the same values once as text, once in bytes.
class PlyText {
 public:
  explicit PlyText(std::string format) : format_(std::move(format)) {
    text_ = "ply\nformat " + format_ + " 1.0\n";
  }
  PlyText& header(const std::string& lines) {
    text_ += lines + "end_header\n";
    return *this;
  }
  template <typename Number>
  PlyText& add(Number value) {
    if (format_ == "ascii") {
      std::ostringstream digits;
      digits.precision(17);
      digits << +value << ' ';
      text_ += digits.str();
      return *this;
    }
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    const bool big = format_ == "binary_big_endian";
    if (big != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
    text_ += bytes;
    return *this;
  }
  PlyText& endRow() {
    if (format_ == "ascii") text_ += '\n';
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return text_; }

 private:
  std::string format_;
  std::string text_;
};

const std::vector<std::string> formats = {"ascii", "binary_little_endian", "binary_big_endian"};

/// The cage's faces with each corner's texture coordinates, in every type of number that there is
/// and with properties and elements that nobody asked for.
std::string plyOf(const Cage& cage, const std::string& format) {
  PlyText ply(format);
  const int faces = cage.faceCount();
  ply.header(
      "comment made by a test\nelement camera 2\nproperty short zoom\n"
      "property list uchar ushort marks\nelement vertex " +
      std::to_string(cage.positions.size()) +
      "\nproperty uchar red\nproperty double x\nproperty double z\nproperty double y\n"
      "property float quality\nobj_info none\nelement face " +
      std::to_string(faces) +
      "\nproperty list uchar double texcoord\nproperty uint flags\n"
      "property list int32 uint32 vertex_index\nproperty char mark\n");
  for (const int camera : {-7, 300}) {
    ply.add(static_cast<std::int16_t>(camera)).add(std::uint8_t{2});
    ply.add(std::uint16_t{65535}).add(std::uint16_t{1}).endRow();
  }
  for (const Vec3& p : cage.positions) {
    ply.add(std::uint8_t{200}).add(p.x).add(p.z).add(p.y).add(0.5F).endRow();
  }
  for (int face = 0; face < faces; ++face) {
    const std::size_t first = cage.faceSize() * static_cast<std::size_t>(face);
    ply.add(static_cast<std::uint8_t>(2 * cage.faceSize()));
    for (std::size_t k = 0; k < cage.faceSize(); ++k) {
      const Vec2 uv = cage.uvs[static_cast<std::size_t>(cage.faceUvs[first + k])];
      ply.add(uv.x).add(uv.y);
    }
    ply.add(std::uint32_t{4000000000}).add(static_cast<std::int32_t>(cage.faceSize()));
    for (std::size_t k = 0; k < cage.faceSize(); ++k) {
      ply.add(static_cast<std::uint32_t>(cage.faceVertices[first + k]));
    }
    ply.add(std::int8_t{-128}).endRow();
  }
  return ply.bytes();
}

void expectSame(const Cage& cage, const Cage& expected) {
  EXPECT_EQ(cage.positions, expected.positions);
  EXPECT_EQ(cage.faceVertices, expected.faceVertices);
  ASSERT_EQ(cage.faceUvs.size(), expected.faceUvs.size());
  for (std::size_t i = 0; i < cage.faceUvs.size(); ++i) {
    EXPECT_EQ(cage.uvs[static_cast<std::size_t>(cage.faceUvs[i])],
              expected.uvs[static_cast<std::size_t>(expected.faceUvs[i])]);
  }
}

TEST(ReadPly, SpotIsTheSameInEveryFormatAsInItsObj) {
  const Cage expected = readMeshFile(spotPath);  // 732 quadrilaterals, seams
  for (const std::string& format : formats) {
    SCOPED_TRACE(format);
    expectSame(readBytes(plyOf(expected, format)), expected);
  }
}

const std::string asciiBegin = "ply\nformat ascii 1.0\n";
const std::string vertexXyz = "property float x\nproperty float y\nproperty float z\n";

/// Two squares side by side, cut apart at a seam: the common side's vertices twice.
std::string twoSquares(const std::string& u, const std::string& v, const std::string& face) {
  return asciiBegin + "element vertex 8\n" + vertexXyz + "property float " + u +
         "\nproperty float " + v + "\nelement face 2\nproperty list uchar int vertex_indices\n" +
         "end_header\n"
         "0 0 0 0 0\n1 0 0 0.4 0\n1 1 0 0.4 1\n0 1 0 0 1\n"
         "1 -0 0 0.6 0\n2 0 0 1 0\n2 1 0 1 1\n1 1 0 0.6 1\n"
         "4 0 1 2 3\n" +
         face + "\n";
}

TEST(ReadPly, VerticesThatASeamCutsApartAreJoined) {
  for (const auto& [u, v] :
       std::map<std::string, std::string>{{"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}}) {
    const Cage cage = readBytes(twoSquares(u, v, "4 4 5 6 7"));
    // -0 and 0 are the same place.
    EXPECT_EQ(cage.faceVertices, (std::vector{0, 1, 2, 3, 1, 5, 6, 2}));
    EXPECT_EQ(cage.faceUvs, (std::vector{0, 1, 2, 3, 4, 5, 6, 7}));
    EXPECT_EQ(cage.uvs[4], Vec2(0.6, 0));
    // One smooth surface: the limit at the common side is not a border's.
    const LimitSurface surface(cage);
    EXPECT_EQ(surface.evaluate(0, 1, 0.5).position, surface.evaluate(1, 0, 0.5).position);
    EXPECT_EQ(surface.corners(0)[1], surface.corners(1)[0]);
  }
}

TEST(ReadPly, VerticesAreJoinedWhereFacesBringTheirOwnCoordinates) {
  const std::string text = asciiBegin + "element vertex 8\n" + vertexXyz +
                           "element face 2\nproperty list uchar int vertex_indices\n"
                           "property list uchar float texcoord\nend_header\n"
                           "0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 0 0\n2 0 0\n2 1 0\n1 1 0\n"
                           "4 0 1 2 3 8 0 0 1 0 1 1 0 1\n4 4 5 6 7 8 0 0 1 0 1 1 0 1\n";
  const Cage cage = readBytes(text);
  EXPECT_EQ(cage.faceVertices, (std::vector{0, 1, 2, 3, 1, 5, 6, 2}));
  EXPECT_EQ(cage.joined.vertices, 2);
}

TEST(ReadPly, PolygonsOfAnySizeAreRefined) {
  // A pentagon and a triangle on its side, cut apart there.
  const std::string text = asciiBegin + "element vertex 8\n" + vertexXyz +
                           "property float s\nproperty float t\nelement face 2\n"
                           "property list uchar int vertex_indices\nend_header\n"
                           "0 0 0 0 0\n2 0 0 1 0\n2 2 0 1 1\n1 3 0 0.5 1.5\n0 2 0 0 1\n"
                           "2 0 0 0 0\n4 1 0 1 0\n2 2 0 0 1\n5 0 1 2 3 4\n3 5 6 7\n";
  const Cage cage = readBytes(text);
  EXPECT_EQ(cage.faceCount(), 5 + 3);
  // Vertices, one more a face and an edge: 6 in faces (2 of 8 are joined), 7 edges; V - E + F = 1.
  const std::string obj =
      "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 3 0\nv 0 2 0\nv 4 1 0\n"
      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0.5 1.5\nvt 0 1\n"
      "f 1/1 2/2 3/3 4/4 5/5\nf 2/1 6/2 3/5\n";
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      ("gnomon_ply_pair" + std::to_string(std::random_device{}()) + ".obj");
  std::ofstream(path) << obj;
  const LimitSurface expected(readMeshFile(path));
  std::filesystem::remove(path);
  const LimitSurface surface(cage);
  ASSERT_EQ(surface.faceCount(), expected.faceCount());
  for (int face = 0; face < surface.faceCount(); ++face) {
    const LimitPoint point = surface.evaluate(face, 0.3, 0.6);
    expectNear(point.position, expected.evaluate(face, 0.3, 0.6).position, 1e-12);
    EXPECT_LT(glm::length(point.uv - expected.evaluate(face, 0.3, 0.6).uv), 1e-14);
  }
}

TEST(ReadPly, TrianglesForLoop) {
  const std::string text = asciiBegin + "element vertex 4\n" + vertexXyz +
                           "property float u\nproperty float v\nelement face 2\n"
                           "property list uchar int vertex_indices\nend_header\n"
                           "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n3 0 1 2\n3 0 2 3\n";
  const Cage cage = readBytes(text, SubdivisionScheme::loop);
  EXPECT_EQ(cage.scheme, SubdivisionScheme::loop);
  EXPECT_EQ(cage.faceVertices, (std::vector{0, 1, 2, 0, 2, 3}));
  expectInputError([&] { readBytes(twoSquares("u", "v", "4 4 5 6 7"), SubdivisionScheme::loop); },
                   {".ply:20: face 0", "4 corners", "triangles only"});
}

TEST(ReadPly, FacesWithoutTextureCoordinatesHaveNoFrames) {
  const std::string text = asciiBegin + "element vertex 6\n" + vertexXyz +
                           "element face 2\nproperty list uchar int vertex_indices\n"
                           "property list uchar float texcoord\nend_header\n"
                           "0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n"
                           "4 0 1 4 3 8 0 0 1 0 1 1 0 1\n4 1 2 5 4 0\n";
  const LimitSurface surface(readBytes(text));
  ASSERT_EQ(surface.faceCount(), 2);
  const LimitPoint with = surface.evaluate(0, 0.3, 0.6);
  EXPECT_NEAR(with.uvDs.x * with.uvDt.y - with.uvDs.y * with.uvDt.x, 1, 1e-12);
  const LimitPoint without = surface.evaluate(1, 0.3, 0.6);
  EXPECT_EQ(without.uvDs, Vec2(0));
  EXPECT_EQ(without.uvDt, Vec2(0));
}

// A body whose first byte is that of a line end: of a float in little-endian order, of a face's
// corners, and of a big-endian float.
TEST(ReadPly, ABinaryBodyKeepsItsBytesWhateverTheHeadersLinesEndWith) {
  const auto tenCorners = [](const std::string& format, float x, bool facesFirst) {
    const std::string vertices =
        "element vertex 10\n" + vertexXyz + "property float u\nproperty float v\n";
    const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
    PlyText text(format);
    text.header(facesFirst ? faces + vertices : vertices + faces);
    const auto addFace = [&] {
      text.add(std::uint8_t{10});
      for (int i = 0; i < 10; ++i) text.add(i);
    };
    if (facesFirst) addFace();
    for (int i = 0; i < 10; ++i) {
      const float angle = 0.6F * static_cast<float>(i);
      text.add(i == 0 ? x : std::cos(angle)).add(std::sin(angle)).add(0.0F);
      text.add(std::cos(angle)).add(std::sin(angle));
    }
    if (!facesFirst) addFace();
    return text.bytes();
  };
  const auto lowByteTen = std::bit_cast<float>(0x3F80000A);
  const auto highByteTen = std::bit_cast<float>(0x0A000000);
  for (const std::string& bytes : {tenCorners("binary_little_endian", lowByteTen, false),
                                   tenCorners("binary_little_endian", 1, true),
                                   tenCorners("binary_big_endian", highByteTen, false)}) {
    const std::size_t body = bytes.find("end_header\n") + 11;
    ASSERT_EQ(bytes[body], '\n');
    const Cage expected = readBytes(bytes);
    for (const char* lineEnd : {"\r", "\r\n"}) {
      std::string header;
      for (const char c : bytes.substr(0, body)) header += c == '\n' ? lineEnd : std::string(1, c);
      expectSame(readBytes(header + bytes.substr(body)), expected);
    }
  }
}

TEST(ReadPly, FormsOfTheSameFile) {
  const std::string text = twoSquares("u", "v", "4 4 5 6 7");
  const Cage expected = readBytes(text);
  std::string dos;
  for (const char c : text) dos += c == '\n' ? "\r\n" : std::string(1, c);
  expectSame(readBytes(dos), expected);
  std::string blank = text;
  blank.insert(blank.find("4 0 1 2 3"), "\n \t\n");
  expectSame(readBytes(blank + "\n\n"), expected);
  // Faces before vertices.
  std::string turned =
      asciiBegin + "element face 1\nproperty list uchar int vertex_indices\nelement vertex 4\n" +
      vertexXyz + "property float u\nproperty float v\nend_header\n4 0 1 2 3\n" +
      "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n";
  EXPECT_EQ(readBytes(turned).faceVertices, (std::vector{0, 1, 2, 3}));
  // Values that nobody needs may be no numbers of use.
  const std::string odd = asciiBegin + "element vertex 4\n" + vertexXyz +
                          "property float u\nproperty float v\nproperty float odd\n"
                          "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                          "0 0 0 0 0 nan\n1 0 0 1 0 inf\n1 1 0 1 1 0\n0 1 0 0 1 0\n4 0 1 2 3\n";
  EXPECT_EQ(readBytes(odd).faceCount(), 1);
}

TEST(ReadPlyErrors, Headers) {
  const std::string rest = "element face 0\nend_header\n";
  expectBadPly("", {"not a PLY"});
  expectBadPly("plywood\n", {":1:", "not a PLY"});
  expectBadPly("OFF\n3 1 0\n", {":1:", "not a PLY"});
  expectBadPly("ply\n", {"ends here"});
  expectBadPly("ply\nelement vertex 3\n", {":2:", "format"});
  expectBadPly("ply\nformat text 1.0\n", {":2:", "'text'", "binary_little_endian"});
  expectBadPly("ply\nformat ascii 2.0\n", {":2:", "'2.0'", "1.0"});
  expectBadPly("ply\nformat ascii\n", {":2:", "2 words"});
  expectBadPly(asciiBegin + "element vertex\n", {":3:", "element NAME COUNT"});
  expectBadPly(asciiBegin + "element vertex -1\n", {":3:", "'-1'"});
  expectBadPly(asciiBegin + "element vertex 99999999999999999999\n", {":3:", "0 or more"});
  expectBadPly(asciiBegin + "element vertex 1\nelement vertex 1\n", {":4:", "second time"});
  expectBadPly(asciiBegin + "property float x\n", {":3:", "before any element"});
  expectBadPly(asciiBegin + "element vertex 1\nproperty half x\n", {":4:", "'half'", "double"});
  expectBadPly(asciiBegin + "element vertex 1\nproperty list float int x\n", {":4:", "fractions"});
  expectBadPly(asciiBegin + "element vertex 1\nproperty list int x\n", {":4:", "4 words"});
  expectBadPly(asciiBegin + "element vertex 1\nproperty int x\nproperty int x\n",
               {":5:", "'x'", "second time"});
  expectBadPly(asciiBegin + "element vertex 3\nend_header\n", {":4:", "without a property"});
  expectBadPly(asciiBegin + "vertex 3\n", {":3:", "'vertex'", "end_header"});
  expectBadPly(asciiBegin + "element vertex 1\nproperty float x\n", {":4:", "ends here"});
  expectBadPly(asciiBegin + rest, {"no element 'vertex'"});
  expectBadPly(asciiBegin + "element vertex 0\n" + vertexXyz + "end_header\n",
               {"no element 'face'"});
  expectBadPly(
      asciiBegin + "element vertex 1\nproperty float x\nproperty float y\n" + rest + "0 0\n",
      {"no property 'z'"});
  expectBadPly(asciiBegin + "element vertex 0\n" + vertexXyz + rest, {"vertex_indices"});
  expectBadPly(asciiBegin + "element vertex 0\n" + vertexXyz +
                   "element face 1\nproperty int vertex_indices\nend_header\n0\n",
               {"no list 'vertex_indices'"});
  expectBadPly(asciiBegin + "element vertex 0\n" + vertexXyz +
                   "element face 0\nproperty list uchar int vertex_indices\nend_header\n",
               {"no faces"});
}

TEST(ReadPlyErrors, Text) {
  const auto text = [](const std::string& face) { return twoSquares("u", "v", face); };
  expectBadPly(text("4 4 5 6"), {":21:", "'vertex_indices'", "of 4 values", "line holds 3"});
  expectBadPly(text("4 4 5 6 7 8"), {":21:", "1 values more", "'face'"});
  expectBadPly(text("4 4 5 6 x"), {":21:", "'x'", "type int"});
  expectBadPly(text("4 4 5 6 7.5"), {":21:", "'7.5'"});
  expectBadPly(text("300 4 5 6 7"), {":21:", "'300'", "uchar"});
  expectBadPly(text("-1 4 5 6 7"), {":21:", "'-1'"});
  expectBadPly(text("4 4 5 6 -7"), {":21:", "vertex index -7"});
  expectBadPly(text("4 4 5 6 8"), {":21: face 1", "vertex 8", "0 to 7"});
  expectBadPly(text("2 4 5"), {":21: face 1", "2 corners"});
  expectBadPly(text("0"), {":21: face 1", "0 corners"});
  expectBadPly(text("4 4 5 6 4"), {":21: face 1", "vertex 4 twice"});
  // 1 and 4 are in one place: such a side without length joins nothing.
  expectBadPly(text("4 1 5 6 4"), {":20: face 0", "vertex 1", "more than one fan"});
  expectBadPly(text("4 0 1 2 3"), {":21:", "opposite directions"});
  expectBadPly(text(""), {"row 1", "'face'", "2 rows"});
  expectBadPly(text("4 4 5 6 7\n4 4 5 6 7"), {"10 bytes after the last row"});
  expectBadPly(asciiBegin + "element vertex 1\n" + vertexXyz +
                   "element face 0\nproperty list uchar int vertex_indices\nend_header\n0 nan 0\n",
               {":10:", "'y'", "finite"});
  expectBadPly(asciiBegin + "element vertex 1\n" + vertexXyz +
                   "element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0\n",
               {":10:", "none for property 'z'"});
}

TEST(ReadPlyErrors, TextureCoordinates) {
  const std::string begin = asciiBegin + "element vertex 4\n" + vertexXyz +
                            "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  expectBadPly(begin + "end_header\n" + vertices + "4 0 1 2 3\n", {"unwrap"});
  const std::string own = begin + "property list uchar float texcoord\nend_header\n" + vertices;
  expectBadPly(own + "4 0 1 2 3 0\n", {"unwrap"});
  expectBadPly(own + "4 0 1 2 3 6 0 0 1 0 1 1\n", {":15:", "6 values", "4 corners"});
  expectBadPly(own + "4 0 1 2 3 8 0 0 1 0 1 1 0 inf\n", {":15:", "'texcoord'", "finite"});
  // One of a pair is none.
  expectBadPly(twoSquares("u", "t", "4 4 5 6 7"), {"unwrap"});
}

TEST(ReadPlyErrors, Bytes) {
  for (const std::string& format : {formats[1], formats[2]}) {
    SCOPED_TRACE(format);
    const std::string whole = plyOf(openGrid(2, 1), format);
    EXPECT_EQ(readBytes(whole).faceCount(), 2);
    expectBadPly(whole.substr(0, whole.size() - 1), {"element 'face'", "row 1", "byte", "'mark'"});
    expectBadPly(whole + "x", {"1 bytes after the last row"});
    // The last face's count of corners lies five bytes and four corners before the end.
    std::string count = whole;
    count.replace(count.size() - 1 - 4 * 4 - 4, 4, "\x7f\x7f\x7f\x7f");
    expectBadPly(count, {"element 'face'", "row 1", "2139062143 values", "holds 4"});
    std::string negative = whole;
    negative.replace(negative.size() - 1 - 4 * 4 - 4, 4, "\xff\xff\xff\xff");
    expectBadPly(negative, {"-1 values"});
    std::string vertex = whole;
    vertex.replace(vertex.size() - 1 - 4, 4, "\xff\xff\xff\xff");
    expectBadPly(vertex, {"vertex index 4294967295"});
  }
  // Rows without end: refused where the bytes end, nothing is allocated for them.
  std::string endless = plyOf(openGrid(2, 1), formats[1]);
  endless.replace(endless.find("vertex 6"), 8, "vertex 9999999999999");
  expectBadPly(endless, {"element 'vertex'", "ends"});
}

TEST(ReadPlyErrors, CutAnywhere) {
  for (const std::string& format : formats) {
    const std::string whole = plyOf(openGrid(1, 1), format);
    for (std::size_t size = 0; size + 8 < whole.size(); ++size) {
      EXPECT_THROW(readBytes(whole.substr(0, size)), InputError) << format << ' ' << size;
    }
  }
}

TEST(ReadPlyErrors, DamagedFilesNeverDoWorseThanAnInputError) {
  Random random(13);
  const std::string cube = plyOf(cubeCage(), formats[1]);
  int refused = 0;
  for (int round = 0; round < 300; ++round) {
    std::string bytes = cube;
    for (int i = 0; i < 3; ++i) {
      bytes[static_cast<std::size_t>(random(0, static_cast<double>(bytes.size())))] =
          static_cast<char>(random(0, 256));
    }
    try {
      const LimitSurface surface(readBytes(bytes));
      expectFinite(surface.evaluate(0, 0.5, 0.5));
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 30);
}

TEST(ReadPlyErrors, Endings) {
  expectInputError([] { readMeshFile("mesh.off"); }, {"mesh.off", ".obj or .ply"});
  expectInputError([] { readMeshFile("mesh"); }, {"mesh:", ".obj or .ply"});
  expectInputError([] { readMeshFile("no/such/mesh.PLY"); }, {"no/such/mesh.PLY", "no such file"});
}

}  // namespace
}  // namespace gnomon::surface
