#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

// Shared by the sources of this component; no other component includes it.

namespace gnomon::surface {

/// One line of a text file, cut at spaces and tabs.
struct TextLine {
  const std::string& source;  ///< the file, as messages name it
  int number = 0;             ///< from 1
  std::vector<std::string_view> tokens;

  /// @throws InputError "source:number: message"
  [[noreturn]] void fail(const std::string& message) const;
};

/// Goes through a text line by line; lines end with "\n", "\r\n" or "\r".
class TextLines {
 public:
  /// @param text        must outlive the lines
  /// @param lineNumber  of the text's first line in its file
  TextLines(const std::string& source, std::string_view text, int lineNumber = 1)
      : source_(source), rest_(text), next_(lineNumber) {}

  /// Empty after the last line; a line without tokens is blank.
  std::optional<TextLine> next();
  /// What comes after the lines given so far.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  const std::string& source_;
  std::string_view rest_;
  int next_;
};

/// A token as an error message may show it: printable, and not long.
std::string quote(std::string_view token);

/// The number that the whole token is, a leading + allowed; empty where it is none, or out of the
/// type's range.
template <typename Number>
std::optional<Number> parseNumber(std::string_view token) {
  if (token.starts_with('+')) token.remove_prefix(1);
  Number value{};
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

/// @param what  opens the message: "coordinate 2"
/// @throws InputError naming the line and the token
int parseInteger(const TextLine& line, std::string_view token, std::string_view what);
double parseFinite(const TextLine& line, std::string_view token, std::string_view what);

}  // namespace gnomon::surface
