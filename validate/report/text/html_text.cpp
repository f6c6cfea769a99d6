#include "report/text/html_text.h"

#include <fmt/core.h>

#include "report/text/utf8_text.h"

namespace gnomon {

std::string escapeHtml(std::string_view text) {
  const std::string clean = xmlText(text);
  std::string html;
  html.reserve(clean.size());
  for (const char c : clean) {
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
      default:
        html += c;
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
