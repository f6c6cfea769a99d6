#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon {

/// The number itself, if it is one. No report may hold a value that is not finite.
/// @param what  names the value in the message
/// @throws InternalError
double requireFinite(double value, std::string_view what);

/// A share as percent with two decimals, without the sign: "9.80". "–" where undefined, "<0.01"
/// where a value above zero would read as zero: 0.00 always means none.
std::string percentText(std::optional<double> share);

/// The shortest text that reads back as the same number: "0.1", "1e-05".
std::string exactText(double value);

/// An integer with its thousands apart (by a narrow no-break space): "33 554 432".
std::string groupedText(std::uint64_t value);

}  // namespace gnomon
