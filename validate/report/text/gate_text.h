#pragma once

#include <optional>
#include <string>

#include "study/record/cases.h"

namespace gnomon::report {

/// "pass", "fail", "undefined" or "skipped", the same in every kind of report.
std::string gateVerdictName(study::GateVerdict verdict);

/// "threshold", "reference" or "option", by the gate's origin.
std::string gateOriginName(const study::Gate& gate);

/// Where a gate is written.
struct GatePlace {
  std::string file;  ///< the study's, or that of its references
  int line = 0;      ///< 0 where none is known
};
GatePlace gatePlace(const study::CheckRecord& check, const study::Gate& gate);

/// What a change has to mend where a gate does not hold: the method's shader, if it is the user's
/// own, else where the gate is written.
GatePlace faultPlace(const study::CheckRecord& check, const study::Gate& gate);

/// The limits: "≤ 0.03", "≥ 0.1", "0.9 to 1.1".
/// @param decimals  of its numbers; none for as many digits as they need
std::string limitText(const study::Gate& gate, std::optional<int> decimals = {});

/// What is judged: "onoue-2004, error_rate ≤ 0.03, camera, elevation 24° azimuth 165°", then the
/// region where it is not that of all samples, and the step of a sweep. Names that a skipped gate
/// does not set read "any".
std::string gateName(const study::Gate& gate);

/// The same without the limit's number, so that it names the gate also after the limit has moved:
/// "onoue-2004, error_rate max, camera, elevation 24° azimuth 165°".
std::string gateTitle(const study::Gate& gate);

/// A gate that does not hold: its name, then the outcome, all numbers with the same decimals.
std::string gateFaultText(const study::Judgement& judgement);

/// The outcome: "0.0412, too large by 0.0112", "undefined: no samples", "skipped: …"; with a
/// reference its committed value.
std::string gateOutcome(const study::Judgement& judgement);

}  // namespace gnomon::report
