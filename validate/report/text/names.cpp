#include "report/text/names.h"

#include "common/error.h"

namespace gnomon::report {

std::string_view runStatusName(study::RunStatus status) {
  switch (status) {
    case study::RunStatus::pass:
      return "pass";
    case study::RunStatus::fail:
      return "fail";
    case study::RunStatus::notJudged:
      return "not judged";
  }
  throw InternalError("status of a run: not one of its three values");
}

std::string_view inputKindName(study::InputRecord::Kind kind) {
  switch (kind) {
    case study::InputRecord::Kind::study:
      return "study";
    case study::InputRecord::Kind::mesh:
      return "mesh";
    case study::InputRecord::Kind::image:
      return "image";
    case study::InputRecord::Kind::shader:
      return "shader";
    case study::InputRecord::Kind::mask:
      return "mask";
  }
  throw InternalError("input: not one of its five kinds");
}

std::string_view differenceVerdictName(study::DifferenceVerdict verdict) {
  switch (verdict) {
    case study::DifferenceVerdict::better:
      return "better";
    case study::DifferenceVerdict::worse:
      return "worse";
    case study::DifferenceVerdict::equal:
      return "equal";
    case study::DifferenceVerdict::notDistinguishable:
      return "not distinguishable";
    case study::DifferenceVerdict::noInterval:
      return "no interval";
  }
  throw InternalError("verdict of a difference: not one of its five values");
}

std::string_view pictureKindName(study::PictureRecord::Kind kind) {
  switch (kind) {
    case study::PictureRecord::Kind::shaded:
      return "shaded";
    case study::PictureRecord::Kind::difference:
      return "difference";
    case study::PictureRecord::Kind::displaced:
      return "displaced";
  }
  throw InternalError("picture: not one of its three kinds");
}

}  // namespace gnomon::report
