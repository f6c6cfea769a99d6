#pragma once

#include <span>
#include <string>

#include "study/gate_record.h"

namespace gnomon {

/// A check as GitHub's workflow commands, one a line, that mark the study's file in a pull request:
/// `::error file=F,line=N,title=T::MESSAGE` for each gate that does not hold and each problem, then
/// `::notice …` for each limit that could be tightened. Nothing for what passed or was skipped.
/// In properties `%`, CR, LF, `:` and `,` are escaped, in messages `%`, CR and LF, as GitHub's
/// "Workflow commands" say. A problem's line is that of its message, where it opens with
/// `FILE:LINE:`.
std::string githubAnnotations(std::span<const CheckRecord> checks);

}  // namespace gnomon
