#include "study/run/scene/view_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/lists.h"
#include "common/parallel.h"
#include "compare/counts.h"

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

namespace {

/// Where a sample is, and how far a neighbour can be.
struct Surrounding {
  glm::vec3 place{0};
  float spacing = 0;
};

Surrounding surroundingOf(const ViewMap& map, const surface::TangentPoint& point) {
  const double spacing = sampleSpacing(map, point, surface::outwardNormal(point));
  return {glm::vec3(point.position), std::isfinite(spacing)
                                         ? static_cast<float>(spacing)
                                         : std::numeric_limits<float>::infinity()};
}

bool isBreak(const Surrounding& a, const Surrounding& b) {
  return glm::distance(a.place, b.place) > std::min(a.spacing, b.spacing);
}

std::vector<std::uint8_t> breaksInCamera(const surface::LimitSurface& surface, const ViewMap& map,
                                         const surface::SampleGrid& grid) {
  const std::vector<surface::LimitFace> faces = surface::limitFaces(surface, grid.samples.size());
  std::vector<Surrounding> surroundings(grid.samples.size());
  constexpr std::size_t grain = 1024;
  parallelFor(
      0, surroundings.size(),
      [&](std::size_t i) {
        const surface::SurfaceSample& sample = grid.samples[i];
        if (!sample.isOnSurface()) return;
        const surface::LimitFace& face = faces[sample.faceIndex()];
        surroundings[i] = surroundingOf(map, face.at(sample.s, sample.t));
      },
      grain);
  const auto width = static_cast<std::size_t>(grid.width);
  std::vector<std::uint8_t> breaks(surroundings.size());
  parallelFor(
      0, breaks.size(),
      [&](std::size_t i) {
        const auto parts = [&](std::size_t neighbour) {
          return grid.samples[i].face >= 0 && grid.samples[neighbour].face >= 0 &&
                 isBreak(surroundings[i], surroundings[neighbour]);
        };
        if ((i + 1) % width != 0 && parts(i + 1)) breaks[i] |= compare::breakRight;
        if (i + width < breaks.size() && parts(i + width)) breaks[i] |= compare::breakBelow;
      },
      grain);
  return breaks;
}

/// Columns and rows in texels.
Vec2 meanSteps(const surface::LimitSurface& surface, Vec2 texelsPerUv, int samplesPerSide) {
  Vec2 sum(0);
  for (int face = 0; face < surface.faceCount(); ++face) {
    const surface::TangentPoint middle = surface.tangentPoint(face, 0.5, 0.5);
    sum += Vec2(glm::length(texelsPerUv * middle.uvDs), glm::length(texelsPerUv * middle.uvDt));
  }
  return sum / (static_cast<double>(surface.faceCount()) * samplesPerSide);
}

Vec2 imageInAtlas(const AtlasSpec& atlas, const surface::TangentPoint& point, const Vec3& tangent) {
  const double ss = glm::dot(point.ds, point.ds);
  const double st = glm::dot(point.ds, point.dt);
  const double tt = glm::dot(point.dt, point.dt);
  const double s = glm::dot(point.ds, tangent);
  const double t = glm::dot(point.dt, tangent);
  const Vec2 parameters = Vec2(tt * s - st * t, ss * t - st * s) / (ss * tt - st * st);
  return static_cast<double>(atlas.samplesPerSide) * Vec2(parameters.x, -parameters.y);
}

}  // namespace

int ViewMap::tileSide() const {
  return std::visit(Overloaded{[](const Camera&) { return 0; },
                               [&](const AtlasSpec& atlas) {
                                 return surface_.grid() ? 0 : atlas.samplesPerSide;
                               }},
                    kind_);
}

Vec2 ViewMap::image(const surface::TangentPoint& point, const Vec3& tangent) const {
  return std::visit(
      Overloaded{[&](const Camera&) { return imageInCamera(point.position, tangent); },
                 [&](const AtlasSpec& atlas) { return imageInAtlas(atlas, point, tangent); }},
      kind_);
}

/// The derivative of (x/w, y/w) is ((x', y') - w' (x/w, y/w)) / w.
Vec2 ViewMap::imageInCamera(const Vec3& position, const Vec3& tangent) const {
  const glm::dvec4 at = clip_ * glm::dvec4(position, 1);
  const glm::dvec4 motion = clip_ * glm::dvec4(tangent, 0);
  const Vec2 device = (Vec2(motion) - motion.w * Vec2(at) / at.w) / at.w;
  return device * Vec2(view_.width, -view_.height) / 2.0;
}

double sampleSpacing(const ViewMap& map, const surface::TangentPoint& point, const Vec3& normal) {
  const Vec3 along = glm::normalize(point.ds);
  const Vec2 image = map.image(point, along);
  const Vec2 imageAcross = map.image(point, glm::cross(normal, along));
  // The inverse of the matrix with these two columns: what a column and a row are in the world.
  const double area = image.x * imageAcross.y - image.y * imageAcross.x;
  const double column = std::hypot(imageAcross.y, image.y) / std::abs(area);
  const double row = std::hypot(imageAcross.x, image.x) / std::abs(area);
  constexpr double roundingSamples = 3;
  return roundingSamples * (column + row);
}

compare::SampleLayout makeSampleLayout(const surface::LimitSurface& surface, Vec2 texelsPerUv,
                                       const ViewKind& kind, const render::RenderView& view,
                                       const surface::SampleGrid& samples) {
  const ViewMap map(surface, kind, view);
  return std::visit(Overloaded{[&](const Camera&) -> compare::SampleLayout {
                                 return {1, 1, 0, breaksInCamera(surface, map, samples)};
                               },
                               [&](const AtlasSpec& atlas) -> compare::SampleLayout {
                                 const Vec2 steps =
                                     meanSteps(surface, texelsPerUv, atlas.samplesPerSide);
                                 return {steps.x, steps.y, map.tileSide(), {}};
                               }},
                    kind);
}

namespace {

FieldPoint fieldPoint(const ViewMap& map, const surface::LimitSurface& surface,
                      const surface::SurfaceSample& sample) {
  const surface::TangentPoint point = surface.tangentPoint(sample);
  const Vec3 normal = surface::outwardNormal(point);
  return {point.position, point.ds, point.dt, normal,
          static_cast<float>(sampleSpacing(map, point, normal))};
}

compare::LightStep lightStep(const ViewMap& map, const FieldPoint& at, const Vec3& light) {
  constexpr double leastSine = 1e-6;
  const Vec3& normal = at.normal;
  const double cosine = glm::dot(light, normal);
  const Vec3 toLight = light - cosine * normal;
  if (normal == Vec3(0) || !(cosine > 0) || !(glm::length(toLight) > leastSine)) return {};

  const Vec3 along = -glm::normalize(toLight);
  const surface::TangentPoint point{at.position, at.ds, at.dt, Vec2(0), Vec2(0), Vec2(0)};
  const Vec2 image = map.image(point, along);
  const double speed = glm::length(image);
  if (!std::isfinite(at.spacing) || !(speed > 0)) return {};
  return {glm::vec2(image / speed), static_cast<float>(1 / speed), glm::vec3(point.position),
          at.spacing};
}

/// @param pointOf  `pointOf(i)` is a sample's
template <typename PointOf>
compare::LightField lightFieldOf(const ViewMap& map, const surface::SampleGrid& samples,
                                 const PointOf& pointOf, const Vec3& light) {
  compare::LightField field{samples.width, samples.height, map.tileSide(),
                            RawVector<compare::LightStep>(samples.samples.size())};
  parallelFor(
      0, field.steps.size(),
      [&](std::size_t i) {
        field.steps[i] = samples.samples[i].isOnSurface() ? lightStep(map, pointOf(i), light)
                                                          : compare::LightStep{};
      },
      1024);
  return field;
}

}  // namespace

FieldPoints makeFieldPoints(const surface::LimitSurface& surface, const ViewKind& kind,
                            const render::RenderView& view, const surface::SampleGrid& samples) {
  const ViewMap map(surface, kind, view);
  FieldPoints points(samples.samples.size());
  parallelFor(
      0, points.size(),
      [&](std::size_t i) {
        const surface::SurfaceSample& sample = samples.samples[i];
        if (sample.isOnSurface()) points[i] = fieldPoint(map, surface, sample);
      },
      1024);
  return points;
}

compare::LightField makeLightField(const surface::LimitSurface& surface, const ViewKind& kind,
                                   const render::RenderView& view,
                                   const surface::SampleGrid& samples, const Vec3& light) {
  const ViewMap map(surface, kind, view);
  return lightFieldOf(
      map, samples, [&](std::size_t i) { return fieldPoint(map, surface, samples.samples[i]); },
      light);
}

compare::LightField makeLightField(const surface::LimitSurface& surface, const ViewKind& kind,
                                   const render::RenderView& view,
                                   const surface::SampleGrid& samples, const FieldPoints& points,
                                   const Vec3& light) {
  return lightFieldOf(
      ViewMap(surface, kind, view), samples,
      [&](std::size_t i) -> const FieldPoint& { return points[i]; }, light);
}

}  // namespace gnomon::study
