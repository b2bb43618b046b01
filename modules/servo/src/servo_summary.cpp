// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/output_file.h"
#include "edgevo/results/yaml_writer.h"
#include "edgevo/servo/servo_outputs.h"

namespace edgevo {

std::string servo_summary(const ServoResult& r, const ServoRunInfo& info) {
  const LatencyFigures latency = latency_figures(r);
  const ServoParams& p = info.params;
  std::string y = "servo:\n  law: " + p.law + "\n  result: " +
                  (r.failure.empty() ? (r.converged ? "converged" : "not_converged") : "not_begun") +
                  "\n  failure: " + yaml_quoted(r.failure) + "\n";
  const auto number = [&](const char* key, double value, int decimals) {
    y += std::string("  ") + key + ": " + fixed(value, decimals) + '\n';
  };
  number("final_mm", r.final_mm, 3);
  number("final_deg", r.final_deg, 4);
  number("final_px", r.final_px, 3);
  number("start_mm", r.start_mm, 1);
  number("start_deg", r.start_deg, 2);
  number("start_px", r.start_px, 1);
  number("duration_s", r.rows.empty() ? 0 : r.rows.back().time_s, 2);
  number("stops", r.stops, 0);
  number("stopped_s", r.stopped_s, 2);
  number("images_replaced", r.replaced, 0);
  number("latency_ms_median", latency.p50, 1);
  number("latency_ms_p95", latency.p95, 1);
  number("latency_ms_max", latency.max, 1);
  number("metres_per_unit", r.metres_per_unit, 6);
  number("scale_error", p.scale_error, 4);
  number("rate_hz", p.rate_hz, 2);
  number("gain", p.gain, 2);
  number("blackout_s", p.blackout_s, 2);
  return y + "  latency: " +
         (p.latency_s     ? "given"
          : p.cpu_latency ? "measured, CPU time"
                          : "measured") +
         "\n  light: " + (p.light.empty() ? "none" : p.light) + "\n  seed: " + std::to_string(p.seed) + "\n";
}

}  // namespace edgevo
