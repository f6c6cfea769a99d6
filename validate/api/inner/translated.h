#pragma once

#include <functional>
#include <future>
#include <utility>

#include "gnomon/exception.h"

namespace gnomon {
inline namespace api {

/// Throws the exception that is being handled as an Exception.
[[noreturn]] void throwTranslated();

/// Does the work of a public function; whatever it throws leaves as an Exception.
template <typename Work>
auto translated(const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (...) {
    throwTranslated();
  }
}

/// Does work that makes an OpenGL context current on a thread of its own, so that the caller's
/// stays as it is, and waits for it.
template <typename Work>
auto onOwnThread(const Work& work) -> decltype(work()) {
  return std::async(std::launch::async, std::cref(work)).get();
}

}  // namespace api
}  // namespace gnomon
