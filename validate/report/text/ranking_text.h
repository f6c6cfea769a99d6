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

/// "a", "a and b", "a; b; c and 2 more": labels may hold commas.
std::string listText(const std::vector<std::string>& names);

/// "not distinguishable from a and b"; empty without a name.
std::string indistinguishableText(const std::vector<std::string>& names);

}  // namespace gnomon::report
