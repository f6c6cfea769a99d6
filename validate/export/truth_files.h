#pragma once

#include <string>

#include "displaced/displaced_mesh.h"
#include "image/images.h"
#include "report/run_folder.h"
#include "study/run/run_study.h"
#include "study/run/scene/run_scene.h"
#include "study/spec/sections/study_files.h"

namespace gnomon::exporting {

/// The other forms of a map `samples/VIEW.exr`: `samples/VIEW.npy`, and
/// `samples/VIEW_layers.exr`, whose channels all are X, Y or Z of a layer, since programs as
/// Blender read no others: face, s and t are `place.X`, `.Y`, `.Z`, and weight is `texel.Z`.
std::string npyName(const std::string& mapFile);
std::string layersName(const std::string& mapFile);

/// Writes a map in its three forms, each whole or not at all.
/// @param mapFile  its name, with .exr at the end
void writeSampleMap(report::RunFolder& folder, const std::string& mapFile, image::ChannelImage map);

/// A picture as the bytes of a NumPy file (format 1.0): 32-bit little-endian floats of shape
/// (height, width, channels), row 0 at the top. Same numbers, same bytes.
std::string npyBytes(const image::ChannelImage& image);

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

/// The parts of an export that are pictures; `exportJson` tells what they hold. All are written
/// whole or not at all.

/// `samples/VIEW.exr` and `roi/VIEW.png`.
std::string sampleMapFile(const study::CaseNames& names, std::size_t view);
std::string roiFile(const study::CaseNames& names, std::size_t view);

/// Writes the height map as `heights.exr`, channel `height`, in height units; the first row is the
/// one with the largest v.
void writeHeights(report::RunFolder& folder, const relief::HeightField& field);

/// The names of a sample map's channels, in the order that its NumPy file has them.
const std::vector<std::string>& sampleChannels();

/// Writes a sample map, in its three forms (truth_files.h), for every view of the standard base,
/// whose truths are not needed. Channels:
///   face, s, t          the sample; face is -1, and all else 0, where the truth has no answer
///   texel.X, .Y         texture coordinates in texels
///   base.X, .Y, .Z      P, on the undisplaced limit surface
///   normal.X, .Y, .Z    n there, unit, outward
///   point.X, .Y, .Z     the displaced point, where the truth's shadow ray starts
///   facet.X, .Y, .Z     normal of the facet that holds it, unit, outward
///   weight              area that the sample stands for in an atlas; 1 in a camera's view
/// @throws MemoryError for a map that cannot fit
void writeSampleMaps(report::RunFolder& folder, study::RunScene& scene,
                     const truth::MicroMesh& mesh);

/// Writes, for every view, where the truths have an answer: white there, black elsewhere.
void writeRegionsOfInterest(report::RunFolder& folder, study::RunScene& scene);

}  // namespace gnomon::exporting
