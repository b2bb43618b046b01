#pragma once
// The lines of a segment, fused: each 3D edge is hosted once.
#include <deque>
#include <optional>
#include <vector>

#include "edgevo/edge_map/edge_depth.h"
#include "edgevo/edge_map/edge_mapper.h"

namespace edgevo {

struct PyramidLevel;
struct ViewGeometry;

/// A keyframe as the fusion needs it.
struct EdgeHost {
  int id = -1;
  std::shared_ptr<const FramePyramid> pyramid;
  std::shared_ptr<const std::vector<EdgeSides>> sides;
  SE3 T_cam_world;
  ImageMotion motion;     ///< of its image
  double max_idepth = 0;  ///< nothing is nearer than 1 over it
};

class EdgeFusion {
 public:
  /// `trace`: may be null
  EdgeFusion(const Pinhole& pinhole, const EdgeMapParams& params, EdgeTrace* trace)
      : pinhole_(pinhole), params_(params), trace_(trace) {}

  void add(const EdgeHost& host, const std::vector<EdgeView>& views);
  void apply(const MapRevision& revision);
  std::vector<HostedLines> close();

 private:
  struct Vertex {
    EdgeVertex vertex;
    std::vector<EdgeVertex> after;  // the edge pixels from it to the next one on its line, without depth
    int edge_pixel = -1;            // of its host
    Eigen::Vector2f normal;
    int seen = 1, missed = 0;              // keyframes
    int views = 0;                         // images that showed it to its host
    double weight = 0;                     // of what keyframes told of its depth so far
    double told_weight = 0, told_sum = 0;  // by the keyframe at hand: weights, and weighted inverse depths
    int told = 0;
    bool is_replaced = false;  // by a nearer keyframe's
    bool is_outline = false;
  };
  using Line = std::vector<Vertex>;
  struct OpenHost {
    int id = -1;
    SE3 T_cam_world;
    ImageMotion motion;
    std::vector<Line> lines;
  };
  struct Sighting;
  struct Explained;

  void project_lines(const EdgeHost& host, Explained* explained);
  void project_line(const EdgeHost& host, const OpenHost& open, Line* line, Explained* explained) const;
  std::optional<Sighting> sight(const PyramidLevel& level, const ViewGeometry& view, const Vertex& v) const;
  void add_new_stretches(const EdgeHost& host, const EdgePiece& piece, Explained* explained,
                         std::vector<Line>* lines) const;
  bool is_news(const EdgeNode& node, Explained* explained) const;
  void count(Explained* explained) const;
  static void take_over(Vertex* v);
  Vertex make_vertex(const EdgeHost& host, const EdgeNode& node, const Explained& explained) const;
  void add_pixels_between(const EdgeHost& host, Line* line) const;
  EdgeFate fate_of(const Vertex& v) const;
  void trace(int keyframe, int edge_pixel, EdgeFate fate) const;
  void settle(const OpenHost& host);
  static void append_pixels_between(const Vertex& a, const Vertex& b, std::vector<EdgeVertex>* vertices);
  static EdgeLine finish(const std::vector<const Vertex*>& stretch);
  void settle_line(int host, const Line& line, std::vector<EdgeLine>* lines) const;

  Pinhole pinhole_;
  EdgeMapParams params_;
  EdgeTrace* trace_;
  std::deque<OpenHost> open_;         // ascending id
  std::vector<HostedLines> settled_;  // ascending id
  std::vector<ImageMotion> motions_;  // of the settled ones: their pixels move when the camera is corrected
};

}  // namespace edgevo
