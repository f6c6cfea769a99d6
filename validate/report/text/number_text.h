#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "study/record/record.h"

namespace gnomon::report {

/// The number itself, if it is one. No report may hold a value that is not finite.
/// @param what  names the value in the message
/// @throws InternalError
double requireFinite(double value, std::string_view what);

/// A share as percent with two decimals, without the sign: "9.80". "–" where undefined; "<0.01" or
/// ">99.99" where a value would round to an end of the scale: 0.00 always means none, 100.00 all.
std::string percentText(std::optional<double> share);

/// What an error is a share of: "the samples"; where a light has a disc "the light".
const char* errorWhole(bool isSoft);

/// What the best method has: "the fewest wrong samples"; where a light has a disc "the smallest
/// error".
const char* leastErrorText(bool isSoft);

/// The title of an axis of error rates: "error rate, percent of the samples".
std::string errorAxis(bool isSoft);

/// The same for the errors inside a bin: "wrong, percent of the bin’s samples".
std::string binErrorAxis(bool isSoft);

/// A share in percent with its sign and two decimals, "+1.20", "−0.03"; "0.00" for none at all, and
/// "+<0.01" or "−<0.01" for what would round to it.
std::string signedPercent(double share);

/// A correlation with three decimals, treated likewise: 1.000 always means that nothing differs.
std::string correlationText(std::optional<double> value);

/// A ratio with two decimals: "1.05"; "–" where undefined, "<0.01" where it would round to none.
std::string ratioText(std::optional<double> value);

/// The shortest text that reads back as the same number: "0.1", "1e-05".
std::string exactText(double value);
/// The same, or nothing.
std::string exactText(std::optional<double> value);

/// A bin: "below 5", "5 to 10", "75 and more", "all".
std::string binText(const std::optional<double>& low, const std::optional<double>& high);

/// An integer with its thousands apart (by a narrow no-break space): "33 554 432".
std::string groupedText(std::uint64_t value);

/// "pass", "fail" or "not judged": in every kind of report.
std::string_view runStatusName(study::RunStatus status);

/// "study", "mesh", "image" or "shader".
std::string_view inputKindName(study::InputRecord::Kind kind);

/// "better", "worse", "equal", "not distinguishable" or "no interval": the first of two methods.
std::string_view differenceVerdictName(study::DifferenceVerdict verdict);

/// "shaded", "difference" or "displaced".
std::string_view pictureKindName(study::PictureRecord::Kind kind);

}  // namespace gnomon::report
