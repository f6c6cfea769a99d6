#pragma once

#include <algorithm>
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

}  // namespace gnomon
