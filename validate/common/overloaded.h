#pragma once

namespace gnomon {

/// One function of several, for `std::visit`: each kind of a variant calls its own, and a kind that
/// none of them takes does not compile.
template <typename... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

}  // namespace gnomon
