// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Waiting for a condition on other threads instead of a fixed sleep, with a deadline that only a fault
// reaches.
#include <chrono>
#include <filesystem>
#include <iterator>
#include <thread>

namespace edgevo::test {

/// Waits until `holds()` returns true; returns false after a minute.
template <class Condition>
bool wait_until(const Condition& holds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // yields the processor to the other thread
  }
  return true;
}

/// Threads of this process, as Linux counts them.
inline int threads_of_process() {
  return int(std::distance(std::filesystem::directory_iterator("/proc/self/task"), {}));
}

/// Whether but so many threads are left: Linux lists one that was joined for a moment more.
inline bool have_ended_down_to(int threads) {
  return wait_until([=] { return threads_of_process() <= threads; });
}

}  // namespace edgevo::test
