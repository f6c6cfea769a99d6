#pragma once

#include <exception>
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

/// Does the work of a public function that somebody watches: what the watcher throws cancels the
/// work and leaves as it is, everything else leaves as an Exception.
/// @param watcher  a function, or none
/// @param work     takes a function that tells the watcher
template <typename Watcher, typename Work>
auto watched(const Watcher& watcher, const Work& work) {
  std::exception_ptr cancelled;
  const auto tell = [&](auto... news) {
    if (!watcher) return;
    try {
      watcher(news...);
    } catch (...) {
      cancelled = std::current_exception();
      throw;
    }
  };
  try {
    return translated([&] { return work(tell); });
  } catch (...) {
    if (cancelled) std::rethrow_exception(cancelled);
    throw;
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
