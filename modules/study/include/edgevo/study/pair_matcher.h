#pragma once
// One way to find the points of a host in a target. All are followed by the same two-view adjustment, so that only the matches
// differ.
#include <memory>
#include <string>
#include <vector>

#include "edgevo/association/associate.h"
#include "edgevo/study/study_pair.h"
#include "edgevo/study/two_view_solve.h"

namespace edgevo {

/// A method to be compared. Stateless; any thread.
class PairMatcher {
 public:
  virtual ~PairMatcher() = default;
  /// It starts from the tracked pose, so that there is nothing to match where tracking is lost.
  virtual bool needs_front_end() const = 0;
  /// One match a point, kNone where there is none.
  virtual std::vector<Match> match(const HostView& host, const TargetView& target) const = 0;
  /// After a first adjustment: what does not fit is dropped, or searched again.
  virtual void update(const HostView& host, const TargetView& target, const TwoViewSolution& solution,
                      std::vector<Match>* matches) const;
};

/// Ours: associate() with these parameters; update() searches again where needs_update() says so.
std::unique_ptr<PairMatcher> association_matcher(const AssociationParams& params, const PatchComparison& comparison);

/// Pyramidal Lucas-Kanade (OpenCV, 21x21 windows, four levels), which knows neither pose nor depth. Points must be found back to
/// within a pixel.
std::unique_ptr<PairMatcher> lucas_kanade_matcher();

/// Semi-dense epipolar flow (epipolar_flow.h), likewise.
std::unique_ptr<PairMatcher> epipolar_flow_matcher();

}  // namespace edgevo
