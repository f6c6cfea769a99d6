#include "truth/surface_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "common/parallel.h"
#include "surface/face_grids.h"
#include "surface/texel_frame.h"
#include "truth/embree.h"

namespace gnomon::truth {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

int cellsFor(int faces) {
  const double wanted = std::sqrt(65536.0 / faces);
  return std::clamp(static_cast<int>(std::ceil(wanted)), 1, 64);
}

double distanceTo(const Vec3& from, const Vec3& to, const Vec3& point) {
  const Vec3 along = to - from;
  const double square = glm::dot(along, along);
  const double share = square > 0 ? glm::dot(point - from, along) / square : 0;
  return glm::length(from + std::clamp(share, 0.0, 1.0) * along - point);
}

}  // namespace

SurfacePaths::SurfacePaths(const surface::LimitSurface& surface)
    : cells_(cellsFor(surface.faceCount())) {
  placeVertices(surface);
  connect();
  labelPieces();
}

void SurfacePaths::placeVertices(const surface::LimitSurface& surface) {
  const auto grids = surface::FaceGrids::even(surface.faceCount(), cells_);
  points_.resize(grids.vertexCount());
  parallelFor(0, grids.faces().size(), [&](std::size_t face) {
    const surface::FaceGrid& grid = grids.faces()[face];
    std::size_t vertex = grid.firstVertex;
    for (const double t : grids.tLines(grid)) {
      for (const double s : grids.sLines(grid)) {
        points_[vertex++] = surface.tangentPoint(static_cast<int>(face), s, t).position;
      }
    }
  });
  triangles_ = surface::gridTriangles(grids, surface::Diagonal::fromOrigin);
  const std::vector<Index> first = surface::firstVertices(surface, grids);
  for (Index& vertex : triangles_) vertex = first[vertex];
  for (std::size_t side = 0; side < triangles_.size(); ++side) {
    longest_ = std::max(longest_,
                        glm::length(corner(side / 3, side % 3 + 1) - corner(side / 3, side % 3)));
  }
}

void SurfacePaths::connect() {
  using Edge = std::pair<std::uint64_t, Index>;  // its two vertices; a side
  std::vector<Edge> edges;
  edges.reserve(triangles_.size());
  for (std::size_t side = 0; side < triangles_.size(); ++side) {
    const std::uint64_t a = triangles_[side];
    const std::uint64_t b = triangles_[side - side % 3 + (side + 1) % 3];
    edges.emplace_back(std::min(a, b) << 32U | std::max(a, b), static_cast<Index>(side));
  }
  std::sort(edges.begin(), edges.end());
  neighbours_.assign(triangles_.size(), none);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (edges[i].first != edges[i + 1].first) continue;
    neighbours_[edges[i].second] = edges[i + 1].second;
    neighbours_[edges[i + 1].second] = edges[i].second;
  }
}

void SurfacePaths::labelPieces() {
  const std::size_t count = triangles_.size() / 3;
  pieces_.assign(count, none);
  std::vector<std::size_t> open;
  for (std::size_t seed = 0; seed < count; ++seed) {
    if (pieces_[seed] != none) continue;
    pieces_[seed] = static_cast<Index>(seed);
    open.push_back(seed);
    while (!open.empty()) {
      const std::size_t triangle = open.back();
      open.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const Index across = neighbours_[3 * triangle + k];
        if (across == none || pieces_[across / 3] != none) continue;
        pieces_[across / 3] = static_cast<Index>(seed);
        open.push_back(across / 3);
      }
    }
  }
}

SurfacePaths::Place SurfacePaths::placeOf(const surface::SurfaceSample& sample) const {
  const auto cellOf = [&](double parameter) {
    return std::clamp(static_cast<int>(parameter * cells_), 0, cells_ - 1);
  };
  const int column = cellOf(sample.s);
  const int row = cellOf(sample.t);
  const double s = static_cast<double>(sample.s) * cells_ - column;
  const double t = static_cast<double>(sample.t) * cells_ - row;
  const auto cells = static_cast<std::size_t>(cells_);
  const std::size_t cell =
      (static_cast<std::size_t>(sample.face) * cells + static_cast<std::size_t>(row)) * cells +
      static_cast<std::size_t>(column);
  // As gridTriangles cuts the cell, from (0, 0) to (1, 1).
  const bool isFirst = s >= t;
  std::array<double, 3> weights =
      isFirst ? std::array{1 - s, s - t, t} : std::array{1 - t, s, t - s};
  // Inside the triangle, so that the section's plane cuts two of its sides.
  double sum = 0;
  for (double& weight : weights) sum += weight = std::max(weight, 1e-6);
  Place place{2 * cell + (isFirst ? 0 : 1), Vec3(0)};
  for (std::size_t k = 0; k < 3; ++k)
    place.point += weights.at(k) / sum * corner(place.triangle, k);
  return place;
}

bool SurfacePaths::passes(std::size_t triangle, const Vec3& from, const Vec3& to,
                          const PathTarget& target) const {
  const Vec3& a = corner(triangle, 0);
  const Vec3& b = corner(triangle, 1);
  const Vec3& c = corner(triangle, 2);
  const double side = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
  return glm::dot(glm::cross(b - a, c - a), target.normal) >= 0 &&
         distanceTo(from, to, target.point) <= target.reach + side;
}

bool SurfacePaths::leadTo(const PathStart& start, const PathTarget& target) const {
  const Place origin = placeOf(start.sample);
  const auto targetCell = static_cast<std::size_t>(target.face) * static_cast<std::size_t>(cells_) *
                          static_cast<std::size_t>(cells_);
  if (pieces_[origin.triangle] != pieces_[2 * targetCell]) return false;
  const Vec3 across = glm::cross(start.normal, start.light);  // the plane's normal
  if (!(glm::length(across) > 1e-9))
    return passes(origin.triangle, origin.point, origin.point, target);
  const Vec3 ahead = glm::normalize(glm::cross(across, start.normal));  // e
  std::size_t triangle = origin.triangle;
  Vec3 from = origin.point;
  std::size_t entered = 3;  // by no side
  for (std::size_t step = 0; step < triangles_.size(); ++step) {
    // The side that the path leaves by: of the two that the plane cuts the one not entered by, in
    // the first triangle the one toward the light.
    std::optional<std::size_t> left;
    Vec3 to(0);
    for (std::size_t k = 0; k < 3; ++k) {
      if (k == entered) continue;
      const double begin = glm::dot(corner(triangle, k) - origin.point, across);
      const double end = glm::dot(corner(triangle, k + 1) - origin.point, across);
      if ((begin >= 0) == (end >= 0)) continue;
      const Vec3 crossing = corner(triangle, k) +
                            begin / (begin - end) * (corner(triangle, k + 1) - corner(triangle, k));
      if (left && !(glm::dot(crossing - to, ahead) > 0)) continue;
      left = k;
      to = crossing;
    }
    if (!left || glm::dot(to - from, ahead) < -1e-9 * longest_) return false;
    if (passes(triangle, from, to, target)) return true;
    if (glm::dot(to - target.point, ahead) > target.reach + longest_) return false;
    const Index next = neighbours_[3 * triangle + *left];
    if (next == none) return false;
    triangle = next / 3;
    entered = next % 3;
    from = to;
  }
  return false;
}

namespace {

constexpr double sameTexel = 1e-3;

double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// Whether a difference of texture coordinates leaves the relief as it is.
bool isPeriod(Vec2 difference, const relief::Relief& relief) {
  if (relief.field.wrap() == relief::Wrap::repeat) {
    const Vec2 map(relief.field.width(), relief.field.height());
    difference -= glm::round(difference / map) * map;
  }
  return glm::length(difference) < sameTexel;
}

double orientationOf(const std::array<Vec2, 4>& corners) {
  const double area = cross(corners[2] - corners[0], corners[3] - corners[1]);
  const double longest =
      std::max(glm::length(corners[2] - corners[0]), glm::length(corners[3] - corners[1]));
  return std::abs(area) > 1e-12 * longest * longest ? std::copysign(1.0, area) : 0.0;
}

}  // namespace

TextureCharts::TextureCharts(const surface::LimitSurface& surface, const relief::Relief& relief) {
  const Vec2 texelsPerUv = relief.texelsPerUv();
  faces_.resize(static_cast<std::size_t>(surface.faceCount()));
  for (int face = 0; face < surface.faceCount(); ++face) {
    Face& own = faces_[static_cast<std::size_t>(face)];
    constexpr std::array places = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
    for (std::size_t corner = 0; corner < 4; ++corner) {
      own.corners.at(corner) =
          surface.evaluate(face, places.at(corner).x, places.at(corner).y).uv * texelsPerUv;
    }
    own.orientation = orientationOf(own.corners);
  }
  for (const auto& [first, second] : surface::sharedSides(surface)) {
    const Side kind = connect(relief, first, second);
    connect(relief, second, first);
    seams_ += kind == Side::seam ? 1 : 0;
  }
}

TextureCharts::Side TextureCharts::connect(const relief::Relief& relief,
                                           const surface::FaceSide& side,
                                           const surface::FaceSide& otherSide) {
  Face& own = faces_[static_cast<std::size_t>(side.face)];
  const Face& other = faces_[static_cast<std::size_t>(otherSide.face)];
  // Neighbours run along their common edge in opposite directions.
  const auto corner = [](int k) { return static_cast<std::size_t>(k % 4); };
  const Vec2 atBegin =
      other.corners.at(corner(otherSide.side + 1)) - own.corners.at(corner(side.side));
  const Vec2 atEnd =
      other.corners.at(corner(otherSide.side)) - own.corners.at(corner(side.side + 1));
  const bool continued = glm::length(atBegin - atEnd) < sameTexel && isPeriod(atBegin, relief) &&
                         own.orientation != 0 && own.orientation == other.orientation;
  const Side kind = continued ? Side::continued : Side::seam;
  own.neighbours.at(corner(side.side)) = {kind, otherSide, atBegin};
  return kind;
}

bool TextureCharts::crossesSeam(const surface::SurfaceSample& sample, Vec2 direction,
                                double length) const {
  const Face* face = &faces_[sample.faceIndex()];
  const auto& [c0, c1, c2, c3] = face->corners;
  const double s = sample.s;
  const double t = sample.t;
  Vec2 origin = (1 - t) * ((1 - s) * c0 + s * c1) + t * ((1 - s) * c3 + s * c2);
  int entered = -1;
  double place = 0;  // along the line, texels
  for (std::size_t step = 0; step < 2 * faces_.size() + 8 && face->orientation != 0; ++step) {
    // The next side that the line leaves by. By its end points where it meets one between them; in
    // a corner rounding may miss both sides, and the nearest side's line decides (Cyrus & Beck
    // 1978).
    double left = std::numeric_limits<double>::infinity();
    double nearest = std::numeric_limits<double>::infinity();
    int side = -1;
    int nearestSide = -1;
    for (int k = 0; k < 4; ++k) {
      const Vec2 begin = face->corners.at(static_cast<std::size_t>(k));
      const Vec2 along = face->corners.at(static_cast<std::size_t>((k + 1) % 4)) - begin;
      const double outward = cross(direction, along);
      if (k == entered || !(face->orientation * outward > 0)) continue;
      const double at = cross(begin - origin, along) / outward;
      const double share = cross(begin - origin, direction) / outward;  // of the side
      if (at < nearest) {
        nearest = at;
        nearestSide = k;
      }
      if (share >= 0 && share <= 1 && at >= place - sameTexel && at < left) {
        left = at;
        side = k;
      }
    }
    if (side < 0) {
      left = nearest;
      side = nearestSide;
    }
    place = std::max(place, left);
    if (side < 0 || place >= length) return false;
    const Neighbour& next = face->neighbours.at(static_cast<std::size_t>(side));
    if (next.kind != Side::continued) return next.kind == Side::seam;
    origin += next.shift;
    entered = next.across.side;
    face = &faces_[static_cast<std::size_t>(next.across.face)];
  }
  return false;
}

std::vector<std::vector<std::uint8_t>> seamCrossings(
    const surface::LimitSurface& surface, const relief::Relief& relief, const MicroMesh& mesh,
    const MicroScene& scene, const TextureCharts& charts, const surface::SampleGrid& samples,
    std::span<const Truth> truths, std::span<const TraceSettings> lights, double radiusTexels) {
  const std::size_t count = samples.samples.size();
  std::vector<std::vector<std::uint8_t>> crosses(lights.size(),
                                                 std::vector<std::uint8_t>(count, 0));
  if (charts.seamCount() == 0) return crosses;
  const auto pathTexels = [&](const SamplePlace& place, bool lit, const surface::LocalLight& local,
                              const TraceSettings& light) {
    double world = 0;  // on the tangent plane
    if (lit) {
      const double below = relief::worldPerHeight(relief.space, place.frame) *
                           (relief.field.maximum() - relief.field.at(place.frame.texel));
      world = local.slope > 0 ? below / local.slope : std::numeric_limits<double>::infinity();
    } else if (const auto hit = scene.nearest(
                   place.facet.rayOrigin(mesh.rayOffset(light.rayOffset)), light.light.direction)) {
      world = hit->distance / std::hypot(1.0, local.slope);
    }
    return std::min(radiusTexels, world / local.worldPerTexel);
  };
  constexpr std::size_t piece = 256;
  parallelFor(0, (count + piece - 1) / piece, [&](std::size_t p) {
    const FlushDenormals flush;
    SamplePlacer placer(surface, relief.texelsPerUv(), mesh);
    for (std::size_t i = p * piece; i < std::min(count, (p + 1) * piece); ++i) {
      const SamplePlace place = placer.place(samples.samples[i]);
      if (!place.defined) continue;
      for (std::size_t l = 0; l < lights.size(); ++l) {
        if (place.facet.facesAwayFrom(lights[l].light.direction)) continue;
        const surface::LocalLight local =
            surface::localLight(place.frame, lights[l].light.direction);
        const bool lit = truths[l].mask.samples[i] == Shade::lit;
        const double length = pathTexels(place, lit, local, lights[l]);
        crosses[l][i] = charts.crossesSeam(place.sample, local.direction, length) ? 1 : 0;
      }
    }
  });
  return crosses;
}

namespace {

/// Below a hit of a ray; world coordinates.
PathTarget targetOf(const surface::LimitSurface& surface, const MicroMesh& mesh,
                    const SurfaceHit& hit, const Vec3& occluder) {
  const surface::SurfaceSample below = mesh.parametersAt(hit.face, hit.place);
  const surface::TangentPoint point = surface.tangentPoint(below);
  return {point.position, surface::outwardNormal(point), hit.face,
          2 * glm::length(occluder - point.position)};
}

/// A sample on the mesh.
struct Placed {
  RayStart start;
  TexelAxes axes;
};

Placed placedBy(SamplePlacer& placer, const surface::SurfaceSample& sample) {
  const SamplePlace place = placer.place(sample);
  return {rayStart(place), {place.frame.px, place.frame.py}};
}

}  // namespace

void splitCastShadows(const surface::LimitSurface& surface, const relief::Relief& relief,
                      const MicroMesh& mesh, const MicroScene& scene, const SurfacePaths& paths,
                      const CastShadowSettings& settings, const surface::SampleGrid& samples,
                      std::span<const TraceSettings> lights, std::span<Truth> truths,
                      const PlacedSamples* placed) {
  const std::span<const int> parts = settings.parts;
  const std::size_t count = samples.samples.size();
  if (!parts.empty()) {
    for (Truth& truth : truths) truth.casters.assign(count, noCaster);
  }
  // The region of a sample whose ray first meets the surface there.
  const auto regionBy = [&](const surface::SurfaceSample& sample, const Placed& from,
                            const Vec3& origin, const Vec3& light, const SurfaceHit& hit) {
    const Vec3 occluder = mesh.centre() + origin + hit.distance * light;
    const bool isOnPath =
        paths.leadTo({sample, from.start.normal, light}, targetOf(surface, mesh, hit, occluder));
    if (!isOnPath) return Region::global;
    const double reach = rayLength(from.start.normal, from.axes, light, settings.radiusTexels);
    return hit.distance > reach ? Region::distant : Region::cast;
  };
  constexpr std::size_t piece = 256;
  parallelFor(0, (count + piece - 1) / piece, [&](std::size_t p) {
    const FlushDenormals flush;
    SamplePlacer placer(surface, relief.texelsPerUv(), mesh);
    for (std::size_t i = p * piece; i < std::min(count, (p + 1) * piece); ++i) {
      throwIfCancelled();
      const auto isCast = [&](const Truth& truth) { return truth.regions[i] == Region::cast; };
      if (std::none_of(truths.begin(), truths.end(), isCast)) continue;
      const surface::SurfaceSample& sample = samples.samples[i];
      const Placed from =
          placed != nullptr ? Placed{placed->starts[i], placed->axes[i]} : placedBy(placer, sample);
      for (std::size_t l = 0; l < lights.size(); ++l) {
        if (!isCast(truths[l])) continue;
        const Vec3& light = lights[l].light.direction;
        const Vec3 origin = from.start.facet.rayOrigin(mesh.rayOffset(lights[l].rayOffset));
        const auto hit = scene.nearest(origin, light);
        if (!hit) continue;  // a ray that grazes an edge
        if (!parts.empty()) {
          truths[l].casters[i] =
              static_cast<std::uint8_t>(parts[static_cast<std::size_t>(hit->face)]);
        }
        truths[l].regions[i] = regionBy(sample, from, origin, light, *hit);
      }
    }
  });
}

}  // namespace gnomon::truth
