#include "report/page/confidence_html.h"

#include "report/page/html_page.h"
#include "report/tables/confidence_table.h"
#include "report/tables/formats/html_format.h"
#include "report/text/confidence_text.h"

namespace gnomon {

Html confidenceSection(const StudyRecord& record) {
  Html content;
  for (const std::string& view : confidenceViews(record)) {
    const Table table = confidenceTable(record, view);
    if (table.rows.empty()) continue;
    content += html("<h3>{}</h3>\n<p><b>{}</b></p>\n{}{}", view, verdictText(record, view),
                    htmlNote(confidenceNote(record, view)), htmlTable(table));
  }
  return htmlSection("confidence", "How sure the error rates are", content);
}

}  // namespace gnomon
