#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <future>
#include <optional>
#include <utility>

#include "common/mask.h"
#include "common/progress.h"
#include "gnomon/exception.h"
#include "gnomon/horizon.h"
#include "gnomon/surface.h"
#include "relief/height_field.h"
#include "surface/cage/cage.h"
#include "surface/limit_surface.h"

namespace gnomon {

// The library's own types behind those of the public headers.

inline namespace api {

/// A mask's bytes are those of its shares, V: 1 lit, 0 shadowed; and 2 where there is no answer.
inline std::uint8_t byteOf(Shade shade) {
  return shade == Shade::lit ? 1 : shade == Shade::shadowed ? 0 : 2;
}

/// None for a byte that is no answer and not 2 either.
inline std::optional<Shade> shadeOf(std::uint8_t byte) {
  if (byte > 2) return std::nullopt;
  return byte == 1 ? Shade::lit : byte == 0 ? Shade::shadowed : Shade::none;
}

/// A copy of a height map, checked.
/// @throws InputError as HeightField, and for heights that no study may have
relief::HeightField heightFieldOf(const HeightMap& map);

/// What a Surface holds.
struct Surface::Data {
  explicit Data(surface::Cage of) : cage(std::move(of)), limit(cage) {}

  surface::Cage cage;
  surface::LimitSurface limit;
};

}  // namespace api

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
