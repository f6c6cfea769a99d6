#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/confidence_interval.h"
#include "study/record/record.h"

namespace gnomon::study {

/// One method's errors in one view, in the cells of the view's tiling.
struct MethodErrors {
  std::string method;                        ///< a MethodRecord's label
  std::vector<compare::BlockErrors> lights;  ///< one a light of the study
};

/// All methods' errors in one view, and how the view is cut.
struct ViewErrors {
  std::string view;
  compare::Tiling tiling;
  std::vector<std::string> lights;
  std::vector<MethodErrors> methods;  ///< those that answer in this view
};

/// Every method's interval for all lights together and, where there are several, under each.
/// @throws InternalError as rateConfidence
std::vector<ConfidenceRecord> confidenceOf(const ViewErrors& errors);

/// Every two methods, each with every later one: for all lights together and, where there are
/// several, under each.
/// @param uncertainties  of the truth in this view, one a light; all lights together have the mean
/// @throws InternalError as differenceConfidence
std::vector<DifferenceRecord> differencesOf(const ViewErrors& errors,
                                            const std::vector<double>& uncertainties);

}  // namespace gnomon::study
