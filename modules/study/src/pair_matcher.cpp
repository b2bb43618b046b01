// SPDX-License-Identifier: BSD-3-Clause
#include "pair_matcher.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/video/tracking.hpp>

#include "edgevo/association/warp.h"
#include "epipolar_flow.h"

namespace edgevo {
namespace {

constexpr double kMaxSigmas = 3.5;  // standard deviations: rejects one in two thousand correct matches

// A flow match is weighted like a photometric match of associate().
Match flow_match(const StudyPoint& p, const TargetView& target, const Eigen::Vector2d& px) {
  const AssociationParams params;
  Match m;
  m.kind = MatchKind::kPhotometric;
  m.px = px;
  m.normal =
      warp_normal(patch_warp(target.pyramid->finest().pinhole, target.T_start, p.px, p.idepth), p.normal);
  m.inv_sigma_normal = 1 / params.sigma_normal_px;
  m.inv_sigma_tangent = 1 / params.sigma_tangent_px;
  return m;
}

class AssociationMatcher : public PairMatcher {
 public:
  AssociationMatcher(const AssociationParams& params, const PatchComparison& comparison)
      : params_(params), comparison_(comparison) {}

  bool needs_front_end() const override { return true; }
  std::vector<Match> match(const HostView& host, const TargetView& target) const override {
    std::vector<Match> matches;
    matches.reserve(host.points.size());
    for (const StudyPoint& p : host.points)
      matches.push_back(
          associate(query(host, target, p, p.idepth, target.track.T_cur_ref, target.track.covariance),
                    params_, comparison_));
    return matches;
  }

  void update(const HostView& host, const TargetView& target, const TwoViewSolution& solution,
              std::vector<Match>* matches) const override {
    const Matrix6d adjusted_covariance = 1e-8 * Matrix6d::Identity();  // as in the window after an adjustment
    for (size_t i = 0; i < matches->size(); ++i) {
      Match& m = (*matches)[i];
      if (m.kind == MatchKind::kNone) continue;
      if (!needs_update(m, solution.residual_normal_px[i], solution.residual_tangent_px[i], params_))
        continue;
      m = associate(query(host, target, host.points[i], solution.idepth[i], solution.T_target_host,
                          adjusted_covariance),
                    params_, comparison_);
    }
  }

 private:
  static AssociationQuery query(const HostView& host, const TargetView& target, const StudyPoint& p,
                                double idepth, const SE3& T, const Matrix6d& covariance) {
    return {host.pyramid.get(), target.pyramid.get(), p.px, p.normal, idepth, p.idepth_sigma, T, covariance};
  }

  AssociationParams params_;
  const PatchComparison& comparison_;
};

cv::Mat gray_of(const FramePyramid& pyramid) {
  const ImageView<uint8_t> view = pyramid.finest().gray.view();
  return cv::Mat(view.height, view.width, CV_8U, const_cast<uint8_t*>(view.data), size_t(view.stride));
}

// Points that are found, and tracked back to within a pixel.
std::vector<uchar> track_both_ways(const cv::Mat& first, const cv::Mat& second,
                                   const std::vector<cv::Point2f>& from, std::vector<cv::Point2f>* to) {
  constexpr float kMaxReturnPx = 1;  // a correct track returns within its own error, some tenths
  const cv::Size window(21, 21);
  std::vector<uchar> found, found_back;
  std::vector<float> error;
  std::vector<cv::Point2f> back;
  cv::calcOpticalFlowPyrLK(first, second, from, *to, found, error, window, 3);
  cv::calcOpticalFlowPyrLK(second, first, *to, back, found_back, error, window, 3);
  for (size_t i = 0; i < from.size(); ++i) {
    const cv::Point2f d = back[i] - from[i];
    found[i] = found[i] && found_back[i] && d.dot(d) <= kMaxReturnPx * kMaxReturnPx;
  }
  return found;
}

class LucasKanadeMatcher : public PairMatcher {
 public:
  bool needs_front_end() const override { return false; }
  std::vector<Match> match(const HostView& host, const TargetView& target) const override {
    std::vector<cv::Point2f> from, to;
    for (const StudyPoint& p : host.points) from.emplace_back(float(p.px.x()), float(p.px.y()));
    const std::vector<uchar> found =
        track_both_ways(gray_of(*host.pyramid), gray_of(*target.pyramid), from, &to);
    std::vector<Match> matches(from.size());
    for (size_t i = 0; i < from.size(); ++i)
      if (found[i]) matches[i] = flow_match(host.points[i], target, {double(to[i].x), double(to[i].y)});
    return matches;
  }
};

class EpipolarFlowMatcher : public PairMatcher {
 public:
  bool needs_front_end() const override { return false; }
  std::vector<Match> match(const HostView& host, const TargetView& target) const override {
    std::vector<Eigen::Vector2d> from;
    for (const StudyPoint& p : host.points) from.push_back(p.px);
    const std::vector<FlowMatch> flow = epipolar_flow(*host.pyramid, *target.pyramid, from);
    std::vector<Match> matches(from.size());
    for (size_t i = 0; i < from.size(); ++i)
      if (flow[i].found) matches[i] = flow_match(host.points[i], target, flow[i].px);
    return matches;
  }
};

}  // namespace

void PairMatcher::update(const HostView&, const TargetView&, const TwoViewSolution& solution,
                         std::vector<Match>* matches) const {
  for (size_t i = 0; i < matches->size(); ++i) {
    Match& m = (*matches)[i];
    const double sigmas = std::hypot(solution.residual_normal_px[i] * m.inv_sigma_normal,
                                     solution.residual_tangent_px[i] * m.inv_sigma_tangent);
    if (sigmas > kMaxSigmas) m.kind = MatchKind::kNone;
  }
}

std::unique_ptr<PairMatcher> association_matcher(const AssociationParams& params,
                                                 const PatchComparison& comparison) {
  return std::make_unique<AssociationMatcher>(params, comparison);
}
std::unique_ptr<PairMatcher> lucas_kanade_matcher() { return std::make_unique<LucasKanadeMatcher>(); }
std::unique_ptr<PairMatcher> epipolar_flow_matcher() { return std::make_unique<EpipolarFlowMatcher>(); }

}  // namespace edgevo
