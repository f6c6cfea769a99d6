#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "study/record/record.h"

namespace gnomon::report {

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

}  // namespace gnomon::report
