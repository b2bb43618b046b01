// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edge_map/edge_mapper.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "edge_fusion.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/trace.h"
#include "edgevo/core/worker.h"

namespace edgevo {
namespace {

// Keyframes used beyond the window: only they see what leaves the view.
constexpr size_t kOlder = 8;
// Nothing is nearer than a fifteenth of the depth of the nearest points, which may be trees along a road.
constexpr double kNearestShare = 0.95, kNearestTimes = 15;
// Views passed on; each pixel is looked up in at most params.views of those that contain it.
constexpr int kMaxViews = 12;
// Frames between keyframes, besides: those next to the host, and those kept after each keyframe.
constexpr size_t kMaxBetween = 8;
constexpr int kBetweenKept = 4;
constexpr int kMinPoints = 10;     // needed to estimate the nearest depth, or the gain of an image
constexpr size_t kMaxWaiting = 4;  // keyframes; a thread further behind would not catch up

// Offsets of keyframes after (negative: before) the host, nearest first: short baselines find an edge, long
// ones constrain its depth.
constexpr int kOffsets[] = {1, -1, 2, -2, 3, -3, 5, -5, 8, -8, 11, 4, -4, 6, -6, 7, -7, 9, 10};

// The keyframes that were marginalised before the last one and still have images, nearest first; those in
// doubt are no views.
std::vector<const Keyframe*> older_than_last(const std::deque<Keyframe>& marginalised) {
  std::vector<const Keyframe*> older;
  for (size_t i = marginalised.size() - 1; i-- > 0 && older.size() < kOlder && marginalised[i].pyramid;)
    if (!marginalised[i].is_doubtful) older.push_back(&marginalised[i]);
  return older;
}

std::vector<const Keyframe*> younger_than_last(const std::deque<Keyframe>& active) {
  std::vector<const Keyframe*> younger;
  for (const Keyframe& k : active)
    if (!k.is_doubtful) younger.push_back(&k);
  return younger;
}

float gray_at(const Keyframe& k, const Eigen::Vector2d& px) {
  const Plane<uint8_t>& gray = k.pyramid->finest().gray;
  const int x = std::clamp(int(std::lround(px.x())), 0, gray.width() - 1);
  const int y = std::clamp(int(std::lround(px.y())), 0, gray.height() - 1);
  return float(gray.at(x, y));
}

// Brightness of another keyframe over that of the host, from the points that both show.
double gain_of(const Keyframe& host, const Keyframe& view) {
  std::vector<double> ratios;
  const auto compare = [&](const Keyframe& from, const Keyframe& to, bool is_host) {
    for (const MapPoint& p : from.points)
      if (const Observation* o = p.find(to.id)) {
        const double ratio = (gray_at(to, o->match.px) + 1) / (gray_at(from, p.px) + 1);
        ratios.push_back(is_host ? ratio : 1 / ratio);
      }
  };
  compare(host, view, true);
  compare(view, host, false);
  return int(ratios.size()) >= kMinPoints ? median(std::move(ratios)) : 1;
}

double max_idepth_of(const Keyframe& host, const std::deque<Keyframe>& younger) {
  std::vector<double> idepths;
  for (const MapPoint& p : host.points) idepths.push_back(p.idepth);
  for (auto k = younger.begin(); k != younger.end() && int(idepths.size()) < kMinPoints; ++k)
    for (const MapPoint& p : k->points) idepths.push_back(p.idepth);
  return kNearestTimes * quantile(std::move(idepths), kNearestShare);
}

}  // namespace

struct EdgeMapper::Impl {
  // A frame between keyframes.
  struct BetweenView {
    int keyframe_id;  // that its pose refers to
    SE3 T_view_keyframe;
    PyramidLevel level;  // pinhole and edges
    int radius;          // of the field
    std::shared_ptr<const std::vector<EdgeSides>> sides;
    std::shared_ptr<const FramePyramid> pyramid;  // of the same edges with their field, while it is a view

    void make_pyramid() {
      if (pyramid) return;
      auto made = std::make_shared<FramePyramid>();
      made->levels.emplace_back();
      PyramidLevel& finest = made->levels.front();
      finest.pinhole = level.pinhole, finest.edges = level.edges,
      finest.field = NearestField(level.edges, radius);
      pyramid = std::move(made);
    }
  };

  Impl(const Rectification& rectification, const EdgeMapParams& p, const ViewAlignment& how, bool own_thread,
       std::shared_ptr<MapLog> log, EdgeTrace* trace)
      : params(p),
        fusion(rectification, p, how, std::move(log), trace),
        worker({"lines of edges", kMaxWaiting, own_thread, true, true}) {}

  std::shared_ptr<const std::vector<EdgeSides>> sides_of(const Keyframe& k) {
    auto& known = sides[k.id];
    if (!known) known = std::make_shared<const std::vector<EdgeSides>>(sample_sides(k.pyramid->finest()));
    return known;
  }

  std::vector<EdgeView> views_of(const Keyframe& host, const std::vector<const Keyframe*>& older,
                                 const std::vector<const Keyframe*>& younger) {
    std::vector<EdgeView> views;
    for (const int offset : kOffsets) {
      const size_t rank = size_t(std::abs(offset)) - 1;
      if (rank >= (offset > 0 ? younger.size() : older.size()) || int(views.size()) >= kMaxViews) continue;
      const Keyframe& k = *(offset > 0 ? younger : older)[rank];
      views.push_back({k.pyramid, sides_of(k), k.T_cam_world * host.T_cam_world.inverse(), gain_of(host, k)});
    }
    add_between(host, older, younger, &views);
    return views;
  }

  // Keyframes whose images are gone are no views any more.
  void forget_before(int keyframe_id) {
    sides.erase(sides.begin(), sides.lower_bound(keyframe_id));
    const auto is_old = [&](const BetweenView& b) { return b.keyframe_id < keyframe_id; };
    between.erase(std::remove_if(between.begin(), between.end(), is_old), between.end());
  }

  void add_between(const Keyframe& host, const std::vector<const Keyframe*>& older,
                   const std::vector<const Keyframe*>& younger, std::vector<EdgeView>* views) {
    std::map<int, const Keyframe*> keyframes{{host.id, &host}};
    for (const auto* list : {&older, &younger})
      for (const Keyframe* k : *list) keyframes[k->id] = k;
    std::vector<BetweenView*> sorted;
    for (BetweenView& b : between)
      if (keyframes.count(b.keyframe_id)) sorted.push_back(&b);
    const auto T_view_host = [&](const BetweenView& b) {
      return b.T_view_keyframe * keyframes.at(b.keyframe_id)->T_cam_world * host.T_cam_world.inverse();
    };
    std::stable_sort(sorted.begin(), sorted.end(), [&](const BetweenView* a, const BetweenView* b) {
      return T_view_host(*a).translation().norm() < T_view_host(*b).translation().norm();
    });
    for (size_t i = kMaxBetween; i < sorted.size(); ++i) sorted[i]->pyramid.reset();
    if (sorted.size() > kMaxBetween) sorted.resize(kMaxBetween);
    // In turn with the keyframes: near and far views share what a pixel is looked up in.
    for (size_t i = 0; i < sorted.size(); ++i) {
      sorted[i]->make_pyramid();
      const Keyframe& near = *keyframes.at(sorted[i]->keyframe_id);
      const EdgeView view{sorted[i]->pyramid,
                          sorted[i]->sides,
                          T_view_host(*sorted[i]),
                          near.id == host.id ? 1 : gain_of(host, near),
                          true,
                          near.id == host.id};
      views->insert(views->begin() + long(std::min(2 * i, views->size())), view);
    }
  }

  std::deque<BetweenView> between;
  EdgeMapParams params;
  EdgeFusion fusion;  // owned by the worker's thread while it works
  int skipped = 0;    // keyframes
  std::map<int, std::shared_ptr<const std::vector<EdgeSides>>> sides;  // by keyframe id
  Worker worker;  // last member: it ends before the others
};

EdgeMapper::EdgeMapper(const Rectification& rectification, const EdgeMapParams& params,
                       const ViewAlignment& how, bool own_thread, std::shared_ptr<MapLog> log,
                       EdgeTrace* trace)
    : impl_(std::make_unique<Impl>(rectification, params, how, own_thread, std::move(log), trace)) {}
EdgeMapper::~EdgeMapper() = default;

void EdgeMapper::add(const Map& map) {
  if (!impl_->params.is_on()) return;
  const Keyframe& keyframe = map.marginalised().back();
  const std::vector<const Keyframe*> older = older_than_last(map.marginalised());
  impl_->forget_before(older.empty() ? keyframe.id : older.back()->id);
  if (keyframe.is_doubtful) return;
  const EdgeHost host{keyframe.id, keyframe.pyramid, impl_->sides_of(keyframe), keyframe.T_cam_world,
                      max_idepth_of(keyframe, map.active())};
  std::vector<EdgeView> views = impl_->views_of(keyframe, older, younger_than_last(map.active()));
  EdgeFusion* fusion = &impl_->fusion;
  const bool is_added = impl_->worker.submit_if_room([fusion, host, views = std::move(views)]() mutable {
    const TraceScope traced("lines of a keyframe");
    fusion->add(host, std::move(views));
  });
  if (!is_added) ++impl_->skipped;
}

void EdgeMapper::add_view(int keyframe_id, const SE3& T_view_keyframe, const FramePyramid& pyramid) {
  if (!impl_->params.is_on()) return;
  const auto& between = impl_->between;
  const auto is_of_keyframe = [&](const auto& b) { return b.keyframe_id == keyframe_id; };
  if (std::count_if(between.begin(), between.end(), is_of_keyframe) >= kBetweenKept) return;
  PyramidLevel level;
  level.pinhole = pyramid.finest().pinhole, level.edges = pyramid.finest().edges;
  auto sides = std::make_shared<const std::vector<EdgeSides>>(sample_sides(pyramid.finest()));
  impl_->between.push_back({keyframe_id, T_view_keyframe, std::move(level), pyramid.finest().field.radius(),
                            std::move(sides), nullptr});
}

size_t EdgeMapper::keyframes_needed() const { return impl_->params.is_on() ? kOlder : 0; }

void EdgeMapper::wait_idle() { impl_->worker.wait_idle(); }
bool EdgeMapper::is_idle() const { return impl_->worker.is_idle(); }

void EdgeMapper::apply(const MapMoved& moved) {
  if (!impl_->params.is_on()) return;
  if (moved.lens) impl_->sides.clear(), impl_->between.clear();
  for (auto& view : impl_->between)
    if (const KeyframeMove* m = moved.find(view.keyframe_id))
      view.T_view_keyframe =
          SE3(view.T_view_keyframe.rotation(), m->scale_ratio * view.T_view_keyframe.translation());
  impl_->worker.wait_idle();
  impl_->fusion.apply(moved);
}

void EdgeMapper::close() {
  impl_->sides.clear();
  impl_->between.clear();
  impl_->worker.wait_idle();
  impl_->fusion.close();
}

int EdgeMapper::skipped() const { return impl_->skipped; }

}  // namespace edgevo
