#pragma once
// Two-view bootstrap: corners are followed from the first view until their parallax allows an essential
// matrix; the frames in between are placed by PnP. Says at every frame why it is not ready yet.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/mapping/mapping_params.h"

namespace edgevo {

/// Corners that must survive; of those that are triangulated half as many.
constexpr int kMinBootstrapCorners = 80;
/// Median depth of the first map: this sets the arbitrary unit of length.
constexpr double kFirstMedianDepth = 10.0;

/// A frame of the bootstrap with its pose; the first view is the origin.
struct BootstrapView {
  int frame_index = 0;                          ///< in the source
  Timestamp time;                               ///< of the frame
  std::shared_ptr<const FramePyramid> pyramid;  ///< empty for frames whose image was not kept
  SE3 T_cam_first;                              ///< first view to this camera, unit of the bootstrap
  bool placed = false;                          ///< false: PnP failed, no pose
};

/// A corner triangulated from the two views, in the first camera.
struct BootstrapCorner {
  Eigen::Vector2d px_first, px_last;         ///< pixels, in the first view and in the last
  double idepth_first = 0, idepth_last = 0;  ///< 1/z in the first camera and in the last, > 0
};

/// Two views that make a map, and what lies between them.
struct BootstrapResult {
  std::vector<BootstrapView> views;      ///< all frames from the first view to the last
  std::vector<BootstrapCorner> corners;  ///< inliers
  double parallax_deg = 0;               ///< median
};

/// What the newest frame brought.
struct BootstrapStatus {
  std::optional<BootstrapResult> result;  ///< none: not ready yet
  std::string reason;                     ///< why there is no result yet, a short sentence
};

/// Waits for two views with enough parallax.
class Bootstrap {
 public:
  Bootstrap(const Pinhole& pinhole, const BootstrapParams& params, uint64_t seed);  ///< `seed` of its RANSAC
  ~Bootstrap();

  /// Next frame. Corners are followed on histogram-equalised images, so that a changing exposure does no
  /// harm.
  [[nodiscard]] BootstrapStatus add(int frame_index, Timestamp time,
                                    std::shared_ptr<const FramePyramid> pyramid);
  /// Forgets everything.
  void reset();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
