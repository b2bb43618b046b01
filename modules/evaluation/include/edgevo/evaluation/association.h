#pragma once
// Which ground-truth pose belongs to which estimated pose, and which input frame that was.
//
// Ground truth may have a rate of its own (motion capture at 100 Hz under images at 30 Hz), so it is interpolated to the
// estimate's times: positions linearly, rotations by slerp. Outside its span, or inside a hole of more than ten of its
// median steps, there is no match: nobody knows where the camera was.
//
// What the metrics need to know beside the poses is the INPUT: the frames that the system was given, posed or not.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/evaluation/trajectory.h"

namespace edgevo {

/// The ground truth at `time`; nullopt where it does not say. A time up to 0.1 ms outside the span (rounding of the
/// files) counts as its end. Cost: logarithmic, after one linear pass in the constructor.
class GroundTruth {
 public:
  /// Keeps a reference; poses in time order.
  explicit GroundTruth(const Trajectory& trajectory);
  std::optional<SE3> at(Timestamp time) const;  ///< interpolated T_world_cam

 private:
  const std::vector<StampedPose>* poses_;  ///< not owned: the trajectory must outlive this
  int64_t longest_gap_ticks_;
};

/// The frames that were put into the system, in time order.
struct InputFrames {
  std::vector<Timestamp> times;  ///< ascending
  std::string source;  ///< how they were found, for the report
};

/// Finds the input frames, taking the first of these that there is:
///   1. `frames_total` (a count that the user gives): that many frames, spaced by the estimate's median step;
///   2. frames.csv in the folder of the trajectory (a run of `edgevo run`): its rows;
///   3. times.txt in the folder of the ground truth (a sequence in the `edgevo` layout): its lines;
///   4. the ground truth's own lines, where most of the estimate's times are among them and the median steps are alike;
///   5. the estimate's span at its median step: frames lost before its first and after its last pose go unnoticed.
/// Throws InputError for a file of 2. or 3. that is there but broken.
InputFrames find_input_frames(const Trajectory& estimate, const Trajectory& ground_truth,
                              std::optional<int> frames_total);

/// An estimated pose with its ground truth.
struct MatchedPose {
  Timestamp time;  ///< of the estimated pose
  int frame = 0;  ///< index of the nearest input frame
  SE3 T_est;      ///< estimate, its own world and unit
  SE3 T_gt;       ///< ground truth at `time`, metres
};

/// One input frame.
struct EvaluatedFrame {
  std::optional<SE3> T_gt;   ///< at the pose's time if there is one, else at the frame's
  int match = -1;            ///< index into Association::matches; -1: no pose, or none with ground truth
  bool has_pose = false;     ///< the estimate holds a pose for it, whether or not ground truth does
};

/// The estimate beside its ground truth, by pose and by input frame.
struct Association {
  std::vector<MatchedPose> matches;     ///< in time order
  std::vector<EvaluatedFrame> frames;   ///< one for each input frame
  int without_ground_truth = 0;         ///< estimated poses outside the ground truth
};

/// Throws InputError with fewer than three matches.
Association associate(const Trajectory& estimate, const Trajectory& ground_truth, const InputFrames& input);

}  // namespace edgevo
