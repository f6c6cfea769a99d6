#pragma once

#include <compare>

#include "render/method.h"
#include "study/spec/sections/base_section.h"

namespace gnomon::study {

/// Which mesh: the base mesh or the displaced one, of so many pieces of every face's side.
struct MeshChoice {
  render::DrawnMesh kind = render::DrawnMesh::base;
  BaseSpec base = {};

  // NOLINTNEXTLINE(modernize-use-nullptr): it takes the comparison's own 0 for a pointer
  friend auto operator<=>(const MeshChoice&, const MeshChoice&) = default;
};

}  // namespace gnomon::study
