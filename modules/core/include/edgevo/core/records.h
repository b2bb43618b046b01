#pragma once
// What a run leaves behind, as plain values: the odometry fills these, the outputs (occupancy, mrpt_bridge,
// evaluation, the command line) read them. Nothing here knows how it was computed.
//
// World frame: the axes of the first camera of the run (x right, y down, z forward), origin at its first
// pose. Map files re-express it z up by T_zup_world below. Unit: arbitrary unless Run::scale_source says
// metres.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/keyframe_reason.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/core/tracking_state.h"

namespace edgevo {

/// One row for every input frame.
struct FrameRecord {
  int index = 0;                                        ///< in the source
  Timestamp time;                                       ///< of the exposure
  TrackingState state = TrackingState::kBootstrapping;  ///< the verdict
  int segment = -1;          ///< number of the connected stretch of trajectory, from 0; -1: none
  bool is_keyframe = false;  ///< it was made one
  /// What called for a keyframe. With !is_keyframe it was called for while the mapping was busy with another,
  /// or it is kReturn.
  KeyframeReason keyframe_reason = KeyframeReason::kNone;
  int reference_keyframe = -1;  ///< Run::keyframes index that the final pose hangs on; -1: no pose
  double inlier_share =
      0;  ///< share of the map points in view that speak for the pose (alignment/pose_evidence.h), [0, 1]
  double residual_px = 0;                                ///< rms over the inliers along the edge normal
  int edges = 0;                                         ///< edge pixels found
  std::vector<std::pair<std::string, double>> stage_ms;  ///< name and CPU milliseconds of each stage that ran
  std::optional<SE3> T_world_cam;       ///< final: re-expressed from the final keyframe poses
  std::optional<SE3> T_world_cam_live;  ///< as it was known when the frame came
  /// Of xi in T_cam_ref <- exp(xi) T_cam_ref, tangent [v, w] in the camera's axes, lengths in the unit of the
  /// run; against the keyframe that the frame was tracked against, the scale taken as known
  /// (alignment/pose_covariance.h, times what odometry/tracking_check.h measured). Zero: unknown.
  Matrix6d covariance = Matrix6d::Zero();
  std::string note;  ///< why a bootstrap is not ready, why tracking was lost; else empty
  std::optional<double>
      latency_ms;  ///< --realtime: from when the frame was due (or came in) until its pose was there
};

/// A 3D edge point as its host keyframe leaves the window.
struct EdgePoint {
  Eigen::Vector2f px;      ///< in the undistorted host image
  Eigen::Vector2f normal;  ///< unit gradient direction in the image
  float idepth = 0;        ///< 1/z in the host frame
  float idepth_sigma = 0;  ///< one standard deviation, same unit; <= 0: unknown
  int observations = 0;    ///< keyframes that matched it
  uint8_t gray = 0;        ///< intensity in the host image
};

/// A place on an EdgeLine.
struct EdgeVertex {
  Eigen::Vector2f px;                      ///< in the undistorted host image
  float idepth = 0;                        ///< 1/z in the host frame, > 0
  float idepth_sigma = 0;                  ///< one standard deviation, same unit, > 0
  uint8_t gray_dark = 0, gray_bright = 0;  ///< intensity on the two sides of the edge in the host image
};

/// A stretch of a 3D edge without a jump in depth, as the keyframe that hosts it saw it
/// (edge_map/edge_mapper.h).
struct EdgeLine {
  std::vector<EdgeVertex> vertices;  ///< two or more, in order along the edge
  int keyframes = 1;                 ///< that saw it, the host among them
  bool is_straight = false;          ///< all vertices lie on one line of space, within their deviations
  bool is_outline = false;  ///< seen against what lies behind: the border of a thing, not a mark on it
};

/// A keyframe as it left the window: final pose, and what it hosts.
struct KeyframeRecord {
  int frame_index = 0;            ///< index of its frame in the source
  Timestamp time;                 ///< of its frame
  int segment = 0;                ///< as FrameRecord::segment
  SE3 T_world_cam;                ///< final
  std::vector<EdgePoint> points;  ///< that it hosts
  std::vector<EdgeLine> lines;    ///< empty with `--edge-map off`
};

/// What self-calibration says about the camera: images of the file's model are distorted by k1 (radial.h),
/// and read row by row in readout_s (ImageCorrection).
struct CameraRefinement {
  /// What became of the estimate; only kApplied changes anything.
  enum class State { kOff, kTooEarly, kNotObservable, kInsignificant, kApplied, kAtLimit };
  State state = State::kOff;  ///< of k1
  double k1 = 0;              ///< applied to all images; 0 unless kApplied
  double estimate = 0;        ///< newest estimate, applied or not
  double sigma = 0;           ///< one standard deviation of the estimate; 0: there is none
  int keyframes = 0;          ///< that the estimate rests on

  /// The read-out time of a rolling shutter, in the same words.
  struct Shutter {
    State state = State::kOff;  ///< of the read-out time
    double readout_s = 0;       ///< applied to all images: found, or as the parameters gave it
    /// newest estimate and its standard deviation, seconds; sigma 0: there is none
    double estimate = 0, sigma = 0;
    int keyframes = 0;  ///< that the estimate rests on
  };
  Shutter shutter;  ///< rolling shutter

  ImageCorrection correction() const { return {k1, shutter.readout_s}; }  ///< what is applied to all images
};

/// Words for the states in files, in their order. At the limit: the images ask for more than a lens that the
/// file nearly describes can have; nothing is applied, and the file is wrong in some other way.
inline const std::vector<std::string>& refinement_state_names() {
  static const std::vector<std::string> names{"off",           "too_early", "not_observable",
                                              "insignificant", "applied",   "at_limit"};
  return names;
}
/// Its word in refinement_state_names().
inline const std::string& to_string(CameraRefinement::State state) {
  return refinement_state_names()[size_t(state)];
}

/// Metres per unit of the odometry at one frame: `factor` from all of the run, `live_factor` from what was
/// known when the frame came.
struct FrameScale {
  double factor = 1, sigma = 0;  ///< sigma: relative, one standard deviation
  int samples = 0;               ///< 0: not measured here, taken over from the nearest frame where it was
  double live_factor = 0, live_sigma = 0;  ///< 0: not known yet
};

/// How a run got its metres; values over the frames that have a pose.
struct ScaleRecord {
  double factor = 1, sigma = 0;    ///< medians
  double lowest = 1, highest = 1;  ///< factors: what the drift of the scale was, before it was taken out
  int frames_carried_over = 0;     ///< frames where the scale was not measured
  std::vector<FrameScale> frames;  ///< as Run::frames; empty where one factor was given
  std::string problem;             ///< why the requested scale could not be had; else empty
};

/// How a --realtime run kept up with its source; the latency of each frame is in its FrameRecord.
struct RealtimeRecord {
  std::string pace;     ///< when frames were due, in words
  int handed_over = 0;  ///< frames that the odometry was given
  int late = 0;         ///< of them, those that it was not ready for within a millisecond after they were due
  int dropped =
      0;  ///< frames that a live camera gave while too many were waiting; each has its row, without a pose
  int left_out_of_mapping =
      0;  ///< frames with a pose that did not refine depths, since the mapping was behind
  double frames_per_second = 0;  ///< handed over, from when the first was due until the last had its pose
};

/// All that the odometry knows about a run.
struct Run {
  Pinhole pinhole;          ///< of the undistorted images, camera.k1 taken out; EdgePoint::px refers to it
  CameraRefinement camera;  ///< what self-calibration found
  std::vector<FrameRecord> frames;         ///< one for every input frame, in time order
  std::vector<KeyframeRecord> keyframes;   ///< in time order
  std::string scale_source = "none";       ///< "none": unit arbitrary; else metres
  ScaleRecord scale;                       ///< all lengths of the run have been multiplied by it
  std::optional<RealtimeRecord> realtime;  ///< none of a synchronous run
  std::optional<SE3>
      T_vehicle_cam;  ///< mount of the camera (vehicle x forward, y left, z up; metres), if it is known

  bool is_metric() const { return scale_source != "none"; }  ///< lengths are metres
  /// The factor changed along the run by more than drift does: the odometry itself was wrong, and so may be
  /// the metres between the places where they were measured.
  bool scale_varies() const {
    constexpr double kMostDrift = 1.3;  // over hundreds of metres a monocular scale drifts by a tenth
    return scale.highest > kMostDrift * scale.lowest;
  }
};

/// Point of a keyframe in the keyframe's camera frame.
inline Eigen::Vector3d point_in_camera(const Pinhole& pinhole, const EdgePoint& p) {
  return pinhole.ray(p.px.cast<double>()) / double(p.idepth);
}

/// The same of a vertex.
inline Eigen::Vector3d point_in_camera(const Pinhole& pinhole, const EdgeVertex& v) {
  return pinhole.ray(v.px.cast<double>()) / double(v.idepth);
}

/// Rotation to the exported world: z up, x forward at the first image (REP-103, MRPT): x = z_cam, y = -x_cam,
/// z = -y_cam.
inline SE3 T_zup_world() {
  Eigen::Matrix3d R;
  R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return {R, Eigen::Vector3d::Zero()};
}

/// What the numbers in a file mean, for its header: "metre (scale from odometry, +- 0.8 %)" or "arbitrary
/// (...)".
std::string unit_statement(const Run& run);

/// From the run's world to the world of the map files: z up, x forward, origin at the first pose of the
/// vehicle. With a known mount "up" is the vehicle's; else the camera is taken to look straight ahead
/// (T_zup_world). The lever arm is in metres and is therefore left out while the scale is arbitrary: the
/// origin is then the first camera.
inline SE3 T_map_world(const Run& run) {
  if (!run.T_vehicle_cam) return T_zup_world();
  return {run.T_vehicle_cam->rotation(),
          run.is_metric() ? run.T_vehicle_cam->translation() : Eigen::Vector3d(Eigen::Vector3d::Zero())};
}

}  // namespace edgevo
