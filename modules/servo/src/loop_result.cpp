// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/servo/loop_result.h"

namespace edgevo {

LatencyFigures latency_figures(const ServoResult& result) {
  std::vector<double> ms;
  for (const ServoRow& row : result.rows)
    if (row.phase == Phase::kServo && row.latency_s > 0) ms.push_back(1000 * row.latency_s);
  return latency_figures(std::move(ms)).value_or(LatencyFigures());
}

}  // namespace edgevo
