#pragma once

#include <string>

#include "study/spec/sections/study_key.h"

namespace gnomon::study {

/// The sections of a study's file, as the keys of its root.
StudyKeys studySections();

/// All keys of all sections as Markdown: name, values, default and meaning of each, from the very
/// declarations that a study is read by.
std::string studyKeysText();

}  // namespace gnomon::study
