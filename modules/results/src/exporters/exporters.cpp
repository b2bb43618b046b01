// SPDX-License-Identifier: BSD-3-Clause
#include "exporters.h"

#include "run_files.h"

namespace edgevo {

// The most important files come first; the summary, which lists those that are missing, comes last.
const std::vector<Exporter>& exporters() {
  using Kind = FileKind;
  static const std::vector<Exporter> list{
      {"trajectory_tum.txt", "final poses, one line for each frame that has one", Kind::kText,
       export_final_trajectory},
      {"trajectory_live_tum.txt", "live poses, as known when each frame was processed", Kind::kText,
       export_live_trajectory},
      {"trajectory_vehicle_tum.txt", "final poses of the vehicle, if the mount of the camera is known",
       Kind::kText, export_vehicle_trajectory, has_vehicle},
      {"trajectory_kitti.txt", "final poses as 3x4 matrices, one line for EVERY frame", Kind::kText,
       export_kitti_trajectory},
      {"frames.csv", "one row for every frame; timing columns last", Kind::kText, export_frames},
      {"covariances.csv", "covariance of each pose relative to its keyframe", Kind::kText,
       export_covariances},
      {"graph.csv", "intervals of one unit of length, and what relates them", Kind::kText, export_graph},
      {"mask.png", "what is fixed to the camera, black, if there is such a part", Kind::kText,
       export_ego_mask, has_ego_mask},
      {"camera.yaml",
       "the camera, for --camera of the next run, if it, or how a gyro sits next to it, was found",
       Kind::kText, export_found_camera, has_found_camera},
      {"scale.csv", "the metric scale over time, if it was measured", Kind::kText, export_scale, has_scale},
      {"edges.ply", "3D edges: points and lines", Kind::kMrpt, export_points},
      {"edges_doubtful.ply", "points of the keyframes made in doubt, if the maps are without them",
       Kind::kMrpt, export_doubtful_points, has_doubtful_points},
      {"edge_segments.csv", "3D lines, one row each: ends, length, direction, uncertainty, observers",
       Kind::kMrpt, export_line_table},
      {"edges.ot", "the map as an OctoMap with probabilities", Kind::kMap, export_full_octree},
      {"edges.bt", "the same map, occupied or free", Kind::kMap, export_binary_octree, has_octree},
      {"edges_color.ot", "occupied voxels in the gray of their edges, for octovis", Kind::kMap,
       export_color_octree, has_octree},
      {"grid.yaml", "2D occupancy grid of obstacles above the ground, for ROS's map_server", Kind::kMap,
       export_grid, has_octree},
      {"grid.pgm", "cells of that grid", Kind::kMap, nullptr},
      {"grid.gridmap.gz", "the same grid for MRPT's navigators", Kind::kMap, export_gridmap, has_grid},
      {"keyframes.simplemap", "keyframes with their edge points", Kind::kMrpt, export_simplemap},
      {"scene.3Dscene", "trajectory and points in 3D", Kind::kMrpt, export_scene},
      {"playback.rawlog", "images, poses with covariance, keyframe points", Kind::kMrpt, export_playback},
      {"playback_Images", "images of the playback, written or linked during the run", Kind::kMrpt, nullptr},
      {"run.mcap",
       "poses, points, lines, grid and log for Foxglove, rerun, RViz and ROS 2, written during the run",
       Kind::kMrpt, export_mcap, has_mcap},
      {"map.db",
       "the map for later runs: keyframes with points, edges and descriptors, written during the run",
       Kind::kMrpt, export_kept_map, has_kept_map},
      {"report.html", "the results on one page", Kind::kReport, export_report},
      {"summary.yaml",
       "versions, parameters, scale, counts, timing, memory, and files that could not be written",
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
