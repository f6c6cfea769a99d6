// Any bytes as a Wavefront OBJ: read, and where that succeeds the limit surface built and
// evaluated.

#include <cmath>

#include "fuzz/reader_fuzz.h"
#include "surface/limit_surface.h"
#include "surface/mesh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  test::fuzzReader(data, size, ".obj", [](const std::filesystem::path& path) {
    const surface::LimitSurface surface(surface::readMeshFile(path));
    for (int face = 0; face < surface.faceCount(); ++face) {
      const surface::LimitPoint point = surface.evaluate(face, 0.3, 0.6);
      if (!std::isfinite(glm::dot(point.position, point.position))) std::abort();
    }
  });
  return 0;
}
