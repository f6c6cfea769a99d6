#include "relief/pattern_parts.h"

#include <fmt/core.h>

#include "common/error.h"
#include "common/system/memory.h"

namespace gnomon {

void requireBetween(std::string_view key, double value, double least, double most) {
  if (!(value >= least && value <= most)) {
    throw InputError(
        fmt::format("relief.{}: {} found, {} to {} expected", key, value, least, most));
  }
}

void requireMap(int width, int height, double amplitude) {
  if (width < 1 || height < 1) {
    throw InputError(
        fmt::format("relief.size: {} x {} texels found, at least 1 x 1 expected", width, height));
  }
  if (!std::isfinite(amplitude)) {
    throw InputError(fmt::format("relief.height: {} found, a finite number expected", amplitude));
  }
  requireMemory(static_cast<double>(width) * height * sizeof(float),
                fmt::format("relief.size: a map of {} x {} texels", width, height));
}

}  // namespace gnomon
