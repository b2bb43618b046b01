// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Time and memory of the process, for summary.yaml.
#include <chrono>

namespace edgevo {

/// Time and memory used.
struct ResourceUse {
  /// Wall-clock and CPU time since the meter was started, seconds.
  double wall_s = 0, cpu_s = 0;
  /// Peak memory of the process since its start, megabytes.
  double peak_memory_mb = 0;
};

/// Measures the resources used since its construction.
class ResourceMeter {
 public:
  /// Starts the clocks.
  ResourceMeter();
  /// Resources used so far.
  ResourceUse so_far() const;

 private:
  std::chrono::steady_clock::time_point wall_begin_;
  double cpu_begin_s_;
};

}  // namespace edgevo
