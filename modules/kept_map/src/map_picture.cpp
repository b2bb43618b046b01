// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/kept_map/map_picture.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/formatted.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/records.h"

namespace edgevo {
namespace {

constexpr int kSide = 1200, kMargin = 40;  // pixels
// Points whose depth is known worse than this share of it smear over the picture.
constexpr double kMaxDepthSigma = 0.1;
const cv::Scalar kPointColor(175, 165, 155), kPathColor(180, 80, 20), kPlaceColor(40, 120, 230),
    kTextColor(60, 60, 60);  // blue, green, red

Eigen::Vector2d from_above(const Eigen::Vector3d& p) { return {p.x(), p.z()}; }

std::vector<Eigen::Vector2d> path_of(const KeptMap& map) {
  std::vector<Eigen::Vector2d> path;
  for (const StoredKeyframe& k : map.store.keyframes())
    path.push_back(from_above(k.record->T_world_cam.translation()));
  return path;
}

// Every so many points, so that there are about 200,000.
std::vector<Eigen::Vector2d> points_of(const KeptMap& map) {
  constexpr size_t kMaxDrawn = 200000;
  size_t all = 0, number = 0;
  for (const StoredKeyframe& k : map.store.keyframes()) all += k.record->points.size();
  const size_t every = all / kMaxDrawn + 1;
  std::vector<Eigen::Vector2d> points;
  for (const StoredKeyframe& k : map.store.keyframes())
    for (const EdgePoint& p : k.record->points) {
      const bool is_certain = p.idepth_sigma > 0 && p.idepth_sigma < kMaxDepthSigma * double(p.idepth);
      if (number++ % every == 0 && is_certain)
        points.push_back(from_above(k.record->T_world_cam * point_in_camera(map.store.pinhole(), p)));
    }
  return points;
}

// From the plane to the picture; one scale for both directions.
class View {
 public:
  View(const std::vector<Eigen::Vector2d>& path, const std::vector<Eigen::Vector2d>& points) {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& p : path) box.extend(p);
    // Points around the path, not the few that are far off.
    const double around = 0.25 * std::max(box.sizes().maxCoeff(), 1e-6) + usual_distance(path, points);
    low_ = box.min().array() - around;
    const Eigen::Vector2d size = box.sizes().array() + 2 * around;
    scale_ = (kSide - 2 * kMargin) / size.maxCoeff();
    picture_ = cv::Mat(int(size.y() * scale_) + 2 * kMargin, int(size.x() * scale_) + 2 * kMargin, CV_8UC3,
                       cv::Scalar(255, 255, 255));
  }
  cv::Point at(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d px = scale_ * (p - low_);
    constexpr double kFar = 1e5;
    return {int(std::clamp(px.x(), -kFar, kFar)) + kMargin,
            picture_.rows - kMargin - int(std::clamp(px.y(), -kFar, kFar))};
  }
  double scale() const { return scale_; }
  cv::Mat& picture() { return picture_; }

 private:
  // Median distance of points from the middle of the path, as far as that is short.
  static double usual_distance(const std::vector<Eigen::Vector2d>& path,
                               const std::vector<Eigen::Vector2d>& points) {
    if (path.size() > 1 && (path.front() - path.back()).norm() > 1e-3) return 0;
    std::vector<double> distances;
    for (const Eigen::Vector2d& p : points) distances.push_back((p - path.front()).norm());
    return distances.empty() ? 1 : 2 * median(std::move(distances));
  }

  Eigen::Vector2d low_;
  double scale_ = 1;
  cv::Mat picture_;
};

void draw_points(const std::vector<Eigen::Vector2d>& points, View* view) {
  const cv::Rect area({0, 0}, view->picture().size());
  for (const Eigen::Vector2d& p : points)
    if (const cv::Point at = view->at(p); area.contains(at))
      view->picture().at<cv::Vec3b>(at) = {uint8_t(kPointColor[0]), uint8_t(kPointColor[1]),
                                           uint8_t(kPointColor[2])};
}

void draw_path(const KeptMap& map, const std::vector<Eigen::Vector2d>& path, View* view) {
  const std::vector<StoredKeyframe>& keyframes = map.store.keyframes();
  for (size_t i = 0; i < path.size(); ++i) {
    cv::circle(view->picture(), view->at(path[i]), 2, kPathColor, cv::FILLED, cv::LINE_AA);
    if (i > 0 && keyframes[i].record->segment == keyframes[i - 1].record->segment)
      cv::line(view->picture(), view->at(path[i - 1]), view->at(path[i]), kPathColor, 1, cv::LINE_AA);
  }
}

void draw_places(const KeptMap& map, const std::vector<Eigen::Vector2d>& path, View* view) {
  std::map<int, size_t> position;
  for (size_t i = 0; i < path.size(); ++i) position[map.store.keyframes()[i].id] = i;
  for (const Constraint& c : map.constraints) {
    const auto a = position.find(c.from.number()), b = position.find(c.to.number());
    if (c.kind != ConstraintKind::kPlace || a == position.end() || b == position.end()) continue;
    cv::line(view->picture(), view->at(path[a->second]), view->at(path[b->second]), kPlaceColor, 2,
             cv::LINE_AA);
    cv::circle(view->picture(), view->at(path[b->second]), 3, kPlaceColor, cv::FILLED, cv::LINE_AA);
  }
}

// A length of one, two or five times a power of ten, about a fifth of the picture.
void draw_scale(const KeptMap& map, View* view) {
  const double about = 0.2 * kSide / view->scale(), power = std::pow(10, std::floor(std::log10(about)));
  const double length = power * (about < 2 * power ? 1 : about < 5 * power ? 2 : 5);
  const cv::Point left(kMargin, view->picture().rows - kMargin / 2);
  cv::line(view->picture(), left, left + cv::Point(int(length * view->scale()), 0), kTextColor, 2);
  cv::putText(view->picture(), formatted(map.is_metric() ? "%g m" : "%g units", length),
              left - cv::Point(0, 6), cv::FONT_HERSHEY_SIMPLEX, 0.45, kTextColor, 1, cv::LINE_AA);
}

}  // namespace

std::string map_picture(const KeptMap& map) {
  const std::vector<Eigen::Vector2d> path = path_of(map), points = points_of(map);
  std::vector<uint8_t> png;
  if (path.empty()) {
    cv::imencode(".png", cv::Mat(kSide / 4, kSide, CV_8UC3, cv::Scalar(255, 255, 255)), png);
    return {png.begin(), png.end()};
  }
  View view(path, points);
  draw_points(points, &view);
  draw_path(map, path, &view);
  draw_places(map, path, &view);
  draw_scale(map, &view);
  cv::imencode(".png", view.picture(), png);
  return {png.begin(), png.end()};
}

}  // namespace edgevo
