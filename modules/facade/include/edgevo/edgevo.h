// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// All that a program needs to turn images into poses, in one header, which needs Eigen only. Images and
// cameras from files: edgevo/sources.h. An example of both: share/examples/poses.
//
//   Camera                  the camera that takes the images
//   GrayImage, Frame        an 8-bit gray image in memory, with its number and its time
//   OdometryParams          what the odometry estimates and how; read_params_file() reads them
//   OdometryOptions         how it works: seed, threads, log
//   Odometry                frames in, poses out
//   FrameRecord             the result for one frame, a value: state, live pose, covariance, evidence
//   Run                     the result of all frames: final poses, keyframes, edge points and lines
//   evaluate                the error of a run against ground truth
//   InputError              what all of them throw for input that cannot be used: what, where, what to do
//
// Objects are independent: several odometries may run in one process, each in a thread of its own. None of
// them prints, exits or changes a setting of the process.
#include <string>

#include "edgevo/core/camera.h"
#include "edgevo/core/error.h"
#include "edgevo/core/image.h"
#include "edgevo/core/params.h"
#include "edgevo/core/records.h"
#include "edgevo/evaluation/figures.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/odometry/odometry_params.h"

namespace edgevo {

/// Errors of the final poses of a run against ground truth. `ground_truth`: a TUM or KITTI file. Throws
/// InputError for a file that cannot be used, or fewer than three common poses.
TrajectoryEvaluation evaluate(const Run& run, const std::string& ground_truth);

}  // namespace edgevo
