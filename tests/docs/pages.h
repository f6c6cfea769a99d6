#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace gnomon::test {

inline std::filesystem::path projectFolder() {
  return GNOMON_PROJECT;
}

/// A block of code of a page, without its fences.
struct CodeBlock {
  std::string language;  ///< what follows the opening fence; may be empty
  std::string text;
};

/// A page of Markdown, as far as the tests read it.
struct DocPage {
  std::filesystem::path file;
  std::vector<std::string> lines;  ///< outside blocks of code
  std::vector<CodeBlock> blocks;
};

inline DocPage readPage(const std::filesystem::path& file) {
  DocPage page{file, {}, {}};
  std::ifstream text(file);
  bool isCode = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) {
      if (!isCode) page.blocks.push_back({line.substr(3), ""});
      isCode = !isCode;
    } else if (isCode) {
      page.blocks.back().text += line + "\n";
    } else {
      page.lines.push_back(line);
    }
  }
  return page;
}

/// README.md, CONTRIBUTING.md, the manual and the pages beside results and scenes.
inline std::vector<DocPage> allPages() {
  namespace fs = std::filesystem;
  std::vector<fs::path> files = {projectFolder() / "README.md",
                                 projectFolder() / "CONTRIBUTING.md"};
  for (const char* folder : {"docs", "results", "scenes"}) {
    for (const auto& entry : fs::recursive_directory_iterator(projectFolder() / folder)) {
      if (entry.path().extension() == ".md") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<DocPage> pages;
  for (const fs::path& file : files) pages.push_back(readPage(file));
  return pages;
}

/// A page of the manual.
inline DocPage manualPage(const std::string& name) {
  return readPage(projectFolder() / "docs" / name);
}

/// A line without its code, `…`.
inline std::string withoutCode(const std::string& line) {
  std::string text;
  bool isCode = false;
  for (const char c : line) {
    if (c == '`') isCode = !isCode;
    if (c != '`' && !isCode) text += c;
  }
  return text;
}

/// The pieces of code of a line, `…`.
inline std::vector<std::string> codeOf(const std::string& line) {
  std::vector<std::string> pieces;
  for (std::size_t begin = line.find('`'); begin != std::string::npos;) {
    const std::size_t end = line.find('`', begin + 1);
    if (end == std::string::npos) break;
    pieces.push_back(line.substr(begin + 1, end - begin - 1));
    begin = line.find('`', end + 1);
  }
  return pieces;
}

/// The anchors of a page's headings, as code hosts make them: lower case, spaces as hyphens, no
/// other punctuation; the second of the same name ends in -1.
inline std::set<std::string> anchorsOf(const DocPage& page) {
  std::set<std::string> anchors;
  std::map<std::string, int> seen;
  for (const std::string& line : page.lines) {
    if (!line.starts_with("#")) continue;
    const std::size_t begin = line.find_first_not_of("# ");
    if (begin == std::string::npos) continue;
    std::string anchor;
    for (const char c : line.substr(begin)) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == ' ') anchor += '-';
      if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 0x80) {
        anchor += static_cast<char>(std::tolower(byte));
      }
    }
    const int before = seen[anchor]++;
    anchors.insert(before == 0 ? anchor : anchor + "-" + std::to_string(before));
  }
  return anchors;
}

}  // namespace gnomon::test
