#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/mask.h"
#include "render/method.h"
#include "render/passes/method_pass.h"
#include "study/run/scene/given_masks.h"
#include "study/run/scene/run_scene.h"
#include "study/run/scene/truth_stage.h"

namespace gnomon::study {

/// A method's shader and its tables.
struct CompiledMethod {
  std::shared_ptr<const render::MethodPass> pass;
  render::GpuTables tables;
  std::shared_ptr<const std::vector<render::GpuBake>> bakes = {};  ///< its own, if it has any
  std::optional<double> frameMs = {};  ///< of the frame that answersOf timed
};

/// A method of a study with the mesh that it draws. Its shader is compiled and its tables are baked
/// when it is first drawn: never, if the cache has all its answers.
struct MethodCase {
  const MethodSpec* spec;
  render::Method method;
  BaseCase* base;
  cache::ContentKey key;     ///< as `RunKeys::method`; of given masks, their contents
  SurfaceOnDemand* surface;  ///< for tables that are shot on it
  std::optional<CompiledMethod> compiled = {};
  GivenMasks given = {};  ///< of a method that another program drew, which is never compiled

  [[nodiscard]] bool isGiven() const { return spec->isGiven(); }
};

/// A method's answers in one view under one light.
struct CaseAnswers : render::MethodAnswers {
  /// Under a light with a disc: the same as shares of it, which the masks are cut from (cutInHalf).
  /// Empty under a point light.
  Visibility drawnShares = {};
  Visibility testShares = {};

  [[nodiscard]] bool isSoft() const { return drawnShares.size() > 0; }
};

/// Whether two methods answer alike, in one view under one light.
bool answerAlike(const CaseAnswers& a, const CaseAnswers& b);

/// Reads a method, or its masks; compiles it unless the cache has all its masks, so that a mistake
/// in it shows before anything else is computed.
/// @param spec     outlives the case
/// @param surface  likewise
/// @throws InputError for a method that cannot be used in this study: its file, its parameters, or
///   a texture plane that the surface does not have, or masks that are missing or of another size
MethodCase prepareMethod(RunScene& scene, const MethodSpec& spec, SurfaceOnDemand& surface);

/// The method compiled, with all its tables; not of given masks.
/// @throws InputError as prepareMethod
const CompiledMethod& compiled(RunScene& scene, MethodCase& method);

/// Counts the texels that the method's answers read.
std::shared_ptr<const render::TexelCounter> texelCounter(RunScene& scene, const MethodCase& method);

/// What the method's passes draw under one of the study's lights.
render::Drawing drawingOf(RunScene& scene, const MethodCase& method, std::size_t light);

/// Triangles that it draws: of its own mesh, and of the one that its light alone sees.
std::uint64_t polygonsOf(RunScene& scene, const MethodCase& method);

/// A method that only a camera can see needs one.
/// @throws InputError where the study has no camera view
void requireView(const MethodCase& method, const StudySpec& study);

/// Gives each compiled method its tables that are ray-shot on the displaced surface, while that is
/// in memory.
void shootTables(RunScene& scene, std::span<MethodCase> methods);

/// Why a method answers in the pictures of cameras alone: "counts shadow volumes at a camera's
/// pixels".
std::string cameraReason(const render::Method& method);

/// Whether the method can answer in a view: one that needs a camera does in a camera's.
bool answersIn(const MethodCase& method, const ViewSpec& view);

/// A method's answers in one view under one light, without the samples for which no frame exists:
/// the truth must have been traced. Given masks are pictures: both answers are theirs.
/// @param clock  where the frame that draws them is to be timed: its time goes to the method's
///               `frameMs`, if its shader has been drawn with before
/// @throws InputError for a sample with a truth and without an answer
CaseAnswers answersOf(RunScene& scene, MethodCase& method, std::size_t view, std::size_t light,
                      std::optional<render::FrameClock> clock = {});

/// The cache key of everything computed from those answers and the truth.
cache::ContentKey answerKey(const RunScene& scene, const MethodCase& method, std::size_t view,
                            std::size_t light);

/// Bytes of the tables and bakes that a frame of the method reads, of its textures, and of those
/// that its passes fill in the first camera's picture.
std::uint64_t tableBytes(RunScene& scene, MethodCase& method);

}  // namespace gnomon::study
