// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/recover_run.h"

#include "edgevo/results/run_outputs.h"
#include "edgevo/results/run_params.h"
#include "edgevo/scale/run_scaling.h"
#include "propagate_keyframe_poses.h"

namespace edgevo {
namespace {

RunParams params_of(const InterruptedRun& interrupted) {
  RunParams params;
  read_params(interrupted.header.info.params_yaml, kRecoveryLog, [&](ParamVisitor& v) { params.visit(v); });
  return params;
}

// Measures the scale again from frames and keyframes in their original order.
RunScaling measure_scale_again(const InterruptedRun& interrupted, const ScaleParams& params) {
  const Run& run = interrupted.run;
  RunScaling scaling(parse_scale_source(interrupted.header.scale), interrupted.header.track, run.pinhole,
                     run.T_vehicle_cam, params);
  size_t next = 0;
  for (size_t i = 0; i < run.frames.size(); ++i) {
    std::vector<KeyframeRecord> marginalised;
    for (; next < run.keyframes.size() && interrupted.frames_before_keyframe[next] <= i + 1; ++next)
      marginalised.push_back(run.keyframes[next]);
    scaling.add_frame(run.frames[i], marginalised);
  }
  return scaling;
}

RunInfo info_of(const InterruptedRun& interrupted) {
  RunInfo info = interrupted.header.info;
  info.interrupted = true;
  info.notes.emplace_back("cut_off", "the program was killed after " +
                                         std::to_string(interrupted.run.frames.size()) +
                                         " frames; `edgevo finish` wrote the results up to then");
  info.notes.emplace_back("timing_of", "`edgevo finish`, except for the stages");
  return info;
}

}  // namespace

Run recover_run(const std::string& folder) {
  InterruptedRun interrupted = read_recovery_log(folder);
  const RunParams params = params_of(interrupted);
  const RunScaling scaling = measure_scale_again(interrupted, params.scale);
  propagate_keyframe_poses(&interrupted);
  scaling.apply(&interrupted.run);
  RunOutputs outputs(folder, interrupted.header.info.camera, params.map, OutputOptions{true, false});
  outputs.adopt(interrupted.run.frames.empty() ? -1 : interrupted.run.frames.back().index);
  outputs.finish(interrupted.run, info_of(interrupted));
  return std::move(interrupted.run);
}

}  // namespace edgevo
