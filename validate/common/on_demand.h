#pragma once

#include <functional>
#include <optional>
#include <utility>

namespace gnomon {

/// A value that is made when it is first asked for, by one thread at a time.
template <typename T>
class OnDemand {
 public:
  /// @param make  what it refers to outlives the value's making
  explicit OnDemand(std::function<T()> make) : make_(std::move(make)) {}

  [[nodiscard]] const T& get() const {
    if (!value_) value_.emplace(make_());
    return *value_;
  }

 private:
  std::function<T()> make_;
  mutable std::optional<T> value_;
};

}  // namespace gnomon
