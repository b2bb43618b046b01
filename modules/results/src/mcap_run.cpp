// SPDX-License-Identifier: BSD-3-Clause
#include "mcap_run.h"

#include "edgevo/core/rectification.h"
#include "edgevo/results/run_params.h"
#include "edgevo_build_info.h"

namespace edgevo {

McapRun mcap_run(const RecoveryHeader& header, const MapParams& map) {
  RunParams params;
  read_params(header.info.params_yaml, kRecoveryLog, [&](ParamVisitor& v) { params.visit(v); });
  McapRun run;
  run.library = std::string("edgevo ") + build_info::kVersion;
  run.pinhole = rectification_of(header.info.camera, header.info.working_pinhole).target();
  run.T_vehicle_cam = header.T_vehicle_cam;
  run.scale = parse_scale_sources(header.scale);
  run.tracks = header.tracks;
  run.scale_params = params.scale;
  run.filter = map.occupancy.points;
  return run;
}

}  // namespace edgevo
