// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/segmentation/moving_objects.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "edgevo/alignment/projection.h"
#include "moving_group.h"
#include "pulling_group.h"

namespace edgevo {
namespace {

constexpr double kFollowedShare = 0.5;  // of a body's edges that are seen again
constexpr int kMaxUnseen = 2;           // frames in a row
constexpr double kMinArea = 0.003;      // of the image: less does no harm
constexpr double kMinNewArea = 0.015;   // of the image, when it is found
constexpr double kMaxArea = 0.6;        // of the image: more is no body in a scene
constexpr size_t kMaxBodyPixels = 150;  // of a body, to follow it
constexpr size_t kMinFollowed = 40;     // that have moved as it did
constexpr double kTrimmed = 0.02;       // of a body's edges on each side: neighbours of the scene
constexpr int kMinPosePoints = 60;      // that constrain a pose
constexpr int kMaxProbation = 60;       // frames: what it hides of the scene is missed by the pose
// Of a body from where a scene that stands still could be, three sigmas: poses are good to a pixel, and the
// image of a part with a relief is a similarity to a twentieth of the parallax (set on fr1_xyz, where parts
// of a desk at rest are 3 to 5 px off at 50 to 180 px of parallax).
constexpr double kProofPx = 3, kProofParallax = 0.15;
// Next to a body: strips of the width of the image, their edges, and the share of those on it that have its
// motion, below which they are none of its own.
constexpr int kStrips = 32;
constexpr size_t kMinInStrip = 12;
constexpr double kForeignShare = 0.3;
constexpr double kSceneMovesBodyPx = 6;  // while a body keeps its place in the image

Eigen::Vector2d centre_of(const ImageBox& b) { return {0.5 * (b.left + b.right), 0.5 * (b.top + b.bottom)}; }

double area(const ImageBox& b) { return (b.right - b.left) * (b.bottom - b.top); }

ImageBox moved(const ImageBox& b, const ImageSimilarity& by) {
  const Eigen::Vector2d low = by(Eigen::Vector2d(b.left, b.top)),
                        high = by(Eigen::Vector2d(b.right, b.bottom));
  return {low.x(), low.y(), high.x(), high.y()};
}

// The part of a box that is in view.
ImageBox clipped(const ImageBox& b, const Pinhole& camera) {
  return {std::max(0.0, b.left), std::max(0.0, b.top), std::min<double>(camera.width - 1, b.right),
          std::min<double>(camera.height - 1, b.bottom)};
}

bool is_worth_following(const ImageBox& box, const Pinhole& camera, double least) {
  const ImageBox seen = clipped(box, camera);
  if (seen.right <= seen.left || seen.bottom <= seen.top) return false;
  const double share = area(seen) / (double(camera.width) * camera.height);
  return share > least && share < kMaxArea;
}

std::vector<OrientedPixel> all_edges_in(const ImageEdges& edges, const ImageBox& box) {
  std::vector<OrientedPixel> all;
  for (const EdgePixel& e : edges.pixels)
    if (const Eigen::Vector2d px = e.position().cast<double>(); box.contains(px))
      all.push_back({px, e.normal()});
  return all;
}

ImageBox wider(const ImageBox& b, double px) {
  return {b.left - px, b.top - px, b.right + px, b.bottom + px};
}

ImageBox joined(const ImageBox& a, const ImageBox& b) {
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right),
          std::max(a.bottom, b.bottom)};
}

// Strips along the sides of a rectangle: outside, or inside with a negative width.
std::array<ImageBox, 4> sides(const ImageBox& b, double width) {
  const double w = std::abs(width), in = width < 0 ? w : 0;
  return {{{b.left - w + in, b.top, b.left + in, b.bottom},
           {b.right - in, b.top, b.right + w - in, b.bottom},
           {b.left, b.top - w + in, b.right, b.top + in},
           {b.left, b.bottom - in, b.right, b.bottom + w - in}}};
}

// A rectangle without a strip along one of its sides.
ImageBox cut_off(ImageBox b, const ImageBox& strip) {
  if (strip.right < b.right && strip.left <= b.left)
    b.left = strip.right;
  else if (strip.left > b.left && strip.right >= b.right)
    b.right = strip.left;
  else if (strip.bottom < b.bottom && strip.top <= b.top)
    b.top = strip.bottom;
  else if (strip.top > b.top && strip.bottom >= b.bottom)
    b.bottom = strip.top;
  return b;
}

double strip_width(const FramePyramid& frame) { return double(frame.finest().pinhole.width) / kStrips; }

// The rectangle around the group's edges in the present image.
ImageBox box_of(const MovingGroup& group) {
  std::vector<double> x, y;
  for (const OrientedPixel& p : group.edges) {
    const Eigen::Vector2d px = group.motion.motion(p.px);
    x.push_back(px.x());
    y.push_back(px.y());
  }
  std::sort(x.begin(), x.end());
  std::sort(y.begin(), y.end());
  const size_t low = size_t(kTrimmed * double(x.size())), high = x.size() - 1 - low;
  return {x[low], y[low], x[high], y[high]};
}

}  // namespace

MovingObjects::Strip MovingObjects::strip(const ImageBox& box, const Body& body) {
  Strip strip{box, {}};
  for (const OrientedPixel& p : body.around)
    if (box.contains(body.step(p.px))) strip.before.push_back(p);
  return strip;
}

// Strips along the four sides of its area: those outside whose edges have moved as the body did are kept for
// grow(), those inside whose edges have not are given back.
void MovingObjects::look_around(const FramePyramid& frame, Body* body) {
  const double w = strip_width(frame);
  const auto share = [&](const Strip& strip) {
    return strip.before.size() < kMinInStrip ? -1 : agreeing_share(frame.finest(), strip.before, body->step);
  };
  const ImageBox a = body->area, &b = body->box;
  for (const ImageBox& inside : sides(a, -w)) {
    const double found = share(strip(inside, *body));
    if (found >= 0 && found < kForeignShare) body->area = joined(b, cut_off(body->area, inside));
  }
  for (const ImageBox& outside : sides(body->area, w)) {
    Strip next = strip(outside, *body);
    if (share(next) >= kSharesMotion) body->strips.push_back(std::move(next));
  }
}

// Next to a body the scene may move as it does: in front of a wall, or far away while the camera only turns.
void MovingObjects::grow(const Pinhole& pinhole, const SE3& T_cur_last, double median_idepth, Body* body) {
  for (const Strip& strip : body->strips) {
    const StaticComparison c =
        compare_with_static(pinhole, T_cur_last, median_idepth, strip.before, body->step);
    const ImageBox grown = joined(body->area, strip.box);
    if (c.distance_px >= kImpossiblePx && is_worth_following(grown, pinhole, 0)) body->area = grown;
  }
  body->strips.clear();
}

// The edges in its box that have moved as it did; what else is seen there, through its window or next to a
// corner, would lead it away.
std::vector<OrientedPixel> MovingObjects::followed_edges(const FramePyramid& frame, const Body& body) {
  const std::vector<OrientedPixel> before = strip(body.box, body).before;
  const std::vector<OrientedPixel> moved = moved_edges(frame.finest(), before, body.step);
  return thinned(moved.size() >= kMinFollowed ? moved : all_edges_in(frame.finest().edges, body.box),
                 kMaxBodyPixels);
}

bool MovingObjects::follow(const FramePyramid& frame, Body* body) {
  const Eigen::Vector2d centre = centre_of(body->box);
  const ImageSimilarity expected{centre, body->step.shift, body->step.scale};
  const GroupMotion found =
      align_group(frame, body->pixels, {expected, {centre, Eigen::Vector2d::Zero(), 1.0}});
  const bool is_seen = found.share >= kFollowedShare;
  body->unseen = is_seen ? 0 : body->unseen + 1;
  body->step = is_seen ? found.motion : expected;
  body->box = moved(body->box, body->step);
  body->area = joined(body->box, moved(body->area, body->step));
  body->motion = then(body->motion, body->step);
  body->strips.clear();
  if (is_seen && body->counts) look_around(frame, body);
  if ((++body->age > kMaxProbation && !body->counts) || body->unseen > kMaxUnseen) return false;
  if (!is_worth_following(body->box, frame.finest().pinhole, kMinArea)) return false;
  if (is_seen)
    body->pixels = followed_edges(frame, *body);
  else
    for (OrientedPixel& p : body->pixels) p.px = body->step(p.px);
  body->around = all_edges_in(frame.finest().edges, wider(body->area, 2 * strip_width(frame)));
  return !body->pixels.empty();
}

void MovingObjects::follow(const FramePyramid& frame) {
  bodies_.erase(std::remove_if(bodies_.begin(), bodies_.end(), [&](Body& b) { return !follow(frame, &b); }),
                bodies_.end());
}

bool MovingObjects::look(const FramePyramid& frame, const Reference& reference, const SE3& T_cur_ref,
                         const AlignmentParams& params) {
  MovingGroup group = find_moving_group(frame, reference.cloud, T_cur_ref, params);
  if (group.points.empty()) group = find_pulling_group(frame, reference, T_cur_ref, params);
  if (group.points.empty()) return false;
  Body body;
  body.box = box_of(group);
  if (!is_worth_following(body.box, frame.finest().pinhole, kMinNewArea)) return false;
  body.area = body.box;
  body.pixels = thinned(all_edges_in(frame.finest().edges, body.box), kMaxBodyPixels);
  body.first_pixels = body.pixels;
  body.motion.centre = centre_of(body.box);
  for (int i : group.points) {
    const CloudPoint& p = reference.cloud.points[size_t(i)];
    body.points.insert({p.host_keyframe, p.host_pixel});
  }
  bodies_.push_back(std::move(body));
  return true;
}

bool MovingObjects::is_proved(const StaticComparison& c) {
  return c.distance_px > std::hypot(kProofPx, kProofParallax * c.parallax_px) ||
         (c.is_fixed && c.parallax_px > kSceneMovesBodyPx);
}

// What is followed looks far away; this is nearer than most of the scene, and the map had its depth wrong.
bool MovingObjects::is_scene(const StaticComparison& c) {
  return c.own_parallax_px > std::max(kProofPx, c.parallax_px);
}

int MovingObjects::evaluate(const Pinhole& pinhole, const SE3& T_cur_last, double median_idepth) {
  int proved = 0;
  const auto is_none = [&](Body& b) {
    if (b.counts) grow(pinhole, T_cur_last, median_idepth, &b);
    if (b.counts || b.age == 0) return false;
    b.T_cur_first = T_cur_last * b.T_cur_first;
    if (b.unseen > 0) return false;
    const StaticComparison c =
        compare_with_static(pinhole, b.T_cur_first, median_idepth, b.first_pixels, b.motion);
    b.counts = is_proved(c);
    proved += b.counts;
    return !b.counts && is_scene(c);
  };
  bodies_.erase(std::remove_if(bodies_.begin(), bodies_.end(), is_none), bodies_.end());
  return proved;
}

MovingAreas MovingObjects::areas_of(bool also_on_probation) const {
  MovingAreas areas;
  for (const Body& b : bodies_) {
    if (!b.counts && !also_on_probation) continue;
    areas.boxes.push_back(b.area);
    areas.points.insert(b.points.begin(), b.points.end());
  }
  return areas;
}

std::shared_ptr<const Reference> MovingObjects::without(std::shared_ptr<const Reference> reference,
                                                        const Pinhole& pinhole, const SE3& T_cur_ref) const {
  if (bodies_.empty()) return reference;
  const MovingAreas areas = areas_of(true);
  const ReferenceCloud& all = reference->cloud;
  const Eigen::Matrix3d R = T_cur_ref.R();
  std::vector<size_t> kept;
  int known = 0;
  for (size_t i = 0; i < all.points.size(); ++i) {
    const CloudPoint& c = all.points[i];
    if (areas.made(c.host_keyframe, c.host_pixel)) continue;
    const Projection p = project(pinhole, R, T_cur_ref.translation(), c.ray, c.idepth);
    if (p.valid && areas.cover(p.px)) continue;
    kept.push_back(i);
    known += c.host_keyframe >= 0;
  }
  if (kept.size() == all.points.size() || known < kMinPosePoints) return reference;
  const auto thinned = std::make_shared<Reference>(*reference);
  thinned->cloud = part_of(all, kept);
  thinned->known_points = known;
  return thinned;
}

}  // namespace edgevo
