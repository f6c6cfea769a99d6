#include "study/spec/sections/study_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <system_error>

#include "common/error.h"

namespace gnomon::study {

namespace fs = std::filesystem;
namespace {

constexpr std::string_view encodedMark = "file:";

bool canHold(const std::string& text) {
  try {
    (void)tomlText(toml::table{{"text", text}});
    return true;
  } catch (const InputError&) {
    return false;
  }
}

bool isUnreserved(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("-._~/").find(c) != std::string_view::npos;
}

std::string encoded(const std::string& bytes) {
  std::string text;
  for (const char c : bytes) {
    text +=
        isUnreserved(c) ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return text;
}

/// The byte of two hexadecimal digits, or none.
std::optional<char> byteOf(std::string_view digits) {
  unsigned value = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, failure] = std::from_chars(digits.data(), end, value, 16);
  if (digits.size() != 2 || failure != std::errc() || stop != end) return std::nullopt;
  return static_cast<char>(static_cast<unsigned char>(value));
}

/// The tables of a list, or of none.
template <typename Work>
void forEachTable(toml::node* list, const Work& work) {
  if (list == nullptr || !list->is_array()) return;
  for (toml::node& entry : *list->as_array()) {
    if (toml::table* table = entry.as_table()) work(*table);
  }
}

}  // namespace

std::string fileText(const fs::path& path) {
  const std::string text = path.string();
  if (!text.starts_with(encodedMark) && canHold(text)) return text;
  return std::string(encodedMark) + encoded(text);
}

fs::path fileOf(const std::string& text) {
  if (!text.starts_with(encodedMark)) return text;
  std::string bytes;
  for (std::size_t i = encodedMark.size(); i < text.size(); ++i) {
    const auto byte =
        text[i] == '%' ? byteOf(std::string_view(text).substr(i + 1, 2)) : std::nullopt;
    bytes += byte.value_or(text[i]);
    if (byte) i += 2;
  }
  return bytes;
}

fs::path namedFile(const TomlReader& section, std::string_view key, const fs::path& folder) {
  fs::path file = folder / fileOf(section.text(key));
  std::error_code unknown;  // another fault is told by who reads the file
  if (fs::status(file, unknown).type() == fs::file_type::not_found) {
    section.fail(key, file.string() + ": no such file");
  }
  return file;
}

std::string stemText(const fs::path& file) {
  const std::string stem = file.stem().string();
  return canHold(stem) ? stem : encoded(stem);
}

std::string relativeFile(const fs::path& file, const fs::path& folder) {
  return fileText(fs::proximate(fs::absolute(file), fs::absolute(folder)));
}

void moveFile(toml::table& table, const char* key, const fs::path& from, const fs::path& to) {
  const auto path = table[key].value<std::string>();
  if (!path || fileOf(*path).is_absolute()) return;
  table.insert_or_assign(key, relativeFile(from / fileOf(*path), to));
}

void moveFiles(toml::table& study, const fs::path& from, const fs::path& to) {
  if (toml::table* relief = study["relief"].as_table()) moveFile(*relief, "image", from, to);
  if (toml::table* surface = study["surface"].as_table()) moveFile(*surface, "mesh", from, to);
  const auto moveShader = [&](toml::table& table) { moveFile(table, "file", from, to); };
  forEachTable(study.get("method"), [&](toml::table& method) {
    moveShader(method);
    moveFile(method, "masks", from, to);
  });
  forEachTable(study.get("ladder"), [&](toml::table& ladder) {
    moveShader(ladder);
    forEachTable(ladder.get("rung"), [&](toml::table& rung) {
      if (toml::table* set = rung["set"].as_table()) moveShader(*set);
    });
  });
}

namespace {

/// The longest part: file systems allow 255 bytes for a name of three.
constexpr std::size_t longest = 60;

std::string plainName(const std::string& name) {
  std::string plain;
  for (const char c : name) {
    const bool keep = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
    if (keep || (!plain.empty() && plain.back() != '-')) plain += keep ? c : '-';
  }
  plain.resize(std::min(plain.size(), longest));
  while (!plain.empty() && plain.back() == '-') plain.pop_back();
  return plain.empty() ? "unnamed" : plain;
}

}  // namespace

bool isNameCharacter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
}

std::vector<std::string> fileNames(const std::vector<std::string>& names,
                                   std::set<std::string> taken) {
  std::vector<std::string> result;
  for (const std::string& name : names) {
    const std::string plain = plainName(name);
    std::string distinct = plain;
    for (int k = 2; !taken.insert(distinct).second; ++k) distinct = fmt::format("{}-{}", plain, k);
    result.push_back(distinct);
  }
  return result;
}

CaseNames caseNames(const StudySpec& study) {
  std::vector<std::string> views, lights, methods;
  for (const ViewSpec& view : study.views) views.push_back(view.name);
  for (const Light& light : study.lights) lights.push_back(light.name);
  for (const MethodSpec& method : study.methods) methods.push_back(method.label);
  return {fileNames(views), fileNames(lights), fileNames(methods, {"truth", "displaced"})};
}

}  // namespace gnomon::study
