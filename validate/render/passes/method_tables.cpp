#include "render/passes/method_tables.h"

#include <fmt/core.h>

#include "common/error.h"
#include "render/passes/drawing.h"
#include "render/passes/method_program.h"

namespace gnomon::render {
namespace {

template <typename Table>
const Table& tableOf(const Table* table, const std::string& method, const char* what) {
  if (table == nullptr) throw InternalError(fmt::format("method {} got no {}", method, what));
  return *table;
}

void bindTable(GLuint program, const GpuTable& table, TextureUnit unit, const char* sampler,
               const char* range) {
  bindTexture(program, unit, table.texture(), sampler);
  setUniform(program, range, table.range());
}

void bindAngles(GLuint program, const GpuAngles& angles) {
  bindTexture(program, TextureUnit::angles, angles.texture(), "angleMaps");
  bindTexture(program, TextureUnit::basis, angles.basis(), "basisMaps");
  bindTexture(program, TextureUnit::arccos, angles.arccos(), "arccosMap");
  setUniform(program, "angleAzimuths", angles.azimuths());
  setUniform(program, "angleLimit", angles.limit());
  setUniform(program, "angleSteps", angles.steps());
  setUniform(program, "angleOrigin", angles.origin());
}

}  // namespace

void bindTables(GLuint program, const std::string& method, const MethodTables& declared,
                const GpuTables& tables) {
  setUniform(program, "searchRadius", tables.searchRadius);
  if (declared.horizon) {
    bindTable(program, tableOf(tables.horizon, method, "horizons"), TextureUnit::horizon,
              "horizonTable", "horizonRange");
  }
  if (declared.distance) {
    bindTable(program, tableOf(tables.distance, method, "distances"), TextureUnit::distance,
              "distanceTable", "distanceRange");
  }
  if (declared.ellipse) {
    bindTable(program, tableOf(tables.ellipse, method, "ellipses"), TextureUnit::ellipse,
              "ellipseTable", "ellipseRange");
  }
  if (declared.angles || declared.surfaceAngles) {
    bindAngles(program, tableOf(tables.angles, method, "angles"));
  }
}

void bindBakes(GLuint program, const std::string& method, const std::vector<MethodBake>& declared,
               const GpuTables& tables) {
  if (declared.empty()) return;
  const std::vector<GpuBake>& bakes = tableOf(tables.bakes, method, "bakes");
  for (std::size_t i = 0; i < declared.size(); ++i) {
    bindTexture(program, bakeUnit(i), bakes.at(i).texture(), declared[i].sampler().c_str());
  }
}

}  // namespace gnomon::render
