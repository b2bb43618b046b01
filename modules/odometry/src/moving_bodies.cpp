// SPDX-License-Identifier: BSD-3-Clause
#include "moving_bodies.h"

#include <algorithm>
#include <cmath>

#include "edgevo/alignment/moving_group.h"
#include "edgevo/alignment/projection.h"

namespace edgevo {
namespace {

constexpr double kFollowedShare = 0.5;   // of a body's edges that are seen again
constexpr int kMostUnseen = 2;           // frames in a row
constexpr int kMostAge = 60;             // frames
constexpr double kLeastArea = 0.003;     // of the image: less does no harm
constexpr double kLeastNewArea = 0.015;  // of the image, when it is found
constexpr double kMostArea = 0.6;        // of the image: more is no body in a scene
constexpr size_t kMostPixels = 150;      // of a body, to follow it
constexpr double kTrimmed = 0.02;        // of a body's edges on each side: neighbours of the scene
constexpr int kFewPoints = 60;           // that constrain a pose
constexpr int kProbation = 4;            // frames
constexpr int kRest = 3;                 // frames without a search, after a body that was none
// Of a body from where a scene that stands still could be: poses and similarities are good to a pixel.
constexpr double kProofPx = 3;
constexpr double kSceneMovesPx = 6;  // while a body keeps its place in the image

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
  return share > least && share < kMostArea;
}

std::vector<OrientedPixel> edges_in(const ImageEdges& edges, const ImageBox& box) {
  std::vector<OrientedPixel> all, some;
  for (const EdgePixel& e : edges.pixels)
    if (const Eigen::Vector2d px = e.position().cast<double>(); box.contains(px))
      all.push_back({px, e.normal()});
  if (all.size() <= kMostPixels) return all;
  for (size_t i = 0; i < kMostPixels; ++i) some.push_back(all[i * all.size() / kMostPixels]);
  return some;
}

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

bool MovingBodies::follow(const FramePyramid& frame, Body* body) {
  const ImageBox& b = body->box;
  const Eigen::Vector2d centre(0.5 * (b.left + b.right), 0.5 * (b.top + b.bottom));
  const ImageSimilarity expected{centre, body->step.shift, body->step.scale};
  const GroupMotion found =
      align_group(frame, body->pixels, {expected, {centre, Eigen::Vector2d::Zero(), 1.0}});
  const bool is_seen = found.share >= kFollowedShare;
  body->unseen = is_seen ? 0 : body->unseen + 1;
  body->step = is_seen ? found.motion : expected;
  body->box = moved(b, body->step);
  body->motion = then(body->motion, body->step);
  if (++body->age > kMostAge || body->unseen > kMostUnseen) return false;
  if (!is_worth_following(body->box, frame.finest().pinhole, kLeastArea)) return false;
  if (is_seen)
    body->pixels = edges_in(frame.finest().edges, body->box);
  else
    for (OrientedPixel& p : body->pixels) p.px = body->step(p.px);
  return !body->pixels.empty();
}

void MovingBodies::follow(const FramePyramid& frame) {
  bodies_.erase(std::remove_if(bodies_.begin(), bodies_.end(), [&](Body& b) { return !follow(frame, &b); }),
                bodies_.end());
}

bool MovingBodies::look(const FramePyramid& frame, const Reference& reference, const SE3& T_cur_ref,
                        const AlignmentParams& params) {
  if (rest_ > 0) return --rest_, false;
  const MovingGroup group = find_moving_group(frame, reference.cloud, T_cur_ref, params);
  if (group.points.empty()) return false;
  Body body;
  body.box = box_of(group);
  if (!is_worth_following(body.box, frame.finest().pinhole, kLeastNewArea)) return false;
  body.pixels = edges_in(frame.finest().edges, body.box);
  body.first_pixels = body.pixels;
  body.motion.centre = {0.5 * (body.box.left + body.box.right), 0.5 * (body.box.top + body.box.bottom)};
  for (int i : group.points) {
    const CloudPoint& p = reference.cloud.points[size_t(i)];
    body.points.insert({p.host_keyframe, p.host_pixel});
  }
  bodies_.push_back(std::move(body));
  return true;
}

bool MovingBodies::is_proved(const Pinhole& pinhole, double median_idepth, const Body& body) {
  const StaticComparison c =
      compare_with_static(pinhole, body.T_cur_first, median_idepth, body.first_pixels, body.motion);
  return c.distance_px > kProofPx || (c.is_fixed && c.parallax_px > kSceneMovesPx);
}

int MovingBodies::evaluate(const Pinhole& pinhole, const SE3& T_cur_last, double median_idepth) {
  int proved = 0;
  const auto is_none = [&](Body& b) {
    if (b.counts || b.age == 0) return false;
    b.T_cur_first = T_cur_last * b.T_cur_first;
    b.counts = b.unseen == 0 && is_proved(pinhole, median_idepth, b);
    proved += b.counts;
    return !b.counts && b.age >= kProbation;
  };
  const size_t before = bodies_.size();
  bodies_.erase(std::remove_if(bodies_.begin(), bodies_.end(), is_none), bodies_.end());
  if (bodies_.size() < before) rest_ = kRest;
  return proved;
}

MovingAreas MovingBodies::areas() const {
  MovingAreas areas;
  for (const Body& b : bodies_) {
    if (!b.counts) continue;
    areas.boxes.push_back(b.box);
    areas.points.insert(b.points.begin(), b.points.end());
  }
  return areas;
}

std::shared_ptr<const Reference> MovingBodies::without(std::shared_ptr<const Reference> reference,
                                                       const Pinhole& pinhole, const SE3& T_cur_ref) const {
  if (bodies_.empty()) return reference;
  MovingAreas areas;  // of all, also those on probation
  for (const Body& b : bodies_) {
    areas.boxes.push_back(b.box);
    areas.points.insert(b.points.begin(), b.points.end());
  }
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
  if (kept.size() == all.points.size() || known < kFewPoints) return reference;
  const auto thinned = std::make_shared<Reference>(*reference);
  thinned->cloud = {all.pyramid, {}, {}, {}};
  thinned->cloud.patches.resize(all.patches.size());
  for (size_t i : kept) {
    thinned->cloud.points.push_back(all.points[i]);
    for (size_t l = 0; l < all.patches.size(); ++l)
      if (!all.patches[l].empty()) thinned->cloud.patches[l].push_back(all.patches[l][i]);
    if (!all.gradient_patches.empty()) thinned->cloud.gradient_patches.push_back(all.gradient_patches[i]);
  }
  thinned->known_points = known;
  return thinned;
}

}  // namespace edgevo
