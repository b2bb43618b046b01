// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A method to find the points of a host in a target. All methods are followed by the same two-view
// adjustment, so that only the matches differ.
#include <memory>
#include <string>
#include <vector>

#include "edgevo/association/associate.h"
#include "edgevo/study/study_pair.h"
#include "two_view_solve.h"

namespace edgevo {

/// A matching method under comparison. Stateless; any thread.
class PairMatcher {
 public:
  virtual ~PairMatcher() = default;
  /// True if it starts from the tracked pose, so that nothing can be matched where tracking is lost.
  virtual bool needs_front_end() const = 0;
  /// One match for each point, kNone if there is none.
  virtual std::vector<Match> match(const HostView& host, const TargetView& target) const = 0;
  /// Called after a first adjustment: drops outliers or searches for them again.
  virtual void update(const HostView& host, const TargetView& target, const TwoViewSolution& solution,
                      std::vector<Match>* matches) const;
};

/// Matcher that uses associate() with these parameters; update() searches again where needs_update() requires
/// it.
std::unique_ptr<PairMatcher> association_matcher(const AssociationParams& params,
                                                 const PatchComparison& comparison);

/// Pyramidal Lucas-Kanade (OpenCV, 21x21 windows, four levels), which uses neither pose nor depth. Points
/// must be tracked back to within a pixel.
std::unique_ptr<PairMatcher> lucas_kanade_matcher();

/// Semi-dense epipolar flow (epipolar_flow.h), which uses neither pose nor depth.
std::unique_ptr<PairMatcher> epipolar_flow_matcher();

}  // namespace edgevo
