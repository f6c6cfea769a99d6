#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <optional>
#include <utility>

#include "common/cancellation.h"
#include "gnomon/exception.h"

namespace gnomon {
inline namespace api {

/// Throws the exception that is being handled as an Exception.
[[noreturn]] void throwTranslated();

/// A child that was forked after the first call of the library has none of its threads, for which
/// loops and image formats would wait for ever.
/// @throws Exception  internal, in such a child
void requireOwnProcess();

/// Does the work of a public function; whatever it throws leaves as an Exception.
template <typename Work>
auto translated(const Work& work) -> decltype(work()) {
  try {
    requireOwnProcess();
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
/// stays as it is, and waits for it. What ends the work of this thread ends that, too.
template <typename Work>
auto onOwnThread(const Work& work) -> decltype(work()) {
  Cancellation ours;
  std::optional<decltype(work())> result;
  auto done = std::async(std::launch::async, [&] { ours.run([&] { result.emplace(work()); }); });
  while (done.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    if (isCancelled()) ours.cancel();
  }
  done.get();
  return std::move(*result);
}

}  // namespace api
}  // namespace gnomon
