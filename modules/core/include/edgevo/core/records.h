// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Results of a run as plain values: filled by the odometry, read by the outputs (occupancy, mrpt_bridge,
// evaluation, the command line), independent of how they were computed.
//
// World frame: the axes of the first camera of the run (x right, y down, z forward), origin at its first
// pose; or those of a map that was kept, if keyframes were found in it. Map files re-express it z up by
// T_zup_world below. Unit: arbitrary unless Run::scale_source says metres.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/frame_evidence.h"
#include "edgevo/core/reason.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/core/tracking_state.h"

namespace edgevo {

/// Result of one input frame.
struct FrameRecord {
  /// Index in the source.
  int index = 0;
  /// Time of exposure.
  Timestamp time;
  /// Tracking state.
  TrackingState state = TrackingState::kBootstrapping;
  /// Number of the connected segment of trajectory, from 0; -1: none.
  int segment = -1;
  /// Whether the frame became a keyframe.
  bool is_keyframe = false;
  /// Whether that keyframe is doubtful (KeyframeRecord::is_doubtful).
  bool is_doubtful_keyframe = false;
  /// Criterion that requested a keyframe. With !is_keyframe the mapping was busy with another one, or the
  /// reason is kReturn.
  KeyframeReason keyframe_reason = KeyframeReason::kNone;
  /// Index into Run::keyframes of the keyframe that anchors the final pose; -1: no pose.
  int reference_keyframe = -1;
  /// Measurements that the tracking state rests on.
  FrameEvidence evidence;
  /// Probability, 0 to 1, that the motion of the camera around this frame is right
  /// (confidence/motion_confidence.h); NaN: not known, as while there is no map.
  double p_right = std::numeric_limits<double>::quiet_NaN();
  /// Name and CPU time, milliseconds, of each stage that ran.
  std::vector<std::pair<std::string, double>> stage_ms;
  /// Final pose, re-expressed from the final keyframe poses.
  std::optional<SE3> T_world_cam;
  /// Live pose, as estimated when the frame was processed.
  std::optional<SE3> T_world_cam_live;
  /// Covariance of xi in T_cam_ref <- exp(xi) T_cam_ref, tangent [v, w] in the camera's axes, lengths in the
  /// unit of the run; relative to the keyframe that the frame was tracked against
  /// (alignment/pose_covariance.h, with the factor of confidence/tracking_check.h), over p_right. Zero:
  /// unknown.
  Matrix6d covariance = Matrix6d::Zero();
  /// Why there is no map yet, tracking was lost, or the motion is doubted; else empty.
  Reasons reasons;
  /// The same in words, or why the frame was skipped.
  std::string note;
  /// With --realtime: time from when the frame was due (or arrived) until its pose was available,
  /// milliseconds.
  std::optional<double> latency_ms;
};

/// A 3D edge point as of the marginalisation of its host keyframe.
struct EdgePoint {
  /// Pixel in the undistorted host image.
  Eigen::Vector2f px;
  /// Unit gradient direction in the image.
  Eigen::Vector2f normal;
  /// Inverse depth 1/z in the host frame.
  float idepth = 0;
  /// Standard deviation of the inverse depth, same unit; <= 0: unknown.
  float idepth_sigma = 0;
  /// Number of keyframes that matched the point; 0: an earlier host has passed it on, and none has matched it
  /// since.
  int observations = 0;
  /// Intensity in the host image.
  uint8_t gray = 0;
};

/// A vertex of an EdgeLine.
struct EdgeVertex {
  /// Pixel in the undistorted host image.
  Eigen::Vector2f px;
  /// Inverse depth 1/z in the host frame, > 0.
  float idepth = 0;
  /// Standard deviation of the inverse depth, same unit, > 0.
  float idepth_sigma = 0;
  /// Intensity on the two sides of the edge in the host image.
  uint8_t gray_dark = 0, gray_bright = 0;
};

enum class DepthSource : uint8_t;  // depth_source.h

/// A section of a 3D edge without a jump in depth, as its host keyframe saw it (edge_map/edge_mapper.h).
struct EdgeLine {
  /// Two or more vertices, in order along the edge.
  std::vector<EdgeVertex> vertices;
  /// Number of keyframes that saw the line, including the host.
  int keyframes = 1;
  /// Number of images besides the host's that showed it there, median of its vertices.
  int views = 0;
  /// Where the depth of most of its vertices is from.
  DepthSource source{};
  /// Whether all vertices lie on one line in space, within their standard deviations.
  bool is_straight = false;
  /// Whether it is an occluding contour: the border of an object, not a mark on its surface.
  bool is_outline = false;
};

/// A keyframe as of its marginalisation: final pose, hosted points and lines.
struct KeyframeRecord {
  /// Index of its frame in the source.
  int frame_index = 0;
  /// Time of its frame.
  Timestamp time;
  /// Number of its segment (FrameRecord::segment).
  int segment = 0;
  /// Final pose.
  SE3 T_world_cam;
  /// Points that the keyframe hosts.
  std::vector<EdgePoint> points;
  /// Lines that the keyframe hosts; empty with `--edge-map off`, and of a doubtful keyframe.
  std::vector<EdgeLine> lines;
  /// Whether the keyframe was made in doubt and never confirmed (confidence/integrity_monitor.h): its pose
  /// and points are not to be trusted.
  bool is_doubtful = false;
};

/// A number that a camera file may have wrong: residual radial coefficients k1 and k2 (radial.h), read-out
/// time of a rolling shutter in seconds, and the true focal length over that of the file, less 1.
enum class CameraNumber { kK1, kReadout, kK2, kFocal };
/// How many there are.
constexpr int kCameraNumbers = 4;

/// Standard deviations from which a value is improbable; the default of camera.significance.
constexpr double kImprobable = 3;
/// The largest error of each number that is considered: beyond it a camera file is wrong in another way.
constexpr std::array<double, kCameraNumbers> kLargestCameraError{0.03, 0.1, 0.5, 0.7};
/// Matches are found with the camera in use and are biased towards it: what they still miss, over what they
/// show. 0 to 1.1, rms 0.55 in ten first estimates of files that were 5 to 20 % off.
constexpr double kMissedByMatches = 0.5;

/// What is known of the numbers of a camera, by CameraNumber.
struct CameraGaussian {
  /// Differences from the camera file.
  Eigen::Matrix<double, kCameraNumbers, 1> mean = Eigen::Matrix<double, kCameraNumbers, 1>::Zero();
  /// Their covariance, where the camera in use is right. Zero of what is given.
  Eigen::Matrix<double, kCameraNumbers, kCameraNumbers> covariance =
      Eigen::Matrix<double, kCameraNumbers, kCameraNumbers>::Zero();
  /// Number of keyframes that it is based on; 0: nothing is known.
  int keyframes = 0;

  /// Mean of a number.
  double mean_of(CameraNumber n) const { return mean[int(n)]; }
  /// Standard deviation of a number; 0: unknown.
  double sigma_of(CameraNumber n) const { return std::sqrt(covariance(int(n), int(n))); }
  /// Sets a number by itself.
  void set(CameraNumber n, double value, double sigma);
};

/// Outcome of self-calibration.
struct CameraPosterior {
  /// What is said of a number; only kApplied changes the images.
  enum class State { kOff, kTooEarly, kNotObservable, kInsignificant, kApplied, kAtLimit };

  /// All numbers together, by file, matches and followed corners.
  CameraGaussian whole;
  /// k1 and the read-out time where the focal length is as applied and k2 as in the file, by file and
  /// matches.
  CameraGaussian given;
  /// What images and map are corrected by: k1 and the focal length are 0, and readout_s as given, unless they
  /// are kApplied.
  ImageCorrection applied;
  /// The read-out time that was given, seconds.
  double readout_given_s = 0;
  /// Whether a number is sought, by CameraNumber.
  std::array<bool, kCameraNumbers> is_sought{};

  /// What followed corners show of the focal length (self_calibration/focal_by_corners.h).
  struct Corners {
    /// True focal length over that of the file, less 1, and its standard deviation; sigma 0: no estimate.
    double focal = 0, sigma = 0;
    /// Number of windows of views that it is based on, and of those that were weighed against the map.
    int windows = 0, windows_weighed = 0;
  };
  /// That of the corners.
  Corners corners;

  /// What is said of k1, the read-out time or the focal length. Not observable: the largest error that is
  /// considered would not be improbable.
  State state_of(CameraNumber n) const;
  /// Whether the search for k1 or the read-out time ended at the largest error that is considered.
  bool is_at_limit(CameraNumber n) const;
  /// Standard deviation of the focal length, with what matches may miss.
  double focal_sigma() const;
  /// Whether the focal length in use is improbable.
  bool contradicts_focal_length() const;
};

/// Names of the states in files, in the order of the enum. "at_limit": the estimate exceeds any plausible
/// residual of a roughly correct camera file; nothing is applied, and the file is wrong in some other way.
const std::vector<std::string>& camera_state_names();
/// Name of `state` in camera_state_names().
inline const std::string& to_string(CameraPosterior::State state) {
  return camera_state_names()[size_t(state)];
}

/// Metres per unit of the odometry at one frame: `factor` from the whole run, `live_factor` from the frames
/// up to this one.
struct FrameScale {
  /// Factor and its relative standard deviation.
  double factor = 1, sigma = 0;
  /// Number of measurements; 0: taken from the nearest frame that has some.
  int samples = 0;
  /// Live factor and its relative standard deviation; 0: not known yet.
  double live_factor = 0, live_sigma = 0;
};

/// A source of scale that contradicts the others, or the steadiness of the run's unit, over some frames. It
/// does not count there.
struct ScaleFault {
  /// The source as --scale names it.
  std::string source;
  /// Indices in the source of images of the first and the last frame.
  int first_frame = 0, last_frame = 0;
  /// Logarithm of the lengths that it measures over those of the run, and its standard deviation; 0 and 0
  /// where its positions are displaced.
  double log_excess = 0, log_excess_sigma = 0;
  /// Displacement of its positions, metres, of scattered ones the largest; 0 where its lengths are wrong.
  double displacement = 0;
  /// Number of positions, of those between the frames, that are scattered; 0: all are displaced alike.
  int scattered = 0;
};

/// By how much a sensor stamps its positions later than the camera stamps its images, and the standard
/// deviation of that, seconds.
struct ClockOffset {
  /// Negative: earlier.
  double late_s = 0, sigma_s = 0;
};

/// Metric scale of a run; statistics over the frames with a pose.
struct ScaleRecord {
  /// Medians of the factor and of its relative standard deviation.
  double factor = 1, sigma = 0;
  /// Smallest and largest factor: the drift of the scale before it was corrected.
  double lowest = 1, highest = 1;
  /// Number of frames without a scale measurement.
  int frames_carried_over = 0;
  /// Scale of each frame, parallel to Run::frames; empty if one factor was given.
  std::vector<FrameScale> frames;
  /// What did not count, by source and time.
  std::vector<ScaleFault> faults;
  /// Clocks that were found to be off, by source as --scale names it. The scale is that of corrected stamps.
  std::map<std::string, ClockOffset> clock_offsets;
  /// Reason why the requested scale is not available; else empty.
  std::string problem;
};

/// How the map of a segment was placed in the world.
struct SegmentRecord {
  /// In words: "origin", "views of both maps", "equal speed", "ratio of depths", "nothing (standstill)".
  std::string placed_by;
  /// Standard deviation of the logarithm of its scale against the segment before; 0 for the first.
  double scale_sigma = 0;
};

/// An interval of a segment within which the unit of length is one. Between two of them lies a doubt.
struct EpochRecord {
  /// Number of its segment, and its own within that, from 0.
  int segment = 0, epoch = 0;
  /// Indices in the source of its first and its last frame with a pose.
  int first_frame = 0, last_frame = 0;
  /// Length in the run over length as it was measured in the epoch; before --scale.
  double scale = 1;
  /// Standard deviation of the logarithm of that; 0 for the first one.
  double scale_sigma = 0;
};

/// What was found to relate two keyframes.
struct ConstraintRecord {
  /// What shows it, as in the messages: "features", ...
  std::string kind;
  /// Indices in the source of the frames of the keyframes; from_frame -1: a map that was kept.
  int from_frame = 0, to_frame = 0;
  /// Length in the map of the first over the same length in that of the second, as measured there.
  double scale = 1;
  /// Standard deviation of the logarithm of that.
  double scale_sigma = 0;
  /// Whether the others agree with it; if not in its unit or its place, that was taken for a mistake.
  bool holds = true;
};

/// Work that a --realtime run has skipped so that poses came in time.
struct ShedWork {
  /// Keyframes whose edges made no lines.
  int lines = 0;
  /// Frames between keyframes that refined no depths.
  int depths = 0;
  /// Keyframes that got half the points.
  int points = 0;
};

/// How a --realtime run kept up with its source; the latency of each frame is in its FrameRecord.
struct RealtimeRecord {
  /// When frames were due, in words.
  std::string pace;
  /// Frames delivered to the odometry.
  int delivered = 0;
  /// Delivered frames that the odometry took more than a millisecond after they were due.
  int late = 0;
  /// Frames dropped because too many were waiting, or because their poses would have come too late; each has
  /// a row, without a pose.
  int dropped = 0;
  /// Frames with a pose that did not refine depths because the mapping was behind.
  int skipped_by_mapping = 0;
  /// What was skipped.
  ShedWork shed;
  /// Delivered frames per second, from when the first was due until the last had its pose.
  double frames_per_second = 0;
};

/// Complete result of a run.
struct Run {
  /// Pinhole of the rectified images (OdometryOptions::working_pinhole), with camera.applied.k1 removed;
  /// EdgePoint::px refers to it.
  Pinhole pinhole;
  /// Result of self-calibration.
  CameraPosterior camera;
  /// One record for each input frame, in time order.
  std::vector<FrameRecord> frames;
  /// Keyframes in time order.
  std::vector<KeyframeRecord> keyframes;
  /// The segments by their number; empty if that is not known.
  std::vector<SegmentRecord> segments;
  /// The epochs in time order; empty if they are not known.
  std::vector<EpochRecord> epochs;
  /// What relates them.
  std::vector<ConstraintRecord> constraints;
  /// Source of the scale; "none": unit arbitrary; else metres.
  std::string scale_source = "none";
  /// Scale by which all lengths of the run have been multiplied.
  ScaleRecord scale;
  /// Timing of a realtime run; nullopt for a synchronous run.
  std::optional<RealtimeRecord> realtime;
  /// Mount of the camera (vehicle x forward, y left, z up; metres), if it is known.
  std::optional<SE3> T_vehicle_cam;

  /// Whether lengths are metres.
  bool is_metric() const { return scale_source != "none"; }
  /// Whether the factor changed along the run by more than drift explains: the odometry itself was then
  /// wrong, and so may be the metres between the measurements.
  bool scale_varies() const {
    constexpr double kMaxDrift = 1.3;  // over hundreds of metres a monocular scale drifts by a tenth
    return scale.highest > kMaxDrift * scale.lowest;
  }
};

/// Point of a keyframe in the keyframe's camera frame.
inline Eigen::Vector3d point_in_camera(const Pinhole& pinhole, const EdgePoint& p) {
  return pinhole.ray(p.px.cast<double>()) / double(p.idepth);
}

/// Vertex of a line of a keyframe in the keyframe's camera frame.
inline Eigen::Vector3d point_in_camera(const Pinhole& pinhole, const EdgeVertex& v) {
  return pinhole.ray(v.px.cast<double>()) / double(v.idepth);
}

/// Rotation from the world frame to the exported one: z up, x forward at the first image (REP-103, MRPT): x =
/// z_cam, y = -x_cam, z = -y_cam.
inline SE3 T_zup_world() {
  Eigen::Matrix3d R;
  R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return {R, Eigen::Vector3d::Zero()};
}

/// Unit of the numbers in a file, for its header: "metre (scale from odometry, +- 0.8 %)" or "arbitrary
/// (...)".
std::string unit_statement(const Run& run);

/// Transform from the run's world frame to that of the map files: z up, x forward, origin at the first pose
/// of the vehicle. "Up" is the vehicle's if the mount is known; else the camera is assumed to look straight
/// ahead (T_zup_world). The lever arm is in metres and is ignored while the scale is arbitrary: the origin is
/// then the first camera.
inline SE3 T_map_world(const Run& run) {
  if (!run.T_vehicle_cam) return T_zup_world();
  return {run.T_vehicle_cam->rotation(),
          run.is_metric() ? run.T_vehicle_cam->translation() : Eigen::Vector3d(Eigen::Vector3d::Zero())};
}

}  // namespace edgevo
