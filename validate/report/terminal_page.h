#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "report/tables/table.h"
#include "study/record/record.h"

namespace gnomon::report {

/// Text for a terminal, measured in its columns: a wide character takes two, a combining one none.
/// Control characters become '?'; bytes that are not UTF-8, and characters that turn the direction
/// of the text after them, U+FFFD: no label can move the cursor or make a row read as another. Line
/// breaks count as control characters.

/// The columns that `text` takes.
std::size_t displayWidth(std::string_view text);

/// The text on one line, as it is.
std::string terminalText(std::string_view text);

/// The text, padded with spaces or cut (then it ends in "…") to exactly `width` columns.
std::string fitLeft(std::string_view text, std::size_t width);

/// As fitLeft, but the text stands at the right.
std::string fitRight(std::string_view text, std::size_t width);

/// The text broken at spaces into lines of at most `width` columns (≥ 1); a longer word is cut into
/// pieces. No text gives no line.
std::vector<std::string> wrapText(std::string_view text, std::size_t width);

/// Text that XML 1.0 can hold, as UTF-8: whatever is no UTF-8 or no XML character (U+FFFE,
/// U+FFFF), a control character other than tab and line breaks, or turns the direction of the text
/// after it, becomes U+FFFD. What XML escapes is left as it is.
std::string xmlText(std::string_view text);

/// The columns of a terminal that every table fits in.
constexpr std::size_t terminalWidth = 100;
/// By how much a table's rows stand in.
constexpr std::size_t terminalIndent = 2;
/// Room for a mark behind a figure, as " ≈".
constexpr std::size_t markWidth = 2;

/// Text for a terminal, line by line.
class TerminalPage {
 public:
  /// @param colours  ANSI colours and bold face; without them the text is plain
  explicit TerminalPage(bool colours) : colours_(colours) {}

  /// A line as it is, but for control characters: those that `styled` has put into it alone stay.
  void line(std::string_view text);
  void blank() { text_ += "\n"; }
  /// Text of any length, broken to the page's width.
  void paragraph(std::string_view text, std::size_t margin = 0);
  void heading(std::string_view text);
  /// The notices that stand before the figures.
  void notices(const std::vector<std::string>& texts);
  /// A failure: a label in red, then the text.
  void fault(const std::string& label, std::string_view text);
  /// "TITLE: 3 of 4 met", then a line for each that failed; nothing without any.
  void met(const std::string& title, std::size_t all, const std::vector<std::string>& failed);
  /// A section of claims with their verdicts; nothing, if there are none.
  void claims(const std::vector<study::ClaimRecord>& claims);

  [[nodiscard]] std::string styled(const std::string& text, const char* code) const;
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  bool colours_;
  std::string text_;
};

/// Adds a table to a terminal's page, at most 100 columns wide: texts at the left, figures at the
/// right of their columns, a row's mark behind it and its remark below it. Where the room is short,
/// texts are cut ("…"), the widest first, but not below 30 columns together; then figures that do
/// not fit beside each other follow in further blocks, each with its rows' names.
/// @throws InternalError for a number that is not finite
void appendTable(TerminalPage& page, const Table& table);

/// The table alone, as plain text.
std::string terminalTable(const Table& table);

}  // namespace gnomon::report
