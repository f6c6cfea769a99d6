#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace gnomon::report {

class Html;

/// What a value becomes in HTML: a number stays one, HTML its text, any other text is escaped.
template <typename T>
using HtmlPart =
    std::conditional_t<std::is_arithmetic_v<T>, T,
                       std::conditional_t<std::is_same_v<T, Html>, std::string_view, std::string>>;

/// A literal of the program's own. Text that is only known at run time does not compile.
class HtmlLiteral {
 public:
  template <std::size_t N>
  consteval HtmlLiteral(const char (&text)[N]) : text_(text, N - 1) {}
  [[nodiscard]] std::string_view text() const { return text_; }

 private:
  std::string_view text_;
};

/// A piece of an HTML page. It comes from literals of the program and from escaped text alone, so
/// that no name in a study can become markup: plain text does not convert to it.
class Html {
 public:
  Html() = default;

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] bool empty() const { return text_.empty(); }
  Html& operator+=(const Html& other) {
    text_ += other.text_;
    return *this;
  }
  friend Html operator+(Html first, const Html& second) { return first += second; }

 private:
  explicit Html(std::string text) : text_(std::move(text)) {}
  friend Html escapeHtml(std::string_view text);
  friend Html htmlLiteral(HtmlLiteral literal);
  friend Html pictureAddress(std::string_view type, const std::string& bytes);
  template <typename... Args>
  friend Html html(fmt::format_string<HtmlPart<Args>...> pattern, const Args&... args);

  std::string text_;
};

/// Text that stands for itself in HTML, in an element or in a quoted attribute: & < > " ' are
/// escaped, and what `xmlText` refuses becomes U+FFFD.
Html escapeHtml(std::string_view text);

/// A literal as it is, braces too.
Html htmlLiteral(HtmlLiteral literal);

/// A picture's bytes as the address of an image: "data:TYPE;base64,…", none of which HTML reads.
/// @param type  the program's own: "image/png"
Html pictureAddress(std::string_view type, const std::string& bytes);

template <typename T>
HtmlPart<T> htmlPart(const T& value) {
  if constexpr (std::is_arithmetic_v<T>) {
    return value;
  } else if constexpr (std::is_same_v<T, Html>) {
    return value.text();
  } else {
    return escapeHtml(value).text();
  }
}

/// HTML by a pattern, as fmt::format takes it: `html("<td>{}</td>", name)`. Text among the
/// arguments is escaped, HTML is not escaped again.
template <typename... Args>
Html html(fmt::format_string<HtmlPart<Args>...> pattern, const Args&... args) {
  return Html(fmt::format(pattern, htmlPart(args)...));
}

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
