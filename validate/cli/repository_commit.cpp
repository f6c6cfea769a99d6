#include "cli/repository_commit.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <system_error>

#include "common/text/shell_quote.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

bool isCommit(std::string_view text) {
  return text.size() >= 40 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::string askGit(const fs::path& folder, const std::string& question) {
  // The checkout may be another user's, as in a container, which git alone would refuse.
  const std::string command = "git -c safe.directory='*' -C " + shellQuoted(folder.string()) + " " +
                              question + " 2>/dev/null </dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) return "";
  std::array<char, 1024> buffer{};
  std::string text(buffer.data(), std::fread(buffer.data(), 1, buffer.size(), pipe.get()));
  return text.substr(0, text.find('\n'));
}

}  // namespace

std::string actionOf(const fs::path& folder) {
  std::error_code failure;
  if (!fs::exists(folder / ".git", failure)) return "";  // it may lie in another repository
  std::string origin = askGit(folder, "remote get-url origin");
  const std::string commit = askGit(folder, "rev-parse HEAD");
  if (origin.ends_with(".git")) origin.resize(origin.size() - 4);
  for (const std::string_view host :
       {"https://github.com/", "git@github.com:", "ssh://git@github.com/"}) {
    if (origin.starts_with(host) && isCommit(commit)) {
      return origin.substr(host.size()) + "@" + commit;
    }
  }
  return "";
}

std::string repositoryCommit(const fs::path& folder) {
  std::error_code failure;
  fs::path existing = fs::absolute(folder, failure);
  while (!fs::is_directory(existing, failure) && existing != existing.parent_path()) {
    existing = existing.parent_path();
  }
  if (std::string commit = askGit(existing, "rev-parse HEAD"); isCommit(commit)) return commit;
  const char* named = std::getenv("GITHUB_SHA");
  return named != nullptr && isCommit(named) ? named : "";
}

}  // namespace gnomon::cli
