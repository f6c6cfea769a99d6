#pragma once

#include "report/text/terminal_page.h"
#include "study/record/record.h"

namespace gnomon {

/// The verdict of each view: its methods ranked, each with its interval and how much worse than the
/// best it is, and what that lets one say. Nothing, if the record has no intervals.
void appendConfidence(TerminalPage& page, const StudyRecord& record);

}  // namespace gnomon
