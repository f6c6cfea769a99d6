#pragma once

#include <string>
#include <vector>

#include "render/bakes/gpu_bake.h"
#include "render/gpu_scene.h"
#include "render/method.h"

namespace gnomon::render {

/// How tables are filtered.
enum class TableFilter {
  exact,     ///< by hand from single texels, in float: masks do not depend on the GPU's filter
  hardware,  ///< by the GPU's own trilinear filter, as products do
};

/// The tables of a bake on the GPU, and how far it searched. A method reads only what it declares.
struct GpuTables {
  const GpuTable* horizon = nullptr;
  const GpuTable* distance = nullptr;
  const GpuAngles* angles = nullptr;  ///< of the flat relief or of the surface, as declared
  const GpuTable* ellipse = nullptr;
  double searchRadius = 128;                    ///< of the bake, texels: marches end there too
  const std::vector<GpuBake>* bakes = nullptr;  ///< the method's own, as it declares them
};

/// Gives a program the tables that a method declares.
/// @throws InternalError where one of them is missing
void bindTables(GLuint program, const std::string& method, const MethodTables& declared,
                const GpuTables& tables);

/// Gives a program the method's own bakes.
/// @throws InternalError where they are missing
void bindBakes(GLuint program, const std::string& method, const std::vector<MethodBake>& declared,
               const GpuTables& tables);

}  // namespace gnomon::render
