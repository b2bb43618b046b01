#pragma once
// The beginning of a segment: two views that make a map, where that map lies in the world, and the poses of
// the frames that led to it.
#include <memory>
#include <optional>
#include <string>

#include "edgevo/mapping/bootstrap.h"
#include "edgevo/odometry/odometry_params.h"
#include "front_end.h"
#include "map_link.h"
#include "run_records.h"

namespace edgevo {

/// A segment that has begun.
struct NewSegment {
  std::shared_ptr<const Reference> reference;
  /// Of the camera, from the frame before the newest to the newest; nothing where that frame has no pose.
  std::optional<SE3> motion;
};

/// The tracking thread's.
class Bootstrapper {
 public:
  /// `map` and `records` must outlive it.
  Bootstrapper(const Pinhole& pinhole, const OdometryParams& params, uint64_t seed, MapLink* map,
               RunRecords* records);

  /// Forgets the first view.
  void reset() { bootstrap_.reset(); }
  /// The next frame: two views that may make a map, or why there are none yet.
  [[nodiscard]] BootstrapStatus add(const ArrivedFrame& now);
  /// Makes their map (MapLink::make_map), and forgets them.
  [[nodiscard]] std::string make_map(const BootstrapResult& views);
  /// The map that was made is that of `segment`: joins it to the segment before and gives the frames of the
  /// bootstrap their poses. `scale`, world over map, where it is known better than by equal speed.
  NewSegment begin_segment(int segment, const BootstrapResult& views, std::optional<double> scale);

 private:
  Bootstrap bootstrap_;
  AlignmentParams alignment_;
  MapLink* map_;
  RunRecords* records_;
};

}  // namespace edgevo
