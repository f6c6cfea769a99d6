#include "report/names.h"

#include "common/error.h"

namespace gnomon {

std::string_view verdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::held:
      return "held";
    case Verdict::failed:
      return "failed";
    case Verdict::notDistinguishable:
      return "not distinguishable";
    case Verdict::notEvaluated:
      return "not evaluated";
  }
  throw InternalError("verdict: not one of its four values");
}

std::string_view differenceVerdictName(DifferenceVerdict verdict) {
  switch (verdict) {
    case DifferenceVerdict::better:
      return "better";
    case DifferenceVerdict::worse:
      return "worse";
    case DifferenceVerdict::notDistinguishable:
      return "not distinguishable";
  }
  throw InternalError("verdict of a difference: not one of its three values");
}

std::string_view pictureKindName(PictureRecord::Kind kind) {
  switch (kind) {
    case PictureRecord::Kind::shaded:
      return "shaded";
    case PictureRecord::Kind::difference:
      return "difference";
    case PictureRecord::Kind::displaced:
      return "displaced";
  }
  throw InternalError("picture: not one of its three kinds");
}

}  // namespace gnomon
