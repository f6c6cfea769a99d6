#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

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

}  // namespace gnomon::report
