#include "surface/readers/text_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace gnomon::surface {

void TextLine::fail(const std::string& message) const {
  throw InputError(fmt::format("{}:{}: {}", source, number, message));
}

std::optional<TextLine> TextLines::next() {
  if (rest_.empty()) return std::nullopt;
  TextLine line{source_, next_++, {}};
  const std::size_t length = std::min(rest_.find_first_of("\r\n"), rest_.size());
  const std::string_view text = rest_.substr(0, length);
  rest_.remove_prefix(length);
  if (rest_.starts_with("\r\n")) rest_.remove_prefix(1);
  if (!rest_.empty()) rest_.remove_prefix(1);

  constexpr std::string_view blanks = " \t";
  for (std::size_t begin = text.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    line.tokens.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(blanks, end);
  }
  return line;
}

std::string quote(std::string_view token) {
  std::string text(token.substr(0, 40));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return fmt::format("'{}'{}", text, token.size() > text.size() ? "…" : "");
}

int parseInteger(const TextLine& line, std::string_view token, std::string_view what) {
  const auto value = parseNumber<int>(token);
  if (!value) line.fail(fmt::format("{} is {}, expected an integer", what, quote(token)));
  return *value;
}

double parseFinite(const TextLine& line, std::string_view token, std::string_view what) {
  const auto value = parseNumber<double>(token);
  if (!value || !std::isfinite(*value)) {
    line.fail(fmt::format("{} is {}, expected a finite number", what, quote(token)));
  }
  return *value;
}

}  // namespace gnomon::surface
