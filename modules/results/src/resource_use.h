#pragma once
// Time and memory of the process, for summary.yaml.
#include <chrono>

namespace edgevo {

struct ResourceUse {
  double wall_s = 0, cpu_s = 0;  ///< since the meter began
  double peak_memory_mb = 0;     ///< of the process, ever
};

class ResourceMeter {
 public:
  /// Begins to count.
  ResourceMeter();
  ResourceUse so_far() const;

 private:
  std::chrono::steady_clock::time_point wall_begin_;
  double cpu_begin_s_;
};

}  // namespace edgevo
