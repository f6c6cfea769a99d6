#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "study/record/swept_value.h"

namespace gnomon::study {

/// Names the cases of a sweep, each distinct, also where a file system takes a letter and its
/// capital for one; of letters, digits, `-`, `_` and `.`, and at most 64 of them.
///   one key of numbers        the value: "0.25", "1e+20" (the only name with a `+`)
///   otherwise                 a part for each key, "height-2_elevation-30", by the last part of
///                             the key's name, or by the whole name where two end alike
///   where these are longer, or two are the same: "case-0042", by their order
void nameCases(std::span<const SweptKey> keys, std::vector<SweepCase>& cases);

}  // namespace gnomon::study
