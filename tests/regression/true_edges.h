#pragma once
// The edges that the keyframes of a run saw, at their true place in a rendered scene, as the judge of its
// map.
//
// A true edge is an edge pixel of the clean rendered image of a keyframe (whatever light the run had) at its
// true depth: creases, outlines, borders of texture and of shadow, and whatever else looks like an edge.
#include <array>
#include <cstdint>
#include <ostream>
#include <unordered_map>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo::test {

struct EdgeMapQuality {
  double completeness = 0;  ///< share of the true edges, seen by three keyframes, that are reconstructed
  double accuracy = 0;      ///< share of the reconstructed length that lies at a true edge
  double points_completeness = 0, points_accuracy = 0;  ///< the same of the sparse points alone
  double both_completeness = 0;
  int64_t true_cells = 0;  ///< cubes of half the tolerance with true edges
  double length = 0;       ///< metres of reconstructed edges within range
  int64_t vertices = 0, lines = 0, keyframes = 0;
};
std::ostream& operator<<(std::ostream& out, const EdgeMapQuality& quality);

/// A pixel of an edge of a clean image of a keyframe.
struct TruePixel {
  Eigen::Vector2f px, normal;
  Eigen::Vector3d p_cam;  ///< metres
  std::array<int, 3> cell;
};

class TrueEdges {
 public:
  using Cell = std::array<int, 3>;

  /// `range`: metres from the camera; `tolerance`: metres between a reconstructed edge and a true one.
  TrueEdges(const SceneRenderer& renderer, const Run& run, double range, double tolerance);

  EdgeMapQuality judge(const Run& run) const;

  double scale() const { return scale_; }          ///< metres per unit of the run
  double tolerance() const { return tolerance_; }  ///< metres
  /// Of each keyframe, within range.
  const std::vector<std::vector<TruePixel>>& pixels() const { return pixels_; }
  /// Three keyframes saw it.
  bool is_counted(const Cell& cell) const;

 private:
  struct CellHash {
    size_t operator()(const Cell& c) const {
      return size_t(c[0]) * 73856093u ^ size_t(c[1]) * 19349663u ^ size_t(c[2]) * 83492791u;
    }
  };
  struct Seen {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int pixels = 0, keyframes = 0, last_keyframe = -1;
    Eigen::Vector3d mean() const { return sum / pixels; }
  };
  using Cells = std::unordered_map<Cell, Seen, CellHash>;

 public:
  /// The cells that lines of a run fill, for is_reconstructed().
  Cells cells_of_lines(const Run& run) const;
  /// A line passes a true cell within the tolerance.
  bool is_reconstructed(const Cell& cell, const Cells& lines) const {
    return has_near(lines, seen_.at(cell).mean());
  }

 private:
  Cell cell_of(const Eigen::Vector3d& p) const;
  void add_edges(int keyframe, int frame_index);
  bool has_near(const Cells& cells, const Eigen::Vector3d& p) const;
  Eigen::Vector3d in_scene(const KeyframeRecord& k, const Eigen::Vector3d& p_cam) const;
  void add(const Eigen::Vector3d& p, Cells* cells) const;
  void judge_points(const Run& run, Cells* points, EdgeMapQuality* q) const;
  void judge_lines(const Run& run, Cells* lines, EdgeMapQuality* q) const;

  const SceneRenderer* renderer_;
  double range_, tolerance_;
  double scale_ = 1;  ///< metres per unit of the run
  SE3 T_scene_run_;   ///< after the scale
  Cells seen_;
  std::vector<std::vector<TruePixel>> pixels_;
};

}  // namespace edgevo::test
