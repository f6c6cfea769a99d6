#pragma once

#include <string_view>

#include "report/text/html.h"

namespace gnomon::report {

/// A word of the glossary, which its meaning opens at by touch, mouse or keyboard, without a
/// script; pointing at it shows the meaning too.
/// @param text  what stands there; the term itself, if empty
/// @throws InternalError for a word that the glossary does not have
Html htmlTerm(std::string_view name, std::string_view text = {});

/// The same for a heading: any word, which stays plain where the glossary does not have it.
Html htmlHeading(std::string_view text);

/// The section that lists the terms that a page uses: what htmlTerm opens. Nothing without any.
Html htmlGlossary(const Html& page);

}  // namespace gnomon::report
