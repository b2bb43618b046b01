#include "edgevo/results/cut_off_run.h"

#include "edgevo/results/run_outputs.h"
#include "edgevo/results/run_params.h"
#include "edgevo/scale/run_scaling.h"
#include "settle.h"

namespace edgevo {
namespace {

RunParams params_of(const CutOffRun& cut_off) {
  RunParams params;
  read_params(cut_off.header.info.params_yaml, kRunJournal, [&](ParamVisitor& v) { params.visit(v); });
  return params;
}

// Frames and keyframes once more, in the order in which they came.
RunScaling measured_again(const CutOffRun& cut_off, const ScaleParams& params) {
  const Run& run = cut_off.run;
  RunScaling scaling(parse_scale_source(cut_off.header.scale), cut_off.header.track, run.pinhole,
                     run.T_vehicle_cam, params);
  size_t next = 0;
  for (size_t i = 0; i < run.frames.size(); ++i) {
    std::vector<KeyframeRecord> settled;
    for (; next < run.keyframes.size() && cut_off.frames_before_keyframe[next] <= i + 1; ++next)
      settled.push_back(run.keyframes[next]);
    scaling.add_frame(run.frames[i], settled);
  }
  return scaling;
}

RunInfo info_of(const CutOffRun& cut_off) {
  RunInfo info = cut_off.header.info;
  info.interrupted = true;
  info.notes.emplace_back("cut_off", "the program was ended from outside after " +
                                         std::to_string(cut_off.run.frames.size()) +
                                         " frames; `edgevo finish` wrote what it had until then");
  info.notes.emplace_back("timing_of", "`edgevo finish`, but for the stages");
  return info;
}

}  // namespace

Run finish_cut_off_run(const std::string& folder) {
  CutOffRun cut_off = read_run_journal(folder);
  const RunParams params = params_of(cut_off);
  const RunScaling scaling = measured_again(cut_off, params.scale);
  settle_frames(&cut_off);
  scaling.apply(&cut_off.run);
  RunOutputs outputs(folder, cut_off.header.info.camera, params.map, OutputOptions{true, false});
  outputs.adopt(cut_off.run.frames.empty() ? -1 : cut_off.run.frames.back().index);
  outputs.finish(cut_off.run, info_of(cut_off));
  return std::move(cut_off.run);
}

}  // namespace edgevo
