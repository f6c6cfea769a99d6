#pragma once

#include <functional>

#include "horizon/table_file.h"
#include "render/gl_context.h"
#include "study/record/record.h"
#include "study/run/scene/run_scene.h"
#include "study/run/scene/truth_stage.h"

namespace gnomon::study {

/// The parts of a study that need no method: its truth and its tables.

/// A record that names the study, with the truth of the study's own base mesh: traced, with its
/// uncertainty. The truths themselves are in the scene's standard base.
/// @param gl           current on this thread
/// @param whileTraced  called once the truths are there, while the surface is
/// @param whileCoarse  called later, while the coarser one is that tells the uncertainty
/// @throws as the run's stages
StudyRecord traceStudy(RunScene& scene, const render::GlContext& gl,
                       const std::function<void(const TracedSurface&)>& whileTraced = {},
                       const std::function<void(const TracedSurface&)>& whileCoarse = {});

/// The study's horizon and distance table as they are stored.
horizon::StoredHorizons bakeStudyTables(const StudySpec& study, cache::Cache& cache,
                                        const Progress& progress = {});

}  // namespace gnomon::study
