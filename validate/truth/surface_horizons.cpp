#include "truth/surface_horizons.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/counted_progress.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "surface/texel_frame.h"
#include "truth/flush_denormals.h"

namespace gnomon {
namespace {

constexpr double rise = radians(4);
constexpr double precision = 1e-3;

/// The largest angle off the normal, up to `limit`, at which a ray escapes.
template <typename IsFree>
double horizonAngle(double limit, const IsFree& isFree) {
  double blocked = limit;
  if (isFree(limit)) return limit;
  double free = limit - rise;
  while (free > 0 && !isFree(free)) {
    blocked = free;
    free -= rise;
  }
  if (free <= 0) {
    if (!isFree(0)) return 0;
    free = 0;
  }
  while (blocked - free > precision) {
    const double middle = (blocked + free) / 2;
    (isFree(middle) ? free : blocked) = middle;
  }
  return free;
}

}  // namespace

AngleTable shootHorizons(const LimitSurface& surface, const Relief& relief, const MicroMesh& mesh,
                         const MicroScene& scene, const SampleGrid& texels, int azimuths,
                         double limit, const Progress& progress) {
  const std::size_t count = texels.samples.size();
  requireMemory(sizeof(float) * static_cast<double>(count) * azimuths,
                fmt::format("bake: horizons of {} × {} texels × {} azimuths on the surface",
                            texels.width, texels.height, azimuths));
  AngleTable table{{texels.width, texels.height, azimuths, Wrap::clamp}, limit, {}};
  table.angles.assign(table.entries(), static_cast<float>(limit));
  const Vec2 texelsPerUv = relief.texelsPerUv();
  const auto shoot = [&](const SurfaceSample& sample, std::size_t texel) {
    if (!sample.isOnSurface()) return;
    const TexelFrame frame = texelFrame(surface.evaluate(sample), texelsPerUv);
    const Facet facet = mesh.facet(sample);
    if (!frame.defined || facet.normal == Vec3(0)) return;
    const Vec3 origin = facet.rayOrigin(mesh.rayOffset());
    for (int m = 0; m < azimuths; ++m) {
      const double azimuth = 2 * pi * m / azimuths;
      const Vec3 tangent =
          glm::normalize(std::cos(azimuth) * frame.px + std::sin(azimuth) * frame.py);
      const double angle = horizonAngle(limit, [&](double off) {
        const Vec3 direction = std::cos(off) * frame.normal + std::sin(off) * tangent;
        return !facet.facesAwayFrom(direction) && !scene.occluded(origin, direction);
      });
      table.angles[static_cast<std::size_t>(m) * count + texel] = static_cast<float>(angle);
    }
  };
  CountedProgress rows(progress, static_cast<std::size_t>(texels.height));
  parallelFor(0, static_cast<std::size_t>(texels.height), [&](std::size_t row) {
    const FlushDenormals flush;
    const auto width = static_cast<std::size_t>(texels.width);
    const std::size_t fromBelow = static_cast<std::size_t>(texels.height) - 1 - row;
    for (std::size_t column = 0; column < width; ++column) {
      shoot(texels.samples[fromBelow * width + column], row * width + column);
    }
    rows.advance();
  });
  return table;
}

}  // namespace gnomon
