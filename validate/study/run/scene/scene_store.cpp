#include "study/run/scene/scene_store.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/system/memory.h"

namespace gnomon::study {

SceneStore::SceneStore(std::uint64_t mostBytes) : mostBytes_(mostBytes) {}

std::uint64_t SceneStore::shareOfMemory() {
  return availableMemoryBytes() / 4;
}

bool SceneStore::canHold(std::uint64_t bytes) const {
  return bytes <= mostBytes_ && bytes <= availableMemoryBytes() / 2;
}

void SceneStore::clear() {
  entries_.clear();
  bytes_ = 0;
}

std::shared_ptr<const void> SceneStore::find(const Name& name) {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& entry) { return entry.name == name; });
  if (found == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found);
  return entries_.front().value;
}

void SceneStore::letGo(std::list<Entry>::const_iterator entry) {
  bytes_ -= entry->bytes;
  entries_.erase(entry);
}

void SceneStore::keep(const Name& name, std::shared_ptr<const void> value, std::uint64_t bytes) {
  if (bytes > mostBytes_) return;
  while (bytes_ > mostBytes_ - bytes) letGo(std::prev(entries_.end()));
  const auto isOfType = [&](const Entry& entry) { return entry.name.type == name.type; };
  if (std::count_if(entries_.begin(), entries_.end(), isOfType) == mostOfAType) {
    letGo(std::prev(std::find_if(entries_.rbegin(), entries_.rend(), isOfType).base()));
  }
  entries_.push_front({name, std::move(value), bytes});
  bytes_ += bytes;
}

}  // namespace gnomon::study
