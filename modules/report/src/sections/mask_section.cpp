// SPDX-License-Identifier: BSD-3-Clause
#include "mask_section.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/output_file.h"
#include "edgevo/report/page.h"

namespace edgevo {
namespace {

constexpr int kMaxWidth = 900;  // pixels of the picture

}  // namespace

std::string mask_section(const RunInfo& info) {
  const GrayImage& mask = info.ego_mask;
  if (mask.empty()) return {};
  const cv::Mat full(mask.height, mask.width, CV_8U, const_cast<uint8_t*>(mask.pixels.data()));
  const double share = 1 - double(cv::countNonZero(full)) / double(full.total());
  cv::Mat shown = full;
  const double scale = std::min(1.0, double(kMaxWidth) / full.cols);
  if (scale < 1) cv::resize(full, shown, {}, scale, scale, cv::INTER_AREA);
  std::vector<uint8_t> png;
  cv::imencode(".png", shown, png);
  const std::string caption =
      "black, " + fixed(100 * share, 1) + " % of the image: fixed to the camera, no edges are taken there";
  return section_html("mask", "Fixed to the camera",
                      "<div class=\"edges\">\n" +
                          figure_html("png", png, "mask of what is fixed to the camera", caption) +
                          "</div>\n");
}

}  // namespace edgevo
