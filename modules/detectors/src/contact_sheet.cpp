// SPDX-License-Identifier: BSD-3-Clause
#include "contact_sheet.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/output_file.h"
#include "edgevo/detectors/all_detectors.h"
#include "edgevo/edges/edge_extraction.h"
#include "edgevo/edges/opencv_view.h"
#include "edgevo/files/image_names.h"

namespace edgevo {
namespace {

constexpr int kTileWidth = 620;  // pixels: half a KITTI image

// The image in pale shades, with its edges in red.
cv::Mat drawn(const ImageView<uint8_t>& gray, const ImageEdges& edges) {
  cv::Mat pale, picture;
  as_mat(gray).convertTo(pale, CV_8U, 0.6, 90);
  cv::cvtColor(pale, picture, cv::COLOR_GRAY2BGR);
  for (const EdgePixel& p : edges.pixels)
    picture.at<cv::Vec3b>(int(p.y + 0.5f), int(p.x + 0.5f)) = {30, 30, 200};
  return picture;
}

cv::Mat tile(const cv::Mat& picture, const std::string& text) {
  cv::Mat small;
  const int height = std::max(1, picture.rows * kTileWidth / picture.cols);
  cv::resize(picture, small, {kTileWidth, height}, 0, 0,
             picture.cols > kTileWidth ? cv::INTER_AREA : cv::INTER_LINEAR);
  cv::putText(small, text, {6, height - 8}, cv::FONT_HERSHEY_SIMPLEX, 0.45, {0, 0, 0}, 1, cv::LINE_AA);
  return small;
}

// Edges on the left, probability on the right, dark where it is high.
cv::Mat row_of(const Frame& frame, const EdgeParams& edges, EdgeDetector& detector, EdgeProbability& files) {
  const ImageView<uint8_t> gray = frame.image.view();
  const Plane<uint8_t> probability = files.estimate(gray, image_name(frame));
  const Gradient gradient = compute_gradient(gray);
  const ImageEdges map =
      extract_edges(detector.detect({gray, gradient, probability.view()}), gradient, edges.min_chain);
  cv::Mat inverted;
  cv::cvtColor(255 - as_mat(probability.view()), inverted, cv::COLOR_GRAY2BGR);
  cv::Mat row;
  cv::hconcat(tile(drawn(gray, map), image_name(frame) + ": " + edges.detector + ", " +
                                         std::to_string(map.pixels.size()) + " edge pixels"),
              tile(inverted, ""), row);
  return row;
}

}  // namespace

ContactSheet::ContactSheet(std::optional<int> size) : size_(size) {}

void ContactSheet::offer(const Frame& frame) {
  const int at = offered_++;
  const int frames = size_ ? std::min(kFrames, *size_) : kFrames;
  const int next = int(kept_.size());
  if (next < frames && at == (size_ ? (2 * next + 1) * *size_ / (2 * frames) : next))
    kept_.emplace(at, frame);
}

void ContactSheet::write(const std::string& folder, const EdgeParams& edges) const {
  if (kept_.empty()) return;
  EdgeParams from_files = edges;
  from_files.detector = "precomputed";
  from_files.folder = folder;
  const auto detector = make_edge_detector(edges, all_edge_detectors());
  const auto files = make_edge_probability(from_files, all_edge_detectors());
  std::vector<cv::Mat> rows;
  for (const auto& [at, frame] : kept_) rows.push_back(row_of(frame, edges, *detector, *files));
  cv::Mat sheet;
  cv::vconcat(rows, sheet);
  std::vector<uint8_t> bytes;
  cv::imencode(".jpg", sheet, bytes, {cv::IMWRITE_JPEG_QUALITY, 85});
  write_file(folder + "/contact_sheet.jpg", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace edgevo
