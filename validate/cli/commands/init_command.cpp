#include "cli/commands/init_command.h"

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <regex>
#include <string_view>
#include <system_error>
#include <vector>

#include "cli/output.h"
#include "common/files/atomic_file.h"
#include "common/text.h"
#include "render/shader_files.h"

namespace gnomon::cli {

namespace fs = std::filesystem;
namespace {

constexpr const char* nextSteps = R"(
Next{}:
  gnomon run shadows/shadows.toml
      measures shadows/my-shadow.glsl; its report is out/shadows/report.html
  gnomon check shadows/shadows.toml --baseline shadows/references \
      --update-baseline --baseline-pictures --reason "first references"
      keeps what was measured: commit shadows/ and .github/
  gnomon check shadows/shadows.toml --baseline shadows/references --gated
      fails when the shader has become worse, as the workflow does for every change
)";

/// The starter's files, relative to its folder, sorted.
std::vector<fs::path> filesOf(const fs::path& starter) {
  std::vector<fs::path> files;
  std::error_code failure;
  fs::recursive_directory_iterator entry(starter, failure);
  for (; !failure && entry != fs::recursive_directory_iterator(); entry.increment(failure)) {
    if (entry->is_regular_file()) files.push_back(fs::relative(entry->path(), starter));
  }
  if (failure || files.empty()) {
    throw InputError(fmt::format("{}: the starter's files expected", starter.string()));
  }
  std::ranges::sort(files);
  return files;
}

constexpr std::string_view placeholder = "OWNER/gnomon@v0.1.0";
constexpr const char* noAction = "none";

/// The action that the workflow calls, or "none".
std::string actionFor(const InitRequest& request, const fs::path& root) {
  if (request.action == noAction) return noAction;
  const std::string action = request.action.empty() ? actionOf(root) : request.action;
  if (action.empty()) {
    throw UsageError(
        "init: --action OWNER/NAME@VERSION expected, the repository on GitHub that you have Gnomon "
        "from, which the workflow calls; with --action none there is no workflow");
  }
  if (!std::regex_match(action, std::regex(R"([\w.-]+/[\w.-]+@[\w./-]+)"))) {
    throw UsageError(fmt::format("--action {}: OWNER/NAME@VERSION expected, or none", action));
  }
  return action;
}

/// The workflow's text with the action in place of the starter's placeholder.
std::string withAction(std::string text, const std::string& action) {
  const std::size_t at = text.find(placeholder);
  return at == std::string::npos ? text : text.replace(at, placeholder.size(), action);
}

}  // namespace

CLI::App* addInitCommand(CLI::App& app, InitRequest& request) {
  CLI::App* init = app.add_subcommand(
      "init", "Write a starter: a study, a method of your own, a workflow of a build server");
  init->add_option("DIR", request.folder,
                   "Folder for the starter; files that are there stay as they are")
      ->capture_default_str()
      ->type_name("DIR");
  init->add_option("--action", request.action,
                   "Gnomon's repository on GitHub, which the workflow calls, or `none` for no "
                   "workflow; by default the one that this checkout is of")
      ->type_name("OWNER/NAME@VERSION");
  return init;
}

ExitStatus writeStarter(const InitRequest& request) {
  const fs::path& folder = request.folder;
  const fs::path root = render::shaderFolder().parent_path();
  const std::string action = actionFor(request, root);
  const fs::path starter = root / "scenes/starter";
  std::vector<fs::path> files = filesOf(starter);
  if (action == noAction) {
    std::erase_if(files, [](const fs::path& file) { return *file.begin() == ".github"; });
  }
  for (const fs::path& file : files) {
    std::error_code failure;
    if (fs::symlink_status(folder / file, failure).type() == fs::file_type::not_found) continue;
    throw InputError(
        fmt::format("{}: is there already; nothing was written", (folder / file).string()));
  }
  for (const fs::path& file : files) {
    const std::string text = withAction(readFile(starter / file), action);
    const fs::path target = folder / file;
    std::error_code failure;
    fs::create_directories(target.parent_path(), failure);
    writeTextAtomically(target, text);
    printLine(target.lexically_normal().string());
  }
  const bool isHere = folder.lexically_normal() == "." || folder.lexically_normal() == "./";
  printText(fmt::format(fmt::runtime(nextSteps),
                        isHere ? "" : fmt::format(", in {}", shellQuoted(folder.string()))));
  return ExitStatus::pass;
}

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
