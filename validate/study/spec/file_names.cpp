#include "study/spec/file_names.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

namespace gnomon::study {
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
