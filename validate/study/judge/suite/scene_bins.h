#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/scenes/resampled_mean.h"
#include "study/record/record.h"

namespace gnomon::study {

/// What one scene gives to one bin of an axis for one method. The shares are means over the scene's
/// views, all lights together; those of an axis's bins add up to 1, and to the error rate over the
/// samples that have a value there.
struct SceneBin {
  std::string method;  ///< a label
  std::string axis;    ///< as in BinRecord, likewise `low` and `high`
  std::optional<double> low, high;
  compare::SceneShare share;
};

/// The suite that a study was drawn for, as its settings have it; empty for none.
std::string suiteNameOf(const StudyRecord& record);

/// Of every method and axis of a record, in the record's order.
std::vector<SceneBin> sceneBins(const StudyRecord& record);

}  // namespace gnomon::study
