// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The description of a run besides its records, for summary.yaml and the report.
#include <memory>
#include <string>

#include "edgevo/calibration/auto_camera.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/report/run_info.h"
#include "edgevo/run_session/run_session.h"

namespace edgevo {

/// The newest mask of what is fixed to the camera.
using EgoMaskImage = std::shared_ptr<const Plane<uint8_t>>;

/// What is known when the run begins.
RunInfo describe_run(const RunRequest& request, const ImageSource& source, const OdometryOptions& odometry);
/// Replaces what the source says of its camera.
void note_found_camera(const AutoCamera& camera, RunInfo* info);
/// Which places were seen again, in one line; empty if none was.
std::string statement_of(const PlaceCounts& places);
/// How the run ended; `stopped`: by the user.
void note_end(const RunResult& result, bool stopped, const std::optional<SE3>& T_vehicle_cam, RunInfo* info);
/// What was fixed to the camera at the end; null: nothing.
void note_mask(const EgoMaskImage& own, RunInfo* info);

}  // namespace edgevo
