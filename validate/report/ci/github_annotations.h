#pragma once

#include <span>
#include <string>
#include <string_view>

#include "study/record/check_record.h"

namespace gnomon::report {

/// A check as GitHub's workflow commands, one a line, that mark files in a pull request: of a gate
/// the user's own shader that it judges (faultPlace), of all else the study's:
/// `::error file=F,line=N,title=T::MESSAGE` for each gate that does not hold and each problem, then
/// `::notice …` for each limit that could be tightened. Nothing for what passed or was skipped.
/// What `xmlText` refuses becomes U+FFFD; in properties `%`, CR, LF, `:` and `,` are escaped, in
/// messages `%`, CR and LF, as GitHub's "Workflow commands" say. A problem's line is that of its
/// message, where it opens with `FILE:LINE:`, FILE the study or a user's own shader.
std::string githubAnnotations(std::span<const study::CheckRecord> checks);

/// Text of any number of lines in which GitHub's runner finds no command. It takes a line that
/// begins with `::`, behind spaces too, and whatever follows `##[` anywhere in a line: names that
/// stand there get a space inside these signs.
std::string withoutWorkflowCommands(std::string_view text);

}  // namespace gnomon::report
