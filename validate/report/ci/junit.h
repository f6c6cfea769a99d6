#pragma once

#include <span>
#include <string>

#include "study/record/cases.h"

namespace gnomon::report {

/// A check as JUnit XML: a test suite a study, a test case a gate and a problem. A gate that failed
/// has a `failure`; one without a number to judge, and whatever kept a study from being judged, an
/// `error`; a gate that was left out is `skipped`. The counts in `testsuites` and `testsuite` are
/// those of the elements below; their `time` is the seconds that the runs took. Every failure and
/// error holds the command that reproduces it. Characters that XML 1.0 does not have become U+FFFD.
std::string junitXml(std::span<const study::CheckRecord> checks);

}  // namespace gnomon::report
