#include "truth/region.h"

#include "common/error.h"

namespace gnomon::truth {

std::string_view regionName(Region region) {
  switch (region) {
    case Region::none:
      return "none";
    case Region::lit:
      return "lit";
    case Region::attached:
      return "attached";
    case Region::cast:
      return "cast";
    case Region::distant:
      return "distant";
    case Region::global:
      return "global";
    case Region::beyondTerminator:
      return "beyond-terminator";
  }
  throw InternalError("a region without a name");
}

}  // namespace gnomon::truth
