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
// Nothing is nearer than a fifth of the depth of the nearest points.
constexpr double kNearestShare = 0.95, kNearestTimes = 5;
// Views passed on; each pixel is looked up in at most params.views of those that contain it.
constexpr int kMaxViews = 12;
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
  Impl(const Rectification& rectification, const EdgeMapParams& p, bool own_thread,
       std::shared_ptr<MapLog> log, EdgeTrace* trace)
      : params(p),
        fusion(rectification, p, std::move(log), trace),
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
    return views;
  }

  EdgeMapParams params;
  EdgeFusion fusion;  // owned by the worker's thread while it works
  int skipped = 0;    // keyframes
  std::map<int, std::shared_ptr<const std::vector<EdgeSides>>> sides;  // by keyframe id
  Worker worker;  // last member: it ends before the others
};

EdgeMapper::EdgeMapper(const Rectification& rectification, const EdgeMapParams& params, bool own_thread,
                       std::shared_ptr<MapLog> log, EdgeTrace* trace)
    : impl_(std::make_unique<Impl>(rectification, params, own_thread, std::move(log), trace)) {}
EdgeMapper::~EdgeMapper() = default;

void EdgeMapper::add(const Map& map) {
  if (!impl_->params.is_on()) return;
  const Keyframe& keyframe = map.marginalised().back();
  if (keyframe.is_doubtful) return;
  const std::vector<const Keyframe*> older = older_than_last(map.marginalised());
  // Keyframes whose images are gone are no views any more.
  impl_->sides.erase(impl_->sides.begin(),
                     impl_->sides.lower_bound(older.empty() ? keyframe.id : older.back()->id));
  const EdgeHost host{keyframe.id, keyframe.pyramid, impl_->sides_of(keyframe), keyframe.T_cam_world,
                      max_idepth_of(keyframe, map.active())};
  std::vector<EdgeView> views = impl_->views_of(keyframe, older, younger_than_last(map.active()));
  EdgeFusion* fusion = &impl_->fusion;
  const bool is_added = impl_->worker.submit_if_room([fusion, host, views = std::move(views)] {
    const TraceScope traced("lines of a keyframe");
    fusion->add(host, views);
  });
  if (!is_added) ++impl_->skipped;
}

size_t EdgeMapper::keyframes_needed() const { return impl_->params.is_on() ? kOlder : 0; }

void EdgeMapper::wait_idle() { impl_->worker.wait_idle(); }
bool EdgeMapper::is_idle() const { return impl_->worker.is_idle(); }

void EdgeMapper::apply(const MapMoved& moved) {
  if (!impl_->params.is_on()) return;
  if (moved.lens) impl_->sides.clear();
  impl_->worker.wait_idle();
  impl_->fusion.apply(moved);
}

void EdgeMapper::close() {
  impl_->sides.clear();
  impl_->worker.wait_idle();
  impl_->fusion.close();
}

int EdgeMapper::skipped() const { return impl_->skipped; }

}  // namespace edgevo
