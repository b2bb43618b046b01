// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The paper's study of data association (section V-A, Fig. paramstudy), from frames with exact depth and pose
// to numbers.
//
// For each host frame and each distance: 800 edge points get noisy depths; the front-end tracks the target
// against them; each method finds them in the target; a two-view adjustment solves for pose and depths; its
// translation is compared with the truth. Everything is run on the original frames and once more with the
// target under changed light.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "edgevo/study/confidence_curve.h"
#include "edgevo/study/exact_frames.h"
#include "edgevo/study/match_error.h"

namespace edgevo {

/// Options of a study; the defaults are those of the published tables.
struct StudyOptions {
  /// Number of points in each host frame.
  int points = 800;
  /// Standard deviation of the inverse depth, relative (study_points.h).
  double noise = 0.05;
  /// Number of host frames, spread over the sequence.
  int pairs = 40;
  /// Number of frames between host and target in curves 1 and 2.
  int distance = 2;
  /// Largest number of frames between host and target in curve 3.
  int max_distance = 8;
  /// Range of frames used, begin <= index < end; -1: to the last.
  int begin = 0, end = -1;
  /// Kind of lighting change (simulation/relight.h).
  std::string light = "mixed";
  /// Seed of points, noise and light.
  uint64_t seed = 1;
  /// Number of threads; affects nothing but times.
  int threads = 2;
};

/// Result of one method on one pair.
struct StudySample {
  /// Drift |t - t_true| / |t_true| in per cent, at most 100, which also stands for a failure.
  double drift_percent = 100;
  /// Angle between the solved and the true rotation, degrees.
  double rotation_deg = 0;
  /// Angle between t and t_true, degrees; independent of the scale and hence of the depth noise.
  double direction_deg = 0;
  /// True if tracking was lost or there were too few matches.
  bool failed = true;
  /// Number of matches found, and of those with a 2-D residual.
  int matches = 0, photometric = 0;
  /// Wrong share and median error in pixels of the photometric matches (of all matches for flow methods).
  double wrong_share = 0, median_px = 0;
  /// CPU time of matching, adjustment and tracking, milliseconds.
  double match_ms = 0, solve_ms = 0, track_ms = 0;
};

/// One point of a curve: all pairs of one method with one setting.
struct StudyCell {
  /// Curve: "search_length", "patch_size", "frame_distance", "residuals", "variants" or "confidence".
  std::string curve;
  /// Light: "normal" or "changed".
  std::string light;
  /// Method: "gradient", "intensity", "census", "lucas_kanade", "epipolar_flow", ...
  std::string method;
  /// Setting: "0.25", "max", "adaptive", ...
  std::string setting;
  /// Position of the setting on the axis.
  int position = 0;
  /// One sample for each host, in order.
  std::vector<StudySample> samples;

  /// Errors of the individual matches of all pairs; only for the curves "residuals" and "confidence".
  std::vector<MatchError> errors;
};

/// All curves of a study.
struct StudyResult {
  /// Options of the study.
  StudyOptions options;
  /// Name of the frames, ExactFrames::name().
  std::string source;
  /// Median flow of the points visible one frame later, pixels.
  double median_flow_px_per_frame = 0;
  /// Cells, curve by curve.
  std::vector<StudyCell> cells;
};

/// Throws InputError if run_study() cannot start: too few frames for the distances, an unknown kind of light.
void check_study(const ExactFrames& frames, const StudyOptions& options);

/// Runs the study. Throws InputError as check_study() does, and for depth and poses that are inconsistent.
/// `on_host_done` receives the number of hosts done, one call at a time.
StudyResult run_study(const ExactFrames& frames, const StudyOptions& options,
                      const std::function<void(int)>& on_host_done = {});

}  // namespace edgevo
