#include "report/tables/latex_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "common/text/one_line.h"

namespace gnomon {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 27> signs = {{
    {"\\", "\\textbackslash{}"},
    {"&", "\\&"},
    {"%", "\\%"},
    {"$", "\\$"},
    {"#", "\\#"},
    {"_", "\\_"},
    {"{", "\\{"},
    {"}", "\\}"},
    {"~", "\\textasciitilde{}"},
    {"^", "\\textasciicircum{}"},
    {"<", "\\textless{}"},
    {">", "\\textgreater{}"},
    {"\"", "\\textquotedbl{}"},
    {"–", "--"},
    {"--", "-{}-{}"},
    {"’", "'"},
    {"°", "\\textdegree{}"},
    {"×", "$\\times$"},
    {"≈", "$\\approx$"},
    {"−", "$-$"},
    {"≤", "$\\leq$"},
    {"≥", "$\\geq$"},
    {"±", "$\\pm$"},
    {"κ", "$\\kappa$"},
    {"…", "\\dots{}"},
    {"\u202f", "\\,"},
    {"→", "$\\to$"},
}};

/// One line; LaTeX refuses U+FFFD.
std::string knownText(std::string_view text) {
  std::string line = oneLine(text);
  constexpr std::string_view unknown = "\uFFFD";
  for (std::size_t at = 0; (at = line.find(unknown, at)) != std::string::npos;) {
    line.replace(at, unknown.size(), 1, '?');
  }
  return line;
}

}  // namespace

std::string escapeLatex(std::string_view asked) {
  const std::string clean = knownText(asked);
  std::string_view text = clean;
  std::string latex;
  // After the end of a row they would be that command's own.
  const std::size_t first = std::min(text.find_first_not_of(' '), text.size());
  if (first < text.size() && (text[first] == '[' || text[first] == '*')) {
    latex = fmt::format("{{{}}}", text[first]);
    text.remove_prefix(first + 1);
  }
  while (!text.empty()) {
    std::size_t length = 1;
    std::string_view written = text.substr(0, 1);
    for (const auto& [sign, command] : signs) {
      if (!text.starts_with(sign)) continue;
      length = sign.size();
      written = command;
      break;
    }
    latex += written;
    text.remove_prefix(length);
  }
  return latex;
}

}  // namespace gnomon
