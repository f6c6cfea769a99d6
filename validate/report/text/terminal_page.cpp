#include "report/text/terminal_page.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/text/number_text.h"
#include "report/text/text_width.h"

namespace gnomon::report {
namespace {

const char* verdictColour(study::Verdict verdict) {
  return verdict == study::Verdict::held ? "32" : verdict == study::Verdict::failed ? "31" : "33";
}

/// Where the next `ESC [ DIGITS m` begins: what changes colour and face, and nothing else.
std::size_t styleAt(std::string_view text) {
  constexpr std::string_view begin = "\x1b[";
  for (std::size_t at = text.find(begin); at != text.npos; at = text.find(begin, at + 1)) {
    const std::size_t end = text.find_first_not_of("0123456789", at + begin.size());
    if (end != text.npos && end > at + begin.size() && text[end] == 'm') return at;
  }
  return text.npos;
}

}  // namespace

void TerminalPage::line(std::string_view text) {
  while (!text.empty()) {
    const std::size_t style = colours_ ? styleAt(text) : std::string_view::npos;
    const std::size_t plain = std::min(style, text.size());
    text_ += terminalText(text.substr(0, plain));
    text.remove_prefix(plain);
    if (text.empty()) break;
    const std::size_t length = text.find('m') + 1;
    text_ += text.substr(0, length);
    text.remove_prefix(length);
  }
  text_ += '\n';
}

void TerminalPage::paragraph(std::string_view text, std::size_t margin) {
  for (const std::string& part : wrapText(text, terminalWidth - margin)) {
    line(std::string(margin, ' ') + part);
  }
}

void TerminalPage::heading(std::string_view text) {
  for (const std::string& part : wrapText(text, terminalWidth)) line(styled(part, "1"));
}

std::string TerminalPage::styled(const std::string& text, const char* code) const {
  const std::string plain = terminalText(text);
  return colours_ ? fmt::format("\x1b[{}m{}\x1b[0m", code, plain) : plain;
}

void TerminalPage::notices(const std::vector<std::string>& texts) {
  if (!texts.empty()) blank();
  for (const std::string& text : texts) paragraph("Notice: " + text);
}

void TerminalPage::fault(const std::string& label, std::string_view text) {
  line(std::string(terminalIndent, ' ') + styled(label, "31"));
  paragraph(text, 2 * terminalIndent);
}

void TerminalPage::met(const std::string& title, std::size_t all,
                       const std::vector<std::string>& failed) {
  if (all == 0) return;
  blank();
  heading(fmt::format("{}: {} of {} met", title, all - failed.size(), all));
  for (const std::string& text : failed) fault("failed", text);
}

void TerminalPage::claims(const std::vector<study::ClaimRecord>& records) {
  if (records.empty()) return;
  constexpr std::size_t margin = terminalIndent + 21;
  blank();
  heading("Claims");
  for (const study::ClaimRecord& claim : records) {
    const std::string verdict = fitLeft(study::verdictName(claim.verdict), margin - terminalIndent);
    std::vector<std::string> lines = wrapText(claim.text, terminalWidth - margin);
    if (lines.empty()) lines.emplace_back();
    line(std::string(terminalIndent, ' ') + styled(verdict, verdictColour(claim.verdict)) +
         lines.front());
    for (std::size_t i = 1; i < lines.size(); ++i) line(std::string(margin, ' ') + lines[i]);
    paragraph(claim.detail, margin);
  }
}

}  // namespace gnomon::report
