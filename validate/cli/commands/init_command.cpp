#include "cli/commands/init_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "cli/output.h"
#include "common/files/atomic_file.h"
#include "common/text/shell_quote.h"
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
  gnomon check shadows/shadows.toml --baseline shadows/references
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

}  // namespace

ExitStatus writeStarter(const fs::path& folder) {
  const fs::path starter = render::shaderFolder().parent_path() / "scenes/starter";
  const std::vector<fs::path> files = filesOf(starter);
  for (const fs::path& file : files) {
    std::error_code failure;
    if (fs::symlink_status(folder / file, failure).type() == fs::file_type::not_found) continue;
    throw InputError(
        fmt::format("{}: is there already; nothing was written", (folder / file).string()));
  }
  for (const fs::path& file : files) {
    const std::string text = readFile(starter / file);
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

}  // namespace gnomon::cli
