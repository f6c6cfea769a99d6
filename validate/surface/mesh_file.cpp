#include "surface/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/error.h"
#include "surface/readers/obj_reader.h"
#include "surface/readers/ply_reader.h"

namespace gnomon::surface {

Cage readMeshFile(const std::filesystem::path& path, SubdivisionScheme scheme) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (ending == ".obj") return readObj(path, scheme);
  if (ending == ".ply") return readPly(path, scheme);
  throw InputError(
      fmt::format("{}: a mesh file that ends in .obj or .ply expected", path.string()));
}

}  // namespace gnomon::surface
