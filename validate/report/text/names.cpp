#include "report/text/names.h"

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

std::string_view runStatusName(RunStatus status) {
  switch (status) {
    case RunStatus::pass:
      return "pass";
    case RunStatus::fail:
      return "fail";
    case RunStatus::notJudged:
      return "not judged";
  }
  throw InternalError("status of a run: not one of its three values");
}

std::string_view inputKindName(InputRecord::Kind kind) {
  switch (kind) {
    case InputRecord::Kind::study:
      return "study";
    case InputRecord::Kind::mesh:
      return "mesh";
    case InputRecord::Kind::image:
      return "image";
    case InputRecord::Kind::shader:
      return "shader";
  }
  throw InternalError("input: not one of its four kinds");
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
