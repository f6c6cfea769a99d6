#pragma once

#include <cstdint>

#include "study/spec/study_file.h"

namespace gnomon::study {

/// How much a run of a study has to do, as its settings tell before anything is built: of an
/// outline (StudyOptions) too. Counts of the same study are the same on every machine.
struct StudyWork {
  /// Of the micro-mesh: 2 / step² for each texel of the map over the surface, with the step of the
  /// study or the one that gives `truth.triangles`.
  double microTriangles = 0;
  double samples = 0;  ///< of all views: pixels of cameras, whatever they show
  double rays = 0;     ///< samples × lights
  double frames = 0;   ///< rays × methods, with the states of ladders: samples that shaders answer
  double horizons = 0;  ///< texels × azimuths of the tables that methods may read
};

StudyWork workOf(const StudySpec& study);

/// Seconds that each of these takes.
struct WorkSpeed {
  double microTriangle = 0;
  double ray = 0;
  double frame = 0;
  double horizon = 0;
  double start = 0;  ///< of a case, whatever it does
};

/// Of Figure 8 on two threads, by the stages in the manual's page on speed: what cases are divided
/// by, where only the ratios matter.
constexpr WorkSpeed standardSpeed{1.2e-7, 9e-7, 6e-7, 5e-8, 0.15};

double expectedSeconds(const StudyWork& work, const WorkSpeed& speed);

/// Expected microseconds at the standard speed, 1 to 10¹².
std::uint64_t standardCost(const StudySpec& study);

}  // namespace gnomon::study
