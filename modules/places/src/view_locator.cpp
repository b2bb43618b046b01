// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/places/view_locator.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "edgevo/core/angle.h"
#include "edgevo/core/motion_tolerance.h"
#include "queries_in_a_row.h"

namespace edgevo {
namespace {

// Adjacent: their view has moved by less, radians. From one image to the next a camera that can be
// followed at all moves it by a tenth of that.
constexpr double kAdjacent = 0.25;

struct Found {
  LocatedPose pose;
  double edges_log_alarms = 0;
};

double turn_between(const SE3& a, const SE3& b) { return (a.inverse() * b).log().tail<3>().norm(); }
double distance_in_depths(const SE3& a, const LocatedPose& b) {
  return (a.translation() - b.T_world_cam.translation()).norm() / b.median_depth;
}

// Not one pose, by the tolerance of a right motion.
bool are_apart(const LocatedPose& a, const LocatedPose& b) {
  return distance_in_depths(a.T_world_cam, b) > kMotionTolerance.share_of_depth ||
         turn_between(a.T_world_cam, b.T_world_cam) > rad(kMotionTolerance.rotation_deg);
}

bool are_adjacent(const LocatedPose& a, const LocatedPose& b) {
  return view_difference(b.T_world_cam, a) < kAdjacent;
}

}  // namespace

double view_difference(const SE3& T_world_cam, const LocatedPose& located) {
  return distance_in_depths(T_world_cam, located) + turn_between(T_world_cam, located.T_world_cam);
}

ViewLocator::ViewLocator(std::shared_ptr<const PlaceStore> map) : map_(std::move(map)) {
  for (size_t i = 0; i < map_->size(); ++i)
    if (map_->keyframes()[i].view) index_.add(*map_->keyframes()[i].view), keyframe_of_.push_back(i);
}

std::optional<LocatedPose> ViewLocator::by_image(const RememberedView& view) {
  std::vector<Found> found;
  for (const int candidate : index_.candidates(view, kCandidates, &votes_)) {
    const size_t at = keyframe_of_[size_t(candidate)];
    const StoredKeyframe& place = map_->keyframes()[at];
    const PlaceView a{*place.view, map_->points_around(at)};
    if (const std::optional<LocatedView> located = locate_view(map_->pinhole(), a, view))
      found.push_back(
          {{place.record->T_world_cam * located->T_a_b, located->covariance, located->median_depth},
           located->evidence.edges_log_alarms});
  }
  if (found.empty()) return std::nullopt;
  const Found& best = *std::min_element(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return a.edges_log_alarms < b.edges_log_alarms;
  });
  const bool is_ambiguous =
      std::any_of(found.begin(), found.end(), [&](const Found& f) { return are_apart(f.pose, best.pose); });
  return is_ambiguous ? std::nullopt : std::optional(best.pose);
}

std::optional<LocatedPose> ViewLocator::locate(const FramePyramid& pyramid) {
  recent_.push_back(by_image(remember_view(pyramid)));
  if (recent_.size() > kRecent) recent_.pop_front();
  const std::optional<LocatedPose>& newest = recent_.back();
  if (!newest) return std::nullopt;
  const auto agreeing = std::count_if(recent_.begin(), recent_.end(),
                                      [&](const auto& pose) { return pose && are_adjacent(*newest, *pose); });
  return size_t(agreeing) >= kAgreeing ? newest : std::nullopt;
}

std::function<std::optional<LocatedPose>(const FramePyramid&)> locate_in(
    std::shared_ptr<const PlaceStore> map) {
  if (!map) return {};
  const auto locator = std::make_shared<ViewLocator>(std::move(map));
  return [locator](const FramePyramid& pyramid) { return locator->locate(pyramid); };
}

}  // namespace edgevo
