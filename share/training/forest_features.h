#pragma once
// What a structured forest looks at: the feature channels of a patch, exactly as OpenCV's detector sees them.
#include <opencv2/core.hpp>

namespace edgevo::training {

/// The options of OpenCV's model file; defaults are those of Dollar and Zitnick, "Fast Edge Detection Using
/// Structured Forests".
struct ForestShape {
  int stride = 2;              ///< pixels from patch to patch
  int shrink = 2;              ///< image pixels a feature pixel, each way
  int patch = 32, inner = 16;  ///< pixels: what is looked at, and its middle, which is predicted
  int orientations = 4;
  int gradient_smoothing = 0, regular_smoothing = 2, similarity_smoothing = 8,
      gradient_normalisation = 4;  ///< radii, pixels
  int grid = 5;                    ///< cells a side whose differences are features
  int trees = 8, trees_asked = 4;

  int channels() const { return 2 * (orientations + 1) + 3; }
  int side() const { return patch / shrink; }
  int border() const { return (patch - inner) / 2; }
  int plain_features() const { return side() * side() * channels(); }
  int pair_features() const { return grid * grid * (grid * grid - 1) / 2 * channels(); }
  int features() const { return plain_features() + pair_features(); }
};

/// Features of an image, smoothed both ways; a patch is named by its row and column on the grid of strides.
class FeatureMaps {
 public:
  /// `gray`: CV_8U; sides are multiples of 4 so that OpenCV rounds nothing.
  FeatureMaps(const cv::Mat& gray, const ForestShape& shape);
  int rows() const { return rows_; }
  int cols() const { return cols_; }
  /// Feature `id` of the patch, 0 <= id < shape.features().
  float at(int row, int col, int id) const;

 private:
  float value(const cv::Mat& map, int row, int col, int y, int x, int channel) const;
  ForestShape shape_;
  int rows_, cols_;
  cv::Mat regular_, similarity_;
};

}  // namespace edgevo::training
