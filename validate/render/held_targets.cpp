#include "render/held_targets.h"

namespace gnomon::render {

const Target& HeldTargets::get(int width, int height, const std::vector<GLenum>& formats) const {
  if (width != width_ || height != height_) targets_.clear();
  width_ = width;
  height_ = height;
  return targets_.try_emplace(formats, width, height, formats).first->second;
}

}  // namespace gnomon::render
