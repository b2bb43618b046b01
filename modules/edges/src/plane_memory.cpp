// SPDX-License-Identifier: BSD-3-Clause
#include <map>
#include <mutex>
#include <new>
#include <vector>

#include "edgevo/edges/plane.h"

namespace edgevo {
namespace {

constexpr size_t kSmallest = 64 << 10;  // bytes; smaller blocks come from the heap
constexpr size_t kKeptOfASize = 8;      // blocks kept per size, as two frames need; more are freed

class Store {
 public:
  void* take(size_t bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto it = kept_.find(bytes);
    if (it == kept_.end() || it->second.empty()) return nullptr;
    void* block = it->second.back();
    it->second.pop_back();
    return block;
  }
  bool keep(void* block, size_t bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<void*>& blocks = kept_[bytes];
    if (blocks.size() >= kKeptOfASize) return false;
    blocks.push_back(block);
    return true;
  }

 private:
  std::mutex mutex_;
  std::map<size_t, std::vector<void*>> kept_;
};

// Never destroyed, since planes of static lifetime may outlive it.
Store& store() {
  static Store* const s = new Store;
  return *s;
}

}  // namespace

void* PlaneMemory::take(size_t bytes) {
  void* kept = bytes >= kSmallest ? store().take(bytes) : nullptr;
  return kept ? kept : ::operator new(bytes);
}

void PlaneMemory::give_back(void* block, size_t bytes) {
  if (bytes < kSmallest || !store().keep(block, bytes)) ::operator delete(block);
}

}  // namespace edgevo
