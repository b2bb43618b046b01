// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Corners followed from image to image (patch_flow.h). They know nothing of edges, poses or depths.
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/features/followed_corner.h"
#include "patch_flow.h"

namespace edgevo {

/// A corner in the newest image.
struct CornerTrack {
  /// Ascends over the whole run; a lost corner's number is not used again.
  uint32_t id = 0;
  /// Pixel of the level in which corners are followed.
  Eigen::Vector2f px;
  /// Motion since the image before, pixels; the search in the next one starts there.
  Eigen::Vector2f motion = Eigen::Vector2f::Zero();
};

/// The corners of one image, by ascending id.
struct CornerView {
  /// Camera of the level in which corners are followed.
  Pinhole pinhole;
  std::vector<CornerTrack> tracks;
};

/// Where the search for a corner starts in the next image, pixels.
struct ExpectedCorner {
  uint32_t id = 0;
  Eigen::Vector2f px;
};

/// Follows corners and replaces those that are lost.
class CornerTracks {
 public:
  /// Moves all corners to the next image, drops those that are lost, and finds new ones where few are left.
  /// `expected`, by ascending id, are the starts of the search; corners without one go on as they moved.
  /// Keeps the frame until the next one. Cost: 0.25 ms at 1241x376.
  void follow(const std::shared_ptr<const FramePyramid>& pyramid,
              const std::vector<ExpectedCorner>& expected);
  /// Drops a corner: it is on something that moves, or slid along an edge.
  void drop(const std::vector<uint32_t>& ids);
  /// Drops the corners that have moved in the newest image.
  void drop_moving();
  /// Drops the corners at such pixels of the finest level.
  void drop_where(const std::function<bool(const Eigen::Vector2d& px)>& is_foreign);

  /// The corners of the newest image.
  const CornerView& view() const { return view_; }
  /// The same as viewing rays.
  std::vector<FollowedCorner> followed() const;

 private:
  void choose_level(const FramePyramid& frame);
  void move(const FlowImage& now, const std::vector<ExpectedCorner>& expected);
  void refill(const ImageView<uint8_t>& coarse);
  void add(const std::vector<std::pair<float, cv::Point>>& corners);

  int level_ = 0;
  CornerView view_;
  std::optional<FlowImage> before_;  // the image before
  uint32_t next_id_ = 0;
  int frames_since_refill_ = 0;
  int wanted_ = 80;
};

}  // namespace edgevo
