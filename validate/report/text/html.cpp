#include "report/text/html.h"

#include "image/images.h"
#include "report/text/text_width.h"

namespace gnomon::report {

Html escapeHtml(std::string_view text) {
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
  return Html(std::move(html));
}

Html htmlLiteral(HtmlLiteral literal) {
  return Html(std::string(literal.text()));
}

Html pictureAddress(std::string_view type, const std::string& bytes) {
  return Html(image::dataAddress(type, bytes));
}

}  // namespace gnomon::report
