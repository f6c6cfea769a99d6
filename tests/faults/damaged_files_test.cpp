// Files of every kind that is read, cut off, grown, with bits turned and with other files' bytes in
// them: each is read, or refused in one line that names it.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <random>

#include "cli/output.h"
#include "common/error.h"
#include "common/files/atomic_file.h"
#include "end_to_end/support/program.h"
#include "image/images.h"
#include "image/mask_picture.h"
#include "render/method.h"
#include "report/json/results_json.h"
#include "study/spec/study_file.h"
#include "support/temporary_folder.h"
#include "support/test_length.h"
#include "surface/mesh_file.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

/// A kind of file: one that is whole, and what reads it.
struct ReadKind {
  std::string name;
  std::string bytes;
  std::function<void(const fs::path&)> read;
};

/// With a label that needs escapes, and a threshold.
std::string studyBytes() {
  return smallStudy() +
         "label = \"a \\\"label\\\"\"\nparameters = {}\n\n[[threshold]]\nmax = 0.5\n";
}

std::string binarySquare() {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nproperty float u\nproperty float v\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  const auto add = [&text](const auto value) {
    text.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (int i = 0; i < 4; ++i) {
    const float x = i == 1 || i == 2 ? 1 : 0;
    const float y = i > 1 ? 1 : 0;
    for (const float value : {x, y, 0.0F, x, y}) add(value);
  }
  add(std::uint8_t{4});
  for (const std::int32_t vertex : {0, 1, 2, 3}) add(vertex);
  return text;
}

std::string referencesBytes() {
  study::Baseline baseline;
  baseline.study = "figure8";
  baseline.environment.glRenderer = "a renderer";
  baseline.history = {{"the first", "0.1", "abc"}};
  for (const compare::MetricId metric :
       {compare::metrics::errorRate, compare::metrics::falseLight}) {
    study::Gate row{"onoue-2004", "evening", "camera", "", metric, {}, {}};
    row.step = "figure8";
    baseline.gates.push_back(study::referenceGate(row, {0.05, 0.001, 0.002}));
  }
  return report::baselineJson(baseline);
}

/// @param folder  for a file that it comes from
std::string maskBytes(const fs::path& folder) {
  Mask mask{24, 16, {}};
  for (int i = 0; i < 24 * 16; ++i) {
    mask.samples.push_back(i % 7 == 0 ? Shade::none : i % 3 == 0 ? Shade::shadowed : Shade::lit);
  }
  image::writePng(folder / "whole.png", image::maskImage(mask));
  return readFile(folder / "whole.png");
}

/// @param folder  as maskBytes
std::vector<ReadKind> readKinds(const fs::path& folder) {
  const auto mesh = [](const fs::path& path) { (void)surface::readMeshFile(path); };
  const std::string asciiPly =
      "ply\nformat ascii 1.0\ncomment one\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nproperty float u\nproperty float v\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n"
      "0 1 0 0 1\n4 0 1 2 3\n";
  const std::string obj =
      "o square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
      "vn 0 0 1\ns 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\nt crease 2/1/0 0 1 2.5\n";
  return {
      {"study.toml", studyBytes(), [](const fs::path& path) { (void)study::readStudy(path); }},
      {"method.glsl",
       readFile(fs::path(GNOMON_SCENES) / "../shaders/methods/osculating-march.glsl"),
       [](const fs::path& path) { (void)render::readMethod(path); }},
      {"mesh.obj", obj, mesh},
      {"ascii.ply", asciiPly, mesh},
      {"binary.ply", binarySquare(), mesh},
      {"references.json", referencesBytes(),
       [](const fs::path& path) { (void)report::readBaseline(path); }},
      {"mask.png", maskBytes(folder),
       [](const fs::path& path) { (void)image::readMaskPicture(path); }},
  };
}

/// How the tries of one kind ended.
struct DamageCounts {
  int read = 0;
  int refused = 0;
  double slowest = 0;  ///< seconds
};

class DamagedFiles : public TemporaryFolder {
 protected:
  void tryOut(const ReadKind& kind, const fs::path& path, const std::string& damage,
              DamageCounts& counts) {
    const auto begin = std::chrono::steady_clock::now();
    try {
      kind.read(path);
      ++counts.read;
    } catch (const std::exception& error) {
      ++counts.refused;
      const cli::Failure failure = cli::currentFailure();
      const bool isMemory = dynamic_cast<const MemoryError*>(&error) != nullptr;
      EXPECT_TRUE(isMemory || failure.status == ExitStatus::badInput)
          << damage << ": " << failure.message;
      EXPECT_NE(failure.message.find(kind.name), std::string::npos)
          << damage << ": " << failure.message;
      EXPECT_EQ(failure.message.find('\n'), std::string::npos) << damage;
      EXPECT_LT(failure.message.size(), 1600U) << damage << ": " << failure.message;
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    counts.slowest = std::max(counts.slowest, taken.count());
  }
  void tryBytes(const ReadKind& kind, const std::string& bytes, const std::string& damage,
                DamageCounts& counts) {
    const fs::path path = file(kind.name);
    std::ofstream(path, std::ios::binary) << bytes;
    tryOut(kind, path, damage, counts);
  }
  void report(const ReadKind& kind, const char* damage, const DamageCounts& counts) const {
    std::printf("faults: %s: %d %s, %d read, %d refused, the slowest in %.2f s\n",
                kind.name.c_str(), counts.read + counts.refused, damage, counts.read,
                counts.refused, counts.slowest);
    EXPECT_LT(counts.slowest, 20) << kind.name;
  }
};

TEST_F(DamagedFiles, WholeOnesAreRead) {
  for (const ReadKind& kind : readKinds(folder())) {
    std::ofstream(file(kind.name), std::ios::binary) << kind.bytes;
    EXPECT_NO_THROW(kind.read(file(kind.name))) << kind.name;
  }
}

TEST_F(DamagedFiles, CutOff) {
  const auto most = static_cast<std::size_t>(repetitions(60, 2000));
  for (const ReadKind& kind : readKinds(folder())) {
    DamageCounts counts;
    const std::size_t step = std::max<std::size_t>(1, kind.bytes.size() / most);
    for (std::size_t length = 0; length < kind.bytes.size(); length += step) {
      tryBytes(kind, kind.bytes.substr(0, length), fmt::format("cut off at {}", length), counts);
    }
    report(kind, "cut off", counts);
    EXPECT_GT(counts.refused, 0) << kind.name;
  }
}

TEST_F(DamagedFiles, WithBitsTurned) {
  const int tries = repetitions(60, 5000);
  for (const ReadKind& kind : readKinds(folder())) {
    std::minstd_rand random(7);
    DamageCounts counts;
    for (int i = 0; i < tries; ++i) {
      std::string bytes = kind.bytes;
      const auto bits = 1 + random() % 4;
      for (unsigned bit = 0; bit < bits; ++bit) {
        char& byte = bytes[random() % bytes.size()];
        byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << random() % 8U));
      }
      tryBytes(kind, bytes, fmt::format("bits turned, try {}", i), counts);
    }
    report(kind, "with bits turned", counts);
    EXPECT_GT(counts.refused, 0) << kind.name;
  }
}

TEST_F(DamagedFiles, WithAPartMissingTwiceOrOfAnotherFile) {
  const int tries = repetitions(60, 3000);
  const std::vector<ReadKind> all = readKinds(folder());
  for (const ReadKind& kind : all) {
    std::minstd_rand random(11);
    DamageCounts counts;
    for (int i = 0; i < tries; ++i) {
      std::string bytes = kind.bytes;
      const std::size_t at = random() % bytes.size();
      const std::size_t length = 1 + random() % std::min<std::size_t>(bytes.size() - at, 64);
      const std::string& other = all[random() % all.size()].bytes;
      switch (i % 3) {
        case 0:
          bytes.erase(at, length);
          break;
        case 1:
          bytes.insert(at, bytes.substr(at, length));
          break;
        default:
          bytes.replace(at, length, other.substr(random() % other.size(), length));
      }
      tryBytes(kind, bytes, fmt::format("parts changed, try {}", i), counts);
    }
    report(kind, "with a part missing, twice or of another file", counts);
  }
}

TEST_F(DamagedFiles, Enlarged) {
  for (const ReadKind& kind : readKinds(folder())) {
    DamageCounts counts;
    const std::size_t more = static_cast<std::size_t>(repetitions(1 << 16, 1 << 22));
    tryBytes(kind, kind.bytes + kind.bytes, "twice", counts);
    for (const char c : {'\0', ' ', '\n', '[', '{', '#', '\xFF', '9', '"'}) {
      tryBytes(kind, kind.bytes + std::string(more, c), fmt::format("{} × {:?}", more, c), counts);
      tryBytes(kind, std::string(more, c) + kind.bytes, fmt::format("{:?} before", c), counts);
      tryBytes(kind, std::string(more, c), fmt::format("{:?} alone", c), counts);
    }
    report(kind, "enlarged", counts);
  }
}

// Grown to more than memory holds, without taking any of the disk.
TEST_F(DamagedFiles, GrownSparse) {
  for (const ReadKind& kind : readKinds(folder())) {
    DamageCounts counts;
    // A PNG is read up to its end, and no more of the file.
    if (kind.name == "mask.png") continue;
    const fs::path path = file(kind.name);
    std::ofstream(path, std::ios::binary) << kind.bytes;
    std::error_code failure;
    fs::resize_file(path, std::uintmax_t{1} << 43U, failure);
    if (failure) GTEST_SKIP() << "no file of 8 TiB, even an empty one: " << failure.message();
    tryOut(kind, path, "grown to 8 TiB", counts);
    report(kind, "grown sparse", counts);
    EXPECT_EQ(counts.refused, 1) << kind.name;
  }
}

}  // namespace
}  // namespace gnomon::test
