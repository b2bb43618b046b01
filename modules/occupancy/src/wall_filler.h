#pragma once
// Which patches of a segment are walls: those that nothing says to be open.
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/occupancy/occupancy_params.h"
#include "wall_patches.h"

namespace edgevo {

/// What a filler asks, lengths in the unit of the map.
struct FillRules {
  double line_width = 0, line_gap = 0;  ///< which pieces of edges are one line: joined()
  PatchRules patches;
  double max_range = 0;           ///< of a piece from its keyframe
  double max_relative_sigma = 0;  ///< of the depth of its ends
};
FillRules fill_rules(const OccupancyParams& params, double resolution, double max_range);

class WallFiller {
 public:
  /// Keyframes of one segment in time order; their way opens what it leads through.
  WallFiller(const Run& run, const std::vector<const KeyframeRecord*>& keyframes, const FillRules& rules);

  /// Before the rays of a keyframe at this place.
  void look_from(const Eigen::Vector3d& eye);
  /// The space up to `end` was seen to be empty: what is crossed on the way is open.
  void see_through(const Eigen::Vector3d& end);

  /// Those that nothing has opened.
  std::vector<WallPatch> walls() const;
  int opened() const;  ///< the others

 private:
  void drive_through(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

  const FillRules rules_;
  std::vector<WallPatch> patches_;
  std::vector<char> is_open_;
  Eigen::Vector3d eye_ = Eigen::Vector3d::Zero();
  std::vector<size_t> in_reach_;  ///< patches not yet open that rays from eye_ may cross
};

}  // namespace edgevo
