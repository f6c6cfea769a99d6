#pragma once

#include <filesystem>
#include <string>

namespace gnomon::cli {

/// The repository on GitHub that a folder is a checkout of, with its commit, as a workflow's `uses`
/// names it: "OWNER/NAME@COMMIT". Empty where the folder is none, or its remote `origin` is
/// elsewhere.
std::string actionOf(const std::filesystem::path& folder);

/// The commit that is checked out in the user's repository that a folder lies in, which may be yet
/// to be made: as git says, else GitHub's runner in GITHUB_SHA. Empty where neither knows one.
std::string repositoryCommit(const std::filesystem::path& folder);

}  // namespace gnomon::cli
