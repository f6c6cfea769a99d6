#pragma once

#include <functional>

#include "horizon/stored_table.h"
#include "render/gl_context.h"
#include "study/record/record.h"
#include "study/run/scene/environment.h"
#include "study/run/scene/run_scene.h"
#include "study/run/scene/truth_stage.h"
#include "study/run/stages/run_writer.h"
#include "study/spec/study_file.h"

namespace gnomon::study {

/// Measures a study: builds surface and relief, bakes tables, traces the truth at full and half
/// resolution, renders every method at the truth's samples, compares. Masks and pictures go to
/// `writer`, figures into the record. Claims are left to `judgeClaims`, since some need other
/// studies of the same run.
/// @param gl    current on this thread
/// @param kept  what earlier runs and studies left: what is found there is not computed again
StudyRecord runStudy(const StudySpec& study, const render::GlContext& gl, RunWriter& writer,
                     cache::Cache& kept, const StageProgress& progress = {});

/// The same without pictures, masks and frame times: the figures alone.
StudyRecord runStudyFigures(const StudySpec& study, const render::GlContext& gl, cache::Cache& kept,
                            const StageProgress& progress = {});

/// The same without what the methods cost, too.
StudyRecord measureStudy(const StudySpec& study, const render::GlContext& gl, cache::Cache& kept,
                         const StageProgress& progress = {});

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
