// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A trajectory that is read in another way than it was written: another clock, quaternions with w first,
// poses from the world to the camera, other axes, other units. Each of these leaves the figures of evaluate()
// large without an error of the odometry. A reading is worth a hint if the error is ten times smaller under
// it; none is applied unless requested.
//
// What is compared: of clock, inverse and units the ATE (positions); of quaternions and axes the motions in
// the axes of the poses, as drift does.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/evaluation/trajectory.h"

namespace edgevo {

/// How the poses of a trajectory file are to be read; the default is the format as documented.
struct TrajectoryReading {
  /// Seconds added to all times.
  double t_offset_s = 0;
  /// Whether its quaternions are qw qx qy qz.
  bool w_first = false;
  /// Whether its poses are T_cam_world.
  bool inverse = false;
};

/// Reads the poses of a file in another way. Throws InputError for w_first of a KITTI file, which has no
/// quaternions, for t_offset_s of one, which has no times, and for a time out of range.
void reread(const TrajectoryReading& reading, Trajectory* trajectory);

/// Readings under which an error is ten times smaller, one line each that names the option of `edgevo eval`;
/// empty if there is none, or nothing large to explain. `given_offset_s`, which the times of the trajectory
/// contain already, is added to the offset that is named. For trajectories that evaluate() accepts. Cost:
/// about 20 ms; poses beyond 300 are thinned out.
std::vector<std::string> alignment_hints(const Trajectory& estimate, const Trajectory& ground_truth,
                                         double given_offset_s = 0);

/// The offset of the estimate's clock under which its poses fit, for two trajectories without common times;
/// nullopt if none is found.
std::optional<double> clock_offset(const Trajectory& estimate, const Trajectory& ground_truth);

}  // namespace edgevo
