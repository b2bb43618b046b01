// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Lines of the log on their way to Python: gathered while the GIL is not held, passed on once it is.
#include <pybind11/pybind11.h>

#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace edgevo::python {

/// Gathers lines, from any thread.
class GatheredLines {
 public:
  /// Adds a line.
  void add(const std::string& line) {
    const std::lock_guard<std::mutex> lock(mutex_);
    lines_.push_back(line);
  }
  /// Calls `log` with each line since the last call, or drops them if it is null. Needs the GIL. What `log`
  /// raises comes out; the lines after it are dropped.
  void pass_to(const pybind11::object& log) {
    std::vector<std::string> lines;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      lines = std::exchange(lines_, {});
    }
    if (!log) return;
    for (const std::string& line : lines) log(line);
  }

 private:
  std::mutex mutex_;
  std::vector<std::string> lines_;
};

}  // namespace edgevo::python
