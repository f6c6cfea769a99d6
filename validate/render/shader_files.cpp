#include "render/shader_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/system/memory.h"
#include "common/system/own_files.h"

namespace gnomon::render {
namespace fs = std::filesystem;

fs::path shaderFolder() {
  std::error_code failure;
  if (const char* chosen = std::getenv("GNOMON_SHADERS"); chosen != nullptr) {
    for (const char* part : {"common", "methods"}) {
      if (fs::is_directory(fs::path(chosen) / part, failure)) continue;
      throw InputError(fmt::format("GNOMON_SHADERS: {} holds no folder `{}`", chosen, part));
    }
    return chosen;
  }
  if (const auto installed = installedFile("share/gnomon/shaders")) return *installed;
  throw InputError(
      fmt::format("no shaders: share/gnomon/shaders is in no folder above {}; set "
                  "GNOMON_SHADERS",
                  ownFolder().string()));
}

bool isShader(const fs::directory_entry& entry) {
  constexpr std::array<std::string_view, 4> endings = {".glsl", ".vert", ".geom", ".frag"};
  const fs::path name = entry.path().filename();
  const bool hasEnding =
      std::find(endings.begin(), endings.end(), name.extension()) != endings.end();
  std::error_code ignored;
  return hasEnding && !name.native().starts_with('.') && entry.is_regular_file(ignored);
}

std::vector<fs::path> shadersIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure); !failure && entry != fs::directory_iterator();
       entry.increment(failure)) {
    if (isShader(*entry)) files.push_back(entry->path());
  }
  if (failure) {
    throw InputError(fmt::format("{}: cannot be read: {}", folder.string(), failure.message()));
  }
  std::sort(files.begin(), files.end());
  return files;
}

ShaderPiece readShader(const fs::path& path) {
  return {path.string(), readFile(path), 1};
}

namespace {

bool isWordCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Whether parentheses that hold a word follow a place.
bool parenthesesHold(std::string_view glsl, std::size_t at, std::string_view word) {
  const std::size_t open = std::min(glsl.find_first_not_of(" \t\r\n", at), glsl.size());
  const std::string_view inside = glsl.substr(open, glsl.find(')', open) - open);
  return inside.starts_with('(') && lineOfWord(inside, word);
}

/// Where a comment that begins at a place ends; the place itself where none begins.
std::size_t endOfComment(std::string_view glsl, std::size_t at) {
  if (glsl.substr(at, 2) == "//") return std::min(glsl.find('\n', at), glsl.size());
  if (glsl.substr(at, 2) != "/*") return at;
  const std::size_t close = glsl.find("*/", at + 2);
  return close == std::string_view::npos ? glsl.size() : close + 2;
}

/// The first place from `at` on that is no space and in no comment.
std::size_t nextCode(std::string_view glsl, std::size_t at) {
  while (at < glsl.size()) {
    const std::size_t end = endOfComment(glsl, at);
    if (end == at && std::string_view(" \t\r\n\\").find(glsl[at]) == std::string_view::npos) break;
    at = std::max(end, at + 1);
  }
  return at;
}

/// The place after the parenthesis that closes the one at a place; npos where none does.
std::size_t afterParentheses(std::string_view glsl, std::size_t open) {
  int depth = 0;
  for (std::size_t at = open; at < glsl.size();) {
    const std::size_t end = endOfComment(glsl, at);
    if (end == at) depth += glsl[at] == '(' ? 1 : (glsl[at] == ')' ? -1 : 0);
    at = std::max(end, at + 1);
    if (depth == 0) return at;
  }
  return std::string_view::npos;
}

/// The head of a loop, "for (…)" or "while (…)", so that `nextTurn()` can end it.
/// @param isLast  whether nothing but a semicolon follows: the end of `do`, or a loop without body
std::string endingHead(std::string_view word, std::string_view parentheses, bool isLast) {
  if (word == "while" && isLast) return fmt::format("while ({} && nextTurn())", parentheses);
  return fmt::format("{} {} if (!nextTurn()) break; else", word, parentheses);
}

/// Where a comment or a line of the preprocessor that begins at a place ends; the place itself
/// where none begins.
std::size_t endOfNoCode(std::string_view glsl, std::size_t at) {
  return glsl[at] == '#' ? std::min(glsl.find('\n', at), glsl.size()) : endOfComment(glsl, at);
}

}  // namespace

std::optional<std::size_t> lineOfWord(std::string_view glsl, std::string_view word) {
  std::size_t line = 1;
  for (std::size_t at = 0; at < glsl.size();) {
    std::size_t end = std::max(endOfComment(glsl, at), at + 1);
    if (isWordCharacter(glsl[at])) {
      while (end < glsl.size() && isWordCharacter(glsl[end])) ++end;
      if (glsl.substr(at, end - at) == word) return line;
    }
    line +=
        static_cast<std::size_t>(std::count(glsl.begin() + static_cast<std::ptrdiff_t>(at),
                                            glsl.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    at = end;
  }
  return std::nullopt;
}

bool definesFunction(std::string_view glsl, std::string_view name, std::string_view argument) {
  int depth = 0;  // of braces
  for (std::size_t at = 0; at < glsl.size();) {
    std::size_t end = endOfNoCode(glsl, at);
    if (end == at) {
      ++end;
      depth += glsl[at] == '{' ? 1 : (glsl[at] == '}' ? -1 : 0);
    }
    if (isWordCharacter(glsl[at])) {
      while (end < glsl.size() && isWordCharacter(glsl[end])) ++end;
      const bool isName = depth == 0 && glsl.substr(at, end - at) == name;
      if (isName && parenthesesHold(glsl, end, argument)) return true;
    }
    at = end;
  }
  return false;
}

bool definesFunction(const std::vector<ShaderPiece>& code, std::string_view name,
                     std::string_view argument) {
  return std::any_of(code.begin(), code.end(), [&](const ShaderPiece& piece) {
    return definesFunction(piece.text, name, argument);
  });
}

std::string withEndingLoops(std::string_view glsl) {
  std::string text;
  for (std::size_t at = 0; at < glsl.size();) {
    std::size_t end = std::max(endOfComment(glsl, at), at + 1);
    if (isWordCharacter(glsl[at])) {
      while (end < glsl.size() && isWordCharacter(glsl[end])) ++end;
    }
    const std::string_view word = glsl.substr(at, end - at);
    const std::size_t open = nextCode(glsl, end);
    const bool isHead = (word == "for" || word == "while") && glsl.substr(open, 1) == "(";
    const std::size_t close = isHead ? afterParentheses(glsl, open) : std::string_view::npos;
    if (close == std::string_view::npos) {
      text += word;
      at = end;
      continue;
    }
    const bool isLast = glsl.substr(nextCode(glsl, close), 1) == ";";
    text += endingHead(word, glsl.substr(open, close - open), isLast);
    at = close;
  }
  return text;
}

std::optional<std::string> placeOfWord(const std::vector<ShaderPiece>& code,
                                       std::string_view word) {
  for (const ShaderPiece& piece : code) {
    const auto line = lineOfWord(piece.text, word);
    if (line) return fmt::format("{}:{}", piece.file, piece.firstLine + *line - 1);
  }
  return std::nullopt;
}

namespace {

constexpr std::size_t mostIncludes = 32;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// What follows `#include` in a line; nothing in other lines.
std::optional<std::string_view> includeIn(std::string_view line) {
  std::string_view rest = trimmed(line);
  if (!rest.starts_with('#')) return std::nullopt;
  rest = trimmed(rest.substr(1));
  constexpr std::string_view word = "include";
  if (!rest.starts_with(word)) return std::nullopt;
  return trimmed(rest.substr(word.size()));
}

/// Whether a comment goes on after a line.
bool isInComment(std::string_view line, bool before) {
  bool inside = before;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const std::string_view two = line.substr(i, 2);
    if (!inside && two == "//") return false;
    if (two != (inside ? "*/" : "/*")) continue;
    inside = !inside;
    ++i;
  }
  return inside;
}

class Includer {
 public:
  explicit Includer(const fs::path& first) : root_(first.parent_path()) {}

  void append(const fs::path& path, const ShaderPiece& file) {
    open_.push_back(path.lexically_normal());
    const std::string_view text = file.text;
    std::size_t begin = 0;  // of what has not been appended
    std::size_t firstLine = 1;
    std::size_t number = 0;
    bool inComment = false;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      const std::string_view line = text.substr(at, end - at);
      ++number;
      const auto named = inComment ? std::nullopt : includeIn(line);
      inComment = isInComment(line, inComment);
      if (named) {
        add(file, text.substr(begin, at - begin), firstLine);
        include(path, fmt::format("{}:{}: ", file.file, number), *named);
        begin = std::min(end + 1, text.size());
        firstLine = number + 1;
      }
      at = end + 1;
    }
    add(file, text.substr(begin), firstLine);
    open_.pop_back();
  }

  IncludedCode code;

 private:
  void add(const ShaderPiece& file, std::string_view text, std::size_t firstLine) {
    const bool isOnlyOne = open_.size() == 1 && firstLine == 1;
    if (!text.empty() || isOnlyOne) {
      code.pieces.push_back({file.file, std::string(text), firstLine});
    }
  }

  void include(const fs::path& from, const std::string& place, std::string_view named) {
    if (named.size() < 3 || named.front() != '"' || named.find('"', 1) != named.size() - 1) {
      throw InputError(place + "#include \"FILE\" expected, in a line of its own");
    }
    const fs::path name(named.substr(1, named.size() - 2));
    const fs::path path = (from.parent_path() / name).lexically_normal();
    const fs::path inside = path.lexically_relative(root_.lexically_normal());
    const bool isOutside = !root_.empty() && (inside.empty() || *inside.begin() == "..");
    const bool isAbove = root_.empty() && *path.begin() == "..";
    if (name.is_absolute() || isOutside || isAbove) {
      throw InputError(
          fmt::format("{}#include {}: a file in the folder of the method expected", place, named));
    }
    if (std::find(open_.begin(), open_.end(), path) != open_.end()) {
      throw InputError(fmt::format("{}#include {}: this file includes itself", place, named));
    }
    if (std::find(known_.begin(), known_.end(), path) != known_.end()) return;
    known_.push_back(path);
    std::error_code failure;
    if (!fs::is_regular_file(path, failure)) {
      throw InputError(fmt::format("{}#include {}: no file {}", place, named, path.string()));
    }
    bytes_ += fs::file_size(path, failure);
    if (known_.size() > mostIncludes || bytes_ > mostShaderBytes) {
      throw InputError(fmt::format("{}#include {}: at most {} files of {} in all expected", place,
                                   named, mostIncludes,
                                   formatBytes(static_cast<double>(mostShaderBytes))));
    }
    code.includes.push_back(readShader(path));
    append(path, ShaderPiece(code.includes.back()));
  }

  fs::path root_;
  std::vector<fs::path> open_;   ///< the files that the place lies in
  std::vector<fs::path> known_;  ///< all that are included
  std::uintmax_t bytes_ = 0;
};

}  // namespace

IncludedCode expandIncludes(const fs::path& path, const ShaderPiece& file) {
  Includer includer(path);
  includer.append(path, file);
  return std::move(includer.code);
}

}  // namespace gnomon::render
