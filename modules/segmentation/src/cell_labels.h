// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One label for each cell of the edge image: scene, or fixed to the camera (a gripper, a bonnet, a
// dashboard). Edges of a fixed part keep their pixel while those of the scene move. Taken for edges of the
// scene, they contradict every motion of the camera; and because they never leave the view, in time the map
// would contain more of them than of the scene, and follow them.
//
// Each cell is a sequential test of the two labels by one question: are the edges that it has shown still at
// their place? Those of a fixed part are with a probability of kFixedFound; those of the scene with the
// probability with which that happens in this image to edges of their direction in cells of the scene: little
// after a displacement of a pixel or more, nearly 1 while the camera stands. Scene and fixed are then the
// same motion, and there is no evidence for either: that is a standstill, known without pose and map.
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "edgevo/edges/gradient.h"
#include "edgevo/edges/image_edges.h"
#include "edgevo/edges/plane.h"
#include "edgevo/segmentation/still_cells.h"

namespace edgevo {

/// Rounds a coordinate, which is not negative: as std::lround(), without its call. The sum is exact in
/// double.
inline int nearest_pixel(float v) { return int(double(v) + 0.5); }

/// Labels of the images of one camera, in the coordinates of one level of their pyramids.
class CellLabels {
 public:
  /// Adds the next image: its gradient and its edges, none of them masked; all images have the same size.
  /// Returns true if the area has changed. Cost: 0.2 ms for 8000 edge pixels.
  bool add(const ImageEdges& edges, const Gradient& gradient);
  /// The view has turned by `px`, pixels of the level, up to the newest image: that much has anything moved
  /// that is far away.
  void add_turn(const Eigen::Vector2f& px);
  /// Forgets what turns have shown: how far the view has turned is unknown.
  void interrupt_turns();
  /// Area of the fixed parts: 255 on them and a few pixels around; null if there is none.
  std::shared_ptr<const Plane<uint8_t>> area() const { return area_; }
  /// Whether some of the view looks fixed, but not for long enough to know.
  bool is_undecided() const { return is_undecided_; }
  /// The cells that stand still before a camera that stands; else empty.
  StillCells still_cells() const;

 private:
  // An edge pixel that a cell has shown; position and unit normal in pixels of the level.
  struct Edge {
    float x, y, nx, ny;
    float fixed = 0;  // logarithm of the odds: fixed over scene
    int direction = 0;
    bool is_found = true;  // at its place in the newest image
  };
  struct Cell {
    std::vector<Edge> edges;   // that may be fixed
    int found = 0, shown = 0;  // of them; edges of the newest image
    float fixed = 0;           // the mean of its best edges
    int turns = 0;             // of the view, that would have moved its edges if they were far away
    Eigen::Vector2f turned = Eigen::Vector2f::Zero();  // of the view, at the last one
    bool in_part = false;
    // What has become dark has not moved.
    bool is_dark() const { return shown == 0; }
    bool speaks() const;  // shows enough, then and now
    bool has_left() const { return speaks() && 2 * found < int(edges.size()); }
    bool is_still() const;
  };
  struct Counts {
    int cells = 0, still = 0, moving = 0;
  };

  void prepare(int width, int height);
  int cell_at(float x, float y) const { return int(y) / size_ * columns_ + int(x) / size_; }
  template <class F>
  void around(int c, const F& f) const;
  void find(const ImageEdges& edges, const Gradient& gradient);
  Counts count() const;
  bool moves_as_one(const ImageEdges& edges) const;
  bool is_compact() const;
  bool stands(const ImageEdges& edges) const;
  void weigh();
  std::vector<float> smooth() const;
  void add_edges(const ImageEdges& edges);
  std::vector<uint8_t> parts(const std::vector<float>& fixed, double least) const;
  bool is_part(const std::vector<int>& cells, double least) const;
  void fill_gaps(const std::vector<float>& fixed, double least, std::vector<uint8_t>* parts) const;
  void keep_dark(std::vector<uint8_t>* parts) const;
  void enclose(std::vector<uint8_t>* parts) const;
  Plane<uint8_t> drawn(const std::vector<uint8_t>& parts) const;
  bool update_area();

  int width_ = 0, height_ = 0, size_ = 0, columns_ = 0, rows_ = 0;
  std::vector<Cell> cells_;
  Plane<uint8_t> occupied_;                           // 1: an edge of a cell is there
  std::vector<EdgePixel> before_;                     // some edges of the image before
  Eigen::Vector2f turned_ = Eigen::Vector2f::Zero();  // pixels, since the first image
  int stood_ = 0, compared_ = 0;
  std::vector<uint8_t> still_;
  std::shared_ptr<const Plane<uint8_t>> area_;
  bool is_undecided_ = false;
  bool has_poses_ = false;  // turns are known
};

}  // namespace edgevo
