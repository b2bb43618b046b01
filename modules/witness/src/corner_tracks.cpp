// SPDX-License-Identifier: BSD-3-Clause
#include "corner_tracks.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "edgevo/edges/opencv_view.h"

namespace edgevo {
namespace {

// The finest level with at most so many pixels: half of 1241x376 and of 640x480, all of 300x300.
constexpr int kMostPixels = 130000;
constexpr int kWanted = 80, kMostWanted = 200;
// Corners are sought again after that many frames if some are lost, at once where too few are left. Fewer
// than kFew of known depth are too few.
constexpr int kFramesBetween = 4, kFew = 40;
// A patch of nine pixels takes half the time of one of eleven: OpenCV works on eight at once.
constexpr int kPatchPx = 9, kKltLevels = 3, kIterations = 8;
constexpr double kLeastStepPx = 0.03, kLeastEigenvalue = 2e-4;
// Largest mean difference of gray values of a patch that was followed.
constexpr float kMaxDifference = 25;
constexpr float kBorderPx = 4;
// Least quality of a new corner relative to the strongest: low, so that they cover the image.
// Standard deviation of the gray values that images are brought to, and the least that is taken for contrast.
constexpr double kUsualContrast = 60, kLeastContrast = 4;
constexpr double kQuality = 0.01;
constexpr float kMovedPx = 0.5;  // corners are followed to a tenth
// Cells of the image per wanted corner: many show nothing.
constexpr double kCellsPerCorner = 2;

// The look-up table that gives an image the usual mean and contrast, so that exposure does not matter.
cv::Mat normalising_table(const cv::Mat& image) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  const double gain = kUsualContrast / std::max(deviation[0], kLeastContrast);
  cv::Mat table(1, 256, CV_8U);
  for (int gray = 0; gray < 256; ++gray)
    table.at<uchar>(gray) = cv::saturate_cast<uchar>(128 + gain * (gray - mean[0]));
  return table;
}

}  // namespace

void CornerTracks::choose_level(const FramePyramid& frame) {
  level_ = 0;
  const auto pixels = [&](int l) {
    return frame.levels[size_t(l)].pinhole.width * frame.levels[size_t(l)].pinhole.height;
  };
  while (level_ + 1 < int(frame.levels.size()) && pixels(level_) > kMostPixels) ++level_;
  view_.pinhole = frame.levels[size_t(level_)].pinhole;
}

void CornerTracks::follow(const FramePyramid& frame, const std::vector<ExpectedCorner>& expected) {
  choose_level(frame);
  const cv::Mat gray = as_mat(frame.levels[size_t(level_)].gray);
  const bool has_coarse = level_ + 1 < int(frame.levels.size());
  const cv::Mat coarse = has_coarse ? as_mat(frame.levels[size_t(level_ + 1)].gray) : gray;
  cv::Mat equal;
  cv::LUT(gray, normalising_table(coarse), equal);
  std::vector<cv::Mat> now;
  cv::buildOpticalFlowPyramid(equal, now, {kPatchPx, kPatchPx}, kKltLevels, false);
  const int had = int(view_.tracks.size());
  if (!before_.empty() && had > 0) move(now, expected);
  before_ = std::move(now);
  ++frames_since_refill_;
  const int left = int(view_.tracks.size());
  // At large motion many corners are lost at once: so many are sought that enough last.
  if (had > 0) wanted_ = std::clamp(wanted_ * kFew / std::max(1, left), kWanted, kMostWanted);
  if (left < kFew + kFew / 2 || (left < wanted_ - kWanted / 10 && frames_since_refill_ >= kFramesBetween))
    refill(coarse, has_coarse ? 2 : 1);
  drop_where([&](const Eigen::Vector2d& px) { return frame.is_own(px.x(), px.y()); });
}

void CornerTracks::drop_where(const std::function<bool(const Eigen::Vector2d& px)>& is_foreign) {
  const double to_finest = 1 << level_;
  view_.tracks.erase(
      std::remove_if(view_.tracks.begin(), view_.tracks.end(),
                     [&](const CornerTrack& c) { return is_foreign(to_finest * c.px.cast<double>()); }),
      view_.tracks.end());
}

void CornerTracks::move(const std::vector<cv::Mat>& now, const std::vector<ExpectedCorner>& expected) {
  std::vector<cv::Point2f> from, to;
  auto e = expected.begin();
  for (const CornerTrack& t : view_.tracks) {
    while (e != expected.end() && e->id < t.id) ++e;
    const bool is_expected = e != expected.end() && e->id == t.id;
    const Eigen::Vector2f start = is_expected ? e->px : Eigen::Vector2f(t.px + t.motion);
    from.emplace_back(t.px.x(), t.px.y());
    to.emplace_back(start.x(), start.y());
  }
  std::vector<uchar> found;
  std::vector<float> difference;
  cv::calcOpticalFlowPyrLK(before_, now, from, to, found, difference, {kPatchPx, kPatchPx}, kKltLevels,
                           {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, kIterations, kLeastStepPx},
                           cv::OPTFLOW_USE_INITIAL_FLOW, kLeastEigenvalue);
  std::vector<CornerTrack> kept;
  for (size_t i = 0; i < view_.tracks.size(); ++i) {
    const Eigen::Vector2f px(to[i].x, to[i].y);
    if (!found[i] || !(difference[i] < kMaxDifference) ||
        !view_.pinhole.contains(px.cast<double>(), kBorderPx))
      continue;
    kept.push_back({view_.tracks[i].id, px, px - view_.tracks[i].px});
  }
  view_.tracks = std::move(kept);
}

// The strongest corner of each cell of the next coarser level, `factor` times smaller, where none is
// followed.
void CornerTracks::refill(const cv::Mat& coarse, int factor) {
  frames_since_refill_ = 0;
  const int cell = std::max(4, int(std::sqrt(double(coarse.total()) / (kCellsPerCorner * wanted_))));
  const int columns = coarse.cols / cell, rows = coarse.rows / cell;
  std::vector<char> taken(size_t(columns) * rows, 0);
  for (const CornerTrack& t : view_.tracks) {
    const int x = int(t.px.x()) / (factor * cell), y = int(t.px.y()) / (factor * cell);
    if (x < columns && y < rows) taken[size_t(y) * columns + x] = 1;
  }
  cv::Mat strength;
  cv::cornerMinEigenVal(coarse, strength, 3);
  double strongest = 0;
  cv::minMaxLoc(strength, nullptr, &strongest);
  std::vector<std::pair<float, cv::Point>> found;
  for (int i = 0; i < columns * rows; ++i) {
    if (taken[size_t(i)]) continue;
    const cv::Rect box(i % columns * cell, i / columns * cell, cell, cell);
    double best = 0;
    cv::Point at;
    cv::minMaxLoc(strength(box), nullptr, &best, nullptr, &at);
    if (best > kQuality * strongest) found.emplace_back(float(best), at + box.tl());
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& p, const auto& q) { return p.first > q.first; });
  found.resize(std::min(found.size(), size_t(std::max(0, wanted_ - int(view_.tracks.size())))));
  add(found, factor);
}

// A new corner is expected to move as its nearest neighbour does.
void CornerTracks::add(const std::vector<std::pair<float, cv::Point>>& corners, int factor) {
  const std::vector<CornerTrack> old = view_.tracks;
  for (const auto& corner : corners) {
    const Eigen::Vector2f px(float(factor * corner.second.x), float(factor * corner.second.y));
    if (!view_.pinhole.contains(px.cast<double>(), kBorderPx)) continue;
    CornerTrack fresh{next_id_++, px, Eigen::Vector2f::Zero()};
    const auto nearest = std::min_element(old.begin(), old.end(), [&](const auto& a, const auto& b) {
      return (a.px - px).squaredNorm() < (b.px - px).squaredNorm();
    });
    if (nearest != old.end()) fresh.motion = nearest->motion;
    view_.tracks.push_back(fresh);
  }
}

void CornerTracks::drop(const std::vector<uint32_t>& ids) {
  view_.tracks.erase(std::remove_if(view_.tracks.begin(), view_.tracks.end(),
                                    [&](const CornerTrack& t) {
                                      return std::find(ids.begin(), ids.end(), t.id) != ids.end();
                                    }),
                     view_.tracks.end());
}

void CornerTracks::drop_moving() {
  view_.tracks.erase(std::remove_if(view_.tracks.begin(), view_.tracks.end(),
                                    [](const CornerTrack& t) { return t.motion.norm() > kMovedPx; }),
                     view_.tracks.end());
}

}  // namespace edgevo
