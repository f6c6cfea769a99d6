#include "report/text/terms_html.h"

#include <fmt/core.h>

#include "common/error.h"
#include "report/text/glossary.h"

namespace gnomon::report {
namespace {

Html termButton(std::size_t place, std::string_view text) {
  return html(
      "<button type=\"button\" class=\"term\" popovertarget=\"term-{}\" title=\"{}\">{}"
      "</button>",
      place, glossary()[place].meaning, text);
}

}  // namespace

Html htmlTerm(std::string_view name, std::string_view text) {
  const auto place = findTerm(name);
  if (!place) throw InternalError(fmt::format("{}: not in the glossary", name));
  return termButton(*place, text.empty() ? name : text);
}

Html htmlHeading(std::string_view text) {
  const auto place = findTerm(text);
  return place ? termButton(*place, text) : escapeHtml(text);
}

Html htmlGlossary(const Html& page) {
  Html entries;
  for (std::size_t place = 0; place < glossary().size(); ++place) {
    const std::string link = fmt::format("popovertarget=\"term-{}\"", place);
    if (page.text().find(link) == std::string::npos) continue;
    const Term& term = glossary()[place];
    // In the list at rest; over the page while it is open.
    entries += html("<div popover id=\"term-{}\"><dt>{}</dt><dd>{}</dd></div>\n", place, term.name,
                    term.meaning);
  }
  if (entries.empty()) return {};
  return html(
      "<section id=\"terms\">\n<h2>What the words mean</h2>\n<dl class=\"terms\">\n{}</dl>"
      "\n</section>\n",
      entries);
}

}  // namespace gnomon::report
