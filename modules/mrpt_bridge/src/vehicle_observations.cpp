// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/vehicle_observations.h"

#include "edgevo/core/doubtful_frame.h"
#include "edgevo/core/output_file.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/playback_pose.h"

namespace edgevo {

mrpt::obs::CObservationImage::Ptr make_image_observation(Timestamp time, const std::string& label,
                                                         const Camera& camera,
                                                         const std::optional<SE3>& T_vehicle_cam) {
  auto obs = mrpt::obs::CObservationImage::Create();
  obs->timestamp = to_mrpt(time);
  obs->sensorLabel = label;
  obs->cameraPose = to_mrpt(T_vehicle_cam.value_or(T_vehicle_cam_forward()));
  obs->cameraParams = closest_mrpt(camera).camera;
  return obs;
}

mrpt::obs::CObservationRobotPose::Ptr make_pose_observation(const Run& run, const FrameRecord& frame,
                                                            const SE3& T_world_cam) {
  auto obs = mrpt::obs::CObservationRobotPose::Create();
  obs->timestamp = to_mrpt(frame.time);
  obs->sensorLabel = "EDGE_VO";
  obs->pose = vehicle_pose_pdf(run, T_world_cam, frame.covariance);
  return obs;
}

mrpt::obs::CObservationRobotPose::Ptr make_live_observation(const Run& run, const FrameRecord& frame) {
  if (!frame.T_world_cam_live || !frame.T_world_cam_live->is_finite()) return nullptr;
  auto obs = make_pose_observation(run, frame, *frame.T_world_cam_live);
  obs->sensorLabel = "EDGE_VO_LIVE";
  return obs;
}

mrpt::obs::CObservationComment::Ptr make_frames_observation(const Run& run, Timestamp time,
                                                            const std::string& frames) {
  auto obs = mrpt::obs::CObservationComment::Create();
  obs->timestamp = to_mrpt(time);
  obs->text = std::string("EDGE_VO: is_metric ") + (run.is_metric() ? "true; " : "false; ") + frames +
              "; unit: " + unit_statement(run);
  return obs;
}

mrpt::obs::CObservationOdometry::Ptr make_odometry_observation(const Run& run, const FrameRecord& frame,
                                                               const SE3& T_world_cam) {
  auto obs = mrpt::obs::CObservationOdometry::Create();
  obs->timestamp = to_mrpt(frame.time);
  obs->sensorLabel = "EDGE_VO_ODO";
  obs->odometry = mrpt::poses::CPose2D(to_mrpt(T_map_vehicle(run, T_world_cam)));
  return obs;
}

mrpt::obs::CObservationComment::Ptr make_doubt_observation(const FrameRecord& frame) {
  if (!is_doubtful(frame)) return nullptr;
  auto obs = mrpt::obs::CObservationComment::Create();
  obs->timestamp = to_mrpt(frame.time);
  obs->text = "EDGE_VO: frame " + std::to_string(frame.index) + " is not to be trusted (p_right " +
              fixed(frame.p_right, 3) + ", " + std::string(to_string(frame.state)) + ")" +
              (frame.note.empty() ? "" : ": " + frame.note);
  return obs;
}

}  // namespace edgevo
