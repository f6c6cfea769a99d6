#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/judge/distinguish.h"

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

}  // namespace gnomon::report
