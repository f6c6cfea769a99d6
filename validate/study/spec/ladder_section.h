#pragma once

#include "study/spec/sections/method_section.h"
#include "study/spec/study_file.h"
#include "study/spec/toml/toml_reader.h"

namespace gnomon::study {

/// The `[[ladder]]` tables of a study file.
///
/// `[[ladder]]` names in `method` the label of a `[[method]]`, and may change its keys (as
/// `changedMethod`) without changing its masks: to name a file that is the same method with
/// switches. Each `[[ladder.rung]]` names a `cause` and holds in `set` the keys that correct it.
/// @param root   of the file
/// @param study  with its views and methods
/// @throws InputError with file, line and key: for a ladder without an atlas view, two of one
///   method, a label that no method has, a rung that changes nothing, two of one cause, and where
///   correcting all causes forward and backward is not the same
std::vector<LadderSpec> readLadders(const TomlReader& root, const StudySpec& study,
                                    const MethodDefaults& defaults);

}  // namespace gnomon::study
