// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/scale_faults.h"

#include <cmath>

#include "edgevo/core/formatted.h"

namespace edgevo {
namespace {

double percent(double log_ratio) { return 100 * std::expm1(log_ratio); }

}  // namespace

std::string to_string(const ScaleFault& fault) {
  const std::string frames = fault.first_frame == fault.last_frame
                                 ? formatted("at frame %d", fault.first_frame)
                                 : formatted("in frames %d to %d", fault.first_frame, fault.last_frame);
  if (fault.scattered > 1)
    return fault.source +
           formatted(": %d positions displaced by up to %.1f m ", fault.scattered, fault.displacement) +
           frames;
  if (fault.displacement > 0)
    return fault.source + ": positions displaced by " + formatted("%.1f m ", fault.displacement) + frames;
  if (fault.log_excess_sigma > 0)
    return fault.source + ": lengths contradict the rest by " +
           formatted("%+.0f +- %.0f %% ", percent(fault.log_excess), 100 * fault.log_excess_sigma) + frames +
           ", where it does not count";
  return fault.source + ": gives no scale, since it does not fit the path of the camera";
}

std::vector<std::string> scale_faults_in_words(const Run& run) {
  std::vector<std::string> lines;
  for (const auto& [source, clock] : run.scale.clock_offsets)
    lines.push_back(
        source + formatted(": its stamps are %.2f +- %.2f s ", std::abs(clock.late_s), clock.sigma_s) +
        (clock.late_s > 0 ? "later" : "earlier") + " than the camera's; its times were corrected");
  for (const ScaleFault& fault : run.scale.faults) lines.push_back(to_string(fault));
  return lines;
}

}  // namespace edgevo
