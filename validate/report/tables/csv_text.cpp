#include "report/tables/csv_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>

#include "report/text/utf8_text.h"

namespace gnomon {
namespace {

bool isNumber(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  return parsed.ec == std::errc() && parsed.ptr == end;
}

/// Whether a spreadsheet would take a cell for a formula.
bool isFormula(std::string_view text) {
  constexpr std::array<std::string_view, 10> signs = {"=",  "+",  "-",  "@",  "\t",
                                                      "\r", "＝", "＋", "－", "＠"};
  const bool opens = std::any_of(signs.begin(), signs.end(),
                                 [&](std::string_view sign) { return text.starts_with(sign); });
  return opens && !isNumber(text);
}

std::string csvCell(std::string_view asked) {
  std::string text = xmlText(asked);
  if (isFormula(asked)) text.insert(text.begin(), '\'');
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) {
    if (c == '"') cell += '"';
    cell += c;
  }
  return cell + '"';
}

}  // namespace

std::string csvLine(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    line += csvCell(cells[i]);
  }
  return line + '\n';
}

}  // namespace gnomon
