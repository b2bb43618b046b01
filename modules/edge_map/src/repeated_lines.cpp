// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edge_map/repeated_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "edge_fusion.h"
#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

constexpr double kAlike = 0.94;      // cosine of the angle between two lines that are one: 20 degrees
constexpr size_t kEverySample = 32;  // vertices: whether a keyframe looks there at all

// What happens to a vertex: whether it goes, and by what more the line is known if it stays.
struct Merged {
  bool is_repeated = false;
  int keyframes = 0, views = 0;
  double information = 0;  // of its inverse depth, once it is that of several; else 0
};
struct Place {
  size_t line, vertex;
};

// A keyframe with its lines, and where in its image they are.
class LinesInView {
 public:
  LinesInView(const Pinhole& pinhole, KeyframeRecord* keyframe)
      : pinhole_(pinhole), keyframe_(*keyframe), T_cam_world_(keyframe->T_world_cam.inverse()) {
    for (const EdgeLine& line : keyframe_.lines) merged_.emplace_back(line.vertices.size());
  }
  bool is_empty() const { return keyframe_.lines.empty(); }

  // Whether some of the other's lines may lie in this view.
  bool may_see(const LinesInView& other) const {
    if (is_empty() || other.is_empty() || keyframe_.segment != other.keyframe_.segment) return false;
    size_t n = 0;
    for (size_t l = 0; l < other.keyframe_.lines.size(); ++l)
      for (size_t i = 0; i < other.keyframe_.lines[l].vertices.size(); ++i)
        if (n++ % kEverySample == 0 && sight(other, {l, i})) return true;
    return false;
  }

  // Gives what both have to the other, which was first.
  void compare(LinesInView* other) {
    index();
    other->each([&](const Place& there) {
      if (!other->merged_[there.line][there.vertex].is_repeated) compare_vertex(other, there);
    });
  }

  void forget_index() { cells_ = {}; }

  // Leaves the vertices that stay, in lines of `least` and more: what remains between two nodes is none.
  void finish(size_t least) {
    std::vector<EdgeLine> kept;
    for (size_t l = 0; l < keyframe_.lines.size(); ++l) split(keyframe_.lines[l], merged_[l], least, &kept);
    keyframe_.lines = std::move(kept);
  }

 private:
  struct Sighting {
    Eigen::Vector2d px;
    double idepth, sigma;
  };

  template <class F>
  void each(const F& f) const {
    for (size_t l = 0; l < keyframe_.lines.size(); ++l)
      for (size_t i = 0; i < keyframe_.lines[l].vertices.size(); ++i) f(Place{l, i});
  }
  const EdgeVertex& at(const Place& p) const { return keyframe_.lines[p.line].vertices[p.vertex]; }

  // A vertex of another keyframe as this one sees it.
  std::optional<Sighting> sight(const LinesInView& other, const Place& there) const {
    const EdgeVertex& v = other.at(there);
    const Eigen::Vector3d p = T_cam_world_ * (other.keyframe_.T_world_cam * point_in_camera(pinhole_, v));
    const double times = p.z() * double(v.idepth);  // as far as from there
    if (!(times * kMaxDepthRatio > 1 && times < kMaxDepthRatio)) return std::nullopt;
    const Eigen::Vector2d px = pinhole_.project(p);
    if (!pinhole_.contains(px, 1)) return std::nullopt;
    return Sighting{px, 1 / p.z(), double(v.idepth_sigma) / times};
  }

  // Unit direction of its line at a vertex, in the image of `seen_from`.
  std::optional<Eigen::Vector2d> direction(const LinesInView& seen_from, const Place& p) const {
    const size_t last = keyframe_.lines[p.line].vertices.size() - 1;
    const size_t from = p.vertex > 2 ? p.vertex - 2 : 0, to = std::min(last, p.vertex + 2);
    if (&seen_from == this) return (at({p.line, to}).px - at({p.line, from}).px).cast<double>().normalized();
    const auto a = seen_from.sight(*this, {p.line, from}), b = seen_from.sight(*this, {p.line, to});
    if (!a || !b) return std::nullopt;
    return (b->px - a->px).normalized();
  }

  void index() {
    if (!cells_.empty()) return;
    columns_ = pinhole_.width / kCellPx + 1;
    cells_.resize(size_t(columns_) * size_t(pinhole_.height / kCellPx + 1));
    each([&](const Place& p) {
      const Eigen::Vector2f px = at(p).px;
      if (pinhole_.contains(px.cast<double>()))
        cells_[size_t(int(px.y()) / kCellPx * columns_ + int(px.x()) / kCellPx)].push_back(p);
    });
  }

  // The nearest of its own vertices, if it is near enough.
  std::optional<Place> nearest(const Eigen::Vector2d& px) const {
    std::optional<Place> found;
    double least = kSeenAcrossPx * kSeenAcrossPx;
    const int x0 = std::max(0, int(px.x()) - kCellPx),
              x1 = std::min(pinhole_.width - 1, int(px.x()) + kCellPx);
    const int y0 = std::max(0, int(px.y()) - kCellPx),
              y1 = std::min(pinhole_.height - 1, int(px.y()) + kCellPx);
    for (int y = y0 / kCellPx; y <= y1 / kCellPx; ++y)
      for (int x = x0 / kCellPx; x <= x1 / kCellPx; ++x)
        for (const Place& p : cells_[size_t(y * columns_ + x)]) {
          const double distance = (at(p).px.cast<double>() - px).squaredNorm();
          if (distance < least) least = distance, found = p;
        }
    return found;
  }

  void compare_vertex(LinesInView* other, const Place& there) {
    const std::optional<Sighting> s = sight(*other, there);
    const std::optional<Place> here = s ? nearest(s->px) : std::nullopt;
    if (!here || merged_[here->line][here->vertex].is_repeated) return;
    const EdgeVertex& v = at(*here);
    if (!is_same_depth(double(v.idepth), double(v.idepth_sigma), s->idepth, s->sigma)) return;
    const auto along = direction(*this, *here), along_there = other->direction(*this, there);
    if (!along || !along_there || std::abs(along->dot(*along_there)) < kAlike) return;
    join(*here, other, there);
  }

  // The vertex that was first stays, at the mean of the depths by their information.
  void join(const Place& here, LinesInView* first, const Place& there) {
    const std::optional<Sighting> seen = first->sight(*this, here);
    if (!seen) return;
    EdgeVertex& v = first->keyframe_.lines[there.line].vertices[there.vertex];
    Merged& kept = first->merged_[there.line][there.vertex];
    const double before = kept.information > 0 ? kept.information : information(double(v.idepth_sigma)),
                 new_one = information(seen->sigma);
    kept.information = before + new_one;
    v.idepth = float((before * double(v.idepth) + new_one * seen->idepth) / kept.information);
    v.idepth_sigma = std::min(v.idepth_sigma, float(seen->sigma));  // errors of poses are no fewer
    merged_[here.line][here.vertex].is_repeated = true;
    const EdgeLine& line = keyframe_.lines[here.line];
    kept.keyframes += line.keyframes;
    kept.views += line.views + 1;  // the image of its host, too
  }
  static double information(double sigma) { return 1 / (sigma * sigma); }

  // The runs of vertices that stay; from all of a line, which stays as it is, to none.
  static void split(const EdgeLine& line, const std::vector<Merged>& merged, size_t least,
                    std::vector<EdgeLine>* kept) {
    for (size_t begin = 0; begin < merged.size();) {
      size_t end = begin;
      while (end < merged.size() && !merged[end].is_repeated) ++end;
      const bool is_whole = end - begin == merged.size();
      if (is_whole || end - begin >= least) kept->push_back(part_of(line, merged, begin, end));
      begin = end + 1;
    }
  }

  static EdgeLine part_of(const EdgeLine& line, const std::vector<Merged>& merged, size_t begin, size_t end) {
    EdgeLine part = line;
    part.vertices.assign(line.vertices.begin() + long(begin), line.vertices.begin() + long(end));
    std::vector<int> keyframes, views;
    for (size_t i = begin; i < end; ++i) {
      keyframes.push_back(merged[i].keyframes);
      views.push_back(merged[i].views);
    }
    part.keyframes += median(std::move(keyframes));
    part.views += median(std::move(views));
    return part;
  }

  static constexpr int kCellPx = 4;

  const Pinhole& pinhole_;
  KeyframeRecord& keyframe_;
  SE3 T_cam_world_;
  std::vector<std::vector<Merged>> merged_;  // by line and vertex
  std::vector<std::vector<Place>> cells_;    // of the image
  int columns_ = 0;
};

}  // namespace

void merge_repeated_lines(const Pinhole& pinhole, const EdgeMapParams& params,
                          std::vector<KeyframeRecord>* keyframes) {
  if (!params.is_fused()) return;
  std::vector<LinesInView> views;
  views.reserve(keyframes->size());
  for (KeyframeRecord& k : *keyframes) views.emplace_back(pinhole, &k);
  constexpr size_t kShared = kFusionKeyframes;  // with these as they came
  for (size_t k = kShared + 1; k < views.size(); ++k) {
    for (size_t before = 0; before + kShared < k; ++before)
      if (views[k].may_see(views[before])) views[k].compare(&views[before]);
    views[k].forget_index();
  }
  for (LinesInView& view : views) view.finish(size_t(params.step_px));
}

}  // namespace edgevo
