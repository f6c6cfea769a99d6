#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/record/record.h"
#include "study/run/scene/method_case.h"
#include "study/run/scene/run_scene.h"

namespace gnomon::study {

/// Notices: what a reader must know before using a run's figures, and what to do about it.

/// A truth that is more uncertain than this cannot tell good methods apart: a share of samples.
constexpr double mostUncertainty = 0.003;
/// Edges of a displaced mesh longer than this miss the map's own features, texels. Measured on
/// figure8's shadow volumes, whose 9 pieces a side are 0.9 texels long and err by 1.4 %: at 1.3
/// texels 2.0 %, at 2 texels 3.3 %, at 4 texels 8.3 %, where no shadow at all errs by 11 %.
constexpr double longestPieceTexels = 2;

/// A notice that the truth is more uncertain than `mostUncertainty`, with the key that refines it.
std::optional<std::string> uncertaintyNotice(const StudySpec& study, const TruthRecord& truth);

/// A notice that a mesh of so many pieces a side is too coarse for the map, with the number that
/// suffices.
/// @param method             its label, or those of all methods that draw this mesh
/// @param longestEdgeTexels  of any face
/// @param isOfLight          whether the light alone sees the mesh: its pieces are the parameter
///                           `light_pieces`
std::optional<std::string> coarsePiecesNotice(const std::string& method, int pieces,
                                              double longestEdgeTexels, bool isOfLight = false);

/// The samples of the truth under one light, over all views.
struct LightCount {
  std::size_t lit = 0;
  std::size_t shadowed = 0;
  std::size_t turned = 0;  ///< of both: the undisplaced surface is turned from the light there
};

/// Notices of the lights below the horizon of the whole surface, of those under which next to all
/// samples are shadowed, and of those under which next to none is: they tell no method from
/// another.
/// @param counts  one a light
std::vector<std::string> lightNotices(const StudySpec& study, std::span<const LightCount> counts);

/// A notice that figures of the quick form are not final.
std::optional<std::string> quickNotice(const StudySpec& study);

/// A notice that a map which repeats past the border of an open mesh makes the search radius more
/// than twice as long as the same map clamped.
std::optional<std::string> wrapNotice(const StudySpec& study, const surface::LimitSurface& surface);

/// A notice that a closed surface is turned inside out, if next to nothing is lit.
/// @param shadowShare  of all samples of the study's own base mesh, in the truth
std::optional<std::string> insideOutNotice(const surface::LimitSurface& surface,
                                           double shadowShare);

/// A notice that charts of the texture overlap, with their share of the surface.
std::optional<std::string> overlapNotice(const surface::TextureLayout& layout);

/// A notice of the methods whose answers met texels of other charts, and at how many samples.
std::optional<std::string> otherChartNotice(std::span<const MethodRecord> methods);

/// A notice of a mesh file's vertices that were joined, and of edges that were not.
std::optional<std::string> joinedNotice(const surface::Cage& cage);

/// A notice of faces that lie outside a clamped map.
std::optional<std::string> outsideMapNotice(const StudySpec& study);

/// A notice of what the masks of another program do not tell.
/// @param method  as above
std::string givenNotice(const std::string& method);

/// A notice that masks of another program seem inverted, of the first of them, see
/// compare::invertedNotice.
std::optional<std::string> invertedMasksNotice(const StudySpec& study, const MethodCase& method);

/// A notice of what is measured under lights with discs, where the study has any.
std::optional<std::string> softNotice(const StudySpec& study);

/// A notice of the views in which a method cannot answer that needs a camera.
std::optional<std::string> cameraNotice(const StudySpec& study, const std::string& label,
                                        const render::Method& method);

/// All notices of a run, each once for all methods that it is about, once its truth is traced.
std::vector<std::string> noticesOf(RunScene& scene, const TruthRecord& truth,
                                   std::span<const MethodCase> methods);

}  // namespace gnomon::study
