// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/run_maps.h"

#include "edgevo/results/run_folder.h"
#include "edgevo/scale/ground_height.h"
#include "edgevo/scale/scale_source.h"
#include "export_files.h"

namespace edgevo {

double camera_height_of(const Run& run, const GridParams& params) {
  if (const double given = params.given_camera_height(); given > 0) return given;
  if (const auto height = recorded_scale_sources(run.scale_source).camera_height()) return *height;
  if (const auto seen = seen_camera_height(run, ScaleParams())) return *seen;
  if (run.is_metric() && run.T_vehicle_cam && run.T_vehicle_cam->translation().z() > 0)
    return run.T_vehicle_cam->translation().z();
  return 0;
}

MapReport write_map_files(const Run& run, const MapParams& params, const std::string& path,
                          const OnKeyframeMapped& on_keyframe_mapped) {
  RunFolder folder(path);
  ExportContext context{run, params};
  context.on_keyframe_mapped = on_keyframe_mapped;
  export_files([](FileKind kind) { return kind == FileKind::kMap; }, &context, &folder);
  folder.throw_first_failure();
  return context.map;
}

}  // namespace edgevo
