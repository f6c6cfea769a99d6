#include "report/text/latex_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "common/text.h"

namespace gnomon::report {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 31> signs = {{
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
    {"|", "\\textbar{}"},
    // Not \textquotedbl, which the encoding OT1 lacks.
    {"\"", "\\char34{}"},
    {"–", "--"},
    {"--", "-{}-{}"},
    {"’", "'"},
    // Not \textdegree, which has no outlines in the usual fonts.
    {"°", "$^\\circ$"},
    {"×", "$\\times$"},
    {"≈", "$\\approx$"},
    {"−", "$-$"},
    {"≤", "$\\leq$"},
    {"≥", "$\\geq$"},
    {"±", "$\\pm$"},
    {"κ", "$\\kappa$"},
    {"Δ", "$\\Delta$"},
    {"ρ", "$\\rho$"},
    {"…", "\\dots{}"},
    {"\u202f", "\\,"},
    {"\u00a0", "~"},
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

/// The wider of the two fonts, a character of each kind.
double characterWidth(std::uint32_t code) {
  if (code == 0x202f) return 0.17;
  if (code == 0xa0) return 0.34;
  if (code == 0x2026) return 1.38;
  if (code > 0x7f) return code < 0x2e80 ? 0.78 : 1.0;
  const char c = static_cast<char>(code);
  const auto isOneOf = [&](std::string_view characters) {
    return characters.find(c) != std::string_view::npos;
  };
  if (isOneOf("ijl.,:;!|'")) return 0.29;
  if (c == ' ') return 0.35;
  if (isOneOf("ftr-()[]/")) return 0.4;
  if (isOneOf("MW%@")) return 1.06;
  if (isOneOf("mw<>+=~&#")) return 0.86;
  if (c >= 'A' && c <= 'Z') return 0.81;
  return c >= '0' && c <= '9' ? 0.514 : 0.54;
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

double latexWidth(std::string_view text) {
  double width = 0;
  const std::string clean = knownText(text);
  for (std::string_view rest = clean; !rest.empty();) {
    const Utf8Character character = firstCharacter(rest);
    width += characterWidth(character.code);
    rest.remove_prefix(character.bytes);
  }
  return width;
}

std::string cutText(const std::string& text, double width) {
  if (latexWidth(text) <= width) return text;
  const double room = width - latexWidth("…");
  std::string cut;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t bytes = firstCharacter(rest).bytes;
    const std::string longer = cut + std::string(rest.substr(0, bytes));
    if (latexWidth(longer) > room) break;
    cut = longer;
    rest.remove_prefix(bytes);
  }
  return cut + "…";
}

std::vector<std::string> breakableParts(std::string_view text) {
  constexpr std::string_view ends = " -/_,:";
  std::vector<std::string> parts;
  bool hasEnded = true;
  for (const char c : text) {
    const bool isEnd = ends.find(c) != std::string_view::npos;
    if (parts.empty() || (hasEnded && !isEnd)) parts.emplace_back();
    parts.back() += c;
    hasEnded = isEnd;
  }
  return parts;
}

}  // namespace gnomon::report
