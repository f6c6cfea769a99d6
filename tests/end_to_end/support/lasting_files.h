#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>

namespace gnomon::test {

/// What of a run's files must be the same in every run of the same study: see docs/summary.md,
/// "What may differ between two runs".

/// A page without a section; unchanged where it has none of that name.
inline std::string withoutSection(std::string html, const std::string& id) {
  const std::size_t begin = html.find("<section id=\"" + id + "\">");
  if (begin == std::string::npos) return html;
  const std::string end = "</section>";
  return html.erase(begin, html.find(end, begin) + end.size() - begin);
}

/// A text of rows without what follows the last separator of each.
inline std::string withoutLastColumn(const std::string& text, const std::string& separator) {
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    kept += line.substr(0, line.rfind(separator)) + "\n";
  }
  return kept;
}

inline std::string lastingJson(const std::string& text) {
  nlohmann::json json = nlohmann::json::parse(text);
  for (const char* key : {"timings", "cache"}) json.erase(key);
  if (json.contains("truth")) json.at("truth").erase("bvh_bytes");
  if (json.contains("environment")) json.at("environment").erase("threads");
  if (json.contains("study")) json.at("study").erase("command");
  for (const char* list : {"cost", "results"}) {
    if (!json.contains(list)) continue;
    for (nlohmann::json& row : json.at(list)) {
      for (const char* key : {"frame_ms", "still_ms", "frame_ratio", "frame_kept_since"})
        row.erase(key);
    }
  }
  return json.dump();
}

inline std::string lastingPage(std::string html) {
  for (const char* id : {"cost", "reproduce"}) html = withoutSection(html, id);
  html = std::regex_replace(html, std::regex(", [0-9.]+ ms a frame"), "");
  // The last column of the ranking.
  const std::size_t table = html.find("<table class=\"ranking\">");
  const std::size_t frame = html.find(">Frame</button>", table);
  const std::size_t end = html.find("</table>", table);
  if (table != std::string::npos && frame < end) {
    const std::string rows = std::regex_replace(html.substr(table, end - table),
                                                std::regex("<td[^>]*>[^<]*</td></tr>"), "</tr>");
    html.replace(table, end - table, rows);
  }
  const std::size_t begin = html.find("<dt>Ray tracing structure</dt>");
  if (begin == std::string::npos) return html;
  return html.erase(begin, html.find("</dd>", begin) - begin);
}

/// What lasts of a file's text.
/// @param name  of the file, with a slash before its last part
inline std::string lasting(const std::string& name, const std::string& text) {
  if (name.ends_with("/summary.json")) return lastingJson(text);
  if (name.ends_with("/report.html")) return lastingPage(text);
  if (name.ends_with("/table.csv")) return withoutLastColumn(text, ",");
  if (name.ends_with("/table-page.tex")) return withoutLastColumn(text, "&");
  if (name.find("/frontier_time") != std::string::npos) return {};
  // Its rows end with a stroke too.
  if (name.ends_with("/table.md")) return withoutLastColumn(withoutLastColumn(text, "|"), "|");
  return text;
}

}  // namespace gnomon::test
