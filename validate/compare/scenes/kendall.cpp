#include "compare/scenes/kendall.h"

#include <fmt/core.h>

#include <cmath>
#include <cstddef>

#include "common/error.h"

namespace gnomon::compare {
namespace {

int orderOf(double a, double b) {
  return a < b ? -1 : (a > b ? 1 : 0);
}

}  // namespace

std::optional<double> kendallTau(std::span<const double> first, std::span<const double> second) {
  if (first.size() != second.size()) {
    throw InternalError(fmt::format("rankings of {} and {} found, the same number expected",
                                    first.size(), second.size()));
  }
  double agreement = 0;
  double untiedFirst = 0;
  double untiedSecond = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const int a = orderOf(first[i], first[j]);
      const int b = orderOf(second[i], second[j]);
      agreement += a * b;
      untiedFirst += a * a;
      untiedSecond += b * b;
    }
  }
  if (untiedFirst == 0 || untiedSecond == 0) return std::nullopt;
  return agreement / std::sqrt(untiedFirst * untiedSecond);
}

}  // namespace gnomon::compare
