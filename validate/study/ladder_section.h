#pragma once

#include "study/method_section.h"
#include "study/study_file.h"
#include "study/toml_reader.h"

namespace gnomon {

/// The `[[ladder]]` tables of a study file and its `[budget]`.
///
/// `[[ladder]]` names in `method` the label of a `[[method]]`, and may change its keys (as
/// `changedMethod`) without changing its masks: to name a file that is the same method with
/// switches. Each `[[ladder.rung]]` names a `cause` and holds in `set` the keys that undo it.
/// @param root   of the file
/// @param study  with its views and methods
/// @param quick  views have a quarter of their side, and so have blocks
/// @throws InputError with file, line and key: for a `[budget]` without a ladder, a ladder without
/// an
///   atlas view, two of one method, a label that no method has, a rung that changes nothing, two
///   of one cause, and where undoing all causes forward and backward is not the same
BudgetSpec readBudget(const TomlReader& root, const StudySpec& study,
                      const MethodDefaults& defaults, bool quick);

}  // namespace gnomon
