// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Feature channels of a patch for a structured forest, exactly as OpenCV's detector computes them.
#include <opencv2/core.hpp>

namespace edgevo::training {

/// Options of OpenCV's model file; the defaults are those of Dollar and Zitnick, "Fast Edge Detection Using
/// Structured Forests".
struct ForestShape {
  /// Distance of patches, pixels.
  int stride = 2;
  /// Image pixels per feature pixel, in each direction.
  int shrink = 2;
  /// Sides of the patch that is read, and of its centre that is predicted, pixels.
  int patch = 32, inner = 16;
  int orientations = 4;
  /// Smoothing radii, pixels.
  int gradient_smoothing = 0, regular_smoothing = 2, similarity_smoothing = 8, gradient_normalisation = 4;
  /// Cells per side of the grid whose differences are features.
  int grid = 5;
  /// Number of trees, and of those evaluated per patch.
  int trees = 8, trees_evaluated = 4;

  int channels() const { return 2 * (orientations + 1) + 3; }
  int side() const { return patch / shrink; }
  int border() const { return (patch - inner) / 2; }
  int plain_features() const { return side() * side() * channels(); }
  int pair_features() const { return grid * grid * (grid * grid - 1) / 2 * channels(); }
  int features() const { return plain_features() + pair_features(); }
};

/// Features of an image, with both smoothing radii; a patch is addressed by its row and column on the stride
/// grid.
class FeatureMaps {
 public:
  /// `gray` is CV_8U; its sides are multiples of 4, so that OpenCV does not round.
  FeatureMaps(const cv::Mat& gray, const ForestShape& shape);
  int rows() const { return rows_; }
  int cols() const { return cols_; }
  /// Feature `id` of a patch, 0 <= id < shape.features().
  float at(int row, int col, int id) const;

 private:
  float value(const cv::Mat& map, int row, int col, int y, int x, int channel) const;
  ForestShape shape_;
  int rows_, cols_;
  cv::Mat regular_, similarity_;
};

}  // namespace edgevo::training
