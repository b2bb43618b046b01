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
// Rounds of the focal length alone, and of everything; each was seen to leave a fifth to three quarters of
// the error.
constexpr int kFocalRounds = 6, kWholeRounds = 10;
// Relative changes of the focal length that end either.
constexpr double kNearlyRight = 0.05, kEnough = 0.003;
// The relative standard deviation beyond which the focal length counts as not observable, at the end and
// while it is sought: far off it is known less well.
constexpr double kMaxFocalSigma = 0.03, kMaxFirstSigma = 0.3;
constexpr LensPrior kFocalAlone{0.3, 0, 0, 0}, kPinhole{0.1, 0, 0, 0.03}, kOneTerm{0.1, 0.1, 0, 0.03},
    kTwoTerms{0.1, 0.1, 0.1, 0.03};
// Standard deviations from which a term of the distortion is taken: less adds noise.
constexpr double kSignificance = 2;

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
  const double square = (1 + e.focal) * (1 + e.focal);
  d.k1 = e.k1 + d.k1 * square, d.k2 = e.k2 + d.k2 * square * square;
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
    const double f = options.focal_px > 0 ? options.focal_px : 0.5 * std::max(w, h);
    found_.camera.set_pinhole({f, f, 0.5 * (w - 1), 0.5 * (h - 1), w, h});
    start_ = found_.camera;
  }

  MotionCalibration run() {
    repeat(kFocalAlone, kFocalRounds, kNearlyRight);
    const LensEstimate last = find_distortion();
    // What the last round has changed is not known better than that.
    const double focal_sigma = std::hypot(kSigmasOfMatches * last.focal_sigma, last.focal);
    if (found_.problem.empty()) check_focal_sigma(focal_sigma, kMaxFocalSigma);
    if (!found_.problem.empty()) {
      found_.camera = start_;
      return found_;
    }
    const double f = found_.camera.pinhole().fx;
    found_.sigma_f_px = f * focal_sigma;
    found_.sigma_c_px = f * kSigmasOfMatches * last.centre_sigma.maxCoeff();
    found_.sigma_k1 = kSigmasOfMatches * last.k1_sigma;
    found_.sigma_k2 = kSigmasOfMatches * last.k2_sigma;
    found_.keyframes = last.keyframes;
    return found_;
  }

 private:
  static bool is_significant(double k, double formal_sigma) {
    return std::abs(k) >= kSignificance * kSigmasOfMatches * formal_sigma;
  }

  // With two terms of the distortion, one or none: as many as are significant. Without a term that is there
  // the focal length is off by more than its standard deviation, so the largest of those tried is stated.
  LensEstimate find_distortion() {
    const LensEstimate one_term = repeat(kOneTerm, kWholeRounds, kEnough);
    if (!found_.problem.empty()) return one_term;
    const MotionCalibration with_one = found_;
    LensEstimate two_terms = repeat(kTwoTerms, kWholeRounds, kEnough);
    const bool has_two = found_.problem.empty();
    // With one unknown more the focal length is not known better.
    two_terms.focal_sigma = std::max(two_terms.focal_sigma, one_term.focal_sigma);
    if (has_two && is_significant(found_.camera.distortion().k2, two_terms.k2_sigma)) return two_terms;
    const int rounds = found_.rounds;
    found_ = with_one, found_.rounds = rounds;
    LensEstimate fewer = one_term;
    if (!is_significant(found_.camera.distortion().k1, one_term.k1_sigma)) {
      found_.camera = Camera(found_.camera.pinhole(), Distortion());
      fewer = repeat(kPinhole, kWholeRounds, kEnough);
    }
    fewer.focal_sigma =
        std::max({fewer.focal_sigma, one_term.focal_sigma, has_two ? two_terms.focal_sigma : 0});
    return fewer;
  }

  // Rounds until the focal length changes by less than `enough`, or `most` of them.
  LensEstimate repeat(const LensPrior& prior, int most, double enough) {
    LensEstimate e;
    for (int i = 0; i < most && found_.problem.empty(); ++i) {
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
    ++found_.rounds;
    if (!e.usable)
      give_up("makes no map of " + std::to_string(kFirstEstimate) + " keyframes",
              "record a longer sequence, with sideways motion, or start nearer (--fov)");
    else
      check_focal_sigma(kSigmasOfMatches * e.focal_sigma, kMaxFirstSigma);
    if (!found_.problem.empty()) return e;
    take(corrected(found_.camera, e));
    log(e);
    return e;
  }

  void take(const Camera& camera) {
    try {
      camera.check(where_);
      found_.camera = camera;
    } catch (const InputError&) {
      give_up("no plausible camera explains the motion", "start nearer (--fov)");
    }
  }

  void give_up(const std::string& problem, const std::string& remedy) {
    found_.problem = problem, found_.remedy = remedy;
  }

  void check_focal_sigma(double sigma, double most) {
    if (sigma <= most) return;
    give_up("the motion does not determine the focal length: it is known to " + fixed(100 * sigma, 0) +
                " % only, where " + fixed(100 * most, 0) + " % is needed",
            "turn the camera about all its axes while you move it, or start nearer (--fov)");
  }

  void log(const LensEstimate& e) const {
    if (!options_.log) return;
    const double sigma = kSigmasOfMatches * e.focal_sigma;
    options_.log("round " + std::to_string(found_.rounds) + ": focal length " +
                 fixed(found_.camera.pinhole().fx, 1) + " px +- " + fixed(100 * sigma, 1) + " %, " +
                 std::to_string(e.keyframes) + " keyframes");
  }

  const SourceOpener& open_;
  const std::string& where_;
  const MotionCalibrationOptions& options_;
  MotionCalibration found_;
  Camera start_;
};

}  // namespace

MotionCalibration camera_from_motion(const SourceOpener& open, const std::string& where,
                                     const MotionCalibrationOptions& options) {
  return Search(open, where, options).run();
}

}  // namespace edgevo
