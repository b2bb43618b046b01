// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Two-view bootstrap: corners are followed from the first view until their parallax allows an essential
// matrix; the frames in between are placed by PnP. Reports at every frame why it is not ready yet.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/reason.h"
#include "edgevo/core/rectification.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/edges/image_motion.h"
#include "edgevo/gyro/gyro_model.h"
#include "edgevo/mapping/mapping_params.h"

namespace edgevo {

/// Least number of corners that must survive; half as many must be triangulated. Of an image of kFullSizePx
/// and more (count_for_size).
constexpr int kMinBootstrapCorners = 80;
/// Geometric mean of the sides from which on an image has the usual counts: that of 320x240, pixels.
constexpr double kFullSizePx = 277;
/// A count of corners or edge points for an image of that size: smaller ones have fewer, as their edges are
/// shorter.
int count_for_size(int count, const Pinhole& camera);
/// Median depth of the first map, which sets the arbitrary unit of length.
constexpr double kFirstMedianDepth = 10.0;

/// A frame of the bootstrap with its pose; the first view is the origin.
struct BootstrapView {
  /// Index of the frame in the source.
  int frame_index = 0;
  /// Timestamp of the frame.
  Timestamp time;
  /// Edge pyramid; null if the image was not kept.
  std::shared_ptr<const FramePyramid> pyramid;
  /// Motion of the image, by which corners and poses were found; `pyramid` is to be rebuilt for it. Unknown
  /// with a global shutter.
  ImageMotion motion;
  /// Whether the rows of `pyramid` have been rectified for `motion` already.
  bool is_straight = false;
  /// Motion from the first view to this camera, in the unit of the bootstrap.
  SE3 T_cam_first;
  /// False if PnP failed: no pose.
  bool placed = false;
};

/// A corner triangulated from the two views, in the first camera.
struct BootstrapCorner {
  /// Pixels in the first view and in the last.
  Eigen::Vector2d px_first, px_last;
  /// Inverse depths 1/z in the first camera and in the last, > 0.
  double idepth_first = 0, idepth_last = 0;
};

/// Two views that make a map, and the frames between them.
struct BootstrapResult {
  /// All frames from the first view to the last.
  std::vector<BootstrapView> views;
  /// Triangulated corners, inliers only.
  std::vector<BootstrapCorner> corners;
  /// Median parallax, degrees.
  double parallax_deg = 0;
  /// The model that the motion was found by, its error and, over several views, that of the next best motion.
  std::string why;
};

/// Outcome of the newest frame.
struct BootstrapStatus {
  /// The two views; nothing if they are not ready yet.
  std::optional<BootstrapResult> result;
  /// Why there is no result yet.
  Reasons reasons;
};

/// Rotation of the camera between two times by a gyro or a map that was kept; nothing if none knows it.
using TurnBetween = std::function<std::optional<CameraTurn>(Timestamp begin, Timestamp end)>;

/// Searches two views with enough parallax. Where the rotation between them is known otherwise, the motion
/// with it is one of those that are compared, and motions that it contradicts are none, unless the images
/// refute it.
class Bootstrap {
 public:
  /// `seed`: that of RANSAC. `turn` may be empty.
  Bootstrap(const Rectification& rectification, const BootstrapParams& params, uint64_t seed,
            TurnBetween turn = {});
  ~Bootstrap();

  /// Adds the next frame. Corners are followed on histogram-equalised images, so that a changing exposure
  /// does no harm. Without `attempt` they are only followed, a tenth of the work: for a caller that is
  /// behind. `rows`: the motion for which the rows of the image have been rectified; unknown: they have not.
  [[nodiscard]] BootstrapStatus add(int frame_index, Timestamp time,
                                    std::shared_ptr<const FramePyramid> pyramid, bool attempt = true,
                                    const ImageMotion& rows = {});
  /// Forgets all frames.
  void reset();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
