// SPDX-License-Identifier: BSD-3-Clause
#include "ego_mask_finder.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "edgevo/core/order_statistics.h"
#include "edgevo/edges/opencv_view.h"

namespace edgevo {
namespace {

constexpr size_t kEvery = 2;                     // of the edge pixels, along the edge, are candidates
constexpr int kViewColumns = 16, kViewRows = 8;  // cells of the view
constexpr float kFaintest = 8;                   // Sobel units: noise alone makes half as much
constexpr float kSameDirection = 0.9f;           // cosine
constexpr int kMinStrongInCell = 4;              // strong edges that show whether a cell moves
constexpr double kMinCellsMoving = 0.5;          // share of the cells with edges
// Directions of edges, and regions of the view by row and column, whose shares are measured.
constexpr int kDirections = 12, kRegions = 3;
constexpr double kPriorEdges = 20;
constexpr double kMinStill = 0.7;      // share of a cell's strong edges that keep their place
constexpr double kMinStanding = 0.15;  // share of the cells that are still before a camera that stands
constexpr double kFoundAgain = 0.7;    // share of a fixed part's edges
constexpr double kMinSceneShare = 0.05, kMaxSceneShare = 0.7;  // of edges found at their place
constexpr double kMaxScore = 26;
constexpr int kFirst = 12, kOften = 3, kSeldom = 8, kEarly = 60;  // images that were compared
constexpr double kMinSuspects = 0.02;                             // share of the image that a map waits for
constexpr double kMuchMore = 1.3;                                 // of the area, that suspects cover
constexpr double kWorthChanging = 0.02;                           // share of the area

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// Interpolated; the place and its neighbours lie inside the image.
template <class T>
float value_at(const Plane<T>& plane, float x, float y) {
  const int left = int(x), top = int(y);
  const float across = x - float(left), down = y - float(top);
  const T *upper = plane.row(top) + left, *lower = plane.row(top + 1) + left;
  const float above = float(upper[0]) + across * (float(upper[1]) - float(upper[0]));
  const float below = float(lower[0]) + across * (float(lower[1]) - float(lower[0]));
  return above + down * (below - above);
}

// Whether an edge of this normal, either sign, lies here: the gradient has its direction and falls on both
// sides within a pixel.
bool shows_edge(const Gradient& gradient, float x, float y, float nx, float ny) {
  const float dx = value_at(gradient.dx, x, y), dy = value_at(gradient.dy, x, y);
  const float along = std::abs(dx * nx + dy * ny);
  if (along < kFaintest * kGradientSteps ||
      along * along < kSameDirection * kSameDirection * (dx * dx + dy * dy))
    return false;
  const float here = value_at(gradient.magnitude, x, y);
  return here >= value_at(gradient.magnitude, x - nx, y - ny) &&
         here > value_at(gradient.magnitude, x + nx, y + ny);
}

int count(const Plane<uint8_t>& plane) { return plane.empty() ? 0 : cv::countNonZero(as_mat(plane)); }

}  // namespace

int EgoMaskFinder::cell(float x, float y) const {
  return std::min(kViewRows - 1, int(y) * kViewRows / height_) * kViewColumns +
         std::min(kViewColumns - 1, int(x) * kViewColumns / width_);
}

void EgoMaskFinder::prepare(int width, int height) {
  width_ = width, height_ = height;
  occupied_ = Plane<uint8_t>(width_, height_);
  leaving_ = LeavingEdges(width_, height_);
  as_mat(occupied_).setTo(0);
}

// In the gradient, not among the edges: their threshold follows the image, and faint edges of a part, though
// they are there, fall below it whenever the scene has much contrast.
void EgoMaskFinder::look(const Gradient& gradient) {
  for (FixedCandidate& c : candidates_) c.seen = shows_edge(gradient, c.x, c.y, c.nx, c.ny);
}

// Strong edges alone: weak ones come and go with the noise.
void EgoMaskFinder::compare_cells() {
  std::vector<float> strengths;
  for (size_t i = 0; i < candidates_.size(); i += 16) strengths.push_back(candidates_[i].strength);
  const float strong = median(std::move(strengths));
  std::vector<int> all(kViewColumns * kViewRows), seen(kViewColumns * kViewRows);
  for (const FixedCandidate& c : candidates_) {
    if (c.strength < strong || (area_ && area_->at(nearest_pixel(c.x), nearest_pixel(c.y)))) continue;
    const size_t i = size_t(cell(c.x, c.y));
    ++all[i];
    seen[i] += c.seen;
  }
  const std::vector<uint8_t> stood = std::exchange(still_, std::vector<uint8_t>(all.size()));
  const bool did_stand = motion_.stands;
  int stood_cells = 0, still_standing = 0;
  moves_.assign(all.size(), 0);
  motion_ = {};
  for (size_t i = 0; i < all.size(); ++i) {
    if (all[i] < kMinStrongInCell) continue;
    ++motion_.cells;
    moves_[i] = 2 * seen[i] < all[i];
    motion_.moving += moves_[i];
    still_[i] = seen[i] >= kMinStill * all[i];
    motion_.still += still_[i];
    if (!did_stand || !stood[i]) continue;
    ++stood_cells;
    still_standing += still_[i];
  }
  motion_.stands = did_stand
                       ? 2 * still_standing >= stood_cells && motion_.still >= kMinStanding * motion_.cells
                       : motion_.cells > 0 && 2 * motion_.still >= motion_.cells;
}

StillCells EgoMaskFinder::still_cells() const {
  return motion_.stands ? StillCells{kViewColumns, kViewRows, still_} : StillCells{};
}

// Edges along the motion stay where they are, too: the share depends on direction and place.
int EgoMaskFinder::kind(const FixedCandidate& c) const {
  const double angle = std::atan2(c.ny, c.nx) * (kDirections / M_PI) + 2.5 * kDirections;
  const int direction = int(angle) % kDirections;
  const int column = std::min(kRegions - 1, int(c.x) * kRegions / width_);
  const int row = std::min(kRegions - 1, int(c.y) * kRegions / height_);
  return (row * kRegions + column) * kDirections + direction;
}

std::vector<double> EgoMaskFinder::scene_shares() const {
  constexpr int kPlaces = kRegions * kRegions;
  std::vector<double> all(kPlaces * kDirections), seen(kPlaces * kDirections);
  for (const FixedCandidate& c : candidates_) {
    if (!moves_[size_t(cell(c.x, c.y))]) continue;
    ++all[size_t(c.kind)];
    seen[size_t(c.kind)] += c.seen;
  }
  // Few edges of a direction at a place borrow from other places, few of a direction from all.
  const double every = (kPriorEdges + sum(seen)) / (kPriorEdges + sum(all));
  std::vector<double> shares(all.size());
  for (int d = 0; d < kDirections; ++d) {
    double all_here = 0, seen_here = 0;
    for (int p = 0; p < kPlaces; ++p)
      all_here += all[size_t(p * kDirections + d)], seen_here += seen[size_t(p * kDirections + d)];
    const double along = (kPriorEdges * every + seen_here) / (kPriorEdges + all_here);
    for (int p = 0; p < kPlaces; ++p) {
      const size_t i = size_t(p * kDirections + d);
      const double share = (kPriorEdges * along + seen[i]) / (kPriorEdges + all[i]);
      shares[i] = std::clamp(share, kMinSceneShare, kMaxSceneShare);
    }
  }
  return shares;
}

void EgoMaskFinder::weigh(const std::vector<double>& shares) {
  std::vector<float> hit, miss;
  for (const double share : shares) {
    hit.push_back(float(std::log(kFoundAgain / share)));
    miss.push_back(float(std::log((1 - kFoundAgain) / (1 - share))));
  }
  leaving_.fade();
  for (FixedCandidate& c : candidates_)
    c.score = std::min(c.score + (c.seen ? hit : miss)[size_t(c.kind)], float(kMaxScore));
  candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(),
                                   [&](const FixedCandidate& c) {
                                     if (c.score >= 0) return false;
                                     leaving_.count(nearest_pixel(c.x), nearest_pixel(c.y));
                                     occupied_.at(nearest_pixel(c.x), nearest_pixel(c.y)) = 0;
                                     return true;
                                   }),
                    candidates_.end());
}

void EgoMaskFinder::add_candidates(const ImageEdges& edges) {
  for (size_t i = 0; i < edges.pixels.size(); i += kEvery) {
    const EdgePixel& e = edges.pixels[i];
    uint8_t& occupied = occupied_.at(nearest_pixel(e.x), nearest_pixel(e.y));
    if (occupied) continue;
    occupied = 1;
    FixedCandidate c{e.x, e.y, e.nx, e.ny, e.strength};
    c.kind = kind(c);
    candidates_.push_back(c);
  }
}

bool EgoMaskFinder::update_area(const ImageEdges& edges, bool is_early) {
  const FixedArea parts(candidates_, edges, leaving_, area_.get());
  Plane<uint8_t> grown = parts.grow(kFixedScore);
  const int now = count(grown), before = area_ ? count(*area_) : 0;
  const int suspects = is_early ? count(parts.grow(kSuspectScore)) : 0;
  is_undecided_ = suspects > std::max(kMuchMore * now, kMinSuspects * width_ * height_);
  if (std::abs(now - before) <= kWorthChanging * before) return false;
  area_ = now > 0 ? std::make_shared<const Plane<uint8_t>>(std::move(grown)) : nullptr;
  return true;
}

bool EgoMaskFinder::add(const ImageEdges& edges, const Gradient& gradient) {
  if (occupied_.empty()) prepare(edges.width, edges.height);
  if (candidates_.empty()) {
    add_candidates(edges);
    return false;
  }
  look(gradient);
  compare_cells();
  if (motion_.stands || motion_.moving < kMinCellsMoving * motion_.cells || motion_.cells == 0) return false;
  ++compared_;
  weigh(scene_shares());
  const bool is_early = compared_ < kEarly;
  const bool changed = compared_ % (compared_ < kFirst ? 1
                                    : is_early         ? kOften
                                                       : kSeldom) ==
                           0 &&
                       update_area(edges, is_early);
  add_candidates(edges);
  return changed;
}

}  // namespace edgevo
