// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Fusion of the lines of a segment: each 3D edge is hosted once.
#include <cmath>
#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "depth_evidence.h"
#include "edge_planes.h"
#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/edge_map/edge_depth.h"
#include "edgevo/edge_map/edge_mapper.h"

namespace edgevo {

struct PyramidLevel;
struct ViewGeometry;

/// A vertex closer to the image border may not be visible, pixels.
constexpr double kSeenBorderPx = 4;
/// Depth in a keyframe over that in the host, below which a vertex is too near the camera, or behind it.
constexpr double kMinDepthRatio = 0.05;

/// Number of later keyframes that lines are compared with as they come.
constexpr int kFusionKeyframes = 12;
/// From a projected vertex to the edge that it is, pixels.
constexpr double kSeenAcrossPx = 1.5;

/// Whether an inverse depth that is known, with its standard deviation, is that of an edge found anew.
inline bool is_same_depth(double known, double known_sigma, double found, double found_sigma) {
  constexpr double kSigmas = 3, kShare = 0.03;
  return std::abs(known - found) < kSigmas * std::hypot(known_sigma, found_sigma) + kShare * found;
}

/// Data of a keyframe that the fusion needs.
struct EdgeHost {
  /// Of the keyframe; -1: it is a frame between keyframes.
  int id = -1;
  std::shared_ptr<const FramePyramid> pyramid;
  std::shared_ptr<const std::vector<EdgeSides>> sides;
  SE3 T_cam_world;
  /// Inverse of the smallest depth in view.
  double max_idepth = 0;
};

/// Fuses the lines of the keyframes of one segment.
class EdgeFusion {
 public:
  /// `log` receives final lines; `trace` may be null.
  EdgeFusion(const Rectification& rectification, const EdgeMapParams& params, const ViewAlignment& how,
             std::shared_ptr<MapLog> log, EdgeTrace* trace)
      : rectification_(rectification),
        pinhole_(rectification.target()),
        params_(params),
        how_(how),
        log_(std::move(log)),
        trace_(trace) {}

  void add(const EdgeHost& host, std::vector<EdgeView> views);
  void apply(const MapMoved& moved);
  void close();

 private:
  struct Vertex {
    EdgeVertex vertex;
    std::vector<EdgeVertex> after;  // edge pixels between it and the next vertex on its line, without depth
    int edge_pixel = -1;            // in its host
    Eigen::Vector2f normal;
    // Keyframes that see it, that see no edge there, and that see one at another depth.
    int seen = 1, missed = 0, contradicted = 0;
    int views = 0;                       // images that showed it when its host was added
    double weight = 0;                   // of the depths of all keyframes so far
    double new_weight = 0, new_sum = 0;  // of the current keyframe: weights, and weighted inverse depths
    int new_depths = 0;
    bool is_replaced = false;  // by a line of a nearer keyframe
    bool is_outline = false;
    bool is_on_plane = false, is_backed_by_plane = false;

    // By the keyframes besides its host: one with another depth takes a sighting back. Without any, three in
    // four are right.
    bool is_unlikely() const { return std::log(3) + log_odds_of_edge(seen - 1 - contradicted, missed) < 0; }
    // Whether the next image is likely to show it: where it does not, a neighbour would be taken for it.
    bool is_mostly_seen() const { return seen > missed + contradicted; }
  };
  using Line = std::vector<Vertex>;
  struct OpenHost {
    int id = -1;
    SE3 T_cam_world;
    std::vector<Line> lines;
  };
  struct Sighting;
  struct Explained;

  void predict_planes(const SE3& T_cam_world);
  std::vector<Line> find_lines(const EdgeHost& host, const std::vector<EdgeView>& views);
  void add_between(const EdgeHost& keyframe, const std::vector<EdgeView>& views);
  double nearest_idepth() const;
  void add_seen_between(const Line& line, const SE3& T_keyframe_host, std::vector<Line>* lines) const;
  std::vector<CloudPoint> cloud_for(const EdgeHost& host) const;
  void add_to_cloud(const ViewGeometry& view, const Vertex& v, std::vector<CloudPoint>* points) const;
  void project_lines(const EdgeHost& host, Explained* explained);
  void project_line(const EdgeHost& host, const OpenHost& open, Line* line, Explained* explained) const;
  std::vector<Sighting> sight(const PyramidLevel& level, const ViewGeometry& view, const Line& line) const;
  void add_new_lines(const EdgeHost& host, const EdgePiece& piece, Explained* explained,
                     std::vector<Line>* lines) const;
  bool is_novel(const EdgeNode& node, Explained* explained) const;
  void count(Explained* explained) const;
  void move_planes(const MapMoved& moved);
  static void merge_new_depths(Vertex* v);
  Vertex make_vertex(const EdgeHost& host, const EdgeNode& node, const Explained& explained) const;
  void add_pixels_between(const EdgeHost& host, Line* line) const;
  EdgeStage stage_of(const Vertex& v) const;
  void trace(int keyframe, int edge_pixel, EdgeStage stage) const;
  void finalise(const OpenHost& host);
  static double weight_of(double idepth, double sigma) { return idepth * idepth / (sigma * sigma); }
  /// Of pixel `k` between `a` and the next vertex `b`: linear there.
  static float idepth_after(const Vertex& a, const Vertex& b, size_t k) {
    const float share = float(k + 1) / float(a.after.size() + 1);
    return a.vertex.idepth + share * (b.vertex.idepth - a.vertex.idepth);
  }
  static void append_pixels_between(const Vertex& a, const Vertex& b, std::vector<EdgeVertex>* vertices);
  static EdgeLine make_line(const std::vector<const Vertex*>& run);
  void finalise_line(int host, const Line& line, std::vector<EdgeLine>* lines) const;

  Rectification rectification_;
  Pinhole pinhole_;
  EdgeMapParams params_;
  ViewAlignment how_;
  std::shared_ptr<MapLog> log_;
  EdgeTrace* trace_;
  std::deque<OpenHost> open_;      // ascending id
  std::vector<EdgePlane> planes_;  // of the last host, in its image
  int plane_host_ = -1;            // the last keyframe
  SE3 T_host_world_;               // pose of that keyframe
  SE3 T_plane_host_;               // of the last host, seen from that keyframe: a frame after it, or itself
};

}  // namespace edgevo
