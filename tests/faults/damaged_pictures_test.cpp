// Damaged pictures of every format that is read, and pictures of formats that are not: cut off,
// with bytes changed, with sizes enlarged, under any name. A reader takes them or refuses them in
// one line that names the file; it prints nothing, and takes no memory for what a file cannot hold.

#include <OpenImageIO/imageio.h>
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <random>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/system/memory.h"
#include "end_to_end/support/program.h"
#include "image/mask_picture.h"
#include "relief/height_field.h"
#include "support/sanitized.h"
#include "support/test_length.h"

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;
using namespace std::string_literals;

/// A whole picture as the bytes of its file.
struct Seed {
  std::string name;    ///< with its coding
  std::string ending;  ///< of the file names that it usually has
  std::string bytes;
  std::string kind;  ///< what a refusal calls it; empty for a format that is read
  int channels = 1;
};

constexpr int width = 9;
constexpr int height = 7;

/// The most memory that the process takes while something runs, over what it had before.
double peakBytesWhile(const std::function<void()>& work) {
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak begins anew
  const double before = static_cast<double>(residentMemoryBytes());
  work();
  std::ifstream status("/proc/self/status");
  std::string key;
  double kibibytes = 0;
  while (status >> key) {
    if (key == "VmHWM:") break;
    status.ignore(1000, '\n');
  }
  status >> kibibytes;
  return kibibytes * 1024 - before;
}

class DamagedPictures : public EndToEnd {
 protected:
  /// Written by OpenImageIO; none where it has no writer for it.
  std::string written(const std::string& ending, const OIIO::ImageSpec& spec) const {
    const std::filesystem::path path = file("seed." + ending);
    const auto out = OIIO::ImageOutput::create(path.string());
    if (!out || !out->open(path.string(), spec)) {
      (void)OIIO::geterror();
      return {};
    }
    std::vector<float> values(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i * 7 % 5) / 4;
    if (!out->write_image(OIIO::TypeDesc::FLOAT, values.data()) || !out->close()) return {};
    std::string bytes = readFile(path);
    std::filesystem::remove(path);
    return bytes;
  }

  /// By hand: some versions of OpenImageIO write these from the bottom.
  static Seed portableMap(const std::string& ending, const std::string& magic, int channels) {
    std::string bytes = fmt::format("{}\n{} {}\n255\n", magic, width, height);
    for (int i = 0; i < width * height * channels; ++i) {
      bytes += static_cast<char>(std::lround(255 * static_cast<float>(i * 7 % 5) / 4));
    }
    return {ending, ending, bytes, "", channels};
  }

  static OIIO::ImageSpec spec(int channels, OIIO::TypeDesc type, const std::string& coding = {}) {
    OIIO::ImageSpec result(width, height, channels, type);
    if (!coding.empty()) result.attribute("compression", coding);
    return result;
  }

  std::vector<Seed> readSeeds() const {
    using OIIO::TypeDesc;
    std::vector<Seed> seeds;
    const auto add = [&](const std::string& ending, const OIIO::ImageSpec& of) {
      const std::string coding = of.get_string_attribute("compression");
      seeds.push_back({fmt::format("{} {} {} {}", ending, coding, of.nchannels, of.format.c_str()),
                       ending, written(ending, of), "", of.nchannels});
    };
    for (const char* coding :
         {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa"}) {
      add("exr", spec(1, TypeDesc::HALF, coding));
    }
    OIIO::ImageSpec tiled = spec(1, TypeDesc::FLOAT, "zip");
    tiled.tile_width = tiled.tile_height = 4;
    add("exr", tiled);
    for (const char* coding : {"none", "lzw", "zip", "packbits"}) {
      add("tif", spec(1, TypeDesc::UINT16, coding));
    }
    add("tif", spec(3, TypeDesc::UINT8, "jpeg"));
    add("tif", spec(1, TypeDesc::DOUBLE, "lzw"));
    OIIO::ImageSpec planes = spec(3, TypeDesc::UINT16, "zip");
    planes.attribute("planarconfig", "separate");
    add("tif", planes);
    for (const int bits : {1, 4}) {
      OIIO::ImageSpec few = spec(1, TypeDesc::UINT8, "none");
      few.attribute("oiio:BitsPerSample", bits);
      add("tif", few);
    }
    tiled = spec(1, TypeDesc::UINT8, "zip");
    tiled.tile_width = tiled.tile_height = 16;
    add("tif", tiled);
    for (const int channels : {1, 2, 3, 4}) {
      add("png", spec(channels, channels < 3 ? TypeDesc::UINT16 : TypeDesc::UINT8));
    }
    add("jpg", spec(1, TypeDesc::UINT8));
    OIIO::ImageSpec progressive = spec(3, TypeDesc::UINT8);
    progressive.attribute("jpeg:progressive", 1);
    add("jpg", progressive);
    add("hdr", spec(3, TypeDesc::FLOAT));
    seeds.push_back(portableMap("pgm", "P5", 1));
    seeds.push_back(portableMap("ppm", "P6", 3));
    add("bmp", spec(1, TypeDesc::UINT8));
    add("bmp", spec(3, TypeDesc::UINT8));
    add("tga", spec(1, TypeDesc::UINT8));
    add("tga", spec(3, TypeDesc::UINT8, "rle"));
    std::string floats(static_cast<std::size_t>(width * height) * sizeof(float), '\0');
    seeds.push_back({"pfm", "pfm", "Pf\n9 7\n-1.0\n" + floats, ""});
    return seeds;
  }

  std::vector<Seed> foreignSeeds() const {
    using OIIO::TypeDesc;
    std::vector<Seed> seeds;
    const auto add = [&](const std::string& ending, int channels, const std::string& kind) {
      const std::string bytes = written(ending, spec(channels, TypeDesc::UINT8));
      if (!bytes.empty()) seeds.push_back({ending, ending, bytes, kind});
    };
    add("gif", 3, "a GIF picture");
    add("sgi", 3, "an SGI picture");
    add("dpx", 3, "a DPX picture");
    add("fits", 1, "a FITS picture");
    add("jp2", 3, "a JPEG 2000 picture");
    add("rla", 3, "an RLA picture");
    add("webp", 3, "a WebP picture");
    add("ico", 4, "an icon (ICO)");
    OIIO::ImageSpec iff = spec(4, TypeDesc::UINT8, "rle");
    iff.tile_width = iff.tile_height = 64;
    const std::string iffBytes = written("iff", iff);
    if (!iffBytes.empty()) seeds.push_back({"iff", "iff", iffBytes, "an IFF picture"});
    // OpenImageIO only reads these: the headers of 9 × 7 pixels, then some bytes.
    const std::string rest(300, '\x05');
    seeds.push_back(
        {"softimage", "pic",
         "\x53\x80\xf6\x34\x40\x60\0\0"s + std::string(80, 'c') + "PICT\0\x09\0\x07"s + rest,
         "a Softimage picture"});
    seeds.push_back({"photoshop", "psd",
                     "8BPS\0\x01\0\0\0\0\0\0\0\x03\0\0\0\x07\0\0\0\x09\0\x08\0\x03"s + rest,
                     "a Photoshop picture (PSD)"});
    seeds.push_back({"cineon", "cin", "\x80\x2a\x5f\xd7\0\0\x08\0"s + rest, "a Cineon picture"});
    return seeds;
  }

  /// What reading a file said; empty where it was taken.
  template <typename Read>
  std::string refusal(const Read& read) {
    try {
      read();
      return {};
    } catch (const InternalError& error) {
      ADD_FAILURE() << "an internal error: " << error.what();
      return error.what();
    } catch (const Error& error) {
      return error.what();
    }
  }

  /// Reads a file in every way that the program has. Each either takes it or says why not, in a
  /// line that begins with its name.
  std::array<std::string, 2> refusals(const std::filesystem::path& path) {
    std::array<std::string, 2> all = {
        refusal([&] { relief::readHeightImage(path, 0, 1, relief::Wrap::repeat); }),
        refusal([&] { image::readMaskPicture(path, {.channel = {}, .threshold = 0.5}); })};
    for (const std::string& said : all) {
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
      EXPECT_TRUE(said.empty() || said.starts_with(path.string() + ": ")) << said;
    }
    return all;
  }
};

/// Fails where something was printed while it lived.
class Silence {
 public:
  Silence() { testing::internal::CaptureStderr(); }
  ~Silence() { EXPECT_EQ(testing::internal::GetCapturedStderr(), ""); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
};

using Random = std::mt19937;

std::size_t below(Random& random, std::size_t end) {
  return end == 0 ? 0 : random() % end;
}

std::string cut(std::string bytes, Random& random) {
  bytes.resize(below(random, bytes.size()));
  return bytes;
}

std::string flipped(std::string bytes, Random& random) {
  for (std::size_t i = 0; i <= random() % 8; ++i) {
    bytes[below(random, bytes.size())] ^= static_cast<char>(1U << (random() % 8));
  }
  return bytes;
}

/// A number of the header replaced by a large one: in a header of text a group of digits, else two
/// or four bytes.
std::string enlarged(std::string bytes, Random& random) {
  const std::size_t header = std::min<std::size_t>(bytes.size(), 400);
  const bool isText = bytes[0] == 'P' || bytes[0] == '#';
  if (isText) {
    std::vector<std::size_t> digits;
    for (std::size_t i = 2; i < std::min<std::size_t>(header, 80); ++i) {
      if (std::isdigit(static_cast<unsigned char>(bytes[i])) != 0) digits.push_back(i);
    }
    return bytes.replace(digits[below(random, digits.size())], 1,
                         std::string(1 + random() % 9, '9'));
  }
  static constexpr std::array<std::uint32_t, 5> large = {12000, 65535, 1U << 20, 0x7fffffff,
                                                         0xffffffff};
  const std::uint32_t value = large.at(below(random, large.size()));
  const std::size_t size = random() % 2 == 0 ? 2 : 4;
  const bool isBig = random() % 2 == 0;
  const std::size_t at = 2 + below(random, header - 6);
  for (std::size_t i = 0; i < size; ++i) {
    bytes[at + i] = static_cast<char>(value >> (8 * (isBig ? size - 1 - i : i)));
  }
  return bytes;
}

TEST_F(DamagedPictures, AreTakenOrRefusedInOneLine) {
  const std::vector<Seed> seeds = readSeeds();
  static constexpr std::array damages = {cut, flipped, enlarged};
  const int count = repetitions(300, 2000);
  Random random(11);
  std::map<std::string, int> outcomes;
  double longest = 0;
  // Another format's name: what counts is the content.
  const auto path = file("damaged.gif");
  const double peak = peakBytesWhile([&] {
    for (int i = 0; i < count; ++i) {
      const Seed& seed = seeds[static_cast<std::size_t>(i) % seeds.size()];
      ASSERT_NE(seed.bytes, "") << seed.name;
      SCOPED_TRACE(fmt::format("picture {}, {}", i, seed.name));
      writeTextAtomically(path, damages.at(random() % damages.size())(seed.bytes, random));
      const auto begin = std::chrono::steady_clock::now();
      const Silence silence;
      const auto said = refusals(path);
      longest = std::max(
          longest, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
      ++outcomes[said[0].empty() ? "taken" : "refused"];
    }
  });
  EXPECT_EQ(outcomes["taken"] + outcomes["refused"], count);
  EXPECT_GT(outcomes["taken"], 0);
  EXPECT_GT(outcomes["refused"], count / 2);
  EXPECT_LT(peak, 1e9);
  EXPECT_LT(longest, 20);
  fmt::print(
      "faults: {} damaged pictures, {} taken, {} refused, {} more at most, {:.2f} s at most\n",
      count, outcomes["taken"], outcomes["refused"], formatBytes(peak), longest);
}

TEST_F(DamagedPictures, OfFormatsThatAreNotReadAreCalledByTheirNames) {
  const std::vector<Seed> seeds = foreignSeeds();
  EXPECT_GE(seeds.size(), 8U);
  const int count = repetitions(4, 60);
  Random random(12);
  int refused = 0;
  for (const Seed& seed : seeds) {
    for (int i = 0; i < count; ++i) {
      // Its first bytes say what it is.
      constexpr std::size_t start = 64;
      std::string bytes = i == 0 ? seed.bytes : flipped(seed.bytes, random);
      bytes.replace(0, start, seed.bytes.substr(0, start));
      if (i % 3 == 2) bytes.resize(start + below(random, bytes.size() - start));
      for (const std::string& ending : {seed.ending, "png"s, "exr"s, "tif"s, "tga"s}) {
        const auto path = file("foreign." + ending);
        writeTextAtomically(path, bytes);
        const Silence silence;
        for (const std::string& said : refusals(path)) {
          EXPECT_THAT(said, HasSubstr(seed.kind + " found, EXR, PNG, TIFF"));
        }
        ++refused;
      }
    }
  }
  fmt::print("faults: {} pictures of {} other formats, all refused by name\n", refused,
             seeds.size());
}

TEST_F(DamagedPictures, WholeOnesAreReadUnderAnyName) {
  for (const Seed& seed : readSeeds()) {
    SCOPED_TRACE(seed.name);
    std::vector<float> heights;
    for (const std::string& ending : {seed.ending, "png"s, "exr"s, "gif"s, "tga"s, "nothing"s}) {
      const auto path = file("whole." + ending);
      writeTextAtomically(path, seed.bytes);
      const relief::HeightField field = relief::readHeightImage(path, 0, 1, relief::Wrap::repeat);
      EXPECT_EQ(field.width(), width);
      EXPECT_EQ(field.height(), height);
      if (heights.empty()) heights = field.texels();
      EXPECT_EQ(field.texels(), heights) << ending;
    }
    // What was written, to half a step of one bit; a JPEG has losses, the PFM is black.
    if (seed.name.find("jp") != std::string::npos || seed.ending == "pfm") continue;
    for (int i = 0; i < width * height; ++i) {
      const float value = static_cast<float>(seed.channels * i * 7 % 5) / 4;
      EXPECT_NEAR(heights[static_cast<std::size_t>((height - 1 - i / width) * width + i % width)],
                  value, 0.51F)
          << i;
    }
  }
}

std::string bigEndian(std::uint32_t value, std::size_t size) {
  std::string bytes;
  for (std::size_t i = size; i-- > 0;) bytes += static_cast<char>(value >> (8 * i));
  return bytes;
}

std::string littleEndian(std::uint32_t value, std::size_t size) {
  std::string bytes = bigEndian(value, size);
  std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::uint32_t pngChecksum(const std::string& bytes) {
  std::uint32_t sum = ~0U;
  for (const char c : bytes) {
    sum ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) sum = (sum & 1) != 0 ? sum >> 1 ^ 0xedb88320U : sum >> 1;
  }
  return ~sum;
}

/// The picture with sides that its header states and its content does not have.
std::string stating(const Seed& seed, std::uint32_t side) {
  std::string bytes = seed.bytes;
  const auto put = [&](std::size_t at, const std::string& by) { bytes.replace(at, by.size(), by); };
  const auto putAfter = [&](const std::string& before, std::size_t skip, const std::string& by) {
    const std::size_t at = bytes.find(before);
    EXPECT_NE(at, std::string::npos) << seed.name;
    put(at + before.size() + skip, by);
  };
  if (seed.ending == "png") {
    put(16, bigEndian(side, 4) + bigEndian(side, 4));
    put(29, bigEndian(pngChecksum(bytes.substr(12, 17)), 4));
  } else if (seed.ending == "bmp") {
    put(18, littleEndian(side, 4) + littleEndian(side, 4));
  } else if (seed.ending == "tga") {
    put(12, littleEndian(side, 2) + littleEndian(side, 2));
  } else if (seed.ending == "exr") {
    putAfter("dataWindow\0box2i\0"s, 12, littleEndian(side - 1, 4) + littleEndian(side - 1, 4));
    putAfter("displayWindow\0box2i\0"s, 12, littleEndian(side - 1, 4) + littleEndian(side - 1, 4));
  } else if (seed.ending == "jpg") {
    const std::size_t frame = std::min(bytes.find("\xff\xc0"), bytes.find("\xff\xc2"));
    put(frame + 5, bigEndian(side, 2) + bigEndian(side, 2));
  } else if (seed.ending == "hdr") {
    bytes = replaced(bytes, "-Y 7 +X 9", fmt::format("-Y {0} +X {0}", side));
  } else if (seed.ending == "tif") {
    // Of tags 256 and 257, whose values are numbers of 16 or 32 bits.
    const auto tag = [&](std::uint32_t number, std::uint32_t was) {
      for (const std::uint32_t type : {3U, 4U}) {
        const std::string entry = littleEndian(number, 2) + littleEndian(type, 2) +
                                  littleEndian(1, 4) + littleEndian(was, type == 3 ? 2 : 4);
        const std::size_t at = bytes.find(entry);
        if (at != std::string::npos) put(at + 8, littleEndian(side, type == 3 ? 2 : 4));
      }
    };
    tag(256, width);
    tag(257, height);
  } else {
    bytes = replaced(bytes, "9 7\n", fmt::format("{0} {0}\n", side));
  }
  EXPECT_NE(bytes, seed.bytes) << seed.name;
  return bytes;
}

TEST_F(DamagedPictures, TakeNoMemoryForSizesThatTheyDoNotHave) {
  const std::vector<Seed> seeds = readSeeds();
  double most = 0;
  for (const Seed& seed : seeds) {
    SCOPED_TRACE(seed.name);
    const auto path = file("stating.picture");
    writeTextAtomically(path, stating(seed, 12000));
    const double peak = peakBytesWhile([&] {
      const Silence silence;
      EXPECT_NE(refusals(path)[0], "");
    });
    // The coefficients of a progressive JPEG, and a whole tile row, are the least that some take.
    EXPECT_LT(peak, 1e8);
    most = std::max(most, peak);
  }
  fmt::print("faults: {} pictures that state 12000 × 12000 pixels, {} more at most\n", seeds.size(),
             formatBytes(most));
}

// More rows and columns than a chunk of an EXR unpacks to: what would fill them is undefined.
TEST_F(DamagedPictures, AreNotFilledUpWithWhatMemoryHeld) {
  for (const Seed& seed : readSeeds()) {
    if (seed.ending != "exr") continue;
    const auto path = file("wider.exr");
    writeTextAtomically(path, stating(seed, 12));
    EXPECT_THAT(refusals(path)[0], HasSubstr("its pixels cannot be read: ")) << seed.name;
  }
}

TEST_F(DamagedPictures, ALargePictureIsInMemoryOnce) {
  if (test::isSanitized) GTEST_SKIP() << "a sanitizer's own memory counts";
  const int side = repetitions(3000, 12000);
  for (const auto& [ending, channels] : {std::pair("png", 1), {"png", 3}, {"tif", 1}, {"exr", 3}}) {
    SCOPED_TRACE(ending);
    const auto path = file(std::string("large.") + ending);
    const OIIO::ImageSpec large(side, side, channels, OIIO::TypeDesc::UINT8);
    const auto out = OIIO::ImageOutput::create(path.string());
    ASSERT_TRUE(out && out->open(path.string(), large));
    const std::vector<std::uint8_t> row(static_cast<std::size_t>(side) * 3, 7);
    for (int y = 0; y < side; ++y) {
      ASSERT_TRUE(out->write_scanline(y, 0, OIIO::TypeDesc::UINT8, row.data()));
    }
    ASSERT_TRUE(out->close());
    const double heights = static_cast<double>(side) * side * sizeof(float);
    const double peak = peakBytesWhile(
        [&, last = channels - 1] { relief::readHeightImage(path, last, 1, relief::Wrap::repeat); });
    EXPECT_LT(peak, 1.3 * heights + 5e7);
    EXPECT_GT(peak, 0.5 * heights) << "the peak cannot be told here";
  }
}

TEST_F(DamagedPictures, EndTheProgramInOneLineToo) {
  const std::vector<Seed> seeds = readSeeds();
  const int count = repetitions(6, 90);
  static constexpr std::array damages = {cut, flipped, enlarged};
  Random random(13);
  write("sound.pgm", "P5\n9 7\n255\n" + std::string(width * height, '\xff'));
  write("image.toml", replaced(smallStudy(),
                               "[relief]\npattern = \"columns\"\ntexels = [32, 32]\n"
                               "period = 16\nradius = 4\nwall = 1\n",
                               "[relief]\nimage = \"damaged.png\"\n"));
  const std::vector<std::vector<std::string>> commands = {
      {"bake", "image.toml"}, {"run", "image.toml"}, {"compare", "damaged.png", "sound.pgm"}};
  std::map<int, int> statuses;
  for (int i = 0; i < count; ++i) {
    const Seed& seed = seeds[below(random, seeds.size())];
    SCOPED_TRACE(fmt::format("run {}, {}", i, seed.name));
    write("damaged.png", damages.at(random() % damages.size())(seed.bytes, random));
    const Outcome outcome = gnomon(commands[static_cast<std::size_t>(i) % commands.size()]);
    ++statuses[outcome.status];
    EXPECT_TRUE(outcome.status == 0 || outcome.status == 3 || outcome.status == 4)
        << outcome.status << outcome.err;
    const auto lines = std::count(outcome.err.begin(), outcome.err.end(), '\n');
    if (outcome.status != 0) {
      EXPECT_EQ(lines, 1) << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr("gnomon: "));
    }
    EXPECT_THAT(outcome.err, testing::Not(HasSubstr("internal error")));
  }
  fmt::print("faults: {} damaged pictures given to the program, {} taken, {} refused\n", count,
             statuses[0], statuses[3] + statuses[4]);
}

}  // namespace
}  // namespace gnomon::test
