// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The sliding window: the active keyframes of the map (map/map.h). Association with a new keyframe,
// activation of immature points, local bundle adjustment with match updates, marginalisation of the oldest
// keyframe.
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/bundle_adjustment/bundle_adjustment.h"
#include "edgevo/map/map.h"
#include "edgevo/mapping/cell_grid.h"
#include "edgevo/mapping/mapping_params.h"

namespace edgevo {

/// Size in pixels of the cells that active points are spread over.
constexpr int kActivationCellPx = 14;

/// Statistics of the window after an adjustment.
struct WindowStats {
  /// Number of matches that were adjusted.
  int observations = 0;
  /// Number of points with such matches.
  int points = 0;
  /// Number of these points that are matched in the newest keyframe.
  int matched_in_newest = 0;
  /// Number of matches with a 2-D residual.
  int photometric = 0;
  /// Robust cost per match, in sigmas squared.
  double cost_per_observation = 0;
  /// Variance of the logarithm of the unit of length that the points activated with the newest keyframe add:
  /// carried_unit_variance().
  double unit_variance = 0;
};

/// Conditions for immature points to become active.
struct ActivationPolicy {
  /// Depth observations of a point that must agree.
  int min_depths = 2;
  /// Keyframes that must match a point.
  int min_matches = 2;
  /// Most points to activate.
  int budget = std::numeric_limits<int>::max();
};

/// The sliding window of one segment. Not thread-safe.
class Window {
 public:
  /// Works on the active keyframes of `map`, which must outlive it. Throws InputError for an unknown solver.
  Window(Map* map, const Rectification& rectification, const WindowParams& params,
         const AssociationParams& association);

  /// Keyframes, oldest first.
  std::deque<Keyframe>& keyframes() { return map_->active(); }
  /// Keyframes, oldest first.
  const std::deque<Keyframe>& keyframes() const { return std::as_const(*map_).active(); }
  /// The newest keyframe; the window must not be empty.
  Keyframe& newest() { return keyframes().back(); }
  /// The newest keyframe; the window must not be empty.
  const Keyframe& newest() const { return keyframes().back(); }
  /// True if there are more keyframes than the window may hold: call remove_oldest().
  bool full() const { return int(keyframes().size()) > params_.keyframes; }
  /// Number of active points of all keyframes.
  int active_points() const;

  /// Appends the newest keyframe; ids ascend.
  void add(Keyframe keyframe) { map_->add(std::move(keyframe)); }

  /// Matches all active points with the newest keyframe; `pose_covariance` is that of its tracking. Returns
  /// the number of matches.
  int associate_newest(const Matrix6d& pose_covariance);

  /// Activates immature points that are certain enough, spread over the newest image. Two depths are of two
  /// images; one depth and one match may be of the same image, so that nothing has confirmed them: a point
  /// with one depth is only tentative until demote_unconfirmed(), and its immature point lives on. Returns
  /// the number of activated points.
  int activate(const ActivationPolicy& policy);
  /// Decides on the tentative points that are older than the newest keyframe: one that a second keyframe
  /// matches, too, stays; the others become immature again, except for those that the adjustment has dropped.
  void demote_unconfirmed();
  /// Number of points of known depth that a keyframe should see for tracking: 500, in a small image one for
  /// each four cells of the activation.
  int points_wanted() const;
  /// Number of points of known depth that the newest keyframe lacks for tracking.
  int points_lacking() const;

  /// How much less certain the newest keyframe has made the unit of length: variance of its logarithm, 0
  /// to 1. A new point has its depth by what the camera moved between the views of it; the error of that
  /// length is shared by all of them, sigma / baseline, and is in the mean depth by their share of the points
  /// in view. The points of one view share it wholly: a view that is new by thirds, and one that is at once,
  /// are alike. What is each point's own is averaged out by the others.
  double carried_unit_variance() const;

  /// Adjusts poses and depths, updates matches that moved, adjusts again, and drops what does not fit.
  WindowStats adjust();

  /// Fixes the scale of the map by a prior on the newest pose, from the bootstrap until the first keyframe
  /// leaves the window.
  void fix_bootstrap_scale();

  /// Marginalises the oldest keyframe: its information becomes part of the prior, and the map announces it
  /// with its pose relative to the four keyframes that share most matches with it. Points that it hosts and
  /// the newest keyframe matches become points of that one, if there are none of its own: without matches,
  /// since the prior has them, but with their depth and its standard deviation. What does not match the next
  /// keyframe is gone after the next adjust(). Returns the oldest keyframe with its present points.
  const Keyframe& remove_oldest();
  /// Gives the oldest keyframe to the marginalised ones at the end of a segment: the others stay as they are,
  /// and the covariances relative to them are unknown.
  const Keyframe& release_oldest();

  /// The points seen in a keyframe of the window, in its frame.
  std::vector<CloudPoint> cloud(const Keyframe& reference) const;
  /// Share of the window's points that lie in the image of `keyframe`, matched there or not; 0 without
  /// points.
  double view_share(const Keyframe& keyframe) const;
  /// The points of cloud(); if they are few (a rotation away from the map), also immature ones, whose depth
  /// is a guess.
  std::vector<CloudPoint> tracking_cloud(const Keyframe& reference) const;

  /// Replaces the prior after the keyframes of the window have moved (Map::move); one without poses changes
  /// nothing.
  void set_prior(const BaPrior& prior);

 private:
  /// Another keyframe as a host sees it.
  struct View {
    const Keyframe* target;
    SE3 T_target_host;
  };
  std::vector<View> views_from(const Keyframe& host) const;
  /// A view in whose image a point lies.
  struct Sight {
    const View* view;
    Eigen::Vector2d px;
  };
  std::vector<Sight> in_sight(const ImmaturePoint& candidate, const std::vector<View>& views) const;
  /// A keyframe whose immature points may become active.
  struct CandidateHost {
    Keyframe* keyframe;
    std::vector<View> views;
  };
  /// An immature point that lies in a cell of the newest image.
  struct Candidate {
    CandidateHost* host;
    ImmaturePoint* point;
    int cell;
    bool tried = false;
  };
  std::vector<int> count_active() const;
  void add_candidates(const ActivationPolicy& policy, CandidateHost* host,
                      std::vector<Candidate>* candidates) const;
  bool is_certain(const Candidate& candidate) const;
  MapPoint match_candidate(const Candidate& candidate, const std::vector<Sight>& sights) const;
  void add_shared_variance(const MapPoint& point, const std::vector<Sight>& sights);
  bool try_activate(const ActivationPolicy& policy, const Candidate& candidate);
  AssociationQuery query(const Keyframe& host, const MapPoint& point, const View& view) const;
  /// The window as a problem, with indices to transfer its result back.
  struct Adjustment {
    BaProblem problem;
    /// Map points of problem.points.
    std::vector<MapPoint*> points;
    /// Index into problem.observations of each match, point by point.
    std::vector<int> match_index;
  };
  Adjustment build_adjustment();
  void add_point(int host, MapPoint* point, Adjustment* adjustment) const;
  void add_corners(BaProblem* problem) const;
  void add_turns(BaProblem* problem) const;
  void take_result(const BaResult& result, const Adjustment& adjustment);
  void update_matches(const BaResult& result, const Adjustment& adjustment);
  Match match_again(const Keyframe& host, const MapPoint& point, int keyframe_id,
                    const std::vector<View>& views) const;
  void drop_unfit(const BaResult& result, const Adjustment& adjustment);
  void apply_gauge(BaProblem* problem) const;
  std::vector<NeighbourPose> neighbours_of_oldest() const;
  BaPrior marginalise_oldest(std::vector<NeighbourPose>* neighbours);
  static void drop_matches_in(int keyframe_id, Keyframe* host);
  std::optional<MapPoint> in_newest(const MapPoint& point, const SE3& T_newest_host) const;
  std::vector<MapPoint> points_to_pass_on() const;
  CloudPoint own_point(const MapPoint& point) const;
  std::optional<CloudPoint> seen_point(const Keyframe& reference, const SE3& T_reference_host,
                                       const MapPoint& point) const;
  void add_immature(const Keyframe& host, size_t wanted, std::vector<CloudPoint>* cloud) const;

  Map* map_;
  Pinhole pinhole_;
  CellGrid cells_;  // of kActivationCellPx
  WindowParams params_;
  AssociationParams association_;
  std::unique_ptr<BundleAdjuster> adjuster_;
  std::optional<BaPrior> prior_;
  bool bootstrap_gauge_ = false;  // prior_ is that of fix_bootstrap_scale
  // Of the newest keyframe: variance of its tracked position along an axis, its matches with older points,
  // its new points, and the sum over these of the variance of log depth that they share.
  double position_variance_ = 0;
  int older_points_ = 0, new_points_ = 0;
  double shared_variances_ = 0;
};

}  // namespace edgevo
