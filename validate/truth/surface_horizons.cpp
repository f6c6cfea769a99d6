#include "truth/surface_horizons.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "common/parallel.h"
#include "common/system/memory.h"
#include "surface/texel_frame.h"
#include "truth/embree.h"

namespace gnomon::truth {
namespace {

constexpr double rise = radians(4);
constexpr double precision = 1e-3;

/// The search for the largest angle off the normal, up to a limit, at which a ray escapes: from the
/// limit upward by steps, then by halving. It asks for one ray after the other.
class HorizonSearch {
 public:
  explicit HorizonSearch(double limit) : asked_(limit), blocked_(limit) {}

  /// The angle of the ray that it waits for.
  [[nodiscard]] double asked() const { return asked_; }
  [[nodiscard]] bool isDone() const { return isDone_; }
  [[nodiscard]] double angle() const { return free_.value_or(0); }

  void take(bool isFree) {
    if (isFree) {
      free_ = asked_;
    } else {
      blocked_ = asked_;
    }
    if (free_) {
      isDone_ = !(blocked_ - *free_ > precision);
      asked_ = (blocked_ + *free_) / 2;
    } else {
      isDone_ = asked_ == 0;
      asked_ = asked_ - rise > 0 ? asked_ - rise : 0;
    }
  }

 private:
  double asked_;
  double blocked_;              ///< the least angle known to be so
  std::optional<double> free_;  ///< the largest known to be so
  bool isDone_ = false;
};

/// A texel with a horizon, as its rays need it.
struct Place {
  std::size_t texel;  ///< of the table
  surface::SurfaceSample sample;
  Vec3 normal, px, py;
  Vec2 perX, perY;  ///< steps in (s, t) of a texel along x and along y
};

/// None where P_x and P_y are not defined.
std::optional<Place> placeOf(std::size_t texel, const surface::SurfaceSample& sample,
                             const surface::LimitSurface& surface, Vec2 texelsPerUv) {
  const surface::TangentPoint point = surface.tangentPoint(sample);
  const surface::TexelFrame frame = surface::texelFrame(point, texelsPerUv);
  if (!frame.defined) return std::nullopt;
  const glm::dmat2 texelPerSt(point.uvDs * texelsPerUv, point.uvDt * texelsPerUv);
  const glm::dmat2 stPerTexel = glm::inverse(texelPerSt);
  return Place{texel, sample, frame.normal, frame.px, frame.py, stPerTexel[0], stPerTexel[1]};
}

/// Searches the horizons of some texels toward one azimuth. Sixteen searches go on at once, so that
/// their rays are traced together; where one ends the next begins. What a search finds does not
/// depend on the others.
class AzimuthSearch {
 public:
  AzimuthSearch(const MicroMesh& mesh, const MicroScene& scene, const std::vector<Place>& places,
                double azimuth, double limit)
      : mesh_(mesh),
        scene_(scene),
        places_(places),
        cosine_(std::cos(azimuth)),
        sine_(std::sin(azimuth)),
        limit_(limit) {}

  /// @param layer  of the table: gets the angles of the texels
  void run(float* layer) {
    while (true) {
      RayBundle rays{};
      std::array<Lane*, RayPacket::size> asking{};
      for (Lane& lane : lanes_) {
        if (!needsRay(lane, layer)) continue;
        asking[rays.count] = &lane;
        rays.add(lane.origin, lane.direction);
      }
      if (rays.count == 0) return;
      const auto blocked = scene_.occluded(rays);
      for (std::size_t k = 0; k < rays.count; ++k) asking[k]->search.take(!blocked[k]);
    }
  }

 private:
  struct Lane {
    const Place* place = nullptr;  ///< none: nothing is searched
    Facet facet;                   ///< that the rays start on
    Vec3 origin;                   ///< of the rays
    Vec3 tangent;                  ///< along the azimuth
    HorizonSearch search{0};
    Vec3 direction;  ///< of the ray that the search waits for
  };

  /// Goes on with a lane, or with the next place where it is done, up to a ray that has to be
  /// traced; false where no place is left.
  bool needsRay(Lane& lane, float* layer) {
    while (true) {
      if (lane.place != nullptr && lane.search.isDone()) {
        layer[lane.place->texel] = static_cast<float>(lane.search.angle());
        lane.place = nullptr;
      }
      if (lane.place == nullptr) {
        if (next_ == places_.size()) return false;
        begin(lane, places_[next_++]);
        if (lane.place == nullptr) continue;
      }
      const double off = lane.search.asked();
      lane.direction = std::cos(off) * lane.place->normal + std::sin(off) * lane.tangent;
      if (!lane.facet.facesAwayFrom(lane.direction)) return true;
      lane.search.take(false);
    }
  }

  /// A texel's centre lies where facets meet: its rays start on the one that the azimuth leads
  /// onto.
  void begin(Lane& lane, const Place& place) {
    lane.facet = mesh_.facet(place.sample.face, place.sample.s, place.sample.t,
                             cosine_ * place.perX + sine_ * place.perY);
    lane.origin = lane.facet.rayOrigin(mesh_.rayOffset());
    lane.tangent = glm::normalize(cosine_ * place.px + sine_ * place.py);
    lane.search = HorizonSearch(limit_);
    lane.place = lane.facet.normal == Vec3(0) ? nullptr : &place;
  }

  const MicroMesh& mesh_;
  const MicroScene& scene_;
  const std::vector<Place>& places_;
  double cosine_, sine_;
  double limit_;
  std::size_t next_ = 0;
  std::array<Lane, RayPacket::size> lanes_;
};

}  // namespace

horizon::AngleTable shootHorizons(const surface::LimitSurface& surface,
                                  const relief::Relief& relief, const MicroMesh& mesh,
                                  const MicroScene& scene, const surface::SampleGrid& texels,
                                  int azimuths, double limit, const Progress& progress) {
  const std::size_t count = texels.samples.size();
  requireMemory(sizeof(float) * static_cast<double>(count) * azimuths,
                fmt::format("bake: horizons of {} × {} texels × {} azimuths on the surface",
                            texels.width, texels.height, azimuths));
  horizon::AngleTable table{
      {texels.width, texels.height, azimuths, relief::Wrap::clamp}, limit, {}};
  table.angles.assign(table.entries(), static_cast<float>(limit));
  const auto width = static_cast<std::size_t>(texels.width);
  const auto height = static_cast<std::size_t>(texels.height);
  const auto addPlace = [&](std::vector<Place>& places, std::size_t row, std::size_t column) {
    const surface::SurfaceSample& sample = texels.samples[(height - 1 - row) * width + column];
    if (!sample.isOnSurface()) return;
    const auto place = placeOf(row * width + column, sample, surface, relief.texelsPerUv());
    if (place) places.push_back(*place);
  };
  // Tiles of neighbours, whose rays meet the same parts of the hierarchy.
  constexpr std::size_t side = 8;
  const std::size_t across = (width + side - 1) / side;
  const std::size_t tiles = across * ((height + side - 1) / side);
  CountedProgress done(progress, tiles);
  parallelFor(0, tiles, [&](std::size_t tile) {
    const FlushDenormals flush;
    const std::size_t top = tile / across * side;
    const std::size_t left = tile % across * side;
    std::vector<Place> places;
    for (std::size_t row = top; row < std::min(height, top + side); ++row) {
      for (std::size_t column = left; column < std::min(width, left + side); ++column) {
        addPlace(places, row, column);
      }
    }
    for (int m = 0; m < azimuths; ++m) {
      AzimuthSearch(mesh, scene, places, 2 * pi * m / azimuths, limit)
          .run(&table.angles[static_cast<std::size_t>(m) * count]);
    }
    done.advance();
  });
  return table;
}

}  // namespace gnomon::truth
