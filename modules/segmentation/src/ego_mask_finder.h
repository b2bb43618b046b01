// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds what is fixed to the camera: a gripper, a bonnet, a dashboard. Its edges keep their pixel while those
// of the scene move. Taken for edges of the scene, they contradict every motion of the camera; and because
// they never leave the view, in time the map would contain more of them than of the scene, and follow them.
//
// Each edge pixel is a sequential test of two hypotheses. An edge of a fixed part shows in the gradient at
// its place with a probability of about 0.7 (outlines vanish where the background has their brightness). An
// edge of the scene shows there, or another one in its place, with the probability with which that happens
// now to the edges of the cells that move: little after a displacement of a pixel or more, nearly 1 while the
// camera stands, which is then no evidence for either. Images are compared only once most cells of the view
// have moved since the one before; a bus before a standing camera moves few.
#include <memory>
#include <vector>

#include "edgevo/edges/gradient.h"
#include "edgevo/edges/image_edges.h"
#include "edgevo/edges/plane.h"
#include "edgevo/segmentation/still_cells.h"
#include "fixed_area.h"

namespace edgevo {

/// How much of the view moves, from the edges alone: cells that show strong edges, compared with an image
/// before. Parts that are fixed to the camera do not count.
struct ViewMotion {
  /// Number of cells; of those whose edges keep their place; of those in which most edges leave it.
  int cells = 0, still = 0, moving = 0;
  /// Whether the camera stands: half of the view stands still. Once it stands, what crosses the view may
  /// cover more, little by little; a camera that begins to move moves everything at once.
  bool stands = false;
};

/// Fixed parts in the images of one camera, in the coordinates of one level of their pyramids.
class EgoMaskFinder {
 public:
  /// Adds the next image: its gradient and its edges, none of them masked; all images have the same size.
  /// Returns true if the area has changed. Cost: 0.3 ms for 8000 edge pixels.
  bool add(const ImageEdges& edges, const Gradient& gradient);
  /// Area of the fixed parts: 255 on them and a few pixels around; null if there is none.
  std::shared_ptr<const Plane<uint8_t>> area() const { return area_; }
  /// Whether some of the view looks fixed, but not for long enough to know.
  bool is_undecided() const { return is_undecided_; }
  /// The cells that stand still before a camera that stands; else empty.
  StillCells still_cells() const;
  /// Number of images that were compared.
  int compared() const { return compared_; }

 private:
  void prepare(int width, int height);
  void look(const Gradient& gradient);
  void compare_cells();
  int kind(const FixedCandidate& c) const;
  std::vector<double> scene_shares() const;
  void weigh(const std::vector<double>& shares);
  void add_candidates(const ImageEdges& edges);
  bool update_area(const ImageEdges& edges, bool is_early);
  int cell(float x, float y) const;

  int width_ = 0, height_ = 0, compared_ = 0;
  std::vector<FixedCandidate> candidates_;
  Plane<uint8_t> occupied_;  // 1: a candidate is there
  LeavingEdges leaving_;
  std::vector<uint8_t> moves_, still_;  // by cell
  std::shared_ptr<const Plane<uint8_t>> area_;
  bool is_undecided_ = false;
  ViewMotion motion_;
};

}  // namespace edgevo
