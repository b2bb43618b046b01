// SPDX-License-Identifier: BSD-3-Clause
// poses SOURCE: images in, poses out.
#include <edgevo/edgevo.h>
#include <edgevo/sources.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: poses SOURCE\n"), 2;
  try {
    const auto source = edgevo::open_source(argv[1]);
    edgevo::Odometry odometry(source->camera());
    while (const auto frame = source->next()) {
      const edgevo::FrameRecord result = odometry.process(*frame);
      if (!result.T_world_cam_live) continue;
      const Eigen::Vector3d p = result.T_world_cam_live->translation();
      std::printf("%d %.3f %.3f %.3f\n", result.index, p.x(), p.y(), p.z());
    }
    const edgevo::Run run = odometry.finish();
    std::printf("%zu keyframes\n", run.keyframes.size());
    const std::string truth = source->ground_truth_path();
    if (!truth.empty()) std::fputs(to_table(edgevo::evaluate(run, truth)).c_str(), stdout);
  } catch (const edgevo::InputError& e) {
    return std::fprintf(stderr, "poses: %s\n", e.what()), 2;
  }
}
