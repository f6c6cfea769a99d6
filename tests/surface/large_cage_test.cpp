// Cages of many faces take bounded memory, and one that would not fit is refused.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "common/error.h"
#include "common/system/memory.h"
#include "support/sanitized.h"
#include "surface/limit_surface.h"
#include "surface/mesh_file.h"
#include "surface/test_surfaces.h"

namespace gnomon::surface {
namespace {

/// How much more memory this process holds at most from here on (Linux).
class PeakGrowth {
 public:
  PeakGrowth() {
    std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew
    begin_ = peakBytes();
  }
  [[nodiscard]] double bytes() const { return peakBytes() - begin_; }

 private:
  static double peakBytes() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
      if (line.rfind("VmHWM:", 0) == 0) return 1024 * std::stod(line.substr(6));
    }
    ADD_FAILURE() << "no VmHWM in /proc/self/status";
    return 0;
  }
  double begin_ = 0;
};

/// A grid with hills.
Cage hillyGrid(int columns, int rows) {
  Cage cage = openGrid(columns, rows);
  Random random(3);
  for (Vec3& position : cage.positions) position.z = random(0, 0.3);
  return cage;
}

/// The grid with its squares cut into triangles, as a file: no face of a Catmull-Clark cage made of
/// it is regular.
std::string triangles(const Cage& grid) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " +
                     std::to_string(grid.positions.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nproperty float u\n"
                     "property float v\nelement face " +
                     std::to_string(2 * grid.faceCount()) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : grid.positions) {
    text += fmt::format("{} {} {} {} {}\n", p.x, p.y, p.z, p.x, p.y);
  }
  for (std::size_t i = 0; i < grid.faceVertices.size(); i += 4) {
    const int* v = &grid.faceVertices[i];
    text += fmt::format("3 {} {} {}\n3 {} {} {}\n", v[0], v[1], v[2], v[0], v[2], v[3]);
  }
  return text;
}

TEST(LargeCage, AHundredThousandFacesTakeBoundedMemory) {
  if (test::isSanitized) GTEST_SKIP() << "memory is not the program's own";
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      ("gnomon_large" + std::to_string(std::random_device{}()) + ".ply");
  std::ofstream(path) << triangles(hillyGrid(170, 100));
  const PeakGrowth growth;
  const Cage cage = readMeshFile(path);
  std::filesystem::remove(path);
  ASSERT_EQ(cage.faceCount(), 3 * 2 * 170 * 100);
  const LimitSurface surface(cage);
  EXPECT_EQ(surface.faceCount(), 102000);
  expectFinite(surface.evaluate(101999, 0.5, 0.5));
  // Measured: 1.36 GB, most of it patch points about the vertices that are not of four faces.
  EXPECT_LT(growth.bytes(), 1.6e9);
  EXPECT_GT(growth.bytes(), 1e8);
}

TEST(LargeCage, OneThatWouldNotFitIsRefusedBeforeItIsBuilt) {
  // Every edge another sharpness: no two faces share their patches.
  Cage cage = hillyGrid(400, 250);
  Random random(4);
  for (int face = 0; face < cage.faceCount(); ++face) {
    const int* corner = &cage.faceVertices[4 * static_cast<std::size_t>(face)];
    cage.creases.push_back({{corner[0], corner[1]}, random(4, 10)});
    cage.creases.push_back({{corner[0], corner[3]}, random(4, 10)});
  }
  if (test::isSanitized || static_cast<double>(availableMemoryBytes()) > 50e9) {
    GTEST_SKIP() << "it might fit here";
  }
  const PeakGrowth growth;
  try {
    const LimitSurface surface(cage);
    FAIL() << "not refused";
  } catch (const MemoryError& error) {
    EXPECT_NE(std::string(error.what()).find("of 100000 faces took"), std::string::npos);
  }
  EXPECT_LT(growth.bytes(), 2e9);
}

}  // namespace
}  // namespace gnomon::surface
