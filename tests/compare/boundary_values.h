#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/boundaries.h"
#include "compare/drawn_mask.h"

namespace gnomon::test {

inline const std::vector<std::string>& boundaryNames() {
  static const std::vector<std::string> names =
      compare::namesOf(compare::metricsOfKinds({compare::MetricKind::boundary}));
  return names;
}

/// The place of a metric among the boundary metrics.
inline std::size_t placeOf(std::string_view name) {
  const auto& names = boundaryNames();
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// The values in the order of their names.
using Values = std::vector<std::optional<double>>;

inline Values valuesOf(const Mask& candidate, const Mask& truth,
                       const compare::SampleLayout& layout = {}) {
  Values values;
  for (const compare::Metric& metric : compare::compareBoundaries(candidate, truth, layout)) {
    values.push_back(metric.value);
  }
  return values;
}

inline void expectAlike(const Values& found, const Values& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].has_value(), expected[i].has_value()) << boundaryNames()[i];
    if (!found[i]) continue;
    EXPECT_NEAR(*found[i], *expected[i], 1e-12) << boundaryNames()[i];
  }
}

}  // namespace gnomon::test
