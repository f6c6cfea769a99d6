#include "study/run/scene/sample_axes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/parallel.h"
#include "compare/bins.h"
#include "surface/curvature.h"
#include "surface/limit_surface.h"

namespace gnomon::study {
namespace {

double roundedToAMillionth(double value) {
  return std::round(value * 1e6) / 1e6;
}

/// World length.
double texelLength(const surface::TexelFrame& frame) {
  return std::sqrt(glm::length(glm::cross(frame.px, frame.py)));
}

}  // namespace

AxisPlace axisPlace(const surface::LimitPoint& point, const surface::TexelFrame& frame,
                    const relief::Relief& relief) {
  const double unit = relief::worldPerHeight(relief.space, frame);
  const double height = relief.field.at(frame.texel);
  return {surface::shapeOperator(point),
          frame.normal,
          unit * height,
          texelLength(frame),
          unit * std::max(0.0, relief.field.maximum() - height),
          uvStretch(frame),
          frame.defined};
}

AxisSample axisSample(const AxisPlace& place, const Vec3& light) {
  const double sine = std::clamp(glm::dot(place.normal, light), -1.0, 1.0);
  const Vec3 tangential = light - sine * place.normal;
  const double cosine = glm::length(tangential);
  const Vec3 change = surface::applyShapeOperator(place.shape, light);
  return {std::atan2(sine, cosine),
          cosine > 1e-12 ? glm::dot(tangential, change) / cosine : 0,
          glm::length(change),
          place.height,
          place.texel,
          place.headroom,
          place.stretch};
}

AxisSample axisSample(const surface::LimitPoint& point, const surface::TexelFrame& frame,
                      const relief::Relief& relief, const Vec3& light) {
  return axisSample(axisPlace(point, frame, relief), light);
}

double curvatureHeight(const AxisSample& sample) {
  return sample.curvature * sample.height;
}

double lightElevation(const AxisSample& sample) {
  return sample.elevation * 180 / pi;
}

double terminatorDistance(const AxisSample& sample) {
  if (sample.elevation == 0) return 0;
  return sample.elevation / sample.normalChange / sample.texel;
}

double uvStretch(const surface::TexelFrame& frame) {
  const double xx = glm::dot(frame.px, frame.px);
  const double yy = glm::dot(frame.py, frame.py);
  const double larger = (xx + yy + std::hypot(xx - yy, 2 * glm::dot(frame.px, frame.py))) / 2;
  const double texel = texelLength(frame);
  return larger / (texel * texel);
}

double shadowReach(const AxisSample& sample) {
  if (!(sample.elevation > 0)) return std::numeric_limits<double>::quiet_NaN();
  return sample.headroom / std::tan(sample.elevation) / sample.texel;
}

namespace {

double stretchOf(const AxisSample& sample) {
  return sample.stretch;
}

}  // namespace

const std::vector<SampleAxis>& sampleAxes() {
  static const std::vector<SampleAxis> axes = {
      {"curvature_height",
       "curvature × height",
       "",
       {-0.2, -0.1, -0.05, -0.02, -0.005, 0.005, 0.02, 0.05, 0.1, 0.2},
       curvatureHeight},
      {"elevation",
       "light over the tangent plane",
       "degrees",
       {-10, 0, 5, 10, 15, 20, 30, 40, 50, 60, 75},
       lightElevation},
      {"terminator",
       "distance to the terminator",
       "texels",
       {-32, -8, 0, 8, 16, 32, 64, 128, 256},
       terminatorDistance},
      {"uv_stretch", "stretch of the texture", "", {1.1, 1.25, 1.5, 2, 3, 5}, stretchOf},
      {"shadow_reach",
       "longest shadow that can fall there",
       "texels",
       {1, 2, 4, 8, 16, 32, 64, 128},
       shadowReach},
  };
  return axes;
}

namespace {

/// @param placeOf  `placeOf(i)` is the place of a sample on the surface
template <typename PlaceOf>
SampleBins binsOf(const surface::SampleGrid& samples, const PlaceOf& placeOf, const Vec3& light) {
  const std::vector<SampleAxis>& axes = sampleAxes();
  for (const SampleAxis& axis : axes) compare::requireEdges(axis.edges);
  SampleBins bins(axes.size(), std::vector<std::uint8_t>(samples.samples.size(), compare::noBin));
  parallelFor(
      0, samples.samples.size(),
      [&](std::size_t i) {
        if (!samples.samples[i].isOnSurface()) return;
        const AxisPlace& place = placeOf(i);
        if (!place.defined) return;
        const AxisSample seen = axisSample(place, light);
        for (std::size_t a = 0; a < axes.size(); ++a) {
          bins[a][i] = compare::binOf(roundedToAMillionth(axes[a].value(seen)), axes[a].edges);
        }
      },
      1024);
  return bins;
}

AxisPlace placeOf(const surface::LimitFace& face, const surface::SurfaceSample& sample,
                  const relief::Relief& relief) {
  const surface::LimitPoint point = face.evaluate(sample.s, sample.t);
  return axisPlace(point, surface::texelFrame(point, relief.texelsPerUv()), relief);
}

}  // namespace

SampleBins binSamples(const surface::LimitSurface& surface, const relief::Relief& relief,
                      const surface::SampleGrid& samples, const Vec3& light) {
  const std::vector<surface::LimitFace> faces =
      surface::limitFaces(surface, samples.samples.size());
  return binsOf(
      samples,
      [&](std::size_t i) {
        const surface::SurfaceSample& sample = samples.samples[i];
        return placeOf(faces[sample.faceIndex()], sample, relief);
      },
      light);
}

AxisPlaces axisPlaces(const surface::LimitSurface& surface, const relief::Relief& relief,
                      const surface::SampleGrid& samples) {
  const std::vector<surface::LimitFace> faces =
      surface::limitFaces(surface, samples.samples.size());
  AxisPlaces places(samples.samples.size());
  parallelFor(
      0, places.size(),
      [&](std::size_t i) {
        const surface::SurfaceSample& sample = samples.samples[i];
        if (sample.isOnSurface()) places[i] = placeOf(faces[sample.faceIndex()], sample, relief);
      },
      1024);
  return places;
}

SampleBins binSamples(const surface::SampleGrid& samples, const AxisPlaces& places,
                      const Vec3& light) {
  return binsOf(
      samples, [&](std::size_t i) -> const AxisPlace& { return places[i]; }, light);
}

}  // namespace gnomon::study
