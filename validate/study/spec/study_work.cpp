#include "study/spec/study_work.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <variant>

#include "common/overloaded.h"

namespace gnomon::study {
namespace {

/// As placeMicroLines chooses it on a surface that the map covers once.
double stepOf(const StudySpec& study, double texels) {
  if (study.truth.stepTexels) return *study.truth.stepTexels;
  const double quarters = std::ceil(std::sqrt(study.truth.leastTriangles / (32 * texels)));
  return 1 / (4 * std::max(1.0, quarters));
}

double samplesOf(const ViewSpec& view, int faces) {
  return std::visit(Overloaded{[](const Camera& camera) {
                                 return static_cast<double>(camera.width) * camera.height;
                               },
                               [&](const AtlasSpec& atlas) {
                                 const double side = atlas.samplesPerSide;
                                 return faces * side * side;
                               }},
                    view.kind);
}

/// Of the limit surface, which a grid's outermost ring of faces is no part of.
int limitFaceCount(const surface::Cage& cage) {
  return cage.grid ? cage.grid->columns * cage.grid->rows : cage.faceCount();
}

/// Azimuths of all bakes that differ in them.
double azimuthsOf(const StudySpec& study) {
  std::set<int> bakes;
  for (const MethodSpec& method : study.methods) bakes.insert(method.bake.settings.azimuths);
  return std::accumulate(bakes.begin(), bakes.end(), 0.0);
}

}  // namespace

StudyWork workOf(const StudySpec& study) {
  StudyWork work;
  const Vec2 texelsPerUv = study.relief.texelsPerUv();
  const double texels = std::max(1.0, texelsPerUv.x * texelsPerUv.y);
  const double step = stepOf(study, texels);
  work.microTriangles = 2 * texels / (step * step);
  for (const ViewSpec& view : study.views)
    work.samples += samplesOf(view, limitFaceCount(study.cage));
  work.rays = work.samples * static_cast<double>(study.lights.size());
  std::size_t methods = study.methods.size();
  for (const LadderSpec& ladder : study.ladders) {
    methods += ladder.forward.size() + ladder.backward.size();
  }
  work.frames = work.rays * static_cast<double>(methods);
  work.horizons = azimuthsOf(study) * study.relief.field.width() * study.relief.field.height();
  return work;
}

double expectedSeconds(const StudyWork& work, const WorkSpeed& speed) {
  return speed.start + work.microTriangles * speed.microTriangle + work.rays * speed.ray +
         work.frames * speed.frame + work.horizons * speed.horizon;
}

std::uint64_t standardCost(const StudySpec& study) {
  constexpr double most = 1e12;
  const double microseconds = 1e6 * expectedSeconds(workOf(study), standardSpeed);
  return static_cast<std::uint64_t>(std::clamp(std::round(microseconds), 1.0, most));
}

}  // namespace gnomon::study
