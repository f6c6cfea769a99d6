#pragma once

#include <map>
#include <vector>

#include "render/target.h"

namespace gnomon::render {

/// Targets that frames are drawn into one after the other, of one method or of many: where a driver
/// draws in software, to get fresh memory takes as long as a small frame. A frame finds in them
/// what the last one left. Those of the last size are kept.
class HeldTargets {
 public:
  /// The target of a size and of these formats. It stays valid until another size is asked for.
  /// @throws InputError as Target
  const Target& get(int width, int height, const std::vector<GLenum>& formats) const;

 private:
  // What is there already; no result depends on it.
  mutable int width_ = 0;
  mutable int height_ = 0;
  mutable std::map<std::vector<GLenum>, Target> targets_;
};

}  // namespace gnomon::render
