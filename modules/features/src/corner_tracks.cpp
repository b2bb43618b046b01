// SPDX-License-Identifier: BSD-3-Clause
#include "corner_tracks.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "corner_strength.h"
#include "edgevo/edges/opencv_view.h"

namespace edgevo {
namespace {

// The finest level with at most so many pixels: half of 1241x376 and of 640x480, all of 300x300.
constexpr int kMaxPixels = 130000;
constexpr int kWanted = 80, kMaxWanted = 200;
// Corners are sought again after that many frames if some are lost, at once where too few are left. Fewer
// than kMinKnown of known depth are too few.
constexpr int kFramesBetween = 4, kMinKnown = 40;
constexpr float kBorderPx = 4;
// Least quality of a new corner relative to the strongest: low, so that they cover the image.
constexpr double kQuality = 0.01;
constexpr float kMovedPx = 0.5;  // corners are followed to a tenth
// Cells of the image per wanted corner: many show nothing.
constexpr double kCellsPerCorner = 2;
// Corners are found in images that are smaller by this.
constexpr int kCoarser = 2;

}  // namespace

void CornerTracks::choose_level(const FramePyramid& frame) {
  level_ = 0;
  const auto pixels = [&](int l) {
    return frame.levels[size_t(l)].pinhole.width * frame.levels[size_t(l)].pinhole.height;
  };
  while (level_ + 1 < int(frame.levels.size()) && pixels(level_) > kMaxPixels) ++level_;
  view_.pinhole = frame.levels[size_t(level_)].pinhole;
}

void CornerTracks::follow(const std::shared_ptr<const FramePyramid>& pyramid,
                          const std::vector<ExpectedCorner>& expected) {
  const FramePyramid& frame = *pyramid;
  choose_level(frame);
  FlowImage now(pyramid, level_);
  const int had = int(view_.tracks.size());
  if (before_ && had > 0) move(now, expected);
  before_ = std::move(now);
  ++frames_since_refill_;
  const int left = int(view_.tracks.size());
  // At large motion many corners are lost at once: so many are sought that enough last.
  if (had > 0) wanted_ = std::clamp(wanted_ * kMinKnown / std::max(1, left), kWanted, kMaxWanted);
  if (left < kMinKnown + kMinKnown / 2 ||
      (left < wanted_ - kWanted / 10 && frames_since_refill_ >= kFramesBetween))
    refill(before_->levels()[1]);
  drop_where([&](const Eigen::Vector2d& px) { return frame.is_ego(px.x(), px.y()); });
}

void CornerTracks::drop_where(const std::function<bool(const Eigen::Vector2d& px)>& is_foreign) {
  const double to_finest = 1 << level_;
  view_.tracks.erase(
      std::remove_if(view_.tracks.begin(), view_.tracks.end(),
                     [&](const CornerTrack& c) { return is_foreign(to_finest * c.px.cast<double>()); }),
      view_.tracks.end());
}

std::vector<FollowedCorner> CornerTracks::followed() const {
  std::vector<FollowedCorner> corners;
  for (const CornerTrack& t : view_.tracks) corners.push_back({t.id, view_.pinhole.ray(t.px.cast<double>())});
  return corners;
}

void CornerTracks::move(const FlowImage& now, const std::vector<ExpectedCorner>& expected) {
  std::vector<CornerTrack> kept;
  auto e = expected.begin();
  for (const CornerTrack& t : view_.tracks) {
    while (e != expected.end() && e->id < t.id) ++e;
    const bool is_expected = e != expected.end() && e->id == t.id;
    const Eigen::Vector2f start = is_expected ? e->px : Eigen::Vector2f(t.px + t.motion);
    const std::optional<Eigen::Vector2f> px = follow_patch(*before_, now, t.px, start);
    if (px && view_.pinhole.contains(px->cast<double>(), kBorderPx)) kept.push_back({t.id, *px, *px - t.px});
  }
  view_.tracks = std::move(kept);
}

// The strongest corner of each cell of the next coarser level, where none is followed.
void CornerTracks::refill(const ImageView<uint8_t>& coarse) {
  frames_since_refill_ = 0;
  const int cell =
      std::max(4, int(std::sqrt(double(coarse.width) * coarse.height / (kCellsPerCorner * wanted_))));
  const int columns = coarse.width / cell, rows = coarse.height / cell;
  std::vector<char> taken(size_t(columns) * rows, 0);
  for (const CornerTrack& t : view_.tracks) {
    const int x = int(t.px.x()) / (kCoarser * cell), y = int(t.px.y()) / (kCoarser * cell);
    if (x < columns && y < rows) taken[size_t(y) * columns + x] = 1;
  }
  const Plane<float> strengths = corner_strength(coarse);
  const cv::Mat strength = as_mat(strengths);
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
  add(found);
}

// A new corner is expected to move as its nearest neighbour does.
void CornerTracks::add(const std::vector<std::pair<float, cv::Point>>& corners) {
  const std::vector<CornerTrack> old = view_.tracks;
  for (const auto& corner : corners) {
    const Eigen::Vector2f px(float(kCoarser * corner.second.x), float(kCoarser * corner.second.y));
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
