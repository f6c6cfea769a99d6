#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <string>

#include "common/error.h"
#include "render/method.h"

namespace gnomon::render::check {

/// Counts pixels that are as they must be, and others.
class Tally {
 public:
  void add(bool isRight) {
    ++all_;
    wrong_ += isRight ? 0 : 1;
  }
  /// Empty if all are right, else "37 of 5124 pixels are wrong".
  /// @throws InternalError if nothing was counted
  [[nodiscard]] std::string fault() const {
    if (all_ == 0) throw InternalError("the check of a pass has looked at nothing");
    return wrong_ == 0 ? "" : fmt::format("{} of {} pixels are wrong", wrong_, all_);
  }

 private:
  std::size_t all_ = 0;
  std::size_t wrong_ = 0;
};

/// A method for a check alone.
/// @param glsl  defines `isShadowed`, and `resolveTexel` for a texture pass
inline Method methodOf(DrawnMesh mesh, const std::string& glsl) {
  Method method;
  method.name = "check";
  method.mesh = mesh;
  method.source = {"the check of a pass", glsl};
  method.code = {method.source};
  return method;
}

}  // namespace gnomon::render::check
