#pragma once

#include <algorithm>
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

}  // namespace gnomon
