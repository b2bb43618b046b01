// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The edges that the keyframes of a run saw, at their true positions in a rendered scene, as ground truth for
// its map.
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
  /// Share of the true edges, seen by three keyframes, that are reconstructed.
  double completeness = 0;
  /// Share of the reconstructed length that lies at a true edge.
  double accuracy = 0;
  /// Completeness and accuracy of the sparse points alone.
  double points_completeness = 0, points_accuracy = 0;
  /// Completeness of lines and points together.
  double both_completeness = 0;
  /// Number of cubes with true edges; their side is half the tolerance.
  int64_t true_cells = 0;
  /// Length of the reconstructed edges within range, metres.
  double length = 0;
  int64_t vertices = 0, lines = 0, keyframes = 0;
};
std::ostream& operator<<(std::ostream& out, const EdgeMapQuality& quality);

/// An edge pixel in the clean image of a keyframe.
struct TruePixel {
  Eigen::Vector2f px, normal;
  /// True position in the camera frame, metres.
  Eigen::Vector3d p_cam;
  std::array<int, 3> cell;
};

class TrueEdges {
 public:
  using Cell = std::array<int, 3>;

  /// `range`: metres from the camera; `tolerance`: metres between a reconstructed edge and a true one.
  TrueEdges(const SceneRenderer& renderer, const Run& run, double range, double tolerance);

  /// Compares the lines and points of `run` with the true edges.
  EdgeMapQuality evaluate(const Run& run) const;

  /// Metres per unit of the run.
  double scale() const { return scale_; }
  /// Largest distance between a reconstructed edge and a true one, metres.
  double tolerance() const { return tolerance_; }
  /// True edge pixels of each keyframe, within range.
  const std::vector<std::vector<TruePixel>>& pixels() const { return pixels_; }
  /// Whether at least three keyframes saw the cell.
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
  /// Cells that the lines of a run pass through, for is_reconstructed().
  Cells cells_of_lines(const Run& run) const;
  /// Whether a line passes within the tolerance of a true cell.
  bool is_reconstructed(const Cell& cell, const Cells& lines) const {
    return has_near(lines, seen_.at(cell).mean());
  }

 private:
  Cell cell_of(const Eigen::Vector3d& p) const;
  void add_edges(int keyframe, int frame_index);
  bool has_near(const Cells& cells, const Eigen::Vector3d& p) const;
  Eigen::Vector3d in_scene(const KeyframeRecord& k, const Eigen::Vector3d& p_cam) const;
  void add(const Eigen::Vector3d& p, Cells* cells) const;
  void evaluate_points(const Run& run, Cells* points, EdgeMapQuality* q) const;
  void evaluate_lines(const Run& run, Cells* lines, EdgeMapQuality* q) const;

  const SceneRenderer* renderer_;
  double range_, tolerance_;
  /// Metres per unit of the run.
  double scale_ = 1;
  /// Pose of the run in the scene, applied after the scale.
  SE3 T_scene_run_;
  Cells seen_;
  std::vector<std::vector<TruePixel>> pixels_;
};

}  // namespace edgevo::test
