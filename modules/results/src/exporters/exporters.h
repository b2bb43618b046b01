// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Functions that write the files of a run, each to `path`; exporters.cpp assigns them to file names.
#include "exporter.h"

namespace edgevo {

// trajectories.cpp
void export_final_trajectory(ExportContext* context, const std::string& path);
void export_live_trajectory(ExportContext* context, const std::string& path);
void export_vehicle_trajectory(ExportContext* context, const std::string& path);
bool has_vehicle(const ExportContext& context);
void export_kitti_trajectory(ExportContext* context, const std::string& path);

// frame_tables.cpp
void export_frames(ExportContext* context, const std::string& path);
void export_covariances(ExportContext* context, const std::string& path);
void export_graph(ExportContext* context, const std::string& path);
void export_scale(ExportContext* context, const std::string& path);
bool has_scale(const ExportContext& context);
void export_ego_mask(ExportContext* context, const std::string& path);
bool has_ego_mask(const ExportContext& context);
void export_found_camera(ExportContext* context, const std::string& path);
bool has_found_camera(const ExportContext& context);

// map_files.cpp
void export_points(ExportContext* context, const std::string& path);
void export_doubtful_points(ExportContext* context, const std::string& path);
bool has_doubtful_points(const ExportContext& context);
void export_line_table(ExportContext* context, const std::string& path);
void export_full_octree(ExportContext* context, const std::string& path);
void export_binary_octree(ExportContext* context, const std::string& path);
void export_color_octree(ExportContext* context, const std::string& path);
bool has_octree(const ExportContext& context);
void export_grid(ExportContext* context, const std::string& path);
void export_gridmap(ExportContext* context, const std::string& path);
bool has_grid(const ExportContext& context);
void export_kept_map(ExportContext* context, const std::string& path);
bool has_kept_map(const ExportContext& context);

// mrpt_files.cpp
void export_simplemap(ExportContext* context, const std::string& path);
void export_scene(ExportContext* context, const std::string& path);
void export_playback(ExportContext* context, const std::string& path);

// ros_files.cpp
void export_mcap(ExportContext* context, const std::string& path);
bool has_mcap(const ExportContext& context);

// pages.cpp
void export_report(ExportContext* context, const std::string& path);
void export_summary(ExportContext* context, const std::string& path);

}  // namespace edgevo
