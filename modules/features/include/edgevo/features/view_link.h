// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The relation of two views whose maps may have different units of length: the map before a failure and the
// one after it.
//
// Features matched between the images give the motion between them up to its length. Triangulated with it, a
// feature has a depth in baselines; the map on each side knows the same depth in its own unit. So each map
// measures the same baseline, and the ratio of the two is that of the units. Nothing is assumed about the
// motion in between, nor that a feature has a depth in both maps. Where the baseline is too short for that,
// features that have a depth in both maps are compared.
#include <memory>
#include <optional>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Two views of one scene, in two maps.
struct ViewLink {
  /// Motion from view a to view b, length in the unit of map a.
  SE3 T_b_a;
  /// A length in map a over the same length in map b.
  double scale = 1;
  /// Standard deviation of the logarithm of `scale`: at least what near and far features, or those of the two
  /// sides of the view, differ by, since a map that is bent has no one scale.
  double sigma = 0;
  /// Number of features that it rests on.
  int features = 0;
};

/// Links two keyframes by features that both images show; nothing if these are too few, know the ratio of the
/// units to less than 15 % by their spread, or if two halves of them differ by more than 50 %. Points whose
/// depth is only a guess (CloudPoint::host_keyframe < 0) have no say. Deterministic. Cost: some 200 ms at
/// 1241x376.
std::optional<ViewLink> link_views(const Pinhole& pinhole, const ReferenceCloud& a, const ReferenceCloud& b);

struct ViewFeatures;

/// A view whose features are found once for several links.
class LinkableView {
 public:
  /// `cloud` must outlive this. Cost: some 60 ms at 1241x376.
  explicit LinkableView(const ReferenceCloud& cloud);
  /// link_views() of this view and `b`, without finding the features again.
  std::optional<ViewLink> link_to(const Pinhole& pinhole, const LinkableView& b) const;

 private:
  const ReferenceCloud* cloud_;
  std::shared_ptr<const ViewFeatures> features_;
};

/// Pixels of the same features in two views.
struct MatchedPixels {
  /// In the first view.
  std::vector<Eigen::Vector2f> a;
  /// In the second one, in the same order.
  std::vector<Eigen::Vector2f> b;
};
/// The same from matched pixels: for tests, and for matches from elsewhere.
std::optional<ViewLink> link_views(const Pinhole& pinhole, const MatchedPixels& matches,
                                   const std::vector<CloudPoint>& a, const std::vector<CloudPoint>& b);

}  // namespace edgevo
