#include "exporters.h"

#include "edgevo/results/run_files.h"

namespace edgevo {

// What a user would miss most comes first, and what tells of the others last.
const std::vector<Exporter>& exporters() {
  using Kind = FileKind;
  static const std::vector<Exporter> list{
      {"trajectory_tum.txt", "final poses, one line for each frame that has one", Kind::kText,
       export_final_trajectory},
      {"trajectory_live_tum.txt", "the poses as they were known when the frames came", Kind::kText,
       export_live_trajectory},
      {"trajectory_vehicle_tum.txt",
       "final poses of the vehicle, where it is known how the camera sits on it", Kind::kText,
       export_vehicle_trajectory, has_vehicle},
      {"trajectory_kitti.txt", "final poses as 3x4 matrices, one line for EVERY frame", Kind::kText,
       export_kitti_trajectory},
      {"frames.csv", "one row for every frame; timing columns last", Kind::kText, export_frames},
      {"scale.csv", "how the metres were found, where they were measured", Kind::kText, export_scale,
       has_scale},
      {"edges.ply", "3D edges: points and lines", Kind::kMrpt, export_points},
      {"edge_segments.csv", "the lines, one row each: ends, length, direction, certainty, who saw it",
       Kind::kMrpt, export_line_table},
      {"edges.ot", "the map as an OctoMap with probabilities", Kind::kMap, export_full_octree},
      {"edges.bt", "the same, occupied or free", Kind::kMap, export_binary_octree, has_octree},
      {"edges_color.ot", "its occupied voxels in the gray of their edges, for octovis", Kind::kMap,
       export_color_octree, has_octree},
      {"grid.yaml", "a 2D grid of what stands over the ground, for ROS's map_server", Kind::kMap, export_grid,
       has_octree},
      {"grid.pgm", "its cells", Kind::kMap, nullptr},
      {"grid.gridmap.gz", "the same for MRPT's navigators", Kind::kMap, export_gridmap, has_grid},
      {"keyframes.simplemap", "keyframes with their edge points", Kind::kMrpt, export_simplemap},
      {"scene.3Dscene", "trajectory and points in 3D", Kind::kMrpt, export_scene},
      {"playback.rawlog", "images, poses with covariance, keyframe points", Kind::kMrpt, export_playback},
      {"playback_Images", "its images, written or linked while the run goes on", Kind::kMrpt, nullptr},
      {"report.html", "all of it on one page", Kind::kReport, export_report},
      {"summary.yaml", "versions, parameters, scale, counts, timing, memory, and what could not be written",
       Kind::kSummary, export_summary},
  };
  return list;
}

std::vector<RunFile> run_files() {
  std::vector<RunFile> files;
  for (const Exporter& e : exporters()) files.push_back({e.file, e.content});
  return files;
}

}  // namespace edgevo
