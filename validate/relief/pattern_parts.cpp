#include "relief/pattern_parts.h"

#include <fmt/core.h>

#include "common/error.h"
#include "common/system/memory.h"

namespace gnomon::relief {

void requireBetween(const std::string& parameter, double value, double least, double most) {
  if (!(value >= least && value <= most)) {
    throw InputError(fmt::format("{} found, {} to {} expected", value, least, most), parameter);
  }
}

void requireMap(int width, int height, double amplitude) {
  if (width < 1 || height < 1) {
    throw InputError(
        fmt::format("a map of {} × {} texels found, at least 1 × 1 expected", width, height));
  }
  if (!std::isfinite(amplitude)) {
    throw InputError(fmt::format("{} found, a finite number expected", amplitude), "amplitude");
  }
  requireMemory(static_cast<double>(width) * height * sizeof(float),
                fmt::format("a map of {} × {} texels", width, height));
}

}  // namespace gnomon::relief
