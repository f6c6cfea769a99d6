#pragma once

#include <optional>
#include <string>

#include "compare/counts.h"

namespace gnomon::study {

/// One method's counts over the samples of a view, all lights together, whose value on one axis
/// lies in a bin. The bins of an axis hold every sample that has a value there, each in one of
/// them. Bins without a sample are left out.
struct BinRecord {
  std::string method;  ///< a MethodRecord's label
  std::string view;
  std::string light;           ///< "all": the sum over the lights
  std::string axis;            ///< the name of one of sampleAxes()
  std::optional<double> low;   ///< included; none where the bin has no lower end
  std::optional<double> high;  ///< excluded; none where the bin has no upper end
  compare::Counts counts;
};

}  // namespace gnomon::study
