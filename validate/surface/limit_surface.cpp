#include "surface/limit_surface.h"

#include <fmt/format.h>
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/version.h>

#include <algorithm>
#include <mutex>
#include <shared_mutex>
#include <vector>

#include "common/error.h"
#include "common/memory.h"
#include "common/parallel.h"
#include "surface/topology.h"

namespace gnomon {
namespace {

namespace Bfr = OpenSubdiv::Bfr;
using Surface = Bfr::Surface<double>;
using Cache =
    Bfr::SurfaceFactoryCacheThreaded<std::shared_mutex, std::shared_lock<std::shared_mutex>,
                                     std::unique_lock<std::shared_mutex>>;
using Factory = Bfr::RefinerSurfaceFactory<Cache>;

/// OpenSubdiv's last level. It costs little, since faces of like topology share their patches, and
/// what is left of the approximation is worst where it falls only threefold a level: along the
/// surface beside a vertex of high valence, and at the end of an infinitely sharp crease.
constexpr int approximationLevel = 10;
/// A regular face's surface, patch points and corners, and its share of OpenSubdiv's topology
/// meanwhile.
constexpr double bytesPerFace = 1500;
constexpr std::size_t grain = 64;

Factory::Options factoryOptions() {
  Factory::Options options;
  options.SetApproxLevelSmooth(approximationLevel);
  options.SetApproxLevelSharp(approximationLevel);
  return options;
}

}  // namespace

struct LimitSurface::Implementation {
  /// A face with a limit surface: which cage face it is, and its first patch point.
  struct Face {
    std::size_t cageFace;
    std::size_t firstPoint;
    Surface surface;
  };

  std::vector<Face> faces;
  std::vector<Vec3> patchPoints;
  std::vector<std::array<int, 4>> corners;
  std::vector<std::array<Vec2, 4>> uvs;
  std::optional<GridChart> grid;
  int vertexCount = 0;

  void initialise(const Factory& factory, const Cage& cage);
  void preparePatchPoints(const Cage& cage);
  void takeCorners(const Cage& cage);
  [[nodiscard]] std::size_t requireFace(int face) const;
};

void LimitSurface::Implementation::initialise(const Factory& factory, const Cage& cage) {
  std::vector<std::size_t> limitFaces;
  for (int face = 0; face < cage.faceCount(); ++face) {
    if (factory.FaceHasLimitSurface(face)) limitFaces.push_back(static_cast<std::size_t>(face));
  }
  if (limitFaces.empty()) {
    throw InputError("cage: no face has a limit surface, expected one inside the outermost ring");
  }
  faces.resize(limitFaces.size());
  parallelFor(
      0, faces.size(),
      [&](std::size_t i) {
        faces[i].cageFace = limitFaces[i];
        const auto cageFace = static_cast<int>(limitFaces[i]);
        if (!factory.InitVertexSurface(cageFace, &faces[i].surface)) {
          throw InputError(fmt::format("cage: face {} has no limit surface", cageFace));
        }
      },
      grain);
}

void LimitSurface::Implementation::preparePatchPoints(const Cage& cage) {
  std::size_t count = 0;
  for (Face& face : faces) {
    face.firstPoint = count;
    count += static_cast<std::size_t>(face.surface.GetNumPatchPoints());
  }
  patchPoints.resize(count);
  parallelFor(
      0, faces.size(),
      [&](std::size_t i) {
        faces[i].surface.PreparePatchPoints(&cage.positions[0].x, 3,
                                            &patchPoints[faces[i].firstPoint].x, 3);
      },
      grain);
}

void LimitSurface::Implementation::takeCorners(const Cage& cage) {
  corners.resize(faces.size());
  uvs.resize(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t corner = 4 * faces[i].cageFace + k;
      corners[i][k] = cage.faceVertices[corner];
      uvs[i][k] = cage.uvs[static_cast<std::size_t>(cage.faceUvs[corner])];
    }
  }
}

std::size_t LimitSurface::Implementation::requireFace(int face) const {
  const auto index = static_cast<std::size_t>(face);
  if (face < 0 || index >= faces.size()) {
    throw InternalError(
        fmt::format("limit surface: face {}, expected 0 to {}", face, faces.size() - 1));
  }
  return index;
}

LimitSurface::LimitSurface(const Cage& cage) : implementation_(std::make_unique<Implementation>()) {
  requireMemory(bytesPerFace * static_cast<double>(cage.faceVertices.size()) / 4,
                fmt::format("limit surface of {} faces", cage.faceVertices.size() / 4));
  const std::vector<int> faceSizes(cage.faceVertices.size() / 4, 4);
  const auto refiner = connect({.positions = cage.positions,
                                .faceSizes = faceSizes,
                                .faceVertices = cage.faceVertices,
                                .uvs = cage.uvs,
                                .faceUvs = cage.faceUvs,
                                .creases = cage.creases,
                                .sharpVertices = cage.sharpVertices,
                                .border = cage.border},
                               PartNames{}, false);
  Implementation& self = *implementation_;
  self.initialise(Factory(*refiner, factoryOptions()), cage);
  self.preparePatchPoints(cage);
  self.takeCorners(cage);
  self.vertexCount = static_cast<int>(cage.positions.size());
  self.grid = cage.grid;
  if (self.grid &&
      static_cast<std::size_t>(self.grid->columns) * static_cast<std::size_t>(self.grid->rows) !=
          self.faces.size()) {
    throw InputError(
        fmt::format("cage: {} faces have a limit surface, expected the {} × {} of its "
                    "grid",
                    self.faces.size(), self.grid->columns, self.grid->rows));
  }
}

LimitSurface::~LimitSurface() = default;
LimitSurface::LimitSurface(LimitSurface&&) noexcept = default;
LimitSurface& LimitSurface::operator=(LimitSurface&&) noexcept = default;

int LimitSurface::faceCount() const {
  return static_cast<int>(implementation_->faces.size());
}

std::optional<GridChart> LimitSurface::grid() const {
  return implementation_->grid;
}

std::array<int, 4> LimitSurface::corners(int face) const {
  return implementation_->corners[implementation_->requireFace(face)];
}

int LimitSurface::vertexCount() const {
  return implementation_->vertexCount;
}

LimitPoint LimitSurface::evaluate(int face, double s, double t) const {
  const std::size_t index = implementation_->requireFace(face);
  const Implementation::Face& patch = implementation_->faces[index];
  LimitPoint point;
  const std::array st = {s, t};
  patch.surface.Evaluate(st.data(), &implementation_->patchPoints[patch.firstPoint].x, 3,
                         &point.position.x, &point.ds.x, &point.dt.x, &point.dss.x, &point.dst.x,
                         &point.dtt.x);
  const auto& [uv0, uv1, uv2, uv3] = implementation_->uvs[index];
  point.uv = (1 - t) * ((1 - s) * uv0 + s * uv1) + t * ((1 - s) * uv3 + s * uv2);
  point.uvDs = (1 - t) * (uv1 - uv0) + t * (uv2 - uv3);
  point.uvDt = (1 - s) * (uv3 - uv0) + s * (uv2 - uv1);
  return point;
}

Vec3 outwardNormal(const LimitPoint& point) {
  const Vec3 normal = glm::cross(point.ds, point.dt);
  const double area = glm::length(normal);
  // Beside the longer derivative a shorter one, or a height over it, of 1e-12 is rounding. Written
  // so that NaN counts as degenerate too.
  const double longer = std::max(glm::length(point.ds), glm::length(point.dt));
  if (!(area > 1e-12 * longer * longer)) return Vec3(0);
  return normal / area;
}

std::string openSubdivVersion() {
  return std::to_string(OPENSUBDIV_VERSION_MAJOR) + "." + std::to_string(OPENSUBDIV_VERSION_MINOR) +
         "." + std::to_string(OPENSUBDIV_VERSION_PATCH);
}

}  // namespace gnomon
