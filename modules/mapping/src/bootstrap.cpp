// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <opencv2/core.hpp>

#include "edgevo/core/angle.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/random.h"
#include "edgevo/features/corner_tracking.h"
#include "edgevo/features/two_view_motion.h"
#include "edgevo/features/view_fit.h"
#include "straight_rows.h"

namespace edgevo {
int count_for_size(int count, const Pinhole& camera) {
  const double side = std::sqrt(double(camera.width) * camera.height);
  constexpr int kFewest = 8;  // a motion by fewer is no motion
  return side < kFullSizePx ? std::max(std::min(count, kFewest), int(count * side / kFullSizePx)) : count;
}

namespace {

// Number of views whose pyramids are kept, to bound memory; three of them become keyframes. The others keep
// their corners only.
constexpr size_t kMaxKeptViews = 14;
// Corners needed for PnP: three determine a pose, but a view between the two is useless with a wrong one.
constexpr int kMinPnpCorners = 20;
// RANSAC runs that have to agree on the rotation: a single one was wrong for two of five seeds
// (lab 2026-11-22_bootstrap).
constexpr int kMotionTrials = 5;
// Frames in a row without a consensus of the corners, after which the first view counts as taken in bad light
// (lab 2026-11-22_bootstrap).
constexpr int kMaxDisagreeing = 8;
constexpr int kMaxFirstCorners = 1200;      // followed from the first view
constexpr double kBootstrapRansacPx = 0.7;  // inlier threshold of the essential matrix
constexpr double kMinInlierShare = 0.6;     // of the corners that must agree with the essential matrix
constexpr double kRefuted = 1.1;            // error of a motion over the best one
// Views between and corners by which motions are compared: more add little.
constexpr size_t kComparedViews = 6, kComparedCorners = 300;

std::string sentence(const char* pattern, double a, double b) {
  char text[160];
  std::snprintf(text, sizeof text, pattern, a, b);
  return text;
}

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
BootstrapStatus no_views(ReasonKind kind, double value = kNoNumber, double other = kNoNumber) {
  return {std::nullopt, {{kind, value, other}}};
}

// Triangulated corners of the two views.
struct Triangulation {
  std::vector<BootstrapCorner> corners;
  /// Index of each among the corners of a view.
  std::vector<int> index;
  std::vector<double> parallax_deg, depths;
};

}  // namespace

struct Bootstrap::Impl {
  Rectification rectification;
  Pinhole pinhole;
  BootstrapParams params;
  Random random{0};
  TurnBetween turn_between;
  std::vector<BootstrapView> views;
  // For each view, pixels of the corners that are still alive: as they are followed, and where all rows had
  // one time.
  std::vector<Corners> corners_in_view, straight;
  size_t first_corners = 0;          // followed from the first view on
  int disagreeing = 0;               // frames in a row
  std::optional<SE3> chosen_before;  // from the first view to the one before the newest
  cv::Mat previous;

  void reset() {
    views.clear();
    corners_in_view.clear();
    chosen_before.reset();
  }

  int min_corners() const { return count_for_size(kMinBootstrapCorners, pinhole); }

  // Makes `view` the first one. Returns false if it shows too few corners; the next frame is tried then.
  bool start(BootstrapView view, cv::Mat image) {
    reset();
    disagreeing = 0;
    Corners corners = find_corners(image, kMaxFirstCorners);
    drop_own(*view.pyramid, &corners);
    for (size_t k = corners.size(); k > 1; --k) std::swap(corners[k - 1], corners[random.below(int(k))]);
    first_corners = corners.size();
    view.placed = true;
    views.push_back(std::move(view));
    corners_in_view.push_back(std::move(corners));
    previous = std::move(image);
    const bool enough = int(first_corners) >= min_corners();
    if (!enough) reset();
    return enough;
  }

  // Makes the newest view the first one.
  BootstrapStatus start_again(const Reasons& reasons) {
    start(BootstrapView(views.back()), previous);
    return {std::nullopt, joined(reasons, {{ReasonKind::kNewFirstView}})};
  }

  BootstrapStatus take_first(BootstrapView view, cv::Mat image) {
    if (start(std::move(view), std::move(image))) return no_views(ReasonKind::kFirstView);
    return no_views(ReasonKind::kFewCorners, double(first_corners), min_corners());
  }

  BootstrapStatus take_next(BootstrapView view, cv::Mat image, bool attempt) {
    follow(std::move(view), std::move(image));
    if (const std::optional<Reason> reason = restart_reason()) return start_again({*reason});
    if (!attempt) return no_views(ReasonKind::kSearchBehind);
    BootstrapStatus status = try_two_views();
    if (disagreeing >= kMaxDisagreeing) return start_again(status.reasons);
    return status;
  }

  // Why the first view is no longer useful; nothing while it is.
  std::optional<Reason> restart_reason() const {
    const int alive = int(corners_in_view.back().size());
    const bool too_few = alive < min_corners();
    const bool too_long = int(views.size()) > params.max_frames;
    if (too_few) return Reason{ReasonKind::kCornersLost, double(alive), double(min_corners())};
    if (too_long) return Reason{ReasonKind::kTooLong};
    return std::nullopt;
  }

  // Follows the corners into `image`; those that fail the forward-backward check are removed from every view.
  void follow(BootstrapView view, cv::Mat image) {
    const Corners& from = corners_in_view.back();
    Corners to;
    const std::vector<bool> found = follow_corners(previous, image, from, &to);
    std::vector<size_t> alive;
    for (size_t i = 0; i < from.size(); ++i)
      if (found[i]) alive.push_back(i);
    corners_in_view.push_back(std::move(to));
    for (Corners& points : corners_in_view) {
      for (size_t k = 0; k < alive.size(); ++k) points[k] = points[alive[k]];
      points.resize(alive.size());
    }
    views.push_back(std::move(view));
    previous = std::move(image);
    thin_views();
  }

  // Bounds memory: of many views in between, every other image is dropped.
  void thin_views() {
    size_t kept = 0;
    for (const BootstrapView& v : views) kept += v.pyramid != nullptr;
    if (kept <= kMaxKeptViews) return;
    bool drop = false;
    for (size_t i = 1; i + 1 < views.size(); ++i) {
      if (!views[i].pyramid) continue;
      if (drop) views[i].pyramid.reset();
      drop = !drop;
    }
  }

  // A rolling shutter skews the images of a camera that turns, each at the rate of its time.
  void straighten() {
    const double row_time_s = row_time(views.back().pyramid->correction);
    straight = corners_in_view;
    if (row_time_s == 0) return;
    std::vector<Timestamp> times;
    for (const BootstrapView& v : views) times.push_back(v.time);
    std::vector<ImageMotion> motions = turning_motions(pinhole, times, corners_in_view);
    for (size_t v = 0; v < views.size(); ++v)
      if (views[v].is_straight)
        motions[v] = {};
      else
        views[v].motion = motions[v];
    straight = straighten_rows(rectification, row_time_s, motions, corners_in_view);
  }

  BootstrapStatus try_two_views() {
    const Corners &first = corners_in_view.front(), &last = corners_in_view.back();
    const double disparity =
        median_motion(params.count_lost_corners ? first_corners : first.size(), first, last);
    const double needed = params.min_disparity * pinhole.width;
    if (disparity < needed) return no_views(ReasonKind::kLittleMotion, disparity, needed);
    straighten();
    const std::optional<Choice> choice = choose(possible_motions());
    if (!choice) return no_views(ReasonKind::kNoMotionFits);
    const int agreeing = cv::countNonZero(choice->best.inliers);
    const bool too_few = agreeing < kMinInlierShare * double(first.size());
    disagreeing = too_few ? disagreeing + 1 : 0;
    if (too_few) return no_views(ReasonKind::kFewAgree, agreeing / double(first.size()), kMinInlierShare);
    if (choice->is_ambiguous) return no_views(ReasonKind::kTwoMotionsFit, agreeing);
    BootstrapStatus status = build_result(choice->best.T_last_first, choice->best.inliers);
    if (status.result)
      status.result->why = choice->why + sentence(", parallax %.1f deg", status.result->parallax_deg, 0);
    return status;
  }

  // Between the first view and the last, as another sensor has measured it.
  std::optional<TurnOfViews> known_turn() const {
    if (!turn_between) return std::nullopt;
    const auto turn = turn_between(views.front().time, views.back().time);
    return turn ? std::make_optional(TurnOfViews{turn->R, turn->covariance.inverse()}) : std::nullopt;
  }

  // Those of RANSAC and of a plane, and the one that the frame before chose.
  std::vector<TwoViewMotion> possible_motions() {
    const Corners &a = straight.front(), &b = straight.back();
    std::vector<TwoViewMotion> motions =
        estimate_motions(pinhole, a, b, kBootstrapRansacPx, kMotionTrials, &random);
    for (TwoViewMotion& m : estimate_motions_of_plane(pinhole, a, b, kBootstrapRansacPx))
      motions.push_back(std::move(m));
    if (chosen_before) {
      motions.push_back(measure_motion(pinhole, a, b, kBootstrapRansacPx, *chosen_before));
      motions.back().model = "the choice of the frame before";
    }
    return without_repeats(std::move(motions));
  }

  // Leaves those that a turn does not contradict by more than depths bear; adds the one that has it.
  void keep_to_turn(const TurnOfViews& turn, std::vector<TwoViewMotion>* motions) {
    const SE3 known(turn.R_last_first, Eigen::Vector3d::Zero());
    const auto is_refuted = [&](const TwoViewMotion& m) {
      return turn.contradicts(m.T_last_first.rotation()) && disagree(m.T_last_first, known, m.parallax_rad);
    };
    motions->erase(std::remove_if(motions->begin(), motions->end(), is_refuted), motions->end());
    const Corners &a = straight.front(), &b = straight.back();
    if (auto m = estimate_motion_with_turn(pinhole, a, b, kBootstrapRansacPx, turn, &random))
      motions->push_back(std::move(*m));
  }

  struct Choice {
    TwoViewMotion best;
    bool is_ambiguous = false;
    std::string why;
    double error_px = 0;
  };

  // With the known turn, unless the images refute it: whoever measured it may be wrong. Nothing: none fits.
  std::optional<Choice> choose(std::vector<TwoViewMotion> motions) {
    const auto best_of = [&](const TurnOfViews* turn) -> std::optional<Choice> {
      if (motions.empty()) return std::nullopt;
      return views.size() > 2 ? choose_by_views(motions, turn) : choose_by_error(motions);
    };
    const std::optional<Choice> by_images = best_of(nullptr);
    const std::optional<TurnOfViews> turn = known_turn();
    if (turn) keep_to_turn(*turn, &motions);
    if (!turn || motions.empty()) return by_images;
    const auto chosen_by_images = chosen_before;
    std::optional<Choice> with_turn = best_of(&*turn);
    const bool is_refuted = by_images && with_turn->error_px > kRefuted * by_images->error_px;
    if (is_refuted) chosen_before = chosen_by_images;
    return is_refuted ? by_images : with_turn;
  }

  static Choice choose_by_error(const std::vector<TwoViewMotion>& motions) {
    const TwoViewMotion& best =
        *std::min_element(motions.begin(), motions.end(),
                          [](const auto& m, const auto& n) { return m.median_error_px < n.median_error_px; });
    return {best, is_ambiguous(best, motions),
            std::string("motion by ") + best.model +
                sentence(", %.2f px over two views, the best of %.0f", best.median_error_px,
                         double(motions.size())),
            best.median_error_px};
  }

  // The motion that the views between allow. It is ambiguous while another one fits them about as well.
  Choice choose_by_views(const std::vector<TwoViewMotion>& motions, const TurnOfViews* turn) {
    const std::vector<Corners> views = fitted_views();
    std::vector<ViewFit> fits;
    std::vector<const char*> models;
    for (const TwoViewMotion& m : motions)
      if (const std::optional<ViewFit> fit = fit_views(pinhole, views, m.T_last_first, turn))
        fits.push_back(*fit), models.push_back(m.model);
    if (fits.empty()) return choose_by_error(motions);
    const auto best = std::min_element(fits.begin(), fits.end(),
                                       [](const auto& f, const auto& g) { return f.error_px < g.error_px; });
    chosen_before = best->T_last_first;
    Choice choice{of_two_views(best->T_last_first, turn), false, {}, best->error_px};
    double next_px = std::numeric_limits<double>::infinity();  // of a motion that disagrees
    for (const ViewFit& other : fits)
      if (disagree(other.T_last_first, best->T_last_first, choice.best.parallax_rad))
        next_px = std::min(next_px, other.error_px);
    choice.is_ambiguous = next_px < kRefuted * best->error_px;
    choice.why =
        std::string("motion by ") + models[size_t(best - fits.begin())] +
        sentence(", %.2f px over %.0f views", best->error_px, double(views.size())) +
        (std::isfinite(next_px) ? sentence(", another %.2f px", next_px, 0) : std::string(", no other fits"));
    return choice;
  }

  // The motion refined to the first and the last view, by which depths are triangulated, unless that leads
  // away to the wrong motion of a plane.
  TwoViewMotion of_two_views(const SE3& T_last_first, const TurnOfViews* turn) const {
    const Corners &a = straight.front(), &b = straight.back();
    TwoViewMotion as_it_is = measure_motion(pinhole, a, b, kBootstrapRansacPx, T_last_first);
    TwoViewMotion refined = refined_motion(pinhole, a, b, kBootstrapRansacPx, T_last_first, turn);
    return disagree(refined.T_last_first, T_last_first, as_it_is.parallax_rad) ? as_it_is : refined;
  }

  // The first view, some between in even steps, and the last, each with the same corners.
  std::vector<Corners> fitted_views() const {
    const size_t last = straight.size() - 1, steps = std::min(last, kComparedViews + 1);
    std::vector<Corners> views;
    for (size_t k = 0; k <= steps; ++k) {
      const Corners& all = straight[k * last / steps];
      views.emplace_back(all.begin(), all.begin() + std::min(all.size(), kComparedCorners));
    }
    return views;
  }

  // Triangulates the inliers that lie in front of both cameras.
  Triangulation triangulate_inliers(const SE3& T_last_first, const cv::Mat& inliers) const {
    const Corners &a = straight.front(), &b = straight.back();
    Triangulation t;
    for (size_t i = 0; i < a.size(); ++i) {
      if (!inliers.at<uchar>(int(i))) continue;
      BootstrapCorner c;
      c.px_first = {a[i].x, a[i].y};
      c.px_last = {b[i].x, b[i].y};
      const Eigen::Vector3d ray_a = pinhole.ray(c.px_first), ray_b = pinhole.ray(c.px_last);
      if (!triangulate(T_last_first, ray_a, ray_b, &c.idepth_first, &c.idepth_last)) continue;
      t.parallax_deg.push_back(deg(angle_between(T_last_first.R() * ray_a, ray_b)));
      t.depths.push_back(1.0 / c.idepth_first);
      t.corners.push_back(c);
      t.index.push_back(int(i));
    }
    return t;
  }

  BootstrapStatus build_result(const SE3& T_last_first, const cv::Mat& inliers) {
    Triangulation triangulated = triangulate_inliers(T_last_first, inliers);
    if (int(triangulated.index.size()) < min_corners() / 2)
      return no_views(ReasonKind::kFewInFront, double(triangulated.index.size()), min_corners() / 2.0);
    BootstrapResult result;
    result.corners = std::move(triangulated.corners);
    result.parallax_deg = median(triangulated.parallax_deg);
    if (result.parallax_deg < params.min_parallax_deg)
      return no_views(ReasonKind::kLittleParallax, result.parallax_deg, params.min_parallax_deg);
    const double scale = kFirstMedianDepth / median(triangulated.depths);
    for (BootstrapCorner& c : result.corners) {
      c.idepth_first /= scale;
      c.idepth_last /= scale;
    }
    views.back().T_cam_first = SE3(T_last_first.rotation(), T_last_first.translation() * scale);
    views.back().placed = true;
    place_views_between(result, triangulated.index);
    result.views = views;
    return {std::move(result), {}};
  }

  // Estimates the pose of each view in between by PnP from the triangulated corners.
  void place_views_between(const BootstrapResult& result, const std::vector<int>& used) {
    std::vector<cv::Point3f> object;
    for (const BootstrapCorner& c : result.corners) {
      const Eigen::Vector3d p = pinhole.ray(c.px_first) / c.idepth_first;
      object.emplace_back(float(p.x()), float(p.y()), float(p.z()));
    }
    if (int(object.size()) < kMinPnpCorners) return;
    const Vector6d whole = views.back().T_cam_first.log();
    for (size_t v = 1; v + 1 < views.size(); ++v) {
      Corners image;
      for (int i : used) image.push_back(straight[v][i]);
      views[v].T_cam_first = SE3::exp(whole * (double(v) / double(views.size() - 1)));
      views[v].placed = place_view(pinhole, object, image, &views[v].T_cam_first);
    }
  }
};

Bootstrap::Bootstrap(const Rectification& rectification, const BootstrapParams& params, uint64_t seed,
                     TurnBetween turn)
    : impl_(new Impl) {
  impl_->rectification = rectification;
  impl_->pinhole = rectification.target();
  impl_->params = params;
  impl_->random = Random::derive(seed, 1);
  impl_->turn_between = std::move(turn);
}
Bootstrap::~Bootstrap() = default;

void Bootstrap::reset() { impl_->reset(); }

BootstrapStatus Bootstrap::add(int frame_index, Timestamp time, std::shared_ptr<const FramePyramid> pyramid,
                               bool attempt, const ImageMotion& rows) {
  cv::Mat image = equalised(*pyramid);
  BootstrapView view;
  view.frame_index = frame_index;
  view.time = time;
  view.pyramid = std::move(pyramid);
  view.motion = rows;
  view.is_straight = rows.is_known();
  return impl_->views.empty() ? impl_->take_first(std::move(view), std::move(image))
                              : impl_->take_next(std::move(view), std::move(image), attempt);
}

}  // namespace edgevo
