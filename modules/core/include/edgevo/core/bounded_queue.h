// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A queue between two threads. What happens when it is full is said by whoever adds.
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace edgevo {

/// First in, first out, for any number of threads. Once it is closed nothing is added, and what waits can
/// still be taken.
template <typename T>
class BoundedQueue {
 public:
  /// It is full when `max_size` items wait.
  explicit BoundedQueue(size_t max_size) : max_size_(max_size) {}

  /// Adds an item even if the queue is full. False if it is closed.
  bool push(T item) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return add(std::move(item));
  }
  /// Adds an item unless the queue is full or closed; false then.
  bool push_if_room(T item) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return items_.size() < max_size_ && add(std::move(item));
  }
  /// Waits while the queue is full. False if it is closed.
  bool push_when_room(T item) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return is_closed_ || items_.size() < max_size_; });
    return add(std::move(item));
  }
  /// Adds an item; a full queue gives the oldest for it. False if it is closed.
  bool push_over_oldest(T item, std::optional<T>* oldest) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!is_closed_ && items_.size() >= max_size_) *oldest = take();
    return add(std::move(item));
  }

  /// Waits for an item and takes the oldest; nullopt if the queue is closed and empty.
  std::optional<T> pop() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return is_closed_ || !items_.empty(); });
    return take();
  }
  /// As pop(); nullopt also if no item comes within that time.
  std::optional<T> pop_within(std::chrono::duration<double> at_most) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, at_most, [this] { return is_closed_ || !items_.empty(); });
    return take();
  }

  /// Ends all waiting.
  void close() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_closed_ = true;
    changed_.notify_all();
  }
  /// Whether nothing is added any more.
  bool is_closed() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return is_closed_;
  }
  /// Whether pop() would return nullopt.
  bool is_finished() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return is_closed_ && items_.empty();
  }
  /// Number of items that wait.
  size_t size() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return items_.size();
  }

 private:
  bool add(T item) {
    if (is_closed_) return false;
    items_.push_back(std::move(item));
    changed_.notify_all();
    return true;
  }
  std::optional<T> take() {
    if (items_.empty()) return std::nullopt;
    std::optional<T> item(std::move(items_.front()));
    items_.pop_front();
    changed_.notify_all();
    return item;
  }

  const size_t max_size_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<T> items_;
  bool is_closed_ = false;
};

}  // namespace edgevo
