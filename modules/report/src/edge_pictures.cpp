// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/report/edge_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "color_ramp.h"
#include "edgevo/core/rectification.h"
#include "edgevo/run_quality/doubtful_intervals.h"

namespace edgevo {
namespace {

// Pixels of a picture.
constexpr int kMaxWidth = 900;
// Number of earlier keyframes whose points are drawn in a picture.
constexpr size_t kKeyframesBefore = 15;

struct SeenPoint {
  Eigen::Vector2d px;  // in the undistorted image of the picture
  double idepth;       // in the camera of the picture
};

// Positions in Run::keyframes of up to `count` keyframes that host points.
std::vector<size_t> choose_keyframes(const Run& run, const PointFilter& filter, int count) {
  std::vector<size_t> with_points, chosen;
  for (size_t k = 0; k < run.keyframes.size(); ++k) {
    const auto& points = run.keyframes[k].points;
    if (std::any_of(points.begin(), points.end(), [&](const EdgePoint& p) { return filter.keeps(p); }))
      with_points.push_back(k);
  }
  const size_t n = std::min(size_t(count), with_points.size());
  for (size_t i = 0; i < n; ++i) chosen.push_back(with_points[(2 * i + 1) * with_points.size() / (2 * n)]);
  return chosen;
}

void add_seen(const Run& run, const KeyframeRecord& host, const SE3& T_cam_world, const PointFilter& filter,
              std::vector<SeenPoint>* seen) {
  const SE3 T_cam_host = T_cam_world * host.T_world_cam;
  const auto add = [&](const auto& p) {
    const Eigen::Vector3d p_cam = T_cam_host * point_in_camera(run.pinhole, p);
    if (p_cam.z() > 0 && run.pinhole.contains(run.pinhole.project(p_cam)))
      seen->push_back({run.pinhole.project(p_cam), 1 / p_cam.z()});
  };
  for (const EdgePoint& p : host.points)
    if (filter.keeps(p)) add(p);
  for (const EdgeLine& line : host.lines)
    for (const EdgeVertex& v : line.vertices) add(v);
}

// The frame of a picture.
struct View {
  int frame_index = 0;
  Timestamp time;
  std::optional<SE3> T_world_cam;
  int segment = 0;
};

View view_of(const KeyframeRecord& k) { return {k.frame_index, k.time, k.T_world_cam, k.segment}; }
View view_of(const FrameRecord& f) { return {f.index, f.time, f.T_world_cam, f.segment}; }

// Points of the keyframes up to the view, sorted from far to near, so that near ones are drawn over far ones.
std::vector<SeenPoint> points_seen(const Run& run, const View& view, const PointFilter& filter) {
  std::vector<SeenPoint> seen;
  if (!view.T_world_cam) return seen;
  const SE3 T_cam_world = view.T_world_cam->inverse();
  const auto end = std::find_if(run.keyframes.begin(), run.keyframes.end(),
                                [&](const KeyframeRecord& k) { return k.frame_index > view.frame_index; });
  const size_t n = size_t(end - run.keyframes.begin());
  for (size_t k = n - std::min(n, kKeyframesBefore + 1); k < n; ++k)
    if (run.keyframes[k].segment == view.segment) add_seen(run, run.keyframes[k], T_cam_world, filter, &seen);
  std::stable_sort(seen.begin(), seen.end(),
                   [](const auto& a, const auto& b) { return a.idepth < b.idepth; });
  return seen;
}

// Sets the ends of the colour scale to percentiles 2 and 98 of the inverse depths.
void set_range(const std::vector<std::vector<SeenPoint>>& seen, EdgePictures* pictures) {
  std::vector<double> idepths;
  for (const auto& points : seen)
    for (const SeenPoint& p : points) idepths.push_back(p.idepth);
  if (idepths.empty()) return;
  std::sort(idepths.begin(), idepths.end());
  pictures->idepth_low = idepths[idepths.size() / 50];
  pictures->idepth_high = idepths[idepths.size() - 1 - idepths.size() / 50];
}

double picture_scale(int width) { return std::min(1.0, double(kMaxWidth) / width); }

// Positions of the pixels of a picture in the image of the camera.
struct PictureMaps {
  cv::Mat x, y;

  explicit PictureMaps(const RectificationMaps& maps) {
    const double scale = picture_scale(maps.width);
    cv::resize(cv::Mat(maps.height, maps.width, CV_32F, const_cast<float*>(maps.x.data())), x, {}, scale,
               scale);
    cv::resize(cv::Mat(maps.height, maps.width, CV_32F, const_cast<float*>(maps.y.data())), y, {}, scale,
               scale);
  }
};

// The image as the method saw it, in the size of a picture. Empty if it cannot be read.
cv::Mat rectified(const std::string& path, const Camera& camera, const PictureMaps& maps) {
  const cv::Mat image = path.empty() ? cv::Mat() : cv::imread(path, cv::IMREAD_GRAYSCALE);
  if (image.cols != camera.width || image.rows != camera.height) return {};
  cv::Mat out;
  cv::remap(image, out, maps.x, maps.y, cv::INTER_LINEAR);
  return out;
}

cv::Vec3b color_of(double idepth, const EdgePictures& range) {
  const double span = std::max(range.idepth_high - range.idepth_low, 1e-12);
  const double share = std::clamp((idepth - range.idepth_low) / span, 0.0, 1.0);
  const auto& [red, green, blue] = color_ramp()[size_t(255 * share)];
  return {uint8_t(blue), uint8_t(green), uint8_t(red)};
}

// A disc with a smooth rim, at each of 16 x 16 positions within a pixel. Tens of thousands are drawn, at a
// twentieth of the cost of cv::circle().
class Disc {
 public:
  Disc() {
    for (size_t place = 0; place < share_.size(); ++place)
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
          const double at_x = double(place % kPlaces) / kPlaces, at_y = double(place / kPlaces) / kPlaces;
          const double distance = std::hypot(x - kBefore - at_x, y - kBefore - at_y);
          share_[place][size_t(y * kSide + x)] =
              int(256 * std::clamp(kDiscRadiusPx + 0.5 - distance, 0.0, 1.0));
        }
  }

  void draw(const Eigen::Vector2d& centre, const cv::Vec3b& color, cv::Mat* picture) const {
    const int x = int(centre.x() * kPlaces), y = int(centre.y() * kPlaces);
    const auto& share = share_[size_t(y % kPlaces * kPlaces + x % kPlaces)];
    const int left = x / kPlaces - kBefore, top = y / kPlaces - kBefore;
    for (int row = std::max(0, -top); row < std::min(kSide, picture->rows - top); ++row)
      for (int column = std::max(0, -left); column < std::min(kSide, picture->cols - left); ++column) {
        cv::Vec3b& there = picture->at<cv::Vec3b>(top + row, left + column);
        for (int i = 0; i < 3; ++i)
          there[i] = uint8_t(there[i] + ((color[i] - there[i]) * share[size_t(row * kSide + column)] >> 8));
      }
  }

 private:
  static constexpr double kDiscRadiusPx = 1.8;
  static constexpr int kPlaces = 16;
  static constexpr int kBefore = 2, kSide = 6;  // pixels before the one with the centre, and all
  std::array<std::array<int, kSide * kSide>, kPlaces * kPlaces> share_;  // of the colour, of 256
};

// `scale`: of the picture.
cv::Mat paint(const cv::Mat& gray, double scale, const std::vector<SeenPoint>& points,
              const EdgePictures& range) {
  cv::Mat pale, picture;
  gray.convertTo(pale, CV_8U, 0.6, 40);  // so that the colours stand out
  cv::cvtColor(pale, picture, cv::COLOR_GRAY2BGR);
  static const Disc disc;
  for (const SeenPoint& p : points) disc.draw(scale * p.px, color_of(p.idepth, range), &picture);
  return picture;
}

EdgePictures draw_views(const Run& run, const Camera& camera, const PointFilter& filter,
                        const std::function<std::string(int)>& image_path, const std::vector<View>& views) {
  EdgePictures result;
  if (views.empty()) return result;
  std::vector<std::vector<SeenPoint>> seen;
  for (const View& view : views) seen.push_back(points_seen(run, view, filter));
  set_range(seen, &result);
  const PictureMaps maps(Rectification(camera, run.pinhole).maps(run.camera.applied));
  const double scale = picture_scale(run.pinhole.width);
  for (size_t i = 0; i < views.size(); ++i) {
    const cv::Mat gray = rectified(image_path(views[i].frame_index), camera, maps);
    if (gray.empty()) continue;
    std::vector<uint8_t> jpeg;
    cv::imencode(".jpg", paint(gray, scale, seen[i], result), jpeg, {cv::IMWRITE_JPEG_QUALITY, 80});
    result.pictures.push_back({views[i].frame_index, views[i].time, int(seen[i].size()), std::move(jpeg)});
  }
  return result;
}

}  // namespace

EdgePictures draw_edge_pictures(const Run& run, const Camera& camera, const PointFilter& filter,
                                const std::function<std::string(int)>& image_path, int count) {
  std::vector<View> views;
  for (const size_t k : choose_keyframes(run, filter, count)) views.push_back(view_of(run.keyframes[k]));
  return draw_views(run, camera, filter, image_path, views);
}

EdgePictures draw_doubtful_pictures(const Run& run, const Camera& camera, const PointFilter& filter,
                                    const std::function<std::string(int)>& image_path, int count) {
  std::vector<View> views;
  for (const size_t f : most_doubtful_frames(run, size_t(count))) views.push_back(view_of(run.frames[f]));
  return draw_views(run, camera, filter, image_path, views);
}

}  // namespace edgevo
