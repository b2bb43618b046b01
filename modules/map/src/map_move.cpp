// SPDX-License-Identifier: BSD-3-Clause
// Moves of the map. If the lens has changed, everything measured in the images moves with them.
#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "edgevo/map/corrected_pixel.h"
#include "edgevo/map/map.h"
#include "edgevo/map/run_builder.h"

namespace edgevo {
namespace {

// An edge pixel of the new image within this distance in pixels, and within 37 degrees of the old direction,
// is the old one: a resampled edge may be found a pixel's diagonal off, and a neighbouring edge is further
// away.
constexpr double kSameEdgePx = 1.5;
constexpr double kSameEdgeCosine = 0.8;

// Of the newest keyframe, tangent: what rounding may leave of no motion.
constexpr double kNoMotion = 1e-6;

int find_edge_pixel(const FramePyramid* pyramid, const Eigen::Vector2d& px, const Eigen::Vector2d& normal) {
  if (!pyramid || !pyramid->finest().pinhole.contains(px)) return -1;
  const PyramidLevel& level = pyramid->finest();
  const int n = level.field.nearest(float(px.x()), float(px.y()));
  if (n < 0) return -1;
  const EdgePixel& e = level.edges.pixels[n];
  const bool same = (e.position().cast<double>() - px).norm() < kSameEdgePx &&
                    e.normal().cast<double>().dot(normal) > kSameEdgeCosine;
  return same ? n : -1;
}

// Converts what is measured in the images.
class LensMove {
 public:
  LensMove(const Rectification& rectification, const MapMoved& moved)
      : rectification_(rectification), moved_(moved), before_(moved.lens->before), now_(moved.lens->now) {}

  // No motion if the keyframe does not move.
  const ImageMotion& motion_of(int keyframe_id) const {
    static const ImageMotion unknown;
    const KeyframeMove* move = moved_.find(keyframe_id);
    return move ? move->motion : unknown;
  }
  Eigen::Vector2d pixel(const ImageMotion& motion, const Eigen::Vector2d& px) const {
    return correct_pixel(rectification_, before_, now_, motion, px);
  }
  Eigen::Vector2d normal(const ImageMotion& motion, const Eigen::Vector2d& px,
                         const Eigen::Vector2d& normal) const {
    return correct_normal(rectification_, before_, now_, motion, px, normal);
  }
  void correct(Observation* o) const {
    const ImageMotion& motion = motion_of(o->keyframe_id);
    o->match.normal = normal(motion, o->match.px, o->match.normal);
    o->match.px = pixel(motion, o->match.px);
  }
  Eigen::Vector3d ray(int keyframe_id, const Eigen::Vector3d& ray) const {
    const Pinhole& pinhole = rectification_.target();
    return pinhole.ray(pixel(motion_of(keyframe_id), pinhole.project(ray)));
  }

 private:
  const Rectification& rectification_;
  const MapMoved& moved_;
  const ImageCorrection &before_, &now_;
};

// The depths of a keyframe, and pixels that the move gives.
void move_depths(const KeyframeMove& move, Keyframe* k) {
  for (size_t i = 0; i < k->points.size(); ++i) {
    MapPoint& p = k->points[i];
    const double before = p.idepth;
    p.idepth_sigma /= move.scale_ratio;
    if (move.points.empty()) {
      p.idepth /= move.scale_ratio;
    } else {
      p.px = move.points[i].px;
      p.idepth = move.points[i].idepth;
    }
    // A point at infinity has no ratio of its own.
    p.known_idepth *= before > 0 ? p.idepth / before : 1 / move.scale_ratio;
    p.known_sigma /= move.scale_ratio;
  }
  for (ImmaturePoint& p : k->immature) {
    p.idepth /= move.scale_ratio;
    p.idepth_sigma /= move.scale_ratio;
    p.idepth_guess /= move.scale_ratio;
  }
}

void correct_points(const LensMove& lens, const KeyframeMove& move, Keyframe* k) {
  for (size_t i = 0; i < k->points.size(); ++i) {
    MapPoint& p = k->points[i];
    p.normal = lens.normal(move.motion, p.px, p.normal);
    p.edge_pixel = find_edge_pixel(k->pyramid.get(), move.points[i].px, p.normal);
    for (Observation& o : p.observations) lens.correct(&o);
  }
}

// Immature points lie on edge pixels: those without one in the new image are dropped.
void correct_immature(const LensMove& lens, const KeyframeMove& move, Keyframe* k) {
  std::vector<ImmaturePoint> kept;
  for (ImmaturePoint p : k->immature) {
    p.normal = lens.normal(move.motion, p.px, p.normal);
    p.px = lens.pixel(move.motion, p.px);
    p.edge_pixel = find_edge_pixel(k->pyramid.get(), p.px, p.normal);
    if (p.edge_pixel >= 0) kept.push_back(p);
  }
  std::stable_sort(kept.begin(), kept.end(), [](const ImmaturePoint& a, const ImmaturePoint& b) {
    return a.edge_pixel < b.edge_pixel;
  });
  k->immature = std::move(kept);
}

// `k` has the images of the new correction, or none.
void correct_measurements(const LensMove& lens, const KeyframeMove& move, Keyframe* k) {
  correct_points(lens, move, k);
  correct_immature(lens, move, k);
  for (CornerPair& corner : k->corners) {
    corner.from = lens.ray(k->corners_from, corner.from);
    corner.to = lens.ray(k->id, corner.to);
  }
}

// Where the focal length turns out shorter, the images grow: points that lie outside them now are dropped.
void drop_points_outside(const Pinhole& pinhole, Keyframe* k) {
  k->points.erase(std::remove_if(k->points.begin(), k->points.end(),
                                 [&](const MapPoint& p) { return !pinhole.contains(p.px); }),
                  k->points.end());
}

void require(bool fulfilled, const char* what) {
  if (!fulfilled) throw std::invalid_argument(std::string("move of the map: ") + what);
}

}  // namespace

const Keyframe* Map::find(int keyframe_id) const {
  for (const std::deque<Keyframe>* keyframes : {&active_, &marginalised_}) {
    const auto k = std::lower_bound(keyframes->begin(), keyframes->end(), keyframe_id,
                                    [](const Keyframe& a, int id) { return a.id < id; });
    if (k != keyframes->end() && k->id == keyframe_id) return &*k;
  }
  return nullptr;
}

void Map::check(const MapMoved& moved) const {
  require(moved.segment == segment_ && !active_.empty(), "its segment is not the present one");
  int last_id = -1;
  for (const KeyframeMove& m : moved.keyframes) {
    require(m.id > last_id, "the ids do not ascend");
    last_id = m.id;
    const auto stored = stored_.find(m.id);
    const bool is_stored = stored != stored_.end() && stored->second.segment == segment_;
    const Keyframe* k = find(m.id);
    require(k || is_stored, "a keyframe is not known");
    const size_t points = k ? k->points.size() : stored->second.keyframe->points.size();
    require(m.points.size() == points || (m.points.empty() && !moved.lens),
            "points are not those of the keyframe");
    require(is_stored || moved.prior, "a keyframe of the window moves, but there is no prior");
    require(m.id != active_.back().id || !(m.T_cam_newest.log().norm() > kNoMotion),
            "the newest keyframe moves");
  }
  for (const Keyframe& k : active_)
    require(!moved.lens || moved.find(k.id), "the lens changes, but not for a keyframe of the window");
}

void Map::move_stored(const MapMoved& moved) {
  for (const KeyframeMove& m : moved.keyframes) {
    const auto stored = stored_.find(m.id);
    if (stored == stored_.end()) continue;
    auto keyframe = std::make_shared<KeyframeRecord>(*stored->second.keyframe);
    apply_move(rectification_, moved, m, keyframe.get());
    stored->second.keyframe = std::move(keyframe);
  }
}

MapMoved Map::move(MapMoved moved, const Rebuild& rebuild) {
  check(moved);
  moved.T_newest_map = active_.back().T_cam_world;
  // The images of marginalised keyframes are not corrected, so they are no longer used.
  if (moved.lens) evict_images(0);
  for (std::deque<Keyframe>* keyframes : {&marginalised_, &active_})
    for (Keyframe& k : *keyframes) {
      const KeyframeMove* m = moved.find(k.id);
      if (!m) continue;
      k.T_cam_world = moved.T_cam_map(*m);
      if (moved.lens) {
        if (k.pyramid) k.pyramid = rebuild(k);
        correct_measurements(LensMove(rectification_, moved), *m, &k);
      }
      move_depths(*m, &k);
    }
  // Those of marginalised keyframes are in the records, point by point.
  if (moved.lens)
    for (Keyframe& k : active_) drop_points_outside(rectification_.target(), &k);
  move_stored(moved);
  ++moves_;
  log_->append(moved);
  return moved;
}

}  // namespace edgevo
