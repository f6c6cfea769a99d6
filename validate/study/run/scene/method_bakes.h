#pragma once

#include <memory>
#include <vector>

#include "render/bakes/method_bake.h"
#include "render/method.h"
#include "render/passes/method_program.h"
#include "study/run/scene/run_scene.h"

namespace gnomon::study {

/// The tables that a method bakes by its own functions: what the cache has of them, else baked,
/// as part of the stage "bake". Null for a method without any.
/// @param tables  those that the method declares beside them
/// @throws InputError as render::BakePass
std::shared_ptr<const std::vector<render::GpuBake>> methodBakes(RunScene& scene,
                                                                const MethodSpec& spec,
                                                                const render::Method& method,
                                                                const render::GpuTables& tables);

}  // namespace gnomon::study
