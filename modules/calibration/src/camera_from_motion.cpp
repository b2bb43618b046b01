// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/calibration/camera_from_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/self_calibration/lens_estimate.h"

namespace edgevo {
namespace {

// Keyframes of the first estimate of a round, and the factor to the next one: the recording may end before
// the last. Below, hardly any point has been seen from far enough.
constexpr int kFirstEstimate = 20;
constexpr double kNextEstimate = 1.5;
// Rounds of the focal length alone, and of everything; each was seen to leave a fifth to a third of the
// error.
constexpr int kFocalRounds = 6, kWholeRounds = 4;
// Relative changes of the focal length that end either.
constexpr double kNearlyRight = 0.05, kEnough = 0.003;
// The relative standard deviation beyond which the focal length counts as not observable, at the end and
// while it is sought: far off it is known less well.
constexpr double kMaxFocalSigma = 0.05, kMaxFirstSigma = 0.3;
// Factor from the standard deviations of the matches to those of the camera. Matches of an edge in many
// keyframes are not independent, and are biased towards the prediction; the estimates of eight sequences with
// a known camera were off by 2.5 to 9 of their formal standard deviations
// (share/lab/archive/2026-11-26_camera_from_motion.md).
constexpr double kMatchesPerIndependentOne = 7;

constexpr LensPrior kFocalAlone{0.3, 0, 0, 0}, kWhole{0.1, 0.1, 0, 0.03};

// A run over the beginning of the recording, whose map is given to the adjustment.
class Round {
 public:
  Round(const Camera& camera, const LensPrior& prior, const MotionCalibrationOptions& options)
      : prior_(prior),
        wanted_(options.keyframes),
        rectification_(rectification_of(camera, OdometryOptions())) {
    OdometryParams params;
    params.edge_map.mode = "off";
    params.camera.refine = "k1";  // keeps the matches of marginalised keyframes;
    params.camera.min_keyframes = std::max(wanted_ + 1, 2 * params.camera.min_keyframes);  // applies nothing
    OdometryOptions o;
    o.seed = options.seed;
    o.move_map = [this](const Map& map) {
      look_at(map);
      return std::optional<MapMoved>();
    };
    odometry_.emplace(camera, params, o);
  }

  LensEstimate run(ImageSource& source, const std::function<bool()>& stop) {
    while (best_.keyframes < wanted_ && !(stop && stop())) {
      const std::optional<Frame> frame = source.next();
      if (!frame) break;
      odometry_->process(*frame);
    }
    return best_;
  }

 private:
  // Called once a keyframe. A lost map is followed by one that begins anew.
  void look_at(const Map& map) {
    const int keyframes = int(map.marginalised().size() + map.active().size());
    if (keyframes < last_count_) next_ = kFirstEstimate;
    last_count_ = keyframes;
    if (keyframes < std::min(next_, wanted_) || keyframes <= best_.keyframes) return;
    const LensEstimate estimate = estimate_lens(rectification_, map, prior_, {});
    if (estimate.usable) best_ = estimate;
    next_ = int(std::ceil(kNextEstimate * keyframes));
  }

  LensPrior prior_;
  int wanted_, next_ = kFirstEstimate, last_count_ = 0;
  Rectification rectification_;
  LensEstimate best_;
  std::optional<Odometry> odometry_;
};

// The file's camera with what it has wrong put right, to first order in the products of both.
Camera corrected(const Camera& camera, const LensEstimate& e) {
  Pinhole p = camera.pinhole();
  Distortion d = camera.distortion();
  d.k1 = e.k1 + d.k1 * (1 + e.focal) * (1 + e.focal);
  p.cx += p.fx * e.centre.x(), p.cy += p.fx * e.centre.y();
  p.fx = p.fy = p.fx * (1 + e.focal);
  return Camera(p, d);
}

class Search {
 public:
  Search(const SourceOpener& open, const std::string& where, const MotionCalibrationOptions& options)
      : open_(open), where_(where), options_(options) {
    const Camera images = open()->camera();
    const int w = images.width, h = images.height;
    const double f = options.focal_px > 0 ? options.focal_px : std::max(w, h);
    found_.camera.set_pinhole({f, f, 0.5 * (w - 1), 0.5 * (h - 1), w, h});
  }

  MotionCalibration run() {
    repeat(kFocalAlone, kFocalRounds, kNearlyRight);
    const LensEstimate last = repeat(kWhole, kWholeRounds, kEnough);
    check_focal_sigma(last, kMaxFocalSigma);
    const double f = found_.camera.pinhole().fx;
    found_.sigma_f_px = f * kMatchesPerIndependentOne * last.focal_sigma;
    found_.sigma_c_px = f * kMatchesPerIndependentOne * last.centre_sigma.maxCoeff();
    found_.sigma_k1 = kMatchesPerIndependentOne * last.k1_sigma;
    found_.keyframes = last.keyframes;
    return found_;
  }

 private:
  // Rounds until the focal length changes by less than `enough`, or `most` of them.
  LensEstimate repeat(const LensPrior& prior, int most, double enough) {
    LensEstimate e;
    for (int i = 0; i < most; ++i) {
      e = round(prior);
      if (std::abs(e.focal) < enough) break;
    }
    return e;
  }

  LensEstimate round(const LensPrior& prior) {
    const std::unique_ptr<ImageSource> source = open_();
    const LensEstimate e = Round(found_.camera, prior, options_).run(*source, options_.stop);
    if (options_.stop && options_.stop())
      throw InputError(where_, "interrupted before the camera was found", "nothing was written");
    if (!e.usable)
      throw InputError(where_, "makes no map of " + std::to_string(kFirstEstimate) + " keyframes",
                       "record a longer sequence, with sideways motion, or start nearer (--fov)");
    check_focal_sigma(e, kMaxFirstSigma);
    found_.camera = corrected(found_.camera, e);
    found_.camera.check(where_);
    ++found_.rounds;
    log(e);
    return e;
  }

  void check_focal_sigma(const LensEstimate& e, double most) const {
    const double sigma = kMatchesPerIndependentOne * e.focal_sigma;
    if (sigma <= most) return;
    throw InputError(where_,
                     "the motion does not determine the focal length: it is known to " +
                         fixed(100 * sigma, 0) + " % only, where " + fixed(100 * most, 0) + " % is needed",
                     "turn the camera about all its axes while you move it, or start nearer (--fov)");
  }

  void log(const LensEstimate& e) const {
    if (!options_.log) return;
    const double sigma = kMatchesPerIndependentOne * e.focal_sigma;
    options_.log("round " + std::to_string(found_.rounds) + ": focal length " +
                 fixed(found_.camera.pinhole().fx, 1) + " px +- " + fixed(100 * sigma, 1) + " %, " +
                 std::to_string(e.keyframes) + " keyframes");
  }

  const SourceOpener& open_;
  const std::string& where_;
  const MotionCalibrationOptions& options_;
  MotionCalibration found_;
};

}  // namespace

MotionCalibration camera_from_motion(const SourceOpener& open, const std::string& where,
                                     const MotionCalibrationOptions& options) {
  return Search(open, where, options).run();
}

}  // namespace edgevo
