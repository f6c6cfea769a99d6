#include "report/latex_text.h"

#include <array>
#include <utility>

namespace gnomon {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 26> signs = {{
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

}  // namespace

std::string escapeLatex(std::string_view text) {
  std::string latex;
  while (!text.empty()) {
    std::size_t length = 1;
    std::string_view written = text.substr(0, 1);
    for (const auto& [sign, command] : signs) {
      if (!text.starts_with(sign)) continue;
      length = sign.size();
      written = command;
      break;
    }
    const auto code = static_cast<unsigned char>(text.front());
    latex += length == 1 && (code < ' ' || code == 0x7f) ? " " : written;
    text.remove_prefix(length);
  }
  return latex;
}

}  // namespace gnomon
