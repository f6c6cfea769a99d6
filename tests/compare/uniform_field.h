#pragma once

#include "common/vec.h"
#include "compare/shadow_length.h"

namespace gnomon::test {

/// Every step in one direction; columns and rows measure one unit.
inline compare::LightField uniformField(int width, int height, Vec2 away, double length = 1) {
  compare::LightField field{width, height, 0, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      field.steps.push_back(
          {glm::vec2(away), static_cast<float>(length), glm::vec3(column, row, 0), 6.0F});
    }
  }
  return field;
}

}  // namespace gnomon::test
