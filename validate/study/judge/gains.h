#pragma once

#include <optional>
#include <span>
#include <string>

#include "study/judge/distinguish.h"
#include "study/record/record.h"
#include "study/record/sweep_record.h"
#include "study/spec/study_file.h"

namespace gnomon::study {

/// Claims that compare gains, which claims.h explains.

/// What `less` gains over `than`, on average over the cases of all records: several, where the
/// study has a sweep. None without any case.
std::optional<Estimate> gainOf(const ClaimSpec& claim, std::span<const StudyRecord* const> records);

/// One gain less another, which is independent of it (Zou & Donner 2008).
Estimate gainDifference(const Estimate& first, const Estimate& second);

/// A claim with `gainExceeds`.
ClaimRecord judgeGain(const ClaimSpec& claim, const StudyRecord& study,
                      std::span<const StudyRecord> run);

/// A claim with `gainGrows`: the gain at the last value of a sweep against that at the first.
ClaimRecord judgeGrowth(const ClaimSpec& claim, const SweepRecord& sweep);

}  // namespace gnomon::study
