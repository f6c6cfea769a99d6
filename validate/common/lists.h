#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon {

/// Whether a list holds a value.
template <typename List, typename Value>
bool contains(const List& list, const Value& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

/// Appends a value that the list does not hold yet.
template <typename Value>
void appendOnce(std::vector<Value>& list, const Value& value) {
  if (!contains(list, value)) list.push_back(value);
}

/// For every place of a list of so many, the first place that `isSame(first, place)` says holds the
/// same: itself where no earlier one does.
template <typename IsSame>
std::vector<std::size_t> firstOfSame(std::size_t count, const IsSame& isSame) {
  std::vector<std::size_t> firsts(count);
  for (std::size_t i = 0; i < count; ++i) {
    firsts[i] = i;
    for (std::size_t k = 0; k < i && firsts[i] == i; ++k) {
      if (firsts[k] == k && isSame(k, i)) firsts[i] = k;
    }
  }
  return firsts;
}

/// One function of several, for `std::visit`: each kind of a variant calls its own, and a kind that
/// none of them takes does not compile.
template <typename... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

/// The value below which a share of the values lies, linear between the two nearest of them: the
/// smallest for 0, the median for 0.5, the largest for 1; exact where these two are equal.
/// @param sorted  ascending, one value or more
/// @param share   0 to 1
inline double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// The same of values in any order, which it changes.
inline double takeQuantile(std::vector<double>& values, double share) {
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), below, values.end());
  const auto above = std::min_element(below + 1, values.end());
  const double next = above == values.end() ? *below : *above;
  return *below + (place - std::floor(place)) * (next - *below);
}

}  // namespace gnomon
