#pragma once

#include "report/text/terminal_page.h"
#include "study/record/record.h"

namespace gnomon {

/// The study's error budgets over all its lights; nothing, if it has none.
void appendBudgets(TerminalPage& page, const StudyRecord& record);

}  // namespace gnomon
