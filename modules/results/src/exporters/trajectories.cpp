// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/output_file.h"
#include "edgevo/results/run_text.h"
#include "exporters.h"

namespace edgevo {

void export_final_trajectory(ExportContext* context, const std::string& path) {
  write_file(path, trajectory_tum(context->run, PoseKind::kFinal));
}

void export_live_trajectory(ExportContext* context, const std::string& path) {
  write_file(path, trajectory_tum(context->run, PoseKind::kLive));
}

void export_vehicle_trajectory(ExportContext* context, const std::string& path) {
  write_file(path, trajectory_vehicle_tum(context->run));
}

bool has_vehicle(const ExportContext& context) { return context.run.T_vehicle_cam.has_value(); }

void export_kitti_trajectory(ExportContext* context, const std::string& path) {
  write_file(path, trajectory_kitti(context->run));
}

}  // namespace edgevo
