#include "relief/relief.h"

#include <cmath>

namespace gnomon::relief {

double worldPerHeight(HeightSpace space, const surface::TexelFrame& frame) {
  if (space == HeightSpace::world) return 1;
  return std::sqrt(glm::length(glm::cross(frame.px, frame.py)));
}

Vec3 displaced(const Relief& relief, const surface::TexelFrame& frame) {
  if (!frame.defined) return frame.position;
  const double height = worldPerHeight(relief.space, frame) * relief.field.at(frame.texel);
  return frame.position + height * frame.direction();
}

}  // namespace gnomon::relief
