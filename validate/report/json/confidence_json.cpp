#include "report/json/confidence_json.h"

#include "report/text/interval_text.h"
#include "report/text/names.h"

namespace gnomon {

Json jsonConfidence(const ConfidenceRecord& confidence) {
  return {{"method", confidence.method},
          {"view", confidence.view},
          {"light", confidence.light},
          {"error_rate", jsonNumber(confidence.rate, "confidence.error_rate")},
          {"low", jsonNumber(lowOf(confidence.interval), "confidence.low")},
          {"high", jsonNumber(highOf(confidence.interval), "confidence.high")},
          {"reason", jsonReason(confidence.reason)},
          {"blocks", confidence.blocks},
          {"block_side", confidence.blockSide}};
}

Json jsonDifference(const DifferenceRecord& difference) {
  return {{"view", difference.view},
          {"light", difference.light},
          {"first", difference.first},
          {"second", difference.second},
          {"difference", jsonNumber(difference.difference, "differences.difference")},
          {"low", jsonNumber(lowOf(difference.interval), "differences.low")},
          {"high", jsonNumber(highOf(difference.interval), "differences.high")},
          {"reason", jsonReason(difference.reason)},
          {"uncertainty", jsonNumber(difference.uncertainty, "differences.uncertainty")},
          {"verdict", differenceVerdictName(difference.verdict)},
          {"radius", jsonRadiusCheck(difference)}};
}

}  // namespace gnomon
