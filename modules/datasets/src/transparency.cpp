// SPDX-License-Identifier: BSD-3-Clause
#include "transparency.h"

#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "edgevo/core/formatted.h"

namespace edgevo {
namespace {

// A PNG with colours and transparency: by its first chunk, IHDR.
bool has_alpha(const std::string& path) {
  constexpr size_t kColourType = 25;
  constexpr char kRgba = 6;
  char head[kColourType + 1] = {};
  std::ifstream(path, std::ios::binary).read(head, sizeof(head));
  return std::string(head + 1, 3) == "PNG" && head[kColourType] == kRgba;
}

}  // namespace

std::optional<InputDecision> transparency_of(const std::vector<std::string>& images) {
  if (images.empty() || !has_alpha(images.front())) return std::nullopt;
  const std::string& first = images.front();
  const cv::Mat image = cv::imread(first, cv::IMREAD_UNCHANGED);
  if (image.channels() != 4) return std::nullopt;
  cv::Mat alpha;
  cv::extractChannel(image, alpha, 3);
  const double transparent = 1 - double(cv::countNonZero(alpha)) / double(alpha.total());
  if (transparent <= 0 || transparent >= 1) return std::nullopt;
  return InputDecision{"transparency", "not read",
                       formatted("%.0f %% of the first image are transparent; --mask %s takes no edges there",
                                 100 * transparent, first.c_str()),
                       ""};
}

}  // namespace edgevo
