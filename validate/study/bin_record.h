#pragma once

#include <optional>
#include <string>

#include "compare/counts.h"

namespace gnomon {

/// One method's counts over the samples of a view whose value on one axis lies in a bin. The bins
/// of an axis hold every sample of the view that has a value there, each in one of them. Bins
/// without a sample are left out.
struct BinRecord {
  std::string method;  ///< a MethodRecord's label
  std::string view;
  std::string light;           ///< its name, or "all": the counts of all lights together
  std::string axis;            ///< a name of binAxes()
  std::optional<double> low;   ///< included; none where the bin has no lower end
  std::optional<double> high;  ///< excluded; none where the bin has no upper end
  Counts counts;
};

}  // namespace gnomon
