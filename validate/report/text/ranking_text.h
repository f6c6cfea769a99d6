#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

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

/// The methods that one is not distinguishable from.
struct LikeMethods {
  std::vector<std::string> close;            ///< by the interval, or the truth's uncertainty
  std::vector<std::string> withoutInterval;  ///< since the difference has no interval
};

/// "not distinguishable from “a” and “b”; could not be compared with “c”: no 95 % interval"; empty
/// without a name.
std::string indistinguishableText(const LikeMethods& methods);

}  // namespace gnomon::report
