#include "surface/limit_surface.h"

#include <fmt/format.h>
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/version.h>

#include <algorithm>
#include <mutex>
#include <shared_mutex>
#include <utility>

#include "common/error.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "surface/polygon_surface.h"

namespace gnomon::surface {

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
/// meanwhile: the least that a face takes. What others need shows as they are built.
constexpr double bytesPerFace = 1500;
constexpr std::size_t grain = 64;

/// Faces initialised between two looks at the memory.
constexpr std::size_t batch = 512;

/// Faces of like topology share their patches, but where semi-sharp edges are all of different
/// sharpness every face has its own, at up to 1.4 MB: what is still to come is told by what has
/// been.
/// @param before  resident bytes before the first face
void requireRest(std::uint64_t before, std::size_t done, std::size_t all) {
  const std::uint64_t now = residentMemoryBytes();
  const double taken = now > before ? static_cast<double>(now - before) : 0;
  const double rest = taken * static_cast<double>(all - done) / static_cast<double>(done);
  requireMemory(rest, fmt::format("limit surface: {} of {} faces took {}, and the others", done,
                                  all, formatBytes(taken)));
}

Factory::Options factoryOptions() {
  Factory::Options options;
  options.SetApproxLevelSmooth(approximationLevel);
  options.SetApproxLevelSharp(approximationLevel);
  return options;
}

/// One of the three squares of a triangle: the triangle's point and derivatives by its own
/// parameters (u, v), (0,0), (1,0), (0,1) at its corners, turned into those by the square's (s, t).
/// (u, v) is bilinear in (s, t), so that P_ss = D²P(q_s, q_s) and P_st = D²P(q_s, q_t) + DP q_st.
template <typename Evaluate>
LimitPoint atCorner(std::size_t corner, Vec2 st, const Evaluate& evaluate) {
  constexpr std::array corners = {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
  const Vec2 own = corners.at(corner);
  const Vec2 alongS = (corners.at((corner + 1) % 3) - own) / 2.0;
  const Vec2 alongT = (corners.at((corner + 2) % 3) - own) / 2.0;
  const Vec2 twist = Vec2(1.0 / 3) - own - alongS - alongT;  // q_st
  const Vec2 qs = alongS + st.y * twist;
  const Vec2 qt = alongT + st.x * twist;
  const LimitPoint of = evaluate(own + st.x * alongS + st.y * alongT + st.x * st.y * twist);
  const auto first = [&of](Vec2 a) { return a.x * of.ds + a.y * of.dt; };
  const auto second = [&of](Vec2 a, Vec2 b) {
    return a.x * b.x * of.dss + (a.x * b.y + a.y * b.x) * of.dst + a.y * b.y * of.dtt;
  };
  LimitPoint point;
  point.position = of.position;
  point.ds = first(qs);
  point.dt = first(qt);
  point.dss = second(qs, qs);
  point.dst = second(qs, qt) + first(twist);
  point.dtt = second(qt, qt);
  return point;
}

/// OpenSubdiv 3.5 turns the sign of second derivatives on those triangles of a Loop face's tree
/// that stand upside down, as it must that of the first. Which they are it does not tell: the first
/// derivatives a small step away do.
/// @param point  with second derivatives right up to one sign
double secondDerivativeSign(const Surface& surface, const double* points, const LimitPoint& point,
                            Vec2 at) {
  constexpr double step = 1e-4;
  const double way = at.x + at.y > 0.5 ? -step : step;  // stays inside the triangle
  const auto change = [&](Vec2 by) {
    LimitPoint there;
    const std::array st = {at.x + by.x, at.y + by.y};
    surface.Evaluate(st.data(), points, 3, &there.position.x, &there.ds.x, &there.dt.x);
    return std::pair{(there.ds - point.ds) / way, (there.dt - point.dt) / way};
  };
  double agreement = 0;
  if (way > 0 || at.x >= step) {
    const auto [ss, st] = change({way, 0});
    agreement += glm::dot(ss, point.dss) + glm::dot(st, point.dst);
  }
  if (way > 0 || at.y >= step) {
    const auto [st, tt] = change({0, way});
    agreement += glm::dot(st, point.dst) + glm::dot(tt, point.dtt);
  }
  return agreement < 0 ? -1.0 : 1.0;
}

}  // namespace

struct LimitSurface::Implementation {
  /// A cage face with a limit surface: which it is, and its first patch point.
  struct Patch {
    std::size_t cageFace;
    std::size_t firstPoint;
    Surface surface;
  };

  std::optional<PolygonSurface> polygons;  ///< in place of patches
  std::vector<Patch> patches;
  std::size_t facesPerPatch = 1;  ///< 3 where patches are triangles
  std::vector<Vec3> patchPoints;
  std::vector<std::array<int, 4>> corners;
  std::vector<std::array<Vec2, 4>> uvs;
  std::optional<GridChart> grid;
  int vertexCount = 0;

  void makeLimit(const Cage& cage);
  void initialise(const Factory& factory, const Cage& cage);
  void preparePatchPoints(const Cage& cage);
  void takeCorners(const Cage& cage, std::size_t cageFace, std::size_t face);
  void takePolygons(const Cage& cage);
  void takeQuadrilaterals(const Cage& cage);
  void takeTriangles(const Cage& cage, const OpenSubdiv::Far::TopologyLevel& level);
  [[nodiscard]] std::size_t requireFace(int face) const;
  [[nodiscard]] LimitPoint position(const Patch& patch, Vec2 at) const;
  void addTexture(std::size_t face, double s, double t, TangentPoint& point) const;
};

void LimitSurface::Implementation::initialise(const Factory& factory, const Cage& cage) {
  std::vector<std::size_t> limitFaces;
  for (int face = 0; face < cage.faceCount(); ++face) {
    if (factory.FaceHasLimitSurface(face)) limitFaces.push_back(static_cast<std::size_t>(face));
  }
  if (limitFaces.empty()) {
    throw InputError("cage: no face has a limit surface, expected one inside the outermost ring");
  }
  patches.resize(limitFaces.size());
  const std::uint64_t before = residentMemoryBytes();
  for (std::size_t begin = 0; begin < patches.size(); begin += batch) {
    const std::size_t end = std::min(begin + batch, patches.size());
    parallelFor(
        begin, end,
        [&](std::size_t i) {
          patches[i].cageFace = limitFaces[i];
          const auto cageFace = static_cast<int>(limitFaces[i]);
          if (!factory.InitVertexSurface(cageFace, &patches[i].surface)) {
            throw InputError(fmt::format("cage: face {} has no limit surface", cageFace));
          }
        },
        grain);
    requireRest(before, end, patches.size());
  }
}

void LimitSurface::Implementation::preparePatchPoints(const Cage& cage) {
  std::size_t count = 0;
  for (Patch& patch : patches) {
    patch.firstPoint = count;
    count += static_cast<std::size_t>(patch.surface.GetNumPatchPoints());
  }
  requireMemory(static_cast<double>(count) * sizeof(Vec3),
                fmt::format("limit surface: {} patch points", count));
  patchPoints.resize(count);
  parallelFor(
      0, patches.size(),
      [&](std::size_t i) {
        patches[i].surface.PreparePatchPoints(&cage.positions[0].x, 3,
                                              &patchPoints[patches[i].firstPoint].x, 3);
      },
      grain);
}

/// Of a face with four corners.
void LimitSurface::Implementation::takeCorners(const Cage& cage, std::size_t cageFace,
                                               std::size_t face) {
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t corner = 4 * cageFace + k;
    corners[face][k] = cage.faceVertices[corner];
    uvs[face][k] = cage.uvs[static_cast<std::size_t>(cage.faceUvs[corner])];
  }
}

void LimitSurface::Implementation::takeQuadrilaterals(const Cage& cage) {
  corners.resize(patches.size());
  uvs.resize(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) takeCorners(cage, patches[i].cageFace, i);
  vertexCount = static_cast<int>(cage.positions.size());
}

void LimitSurface::Implementation::takeTriangles(const Cage& cage,
                                                 const OpenSubdiv::Far::TopologyLevel& level) {
  facesPerPatch = 3;
  const int firstMiddle = level.GetNumVertices();
  const int firstCentroid = firstMiddle + level.GetNumEdges();
  vertexCount = firstCentroid + cage.faceCount();
  for (const Patch& patch : patches) {
    const int* vertices = &cage.faceVertices[3 * patch.cageFace];
    const int* faceUvs = &cage.faceUvs[3 * patch.cageFace];
    const auto uv = [&](std::size_t k) {
      return cage.uvs[static_cast<std::size_t>(faceUvs[k % 3])];
    };
    const Vec2 centroid = (uv(0) + uv(1) + uv(2)) / 3.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int own = vertices[k];
      const int next = vertices[(k + 1) % 3];
      const int previous = vertices[(k + 2) % 3];
      corners.push_back({own, firstMiddle + level.FindEdge(own, next),
                         firstCentroid + static_cast<int>(patch.cageFace),
                         firstMiddle + level.FindEdge(previous, own)});
      uvs.push_back({uv(k), (uv(k) + uv(k + 1)) / 2.0, centroid, (uv(k) + uv(k + 2)) / 2.0});
    }
  }
}

std::size_t LimitSurface::Implementation::requireFace(int face) const {
  const auto index = static_cast<std::size_t>(face);
  if (face < 0 || index >= corners.size()) {
    throw InternalError(
        fmt::format("limit surface: face {}, expected 0 to {}", face, corners.size() - 1));
  }
  return index;
}

/// Without the texture.
LimitPoint LimitSurface::Implementation::position(const Patch& patch, Vec2 at) const {
  LimitPoint point;
  const std::array st = {at.x, at.y};
  const double* points = &patchPoints[patch.firstPoint].x;
  patch.surface.Evaluate(st.data(), points, 3, &point.position.x, &point.ds.x, &point.dt.x,
                         &point.dss.x, &point.dst.x, &point.dtt.x);
  if (facesPerPatch == 3 && !patch.surface.IsRegular()) {
    const double sign = secondDerivativeSign(patch.surface, points, point, at);
    point.dss *= sign;
    point.dst *= sign;
    point.dtt *= sign;
  }
  return point;
}

/// Texture coordinates are bilinear on every face.
void LimitSurface::Implementation::addTexture(std::size_t face, double s, double t,
                                              TangentPoint& point) const {
  const auto& [uv0, uv1, uv2, uv3] = uvs[face];
  point.uv = (1 - t) * ((1 - s) * uv0 + s * uv1) + t * ((1 - s) * uv3 + s * uv2);
  point.uvDs = (1 - t) * (uv1 - uv0) + t * (uv2 - uv3);
  point.uvDt = (1 - s) * (uv3 - uv0) + s * (uv2 - uv1);
}

void LimitSurface::Implementation::makeLimit(const Cage& cage) {
  const std::size_t count = cage.faceVertices.size() / cage.faceSize();
  requireMemory(bytesPerFace * static_cast<double>(count),
                fmt::format("limit surface of {} faces", count));
  const std::vector<int> faceSizes(count, static_cast<int>(cage.faceSize()));
  const auto refiner = makeTopologyRefiner({.positions = cage.positions,
                                            .faceSizes = faceSizes,
                                            .faceVertices = cage.faceVertices,
                                            .uvs = cage.uvs,
                                            .faceUvs = cage.faceUvs,
                                            .creases = cage.creases,
                                            .sharpVertices = cage.sharpVertices,
                                            .border = cage.border,
                                            .scheme = cage.scheme},
                                           PartNames{}, false);
  initialise(Factory(*refiner, factoryOptions()), cage);
  preparePatchPoints(cage);
  if (cage.scheme == SubdivisionScheme::loop) {
    takeTriangles(cage, refiner->GetLevel(0));
  } else {
    takeQuadrilaterals(cage);
  }
}

/// Every face of the cage has its own; a triangle's were made with the cage.
void LimitSurface::Implementation::takePolygons(const Cage& cage) {
  polygons.emplace(cage);
  facesPerPatch = static_cast<std::size_t>(cage.facesPerPolygon);
  const std::size_t count = cage.faceVertices.size() / 4;
  corners.resize(count);
  uvs.resize(count);
  for (std::size_t face = 0; face < count; ++face) {
    takeCorners(cage, face, face);
  }
  vertexCount = static_cast<int>(cage.positions.size());
}

LimitSurface::LimitSurface(const Cage& cage) : implementation_(std::make_unique<Implementation>()) {
  Implementation& self = *implementation_;
  if (cage.scheme == SubdivisionScheme::none) {
    self.takePolygons(cage);
  } else {
    self.makeLimit(cage);
  }
  self.grid = cage.grid;
  if (self.grid &&
      static_cast<std::size_t>(self.grid->columns) * static_cast<std::size_t>(self.grid->rows) !=
          self.corners.size()) {
    throw InputError(
        fmt::format("cage: {} faces have a limit surface, expected the {} × {} of its "
                    "grid",
                    self.corners.size(), self.grid->columns, self.grid->rows));
  }
}

LimitSurface::~LimitSurface() = default;
LimitSurface::LimitSurface(LimitSurface&&) noexcept = default;
LimitSurface& LimitSurface::operator=(LimitSurface&&) noexcept = default;

int LimitSurface::faceCount() const {
  return static_cast<int>(implementation_->corners.size());
}

bool LimitSurface::isPolygons() const {
  return implementation_->polygons.has_value();
}

int LimitSurface::facesPerCageFace() const {
  return static_cast<int>(implementation_->facesPerPatch);
}

std::optional<GridChart> LimitSurface::grid() const {
  return implementation_->grid;
}

std::array<int, 4> LimitSurface::corners(int face) const {
  return implementation_->corners[implementation_->requireFace(face)];
}

std::array<Vec2, 4> LimitSurface::cornerUvs(int face) const {
  return implementation_->uvs[implementation_->requireFace(face)];
}

int LimitSurface::vertexCount() const {
  return implementation_->vertexCount;
}

LimitPoint LimitSurface::evaluate(int face, double s, double t) const {
  const std::size_t index = implementation_->requireFace(face);
  if (implementation_->polygons) {
    LimitPoint point = implementation_->polygons->evaluate(index, s, t);
    implementation_->addTexture(index, s, t, point);
    return point;
  }
  const std::size_t perPatch = implementation_->facesPerPatch;
  const Implementation::Patch& patch = implementation_->patches[index / perPatch];
  LimitPoint point = perPatch == 1 ? implementation_->position(patch, {s, t})
                                   : atCorner(index % perPatch, {s, t}, [&](Vec2 at) {
                                       return implementation_->position(patch, at);
                                     });
  implementation_->addTexture(index, s, t, point);
  return point;
}

TangentPoint LimitSurface::tangentPoint(int face, double s, double t) const {
  if (implementation_->polygons) {
    const std::size_t index = implementation_->requireFace(face);
    TangentPoint point = implementation_->polygons->tangentPoint(index, s, t);
    implementation_->addTexture(index, s, t, point);
    return point;
  }
  if (implementation_->facesPerPatch != 1) {
    const LimitPoint all = evaluate(face, s, t);
    const TangentPoint& first = all;  // without the second derivatives
    return first;
  }
  const std::size_t index = implementation_->requireFace(face);
  const Implementation::Patch& patch = implementation_->patches[index];
  TangentPoint point;
  const std::array st = {s, t};
  patch.surface.Evaluate(st.data(), &implementation_->patchPoints[patch.firstPoint].x, 3,
                         &point.position.x, &point.ds.x, &point.dt.x);
  implementation_->addTexture(index, s, t, point);
  return point;
}

bool LimitSurface::isBicubic(int face) const {
  const std::size_t index = implementation_->requireFace(face);
  return !implementation_->polygons && implementation_->facesPerPatch == 1 &&
         implementation_->patches[index].surface.IsRegular();
}

Vec3 outwardNormal(const TangentPoint& point) {
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

namespace {

/// The cubic with these values and derivatives at 0 and at 1.
std::array<Vec3, 4> cubicOf(const Vec3& value0, const Vec3& slope0, const Vec3& value1,
                            const Vec3& slope1) {
  const Vec3 rise = value1 - value0;
  return {value0, slope0, 3.0 * rise - 2.0 * slope0 - slope1, slope0 + slope1 - 2.0 * rise};
}

Vec3 valueAt(const std::array<Vec3, 4>& cubic, double x) {
  return cubic[0] + x * (cubic[1] + x * (cubic[2] + x * cubic[3]));
}

Vec3 firstDerivative(const std::array<Vec3, 4>& cubic, double x) {
  return cubic[1] + x * (2.0 * cubic[2] + x * (3.0 * cubic[3]));
}

Vec3 secondDerivative(const std::array<Vec3, 4>& cubic, double x) {
  return 2.0 * cubic[2] + x * (6.0 * cubic[3]);
}

}  // namespace

LimitFace::LimitFace(const LimitSurface& surface, int face, std::size_t points)
    : surface_(&surface), face_(face), bicubic_(points > 10 && surface.isBicubic(face)) {
  if (!bicubic_) return;
  const std::array corners = {surface.evaluate(face, 0, 0), surface.evaluate(face, 1, 0),
                              surface.evaluate(face, 1, 1), surface.evaluate(face, 0, 1)};
  const auto& [p00, p10, p11, p01] = corners;
  // Along s at t = 0 and t = 1: the position and its derivative by t.
  const Cubic near = cubicOf(p00.position, p00.ds, p10.position, p10.ds);
  const Cubic nearDt = cubicOf(p00.dt, p00.dst, p10.dt, p10.dst);
  const Cubic far = cubicOf(p01.position, p01.ds, p11.position, p11.ds);
  const Cubic farDt = cubicOf(p01.dt, p01.dst, p11.dt, p11.dst);
  for (std::size_t i = 0; i < 4; ++i) {
    const Cubic alongT = cubicOf(near[i], nearDt[i], far[i], farDt[i]);
    for (std::size_t j = 0; j < 4; ++j) rows_[j][i] = alongT[j];
  }
  for (std::size_t k = 0; k < 4; ++k) uvs_[k] = corners[k].uv;
}

TangentPoint LimitFace::at(double s, double t) const {
  TangentPoint point;
  row(t, {&s, 1}, {&point, 1});
  return point;
}

LimitPoint LimitFace::evaluate(double s, double t) const {
  if (!bicubic_) return surface_->evaluate(face_, s, t);
  Cubic curve, curveDt, curveDtt;
  for (std::size_t i = 0; i < 4; ++i) {
    const Cubic alongT = {rows_[0][i], rows_[1][i], rows_[2][i], rows_[3][i]};
    curve[i] = valueAt(alongT, t);
    curveDt[i] = firstDerivative(alongT, t);
    curveDtt[i] = secondDerivative(alongT, t);
  }
  return {at(s, t), secondDerivative(curve, s), firstDerivative(curveDt, s), valueAt(curveDtt, s)};
}

void LimitFace::row(double t, std::span<const double> s, std::span<TangentPoint> points) const {
  if (!bicubic_) {
    for (std::size_t k = 0; k < s.size(); ++k) {
      points[k] = surface_->tangentPoint(face_, s[k], t);
    }
    return;
  }
  Cubic curve, curveDt;
  for (std::size_t i = 0; i < 4; ++i) {
    const Cubic alongT = {rows_[0][i], rows_[1][i], rows_[2][i], rows_[3][i]};
    curve[i] = valueAt(alongT, t);
    curveDt[i] = firstDerivative(alongT, t);
  }
  const auto& [uv0, uv1, uv2, uv3] = uvs_;
  const Vec2 uvDs = (1 - t) * (uv1 - uv0) + t * (uv2 - uv3);
  for (std::size_t k = 0; k < s.size(); ++k) {
    const double x = s[k];
    points[k] = {valueAt(curve, x),
                 firstDerivative(curve, x),
                 valueAt(curveDt, x),
                 (1 - t) * ((1 - x) * uv0 + x * uv1) + t * ((1 - x) * uv3 + x * uv2),
                 uvDs,
                 (1 - x) * (uv3 - uv0) + x * (uv2 - uv1)};
  }
}

std::vector<LimitFace> limitFaces(const LimitSurface& surface, std::size_t points) {
  const auto count = static_cast<std::size_t>(surface.faceCount());
  std::vector<LimitFace> faces;
  faces.reserve(count);
  for (int face = 0; face < surface.faceCount(); ++face) {
    faces.emplace_back(surface, face, points / count);
  }
  return faces;
}

}  // namespace gnomon::surface
