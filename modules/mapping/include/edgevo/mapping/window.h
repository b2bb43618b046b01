#pragma once
// The sliding window of keyframes: association with a new keyframe, activation of immature points, local
// bundle adjustment with match updates, removal of the oldest keyframe.
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/bundle_adjustment/bundle_adjustment.h"
#include "edgevo/mapping/keyframe.h"
#include "edgevo/mapping/map_revision.h"
#include "edgevo/mapping/mapping_params.h"

namespace edgevo {

struct CellGrid;

/// Active points are spread over cells of this size, pixels.
constexpr int kActivationCellPx = 14;

/// Health of the window after an adjustment.
struct WindowStats {
  int observations = 0;             ///< matches that were adjusted
  int points = 0;                   ///< that have them
  int matched_in_newest = 0;        ///< of these points
  int photometric = 0;              ///< matches with a 2-D residual
  double cost_per_observation = 0;  ///< robust, in sigmas squared
};

/// Which immature points become active, and how many.
struct ActivationPolicy {
  /// Depth observations of a point that agree.
  int min_depths = 2;
  /// Keyframes that match it.
  int min_matches = 2;
  /// Points that are activated at most.
  int budget = std::numeric_limits<int>::max();
};

/// The sliding window of one segment. Not for several threads at a time.
class Window {
 public:
  /// Throws InputError for an unknown solver.
  Window(const Pinhole& pinhole, const WindowParams& params, const AssociationParams& association);

  std::deque<Keyframe>& keyframes() { return keyframes_; }              ///< the oldest first
  const std::deque<Keyframe>& keyframes() const { return keyframes_; }  ///< the oldest first
  Keyframe& newest() { return keyframes_.back(); }                      ///< there must be one
  const Keyframe& newest() const { return keyframes_.back(); }          ///< there must be one
  /// more keyframes than it is to hold: remove_oldest()
  bool full() const { return int(keyframes_.size()) > params_.keyframes; }
  int active_points() const;  ///< of all keyframes

  /// the newest from now on; ids ascend
  void add(Keyframe keyframe) { keyframes_.push_back(std::move(keyframe)); }

  /// Matches all active points with the newest keyframe; `pose_covariance` is that of its tracking. Returns
  /// the number of matches.
  int associate_newest(const Matrix6d& pose_covariance);

  /// Turns immature points into active ones where they are certain enough, spread over the newest image. Two
  /// depths are of two images; one and a match may be of the same, so that nothing has checked it: a point
  /// with one depth is only tentative, until demote_unconfirmed(), and its immature point lives on. Returns
  /// how many.
  int activate(const ActivationPolicy& policy);
  /// Decides on the tentative points of before the newest keyframe: one that a second keyframe matches, too,
  /// stays; the others are immature again, but for those that the adjustment has dropped, which are gone.
  void demote_unconfirmed();
  /// Points of known depth that the newest keyframe lacks for tracking: it should see 500, in a small image
  /// one for each four cells of the activation.
  int points_lacking() const;

  /// Adjusts poses and depths, updates matches that moved, adjusts again, drops what does not fit.
  WindowStats adjust();

  /// Scale of the map held by a prior on the newest pose: used from the bootstrap until the window first
  /// moves on.
  void hold_bootstrap_scale();

  /// Takes the oldest keyframe out and returns it with its points as they stand.
  Keyframe remove_oldest();

  /// The points seen in a keyframe of the window, in its frame.
  std::vector<CloudPoint> cloud(const Keyframe& reference) const;
  /// Share of the window's points that lie in the image of `keyframe`, matched there or not; 0 without
  /// points.
  double view_share(const Keyframe& keyframe) const;
  /// The points of `cloud`; where they are few (a rotation away from the map) with immature ones, whose depth
  /// is a guess.
  std::vector<CloudPoint> tracking_cloud(const Keyframe& reference) const;

  /// The camera was corrected: poses, points and prior as the revision says, images built again by `rebuild`.
  using Rebuild = std::function<std::shared_ptr<const FramePyramid>(const Keyframe&)>;
  void apply(const MapRevision& revision, const Rebuild& rebuild);  ///< moves the window to the revision

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
  std::vector<int> count_active(const CellGrid& grid) const;
  void add_candidates(const ActivationPolicy& policy, const CellGrid& grid, CandidateHost* host,
                      std::vector<Candidate>* candidates) const;
  bool is_certain(const Candidate& candidate) const;
  MapPoint match_candidate(const Candidate& candidate, const std::vector<Sight>& sights) const;
  bool try_activate(const ActivationPolicy& policy, const Candidate& candidate);
  AssociationQuery query(const Keyframe& host, const MapPoint& point, const View& view) const;
  /// The window as a problem, and how to find one's way back from it.
  struct Adjustment {
    BaProblem problem;
    std::vector<MapPoint*> points;  ///< of problem.points
    std::vector<int> match_index;   ///< of each match, point by point: its place in problem.observations
  };
  Adjustment build_adjustment();
  void add_point(int host, MapPoint* point, Adjustment* adjustment) const;
  void add_corners(BaProblem* problem) const;
  void take_result(const BaResult& result, const Adjustment& adjustment);
  void update_matches(const BaResult& result, const Adjustment& adjustment);
  Match match_again(const Keyframe& host, const MapPoint& point, int keyframe_id,
                    const std::vector<View>& views) const;
  void drop_unfit(const BaResult& result, const Adjustment& adjustment);
  void apply_gauge(BaProblem* problem) const;
  BaPrior marginalise_oldest();
  static void drop_matches_in(int keyframe_id, Keyframe* host);
  CloudPoint own_point(const MapPoint& point) const;
  std::optional<CloudPoint> seen_point(const Keyframe& reference, const SE3& T_reference_host,
                                       const MapPoint& point) const;
  void add_immature(const Keyframe& host, size_t wanted, std::vector<CloudPoint>* cloud) const;

  Pinhole pinhole_;
  WindowParams params_;
  AssociationParams association_;
  std::unique_ptr<BundleAdjuster> adjuster_;
  std::deque<Keyframe> keyframes_;
  std::optional<BaPrior> prior_;
  bool bootstrap_gauge_ = false;  // prior_ is that of hold_bootstrap_scale
};

}  // namespace edgevo
