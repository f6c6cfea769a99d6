#include "report/html_text.h"

#include <fmt/core.h>

namespace gnomon {

std::string escapeHtml(std::string_view text) {
  std::string html;
  html.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default: {
        const auto code = static_cast<unsigned char>(c);
        const bool control = (code < 0x20 && c != '\t' && c != '\n' && c != '\r') || code == 0x7f;
        if (!control) html += c;
      }
    }
  }
  return html;
}

std::string htmlTable(std::string_view kind, std::string_view head, std::string_view body) {
  return fmt::format(
      "<div class=\"scroll\"><table class=\"{}\">\n<thead><tr>{}</tr></thead>\n"
      "<tbody>\n{}</tbody>\n</table></div>\n",
      kind, head, body);
}

}  // namespace gnomon
