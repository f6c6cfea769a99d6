#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/judge/distinguish.h"
#include "study/record/cases.h"

namespace gnomon::report {

/// "in 2 of 4 cases: no rank; onoue-2004 has 1.60 % on the same", of a method without a rank.
/// @param best       the method of rank 1
/// @param leaderError  its mean error rate over the method's cases; none where no method has a rank
std::string fewerCasesText(std::size_t cases, std::size_t allCases, const std::string& best,
                           std::optional<double> leaderError);

/// A label among words, in quotes: it may hold commas.
std::string quotedText(const std::string& label);

/// "“a”", "“a” and “b”", "“a”, “b”, “c” and 2 more".
std::string listText(const std::vector<std::string>& labels);

/// The sign behind a method by the verdict on its difference from the best, with its space: " =",
/// " ≈" or " ?"; none for one that is better or worse.
std::string_view differenceSign(study::DifferenceVerdict verdict);

/// What the signs mean, for the text beside a table: "Compared with the best: …".
constexpr std::string_view signMeaning =
    "≈ not distinguishable from it: the 95 % interval of the difference contains 0, or the "
    "difference is within the truth’s uncertainty; = the same answers, to the sample; ? the "
    "difference has no interval; without a sign they differ";

/// "the same answers as “a”; not distinguishable from “b” and “c”; no interval of the difference
/// from “d”"; empty without a name.
std::string likeText(const study::LikeMethods& methods);

/// Why differences have no interval, for below a table: one note a reason, "? No interval of the
/// difference of “a” and “b”: too few blocks of the view differ."
/// @param toBest  of the table's methods to the best, in its order
std::vector<std::string> noIntervalNotes(const std::vector<study::DifferenceRecord>& toBest);

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
