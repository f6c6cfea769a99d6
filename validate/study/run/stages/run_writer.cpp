#include "study/run/stages/run_writer.h"

#include <utility>

#include "common/parallel.h"

namespace gnomon::study {

void EncodingQueue::add(std::vector<Work> encodings, Work then, std::size_t waitingBytes) {
  for (Work& encoding : encodings) encodings_.push_back(std::move(encoding));
  after_.push_back(std::move(then));
  waitingBytes_ += waitingBytes;
  constexpr std::size_t mostBytes = 100'000'000;
  if (waitingBytes_ > mostBytes) finish();
}

void EncodingQueue::finish() {
  const std::vector<Work> encodings = std::exchange(encodings_, {});
  const std::vector<Work> after = std::exchange(after_, {});
  waitingBytes_ = 0;
  if (after.empty()) return;
  clock_.measure("writing", [&](const Progress&) {
    parallelFor(0, encodings.size(), [&](std::size_t i) { encodings[i](); });
    for (const Work& then : after) then();
  });
}

}  // namespace gnomon::study
