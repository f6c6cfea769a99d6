#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "report/text/html.h"

namespace gnomon::report {

/// The words of the reports that a reader may not know: the only place that explains them.

struct Term {
  std::string_view name;     ///< as headings and sentences spell it
  std::string_view meaning;  ///< one sentence or two
};

/// All terms, in the order in which a page lists them.
std::span<const Term> glossary();

/// The place of a term in the glossary; none for any other word.
std::optional<std::size_t> findTerm(std::string_view name);

/// A word of the glossary, which its meaning opens at by touch, mouse or keyboard, without a
/// script; pointing at it shows the meaning too.
/// @param text  what stands there; the term itself, if empty
/// @throws InternalError for a word that the glossary does not have
Html htmlTerm(std::string_view name, std::string_view text = {});

/// The same for a heading: any word, which stays plain where the glossary does not have it.
Html htmlHeading(std::string_view text);

/// The list of the terms that a page uses: what htmlTerm opens. Nothing without any.
Html htmlGlossary(const Html& page);

}  // namespace gnomon::report
