#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/mask.h"
#include "compare/confidence_interval.h"
#include "compare/counts.h"
#include "study/record/gate.h"

namespace gnomon::report {

/// A picture of a mask, as it was read.
struct MaskFileRecord {
  std::string file;
  std::size_t lit = 0, shadowed = 0, none = 0;
  std::size_t binarised = 0;  ///< grey ones: a threshold made them lit or shadowed

  MaskFileRecord(std::string name, const Mask& mask, std::size_t soft);
};

/// The result of comparing two pictures of masks: plain data.
struct MaskComparison {
  MaskFileRecord candidate, truth;
  std::optional<MaskFileRecord> roi = std::nullopt;  ///< of the region of interest
  std::string command = {};                          ///< reproduces it
  int width = 0;
  int height = 0;
  std::size_t withoutSample = 0;  ///< pixels left out: the truth has no sample
  std::size_t outsideRoi = 0;     ///< pixels left out: outside the region of interest
  bool isSoft = false;  ///< the pictures hold shares of light; the files' pixels are those of cuts
  compare::Counts counts = {};
  std::vector<compare::Metric> metrics = {};
  compare::ConfidenceInterval confidence = {};    ///< of the error rate
  std::optional<double> uncertainty = {};         ///< of the truth, a share; none where unknown
  std::vector<std::string> notices = {};          ///< what to look at before the figures
  std::vector<study::Judgement> judgements = {};  ///< of the command's options

  /// True unless a gate failed.
  [[nodiscard]] bool passed() const;
};

/// What the truth's uncertainty means, as a sentence.
std::string uncertaintyText(double share);

/// For programs: schema "gnomon-comparison/1". The confusion matrix and the metrics have the names
/// that a run's summary gives them; a metric without a value is null, its reason in `undefined`.
std::string maskComparisonJson(const MaskComparison& comparison);

/// For the terminal, at most 100 columns wide; figures with six digits, shares in percent.
/// @param colours  ANSI colours and bold face; without them the text is plain
std::string maskComparisonTable(const MaskComparison& comparison, bool colours);

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
