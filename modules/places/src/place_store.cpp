// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/places/place_store.h"

#include <algorithm>

#include "edgevo/alignment/projection.h"
#include "edgevo/edges/image_edges.h"
#include "edgevo/map/run_builder.h"
#include "moved_view.h"

namespace edgevo {
namespace {

// Where a point that `from` hosts is seen in another keyframe; nothing if behind it or out of its view.
std::optional<CloudPoint> seen_from(const Pinhole& pinhole, const SE3& T_to_from, const EdgePoint& p,
                                    int id) {
  const Eigen::Matrix3d R = T_to_from.R();
  const Eigen::Vector3d& t = T_to_from.translation();
  const Eigen::Vector2d px = p.px.cast<double>(), along(-p.normal.y(), p.normal.x());
  const Projection seen = project(pinhole, R, t, pinhole.ray(px), p.idepth),
                   next = project(pinhole, R, t, pinhole.ray(px + along), p.idepth);
  if (!(p.idepth > 0) || !seen.valid || !next.valid || !pinhole.contains(seen.px, kEdgelessBorder))
    return std::nullopt;
  const Eigen::Vector2d edge = (next.px - seen.px).normalized();
  CloudPoint found;
  found.ray = pinhole.ray(seen.px);
  found.idepth = p.idepth / seen.Y.z();
  found.idepth_sigma = p.idepth_sigma * (R.row(2) * pinhole.ray(px)).value() / (seen.Y.z() * seen.Y.z());
  found.px = seen.px.cast<float>();
  found.normal = Eigen::Vector2d(edge.y(), -edge.x()).cast<float>();
  found.host_keyframe = id;
  return found;
}

}  // namespace

void PlaceStore::number_epochs(const std::set<int>& first_keyframes) {
  for (StoredKeyframe& k : keyframes_)
    k.epoch = int(std::distance(first_keyframes.begin(), first_keyframes.upper_bound(k.id)));
}

void PlaceStore::move(const Rectification& rectification, const MapMoved& moved) {
  for (StoredKeyframe& k : keyframes_) {
    const KeyframeMove* move = k.record->segment == moved.segment ? moved.find(k.id) : nullptr;
    if (!move) continue;
    auto record = std::make_shared<KeyframeRecord>(*k.record);
    apply_move(rectification, moved, *move, record.get());
    k.record = std::move(record);
    if (k.next) scale_motion(move->scale_ratio, &*k.next);
    if (k.view && moved.lens)
      k.view = std::make_shared<const RememberedView>(
          moved_view(rectification, *moved.lens, move->motion, *k.view));
  }
}

Matrix7d PlaceStore::path_covariance(size_t a, size_t b) const {
  if (b < a) {
    const Matrix7d back = Sim3{1, T_a_b(a, b)}.adjoint();  // of the inverse
    return back * path_covariance(b, a) * back.transpose();
  }
  std::vector<PathStep> steps;
  for (size_t i = a; i < b; ++i) {
    PathStep step{T_a_b(i, i + 1), std::nullopt};
    const std::optional<NeighbourPose>& next = keyframes_[i].next;
    if (next && next->id == keyframes_[i + 1].id && !next->covariance.isZero())
      step.adjusted = next->covariance;
    steps.push_back(step);
  }
  return edgevo::path_covariance(steps);
}

std::vector<CloudPoint> PlaceStore::points_around(size_t at) const {
  std::vector<CloudPoint> points;
  const size_t end = std::min(size(), at + kAround + 1);
  for (size_t i = at > kAround ? at - kAround : 0; i < end; ++i) {
    if (!is_one_unit(i, at) || keyframes_[i].record->is_doubtful) continue;
    const SE3 T_at_i = T_a_b(at, i);
    for (const EdgePoint& p : keyframes_[i].record->points)
      if (auto seen = seen_from(pinhole_, T_at_i, p, keyframes_[i].id)) points.push_back(*seen);
  }
  return points;
}

}  // namespace edgevo
