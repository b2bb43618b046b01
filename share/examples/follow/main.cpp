// SPDX-License-Identifier: BSD-3-Clause
// follow SOURCE OUT: runs the odometry over a source; prints each pose as it is computed, writes all results
// to OUT.
#include <edgevo/core/error.h>
#include <edgevo/datasets/open_source.h>
#include <edgevo/results/run_outputs.h>
#include <edgevo/run_loop/run_odometry.h>

#include <cstdio>

namespace {

bool print(const edgevo::FrameRecord& frame) {
  const std::string state(to_string(frame.state));
  if (!frame.T_world_cam_live)
    return std::printf("%d %s: %s\n", frame.index, state.c_str(), frame.note.c_str()) > 0;
  const Eigen::Vector3d p = frame.T_world_cam_live->translation();
  return std::printf("%d %s %.3f %.3f %.3f\n", frame.index, state.c_str(), p.x(), p.y(), p.z()) > 0;
}

int follow(const std::string& path, const std::string& out) {
  edgevo::SourceOptions source_options;
  source_options.path = path;
  const auto source = edgevo::open_source(source_options);

  edgevo::OdometryParams params;  // defaults; edgevo help parameters --all explains every field
  params.mapping.window.keyframes = 10;
  edgevo::RunLoopOptions options;
  options.odometry.seed = 1;
  options.odometry.realtime = false;  // true: two threads, not bit-identical
  options.on_bad_frame = edgevo::OnBadFrame::kSkip;

  edgevo::RunOutputs outputs(out, source->camera(), edgevo::MapParams());
  const edgevo::RunResult result =
      edgevo::run_odometry(*source, params, options, [&](const edgevo::ProcessedFrame& f) {
        return print(f.record) && outputs.add_frame(f.frame, f.frame.image_path);
      });

  edgevo::RunInfo info;
  info.source_kind = source->kind();
  info.source_path = path;
  info.camera = source->camera();
  outputs.finish(result.run, info);                          // first write what was computed ...
  if (result.broken) std::rethrow_exception(result.broken);  // ... then report what went wrong
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: follow SOURCE OUT\n"), 2;
  try {
    return follow(argv[1], argv[2]);
  } catch (const std::exception& e) {
    return std::fprintf(stderr, "follow: %s\n", e.what()), 2;
  }
}
