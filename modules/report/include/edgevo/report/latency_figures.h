#pragma once
// How a --realtime run kept up with its source, as summary.yaml, report.html and the closing line tell it.
// Latency of a frame: FrameRecord::latency_ms.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Milliseconds that half, 95 and 99 % of the frames do not exceed (nearest rank), and the largest.
struct LatencyFigures {
  double p50 = 0, p95 = 0, p99 = 0, max = 0;  ///< milliseconds
};
/// None of no values.
std::optional<LatencyFigures> latency_figures(std::vector<double> ms);
/// None where no frame has a latency.
std::optional<LatencyFigures> latency_figures(const Run& run);

/// One sentence; empty for a synchronous run.
std::string latency_statement(const Run& run);

}  // namespace edgevo
