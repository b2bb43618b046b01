// SPDX-License-Identifier: BSD-3-Clause
#include "small_path.h"

#include <algorithm>

#include "axes.h"
#include "edgevo/report/palette.h"

namespace edgevo {
namespace {

constexpr double kPictureWidth = 110, kPictureHeight = 70, kMargin = 4;
constexpr size_t kMaxPoints = 80;

// Maps the ground to the picture: forward is up, left is left, one scale.
struct Frame {
  Range forward, left;
  double scale() const {
    const double fit = std::min((kPictureHeight - 2 * kMargin) / std::max(forward.span(), 1e-9),
                                (kPictureWidth - 2 * kMargin) / std::max(left.span(), 1e-9));
    return fit;
  }
  std::string at(const std::pair<double, double>& p) const {
    const double x = 0.5 * kPictureWidth - scale() * (p.second - 0.5 * (left.low + left.high));
    const double y = 0.5 * kPictureHeight - scale() * (p.first - 0.5 * (forward.low + forward.high));
    return svg_number(x) + ' ' + svg_number(y);
  }
};

std::string line(const GroundPath& path, const Frame& frame, const char* color, const char* width) {
  std::string d;
  for (const auto& p : thinned(path, kMaxPoints)) d += (d.empty() ? "M" : "L") + frame.at(p);
  return "<path fill=\"none\" style=\"stroke:" + std::string(color) + ";stroke-width:" + width + "\" d=\"" +
         d + "\"/>";
}

}  // namespace

GroundPath thinned(const GroundPath& path, size_t most) {
  const size_t step = (path.size() + most - 1) / std::max<size_t>(most, 1);
  if (step <= 1) return path;
  GroundPath thin;
  for (size_t i = 0; i < path.size(); i += step) thin.push_back(path[i]);
  if ((path.size() - 1) % step != 0) thin.push_back(path.back());
  return thin;
}

std::string small_path_svg(const GroundPath& path, const GroundPath& truth) {
  Frame frame;
  for (const GroundPath* all : {&path, &truth})
    for (const auto& [forward, left] : *all) frame.forward.add(forward), frame.left.add(left);
  if (path.empty()) return "";
  return "<svg viewBox=\"0 0 110 70\" aria-hidden=\"true\">" + line(truth, frame, palette::kGray, "3") +
         line(path, frame, palette::kBlue, "1.4") + "</svg>";
}

}  // namespace edgevo
