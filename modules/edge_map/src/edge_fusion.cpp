// SPDX-License-Identifier: BSD-3-Clause
#include "edge_fusion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edgevo/core/depth_source.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/simd.h"
#include "edgevo/map/run_builder.h"
#include "straight_line.h"
#include "view_poses.h"

namespace edgevo {

/// Depth of an edge pixel as predicted by the line of an earlier keyframe.
struct KnownDepth {
  double idepth = 0;  // 0: none
  double sigma = 0;
  double h_z = 0, e_z = 0;  // of the sight line of the predicting vertex
};

namespace {

constexpr double kSeenAlongPx = 2.5;
constexpr double kInFront = 1.1;  // ratio of inverse depths: of two lines at one pixel the nearer is visible
// A new depth replaces a known one if its standard deviation is below this share.
constexpr double kMuchBetter = 0.75;
// A vertex is confirmed by a second keyframe with the same depth, by the plane that it lies on, or, if its
// depth is certain to this share, by this many images: of the vertices that only their host supports, from
// few images, half are wrong; of those less certain, too, which many views show at any depth along the
// motion.
constexpr int kMinSeen = 2, kManyViews = 6;
constexpr double kSureShare = 0.007;
constexpr int kMaxBridge = 40;  // pixels between two neighbours on a line, which spread as it comes nearer

bool is_same_depth(const KnownDepth& known, const EdgeNode& node) {
  return edgevo::is_same_depth(known.idepth, known.sigma, node.idepth, node.idepth_sigma);
}

// Whether a vertex that projects to `px`, with this normal in its host, lies on the edge.
bool is_at_edge(const ViewGeometry& view, const Eigen::Vector2d& normal, const Eigen::Vector2d& px,
                const EdgePixel& e) {
  const Eigen::Vector2d offset = e.position().cast<double>() - px;
  return std::abs(e.normal().cast<double>().dot(offset)) < kSeenAcrossPx &&
         offset.norm() < kSeenAcrossPx + kSeenAlongPx && is_like_direction(view, normal, e);
}

}  // namespace

// A vertex of an earlier line where a keyframe should see it.
struct EdgeFusion::Sighting {
  bool is_in_view = false;
  Eigen::Vector2d px;
  // The edge pixel of the keyframe; -1: there is none.
  int pixel = -1;
  KnownDepth depth;

  bool is_seen() const { return is_in_view && pixel >= 0; }
  bool is_missed() const { return is_in_view && pixel < 0; }
};

// The edge pixels of a keyframe that lines of earlier keyframes explain.
struct EdgeFusion::Explained {
  std::vector<KnownDepth> known;  // by edge pixel
  std::vector<Vertex*> source;    // the predicting vertex; for pixels between two, the nearer one
  std::vector<Vertex*> seen, missed, contradicted;

  std::vector<double> idepths() const {
    std::vector<double> all;
    all.reserve(known.size());
    for (const KnownDepth& k : known) all.push_back(k.idepth);
    return all;
  }

  // Of two lines at one pixel the nearer is visible.
  void mark(int pixel, const KnownDepth& depth, Vertex* vertex) {
    KnownDepth& there = known[size_t(pixel)];
    if (there.idepth > 0 && depth.idepth < kInFront * there.idepth) return;
    there = depth;
    source[size_t(pixel)] = vertex;
  }

  // Marks the pixels of the chain between two neighbours on a line: the inverse depth is linear there.
  void bridge(const ImageEdges& edges, const Sighting& a, const Sighting& b, Vertex* vertex) {
    const bool is_one_chain = edges.pixels[size_t(a.pixel)].chain == edges.pixels[size_t(b.pixel)].chain;
    if (!is_one_chain || std::abs(b.pixel - a.pixel) >= kMaxBridge) return;
    for (int k = std::min(a.pixel, b.pixel) + 1; k < std::max(a.pixel, b.pixel); ++k) {
      const double share = double(k - a.pixel) / (b.pixel - a.pixel);
      const double idepth = a.depth.idepth + share * (b.depth.idepth - a.depth.idepth);
      mark(k, {idepth, std::max(a.depth.sigma, b.depth.sigma), b.depth.h_z, b.depth.e_z}, vertex);
    }
  }
};

void EdgeFusion::add(const EdgeHost& host, std::vector<EdgeView> views) {
  align_tracked_views(cloud_for(host), how_, &views);
  predict_planes(host.T_cam_world);
  plane_host_ = host.id, T_host_world_ = host.T_cam_world, T_plane_host_ = SE3();
  open_.push_back({host.id, host.T_cam_world, {}});
  open_.back().lines = find_lines(host, views);
  if (params_.is_fused()) add_between(host, views);
  while (int(open_.size()) > kFusionKeyframes) {
    finalise(open_.front());
    open_.pop_front();
  }
}

// The lines that no earlier one explains.
std::vector<EdgeFusion::Line> EdgeFusion::find_lines(const EdgeHost& host,
                                                     const std::vector<EdgeView>& views) {
  Explained explained;
  explained.known.resize(host.pyramid->finest().edges.pixels.size());
  explained.source.resize(explained.known.size(), nullptr);
  if (params_.is_fused()) project_lines(host, &explained);
  std::vector<TracedPixel>* trace = trace_ && host.id >= 0 ? &(*trace_)[host.id] : nullptr;
  std::vector<Line> lines;
  for (const EdgePiece& piece : find_edge_depths(pinhole_, *host.pyramid, *host.sides, views, host.max_idepth,
                                                 params_, &planes_, trace, explained.idepths()))
    add_new_lines(host, piece, &explained, &lines);
  count(&explained);
  return lines;
}

// Pixels that no earlier line explains as well become lines of this keyframe, extended by one vertex at each
// end.
void EdgeFusion::add_new_lines(const EdgeHost& host, const EdgePiece& piece, Explained* explained,
                               std::vector<Line>* lines) const {
  std::vector<bool> is_new(piece.size());
  for (size_t i = 0; i < piece.size(); ++i) {
    is_new[i] = is_novel(piece[i], explained);
    if (!is_new[i]) trace(host.id, piece[i].edge_pixel, EdgeStage::kExplained);
  }
  for (size_t begin = 0; begin < piece.size();) {
    size_t end = begin;
    while (end < piece.size() && is_new[end]) ++end;
    if (end > begin) {
      const size_t from = begin > 0 ? begin - 1 : begin, to = end < piece.size() ? end + 1 : end;
      Line line;
      for (size_t i = from; i < to; ++i) line.push_back(make_vertex(host, piece[i], *explained));
      add_pixels_between(host, &line);
      lines->push_back(std::move(line));
    }
    begin = std::max(end, begin + 1);
  }
}

// Whether the node belongs to a new line. Records its evidence for or against the vertex that explains it.
bool EdgeFusion::is_novel(const EdgeNode& node, Explained* explained) const {
  const KnownDepth& known = explained->known[size_t(node.edge_pixel)];
  Vertex* by = explained->source[size_t(node.edge_pixel)];
  if (!by) return true;
  if (!is_same_depth(known, node)) {
    explained->contradicted.push_back(by);
    return true;
  }
  explained->seen.push_back(by);
  // z' = h_z / rho + e_z, and z' is off by the ratio of the two depths.
  const double z = (known.h_z / double(by->vertex.idepth) + known.e_z) * known.idepth / node.idepth;
  // The plane's depth is that of its other edges: nothing new.
  if (z > known.e_z && !node.is_on_plane) {
    const double weight = weight_of(node.idepth, node.idepth_sigma);
    by->new_weight += weight;
    by->new_sum += weight * known.h_z / (z - known.e_z);
    ++by->new_depths;
  }
  if (node.idepth_sigma > kMuchBetter * known.sigma) return false;
  by->is_replaced = true;
  return true;
}

void EdgeFusion::project_lines(const EdgeHost& host, Explained* explained) {
  for (OpenHost& open : open_)
    for (Line& line : open.lines) project_line(host, open, &line, explained);
}

void EdgeFusion::project_line(const EdgeHost& host, const OpenHost& open, Line* line,
                              Explained* explained) const {
  const PyramidLevel& level = host.pyramid->finest();
  const SE3 T_host_open = host.T_cam_world * open.T_cam_world.inverse();
  const ViewGeometry view(pinhole_, {host.pyramid, host.sides, T_host_open, 1});
  const std::vector<Sighting> sightings = sight(level, view, *line);
  for (size_t i = 0; i < line->size(); ++i) {
    const Sighting& here = sightings[i];
    Vertex* v = &(*line)[i];
    if (here.is_missed()) explained->missed.push_back(v);
    if (!here.is_seen()) continue;
    explained->mark(here.pixel, here.depth, v);
    if (i > 0 && sightings[i - 1].is_seen()) explained->bridge(level.edges, sightings[i - 1], here, v);
  }
}

// Of all vertices of a line: what is read lies nowhere near in memory, so that they wait for it together.
std::vector<EdgeFusion::Sighting> EdgeFusion::sight(const PyramidLevel& level, const ViewGeometry& view,
                                                    const Line& line) const {
  std::vector<Sighting> all(line.size());
  for (size_t i = 0; i < line.size(); ++i) {
    const Vertex& v = line[i];
    const SightLine ray(view, v.vertex.px.cast<double>());
    const double idepth = double(v.vertex.idepth), depth_ratio = ray.depth(idepth);
    if (v.is_replaced || !(depth_ratio > kMinDepthRatio)) continue;
    Sighting& s = all[i];
    s.px = ray.at(idepth), s.is_in_view = pinhole_.contains(s.px, kSeenBorderPx);
    // z' = z (h + rho e)_z: the inverse depth and its standard deviation in this keyframe.
    s.depth = {idepth / depth_ratio, double(v.vertex.idepth_sigma) / depth_ratio, ray.h.z(), ray.e.z()};
    if (s.is_in_view) level.field.prefetch_pixel(float(s.px.x()), float(s.px.y()));
  }
  for (Sighting& s : all) {
    if (s.is_in_view) s.pixel = level.field.nearest_pixel(float(s.px.x()), float(s.px.y()));
    if (s.pixel >= 0) level.field.prefetch_edge(s.pixel);
  }
  for (Sighting& s : all) {
    if (s.pixel >= 0) s.pixel = level.field.edge_at(s.pixel);
    if (s.pixel >= 0) prefetch(&level.edges.pixels[size_t(s.pixel)]);
  }
  for (size_t i = 0; i < line.size(); ++i) {
    Sighting& s = all[i];
    if (s.pixel >= 0 &&
        !is_at_edge(view, line[i].normal.cast<double>(), s.px, level.edges.pixels[size_t(s.pixel)]))
      s.pixel = -1;
  }
  return all;
}

// Each vertex is seen or missed at most once per keyframe.
void EdgeFusion::count(Explained* explained) const {
  const auto distinct = [](std::vector<Vertex*>* v) {
    std::sort(v->begin(), v->end());
    v->erase(std::unique(v->begin(), v->end()), v->end());
  };
  distinct(&explained->seen);
  distinct(&explained->missed);
  distinct(&explained->contradicted);
  for (Vertex* v : explained->seen) {
    ++v->seen;
    merge_new_depths(v);
  }
  const auto is_in = [](const std::vector<Vertex*>& all, Vertex* v) {
    return std::binary_search(all.begin(), all.end(), v);
  };
  for (Vertex* v : explained->contradicted) v->contradicted += !is_in(explained->seen, v);
  for (Vertex* v : explained->missed)
    v->missed += !is_in(explained->seen, v) && !is_in(explained->contradicted, v);
}

// Averages the depths of the keyframes. They share some images, so the standard deviation does not decrease.
void EdgeFusion::merge_new_depths(Vertex* v) {
  if (v->new_depths == 0) return;
  const double weight = v->new_weight / v->new_depths, mean = v->new_sum / v->new_weight;
  v->vertex.idepth = float((v->weight * double(v->vertex.idepth) + weight * mean) / (v->weight + weight));
  v->weight += weight;
  v->new_depths = 0;
  v->new_weight = v->new_sum = 0;
}

EdgeFusion::Vertex EdgeFusion::make_vertex(const EdgeHost& host, const EdgeNode& node,
                                           const Explained& explained) const {
  const EdgePixel& e = host.pyramid->finest().edges.pixels[size_t(node.edge_pixel)];
  const EdgeSides& sides = (*host.sides)[size_t(node.edge_pixel)];
  Vertex v;
  v.vertex = {e.position(), float(node.idepth), float(node.idepth_sigma), sides.dark, sides.bright};
  v.edge_pixel = node.edge_pixel;
  v.weight = weight_of(node.idepth, node.idepth_sigma);
  v.normal = e.normal();
  v.views = node.views;
  v.is_outline = node.is_outline;
  v.is_on_plane = node.is_on_plane, v.is_backed_by_plane = node.is_backed_by_plane;
  const Vertex* before = explained.source[size_t(node.edge_pixel)];
  if (before && is_same_depth(explained.known[size_t(node.edge_pixel)], node)) v.seen += before->seen;
  return v;
}

void EdgeFusion::add_pixels_between(const EdgeHost& host, Line* line) const {
  const ImageEdges& edges = host.pyramid->finest().edges;
  for (size_t i = 0; i + 1 < line->size(); ++i)
    for (int k = (*line)[i].edge_pixel + 1; k < (*line)[i + 1].edge_pixel; ++k) {
      const EdgeSides& sides = (*host.sides)[size_t(k)];
      (*line)[i].after.push_back({edges.pixels[size_t(k)].position(), 0, 0, sides.dark, sides.bright});
    }
}

void EdgeFusion::finalise(const OpenHost& host) {
  LinesFinished finished{host.id, {}};
  for (const Line& line : host.lines) finalise_line(host.id, line, &finished.lines);
  log_->append(std::move(finished));
}

EdgeStage EdgeFusion::stage_of(const Vertex& v) const {
  if (!params_.is_fused()) return EdgeStage::kKept;
  if (v.is_replaced) return EdgeStage::kReplaced;
  if (v.is_unlikely()) return EdgeStage::kMissed;
  if (v.is_on_plane || v.is_backed_by_plane || v.seen >= kMinSeen) return EdgeStage::kKept;
  const bool is_sure = double(v.vertex.idepth_sigma) <= kSureShare * double(v.vertex.idepth);
  return is_sure && v.views >= kManyViews ? EdgeStage::kKept : EdgeStage::kUnconfirmed;
}

void EdgeFusion::trace(int keyframe, int edge_pixel, EdgeStage stage) const {
  if (trace_ && keyframe >= 0 && edge_pixel >= 0) trace_->at(keyframe)[size_t(edge_pixel)].reach(stage);
}

void EdgeFusion::append_pixels_between(const Vertex& a, const Vertex& b, std::vector<EdgeVertex>* vertices) {
  for (size_t k = 0; k < a.after.size(); ++k) {
    EdgeVertex v = a.after[k];
    v.idepth = idepth_after(a, b, k);
    v.idepth_sigma = std::max(a.vertex.idepth_sigma, b.vertex.idepth_sigma);
    vertices->push_back(v);
  }
}

EdgeLine EdgeFusion::make_line(const std::vector<const Vertex*>& run) {
  std::vector<EdgeVertex> found;
  std::vector<int> keyframes, views;
  size_t outline = 0, on_plane = 0;
  EdgeLine line;
  for (size_t i = 0; i < run.size(); ++i) {
    found.push_back(run[i]->vertex);
    keyframes.push_back(run[i]->seen);
    views.push_back(run[i]->views);
    outline += run[i]->is_outline, on_plane += run[i]->is_on_plane;
    if (i > 0) append_pixels_between(*run[i - 1], *run[i], &line.vertices);
    line.vertices.push_back(run[i]->vertex);
  }
  line.keyframes = median(std::move(keyframes));
  line.views = median(std::move(views));
  line.source = 2 * on_plane > run.size() ? DepthSource::kPlane : DepthSource::kViews;
  line.is_straight = is_straight(found);
  line.is_outline = 2 * outline > run.size();
  return line;
}

// Splits the line into runs of vertices that are kept.
void EdgeFusion::finalise_line(int host, const Line& line, std::vector<EdgeLine>* lines) const {
  std::vector<const Vertex*> run;
  const auto flush = [&] {
    if (run.size() >= 2) lines->push_back(make_line(run));
    run.clear();
  };
  for (const Vertex& v : line) {
    const EdgeStage stage = stage_of(v);
    trace(host, v.edge_pixel, stage);
    if (stage == EdgeStage::kKept)
      run.push_back(&v);
    else
      flush();
  }
  flush();
}

// Lines that are final have left as events: whoever holds them moves them.
void EdgeFusion::apply(const MapMoved& moved) {
  move_planes(moved);
  for (OpenHost& host : open_) {
    const KeyframeMove* m = moved.find(host.id);
    if (!m) continue;
    host.T_cam_world = moved.T_cam_map(*m);
    const auto move = [&](EdgeVertex* v) { apply_move(rectification_, moved, *m, v); };
    for (Line& line : host.lines)
      for (Vertex& v : line) {
        move(&v.vertex);
        for (EdgeVertex& between : v.after) move(&between);
      }
  }
}

void EdgeFusion::close() {
  for (const OpenHost& host : open_) finalise(host);
  open_.clear();
  planes_.clear();
}

}  // namespace edgevo
