#include "surface/cage/cage.h"

namespace gnomon::surface {

std::vector<int> Cage::limitFaceParts() const {
  const std::size_t each = scheme == SubdivisionScheme::loop ? 3 : 1;
  std::vector<int> parts;
  parts.reserve(each * faceParts.size());
  for (const int part : faceParts) parts.insert(parts.end(), each, part);
  return parts;
}

}  // namespace gnomon::surface
