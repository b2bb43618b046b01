#pragma once
// The paper's study of data association (section V-A, Fig. paramstudy), from frames with exact depth and pose to numbers.
//
// For each host frame and each distance: 800 edge points get noisy depths; the front-end tracks the target against them; each
// method finds them in the target; a two-view adjustment solves pose and depths; its translation is compared with the truth.
// Everything is done on the frames as they are and once more with the target under changed light.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "edgevo/study/confidence_curve.h"
#include "edgevo/study/exact_frames.h"
#include "edgevo/study/match_error.h"

namespace edgevo {

/// What is measured; the defaults are those of the published tables.
struct StudyOptions {
  int points = 800;  ///< of each host frame
  double noise = 0.05;          ///< of the inverse depth, relative (study_points.h)
  int pairs = 40;               ///< host frames, spread over the sequence
  int distance = 2;             ///< frames between host and target, curves 1 and 2
  int max_distance = 8;         ///< curve 3
  int begin = 0, end = -1;      ///< frames begin <= index < end are used; -1: to the last
  std::string light = "mixed";  ///< kind of simulation/relight.h
  uint64_t seed = 1;  ///< of points, noise and light
  int threads = 2;  ///< the numbers do not depend on it, times excluded
};

/// One method on one pair.
struct StudySample {
  double drift_percent = 100;  ///< |t - t_true| / |t_true|, at most 100, which is also what a failure counts
  double rotation_deg = 0;  ///< angle between the solved and the true rotation
  double direction_deg = 0;  ///< angle between t and t_true: what the scale, hence the noise of the depths, has no part in
  bool failed = true;        ///< tracking lost, or too few matches
  int matches = 0, photometric = 0;  ///< that were found; those of them with a 2-D residual
  double wrong_share = 0, median_px = 0;            ///< of the photometric matches (of all, for flow methods)
  double match_ms = 0, solve_ms = 0, track_ms = 0;  ///< CPU
};

/// One point of a curve: all pairs of one method with one setting.
struct StudyCell {
  std::string curve;                 ///< "search_length", "patch_size", "frame_distance", "residuals", "variants" or "confidence"
  std::string light;                 ///< "normal" or "changed"
  std::string method;                ///< "gradient", "intensity", "census", "lucas_kanade", "epipolar_flow", ...
  std::string setting;               ///< "0.25", "max", "adaptive", ...
  int position = 0;                  ///< of the setting on the axis
  std::vector<StudySample> samples;  ///< one a host, in order

  /// Errors of the single matches of all pairs; filled for the curves "residuals" and "confidence" only.
  std::vector<MatchError> errors;
};

/// All curves of a study.
struct StudyResult {
  StudyOptions options;  ///< as given
  std::string source;  ///< ExactFrames::name()
  double median_flow_px_per_frame = 0;  ///< of the points that are visible one frame later
  std::vector<StudyCell> cells;  ///< curve by curve
};

/// Throws InputError where run_study() cannot begin: too few frames for the distances, a kind of light that is not known.
void check_study(const ExactFrames& frames, const StudyOptions& options);

/// Throws InputError as check_study(), and for depth and poses that do not belong together. `on_host_done` is told how many
/// hosts are done, one call at a time.
StudyResult run_study(const ExactFrames& frames, const StudyOptions& options, const std::function<void(int)>& on_host_done = {});

}  // namespace edgevo
