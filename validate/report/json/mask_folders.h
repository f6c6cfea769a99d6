#pragma once

#include <string>
#include <vector>

#include "report/json/mask_comparison.h"

namespace gnomon::report {

/// Two pictures of the same name.
struct MaskPair {
  std::string name;
  MaskComparison comparison;
};

/// The result of comparing two folders of masks: plain data.
struct MaskFolders {
  std::string candidate, truth;  ///< the folders, as the command names them
  std::string command = {};      ///< reproduces it
  std::vector<MaskPair> pairs = {};
  compare::ConfidenceInterval confidence = {};  ///< of the error rate over all pixels

  /// True unless a gate failed for a pair.
  [[nodiscard]] bool passed() const;
  /// Of all pixels together.
  [[nodiscard]] compare::Counts counts() const;
  /// Mean of the truths' uncertainties by their pixels; none where one is unknown.
  [[nodiscard]] std::optional<double> uncertainty() const;
};

/// For programs: schema "gnomon-comparisons/1".
std::string maskFoldersJson(const MaskFolders& folders);

/// For the terminal, at most 100 columns wide: a line a pair, then all pixels together.
/// @param colours  as maskComparisonTable
std::string maskFoldersTable(const MaskFolders& folders, bool colours);

}  // namespace gnomon::report
