// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One rendered frame, compared with the lines of a map.
#include <vector>

#include "edgevo/map_evaluation/map_figures.h"
#include "placed_lines.h"
#include "true_view.h"

namespace edgevo {

/// A frame with the lines in it.
struct ComparedFrame {
  ComparedFrame(const SceneRenderer& scene, PyramidBuilder* builder, const PlacedLines& lines, int index,
                const MapEvaluationOptions& options);

  TrueView view;
  std::vector<DrawnPixel> drawn;
  /// By edge of the view: whether a line explains it, and whether none does but one that lies along it there
  /// has another depth.
  std::vector<bool> is_found, is_misplaced;
  /// By drawn pixel.
  std::vector<bool> is_hidden, is_right;
  std::vector<EdgePlace> place;
};

}  // namespace edgevo
