#pragma once

#include <cstdint>
#include <span>

#include "common/mask.h"
#include "render/method.h"
#include "render/method_pass.h"
#include "study/run_scene.h"
#include "truth/micro_mesh.h"
#include "truth/micro_scene.h"

namespace gnomon {

/// A method ready to be asked: its shader, its tables and the mesh that it draws.
struct MethodCase {
  const MethodSpec* spec;
  Method method;
  MethodPass pass;
  GpuTables tables;
  BaseCase* base;
};

/// Reads and compiles a method and bakes the tables that depend on the relief alone.
/// @param spec  outlives the case
/// @throws InputError for a method that cannot be used in this study: its file, its parameters, or
///   a texture plane that the surface does not have
MethodCase prepareMethod(RunScene& scene, const MethodSpec& spec);

/// A method that only a camera can see needs one.
/// @throws InputError where the study has no camera view
void requireView(const MethodCase& method, const StudySpec& study);

/// The tables that are shot on the displaced surface, for those of the methods that read them.
void shootTables(RunScene& scene, std::span<MethodCase> methods, const MicroMesh& mesh,
                 const MicroScene& traced);

/// Whether the method can answer in a view: one that counts shadow volumes does in a camera's.
bool answersIn(const MethodCase& method, const ViewSpec& view);

/// A method's mask in one view under one light, without the samples for which no frame exists: the
/// truth must have been traced.
Mask answerOf(const RunScene& scene, const MethodCase& method, std::size_t view, std::size_t light);

/// Bytes of the tables that the method declares, and of the textures that its passes fill.
std::uint64_t tableBytes(const RunScene& scene, const MethodCase& method);

}  // namespace gnomon
