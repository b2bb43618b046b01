// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds what is fixed to the camera: a gripper, a bonnet, a dashboard, a watermark. Its edges keep their
// pixel while those of the scene move. Taken for edges of the scene, they contradict every motion of the
// camera; and because they never leave the view, in time the map would contain more of them than of the
// scene, and follow them.
//
// The view is divided into cells. Each has a label, the log-odds of {fixed to the camera : scene}, and one
// statistic moves it: how many of the cell's edges of earlier images still show at their place, against the
// chance of that for edges of their direction and region in this image, measured where the view moves
// (KeptEdges::chances). While most of the view does not move, scene and fixed parts have the same motion, and
// nothing is evidence; then the camera stands. Cells that lie together add up: a part is fixed if all of it
// is.
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "edgevo/edges/gradient.h"
#include "edgevo/edges/image_edges.h"
#include "edgevo/edges/plane.h"
#include "edgevo/segmentation/still_cells.h"
#include "kept_edges.h"
#include "view_motion.h"

namespace edgevo {

/// Labels of the cells of one camera's view, on one level of its pyramids.
class CellLabels {
 public:
  /// Cells that touch this area, 255 there, of the level's size, take no part: what is masked by hand is
  /// evidence of nothing. To be called before add().
  void exclude(const Plane<uint8_t>& area);
  /// Adds the next image: its gradient and its edges, none of them masked, and where it shows anything of its
  /// own (ViewObserver::add_edges); all images have the same size.
  /// Returns true if the area has changed. Cost: 0.3 ms for 8000 edge pixels.
  bool add(const ImageEdges& edges, const Gradient& gradient, const Plane<uint8_t>& shown,
           const RowShifts& rows = {});
  /// Area of the fixed parts: 255 on them and a few pixels around; null if there is none.
  std::shared_ptr<const Plane<uint8_t>> area() const { return area_; }
  /// Whether some of the view looks fixed, but not for long enough to know.
  bool is_undecided() const { return is_undecided_; }
  /// The cells that stand still before a camera that stands; else empty.
  StillCells still_cells() const { return motion_.still_cells(); }

 private:
  // Sums of products of normals, of edges that keep their place.
  struct Directions {
    float xx = 0, xy = 0, yy = 0;
    void add(float x, float y) { xx += x * x, xy += x * y, yy += y * y; }
    void add(const Directions& d) { xx += d.xx, xy += d.xy, yy += d.yy; }
    // Whether most are more than 45 degrees from this angle.
    bool are_across(double angle) const {
      return (xx - yy) * std::cos(2 * angle) + 2 * xy * std::sin(2 * angle) < 0;
    }
  };
  void prepare(int width, int height);
  std::vector<uint8_t> voters() const;
  void weigh(const std::vector<double>& chances);
  double log_odds_of(const std::vector<int>& part, float least) const;
  bool lies_across(const std::vector<int>& part) const;
  void label();
  void add_between(size_t first, size_t step, size_t number, std::vector<uint8_t>* fixed) const;
  void add_enclosed(std::vector<uint8_t>* fixed) const;
  bool update_area();

  int width_ = 0, height_ = 0;
  // Of the last image from which most of the view moved, and of one 8 to 16 such images earlier.
  std::optional<KeptEdges> recent_, kept_, next_;
  ViewMotion motion_, motion_of_kept_;
  int age_ = 0;                                       // of what is kept, images
  std::vector<uint8_t> takes_part_, fixed_, masked_;  // by cell
  std::vector<Directions> directions_;                // by cell
  std::vector<float> log_odds_;                       // by cell
  std::shared_ptr<const Plane<uint8_t>> area_;
  bool is_undecided_ = false;
};

}  // namespace edgevo
