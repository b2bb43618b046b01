// SPDX-License-Identifier: BSD-3-Clause
// Structured forests (Dollar and Zitnick, ICCV 2013) by OpenCV's ximgproc: each patch of the image is passed
// through some trees whose leaves contain edge patches, which are added up.
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/structured_edge_detection.hpp>

#include "detector_list.h"
#include "edgevo/core/error.h"
#include "edgevo/edges/opencv_view.h"
#include "edgevo/files/share_folder.h"
#include "file_checksum.h"
#include "forest_model.h"

namespace edgevo {
namespace {

int next_multiple(int size, int of) { return (size + of - 1) / of * of; }

class StructuredProbability : public EdgeProbability {
 public:
  explicit StructuredProbability(const std::string& path) : path_(path), options_(read_forest(path).options) {
    forest_ = cv::ximgproc::createStructuredEdgeDetection(path);
  }

  Plane<uint8_t> estimate(const ImageView<uint8_t>& gray, const std::string&) override {
    cv::Mat found;
    forest_->detectEdges(padded(gray), found);
    Plane<uint8_t> probability(gray.width, gray.height);
    found(cv::Rect(0, 0, gray.width, gray.height)).convertTo(as_mat(probability), CV_8U, 255.0);
    return probability;
  }

  std::string description() const override { return file_checksum(path_); }

 private:
  // Three channels of 0 to 1. OpenCV rounds the size of its features, and then reads patches outside the
  // image. So the size is a multiple of the shrink factor, and not smaller than a patch.
  cv::Mat padded(const ImageView<uint8_t>& gray) const {
    const int side = 2 * options_.shrinkNumber;
    const int width = next_multiple(std::max(gray.width, options_.patchSize), side);
    const int height = next_multiple(std::max(gray.height, options_.patchSize), side);
    cv::Mat wide, colour, scaled;
    cv::copyMakeBorder(as_mat(gray), wide, 0, height - gray.height, 0, width - gray.width,
                       cv::BORDER_REPLICATE);
    cv::cvtColor(wide, colour, cv::COLOR_GRAY2RGB);
    colour.convertTo(scaled, CV_32F, 1.0 / 255.0);
    return scaled;
  }

  std::string path_;
  ForestOptions options_;
  cv::Ptr<cv::ximgproc::StructuredEdgeDetection> forest_;
};

}  // namespace

std::unique_ptr<EdgeProbability> make_structured_probability(const EdgeParams& params) {
  const std::string path =
      params.model.empty()
          ? share_file("models/structured_forest.yml.gz", "give a forest with edges.model=FILE").string()
          : params.model;
  return std::make_unique<StructuredProbability>(path);
}

}  // namespace edgevo
