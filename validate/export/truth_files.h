#pragma once

#include <string>

#include "report/run_folder.h"
#include "study/run/scene/run_scene.h"
#include "study/run/truth_study.h"
#include "study/spec/file_names.h"

namespace gnomon::exporting {

/// `masks/VIEW_LIGHT_truth.png`, as in a run's folder.
std::string truthMaskFile(const study::CaseNames& names, std::size_t view, std::size_t light);

/// `shares/VIEW_LIGHT_truth.exr`: under a light with a disc, V as floats.
std::string truthShareFile(const study::CaseNames& names, std::size_t view, std::size_t light);

/// Writes a truth's mask as a picture; of a light with a disc the mask is a map of visibility in
/// 16-bit greys, and as floats in `shareFile`.
void writeTruthMask(report::RunFolder& folder, const truth::Truth& truth,
                    const std::string& maskFile, const std::string& shareFile);

/// Writes the truths of the scene's standard base, in `truthMaskFile` and `truthShareFile`.
void writeTruthMasks(report::RunFolder& folder, study::RunScene& scene);

/// Writes what `gnomon truth` finds: the masks, `regions/VIEW_LIGHT.png` (in the colours that the
/// JSON names) and last `truth.json`, schema "gnomon-truth/1", whose presence says that all is
/// there.
/// @param record  as `traceStudy` gives it
void writeTruth(report::RunFolder& folder, study::RunScene& scene,
                const study::StudyRecord& record);

}  // namespace gnomon::exporting
