#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/error.h"

namespace CLI {
class App;
}

namespace gnomon::cli {

/// What `gnomon compare` was asked for.
struct CompareRequest {
  std::filesystem::path candidate, truth;  ///< two pictures, or two folders of them
  std::optional<std::filesystem::path> roi;
  std::vector<std::string> maxima, minima;          ///< METRIC=VALUE
  std::string uncertainty;                          ///< of the truth, a share; empty if not given
  std::optional<double> threshold;                  ///< of soft masks, between 0 and 1
  std::string candidateChannel, truthChannel;       ///< empty for the only one
  bool inverted = false;                            ///< the candidate's white is shadow
  bool upward = false;                              ///< the candidate's first row is the lowest
  std::string json;                                 ///< a file, "-" for standard output
  std::optional<std::filesystem::path> difference;  ///< a PNG
  std::string command;                              ///< the command line
};

/// Adds the command and its options; they fill `request`.
CLI::App* addCompareCommand(CLI::App& app, CompareRequest& request);

/// Compares two pictures of masks, or the pictures of one name in two folders, and prints what was
/// found; files that were asked for are written whole or not at all.
/// @return pass, or thresholdFailed where a gate failed
/// @throws UsageError for a gate that is no METRIC=VALUE, on no known metric, or that no candidate
///   could fail or none could pass; InputError for
///   pictures that cannot be compared, and for folders that do not hold the same names
ExitStatus compareMasks(const CompareRequest& request);

}  // namespace gnomon::cli
