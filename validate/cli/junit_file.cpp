#include "cli/junit_file.h"

#include <fmt/core.h>

#include <fstream>
#include <string_view>

#include "common/files/atomic_file.h"
#include "report/ci/junit.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view option = "--junit";

/// Whether a result may stand there: nothing does, or another result.
bool mayReplace(const fs::path& file) {
  if (!keepsContent(file)) return true;
  std::ifstream content(file, std::ios::binary);
  std::string head(4096, '\0');
  content.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(content.gcount()));
  return head.empty() || head.find("<testsuite") != std::string::npos;
}

std::string errorXml(const std::string& command, const Failure& failure) {
  study::CheckRecord check;
  check.name = "gnomon check";
  check.command = command;
  check.problems.push_back({"check", failure.status, failure.message});
  return report::junitXml({&check, 1});
}

}  // namespace

JunitFile::JunitFile(std::span<const char* const> arguments, std::string command)
    : command_(std::move(command)) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string_view word = arguments[i];
    if (word == "--") break;
    if (word == option && i + 1 < arguments.size()) {
      files_.emplace_back(arguments[i + 1]);
    } else if (word.starts_with(option) && word.substr(option.size()).starts_with('=')) {
      files_.emplace_back(word.substr(option.size() + 1));
    }
  }
  std::erase_if(files_, [](const fs::path& file) { return file.empty(); });
}

void JunitFile::open() const {
  for (const fs::path& file : files_) {
    if (mayReplace(file)) continue;
    throw UsageError(
        fmt::format("--junit {}: a file that is no JUnit XML stands there; it is left as it is",
                    file.string()));
  }
  const std::string text =
      errorXml(command_, {ExitStatus::internal, "the check did not come to its end"});
  for (const fs::path& file : files_) {
    if (keepsContent(file)) writeTextAtomically(file, text);
  }
}

void JunitFile::fail(const Failure& failure) const noexcept {
  for (const fs::path& file : files_) {
    try {
      if (mayReplace(file)) writeTextAtomically(file, errorXml(command_, failure));
    } catch (...) {
      continue;
    }
  }
}

bool keepsContent(const fs::path& file) {
  std::error_code failure;
  const fs::file_status status = fs::status(file, failure);
  return !fs::exists(status) || fs::is_regular_file(status);
}

}  // namespace gnomon::cli
