// SPDX-License-Identifier: BSD-3-Clause
#include "fixed_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "edgevo/core/order_statistics.h"
#include "edgevo/edges/opencv_view.h"

namespace edgevo {
namespace {

constexpr size_t kEvery = 2;               // of the edge pixels, along the edge, are candidates
constexpr int kColumns = 16, kRows = 8;    // cells of the view
constexpr float kSamePlacePx = 0.5f;       // along the normal: sensor noise moves an edge by 0.1 to 0.2
constexpr float kSameDirection = 0.9f;     // cosine
constexpr int kFewestInCell = 4;           // strong edges that show whether a cell moves
constexpr double kLeastCellsMoving = 0.5;  // share of the cells with edges
// Directions of edges, and regions of the view by row and column, whose shares are measured.
constexpr int kDirections = 12, kRegions = 3;
constexpr double kFewEdges = 20;
constexpr double kLeastStill = 0.7;      // share of a cell's strong edges that keep their place
constexpr double kLeastStanding = 0.15;  // share of the cells that are still before a camera that stands
constexpr double kFoundAgain = 0.7;      // share of a fixed part's edges
constexpr double kLeastSceneShare = 0.05, kMostSceneShare = 0.7;  // of edges found at their place
// Logarithms of likelihood ratios. An image has 10^4 edge pixels, neighbours that depend on each other.
constexpr double kFixed = 16, kSuspect = 3.5, kMostScore = 26;
// Scene edges around and behind a part are found between its edges, too.
constexpr double kLeastFixedShare = 0.5;
constexpr int kReachPx = 6;      // edges of a piece are that near to each other
constexpr int kPartsApart = 12;  // pieces of a part are this share of the width from each other
constexpr int kMarginPx = 2;     // around the edges: what the gradient there is made of
constexpr int kGapPx = 12;       // half width of gaps that are closed
constexpr double kLeastFixedInGaps = 0.7;
// Blocks of the view in which edges that leave their place are counted, and over how many images.
constexpr int kBlockPx = 8, kCalmReach = 5;  // pixels; a share of the height
constexpr float kMemory = 0.96f;
constexpr double kFewestLeaving = 4, kCalm = 0.15;
constexpr int kFewestInPiece = 6;                                 // candidates
constexpr double kLeastArea = 0.01;                               // share of the image; less is harmless
constexpr int kFewestFixed = 40;                                  // candidates
constexpr int kFirst = 12, kOften = 3, kSeldom = 8, kEarly = 60;  // images that were compared
constexpr double kLeastAcross = 0.1;     // smaller eigenvalue of the mean of n n^T, n: normals
constexpr double kLeastSuspects = 0.02;  // share of the image that a map waits for
constexpr double kMuchMore = 1.3;        // of the area, that suspects cover
constexpr double kWorthChanging = 0.02;  // share of the area

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// Rounds a coordinate, which is not negative: as std::lround(), without its call. The sum is exact in double.
int nearest(float v) { return int(double(v) + 0.5); }

// Candidates that lie together.
struct Piece {
  int number = 0, area = 0, edges = 0, edges_fixed = 0, part = 0;
  double xx = 0, xy = 0, yy = 0;  // sums of the normals' products
  void add(double x, double y) { ++number, xx += x * x, xy += x * y, yy += y * y; }
  void add(const Piece& p) { number += p.number, area += p.area, xx += p.xx, xy += p.xy, yy += p.yy; }
  // Most edges there are fixed.
  bool holds_together() const { return number >= kFewestInPiece && edges_fixed >= kLeastFixedShare * edges; }
  // Edges of a single direction may slide along themselves, as those of a kerb do.
  bool is_part(int least_area) const {
    const double mean = 0.5 * (xx + yy), spread = std::hypot(0.5 * (xx - yy), xy);
    return number >= kFewestFixed && area >= least_area && mean - spread >= kLeastAcross * number;
  }
};

cv::Mat square(int radius) {
  return cv::getStructuringElement(cv::MORPH_RECT, {2 * radius + 1, 2 * radius + 1});
}

int count(const Plane<uint8_t>& plane) { return plane.empty() ? 0 : cv::countNonZero(as_mat(plane)); }

}  // namespace

int FixedParts::cell(float x, float y) const {
  return std::min(kRows - 1, int(y) * kRows / height_) * kColumns +
         std::min(kColumns - 1, int(x) * kColumns / width_);
}

void FixedParts::index(const ImageEdges& edges) {
  if (edge_at_.empty()) {
    width_ = edges.width, height_ = edges.height;
    edge_at_ = Plane<int>(width_, height_);
    occupied_ = Plane<uint8_t>(width_, height_);
    left_.assign(size_t(blocks_across() * (height_ / kBlockPx + 1)), 0);
    as_mat(occupied_).setTo(0);
    as_mat(edge_at_).setTo(-1);
  }
  for (const int at : indexed_) edge_at_.row(0)[at] = -1;
  indexed_.clear();
  for (size_t i = 0; i < edges.pixels.size(); ++i) {
    const int at = nearest(edges.pixels[i].y) * width_ + nearest(edges.pixels[i].x);
    edge_at_.row(0)[at] = int(i);
    indexed_.push_back(at);
  }
}

bool FixedParts::is_seen(const Candidate& c, const ImageEdges& edges) const {
  const int cx = nearest(c.x), cy = nearest(c.y);
  for (int y = std::max(0, cy - 1); y <= std::min(height_ - 1, cy + 1); ++y)
    for (int x = std::max(0, cx - 1); x <= std::min(width_ - 1, cx + 1); ++x) {
      const int i = edge_at_.at(x, y);
      if (i < 0) continue;
      const EdgePixel& e = edges.pixels[size_t(i)];
      if (std::abs(c.nx * (e.x - c.x) + c.ny * (e.y - c.y)) < kSamePlacePx &&
          std::abs(c.nx * e.nx + c.ny * e.ny) > kSameDirection)
        return true;
    }
  return false;
}

void FixedParts::look(const ImageEdges& edges) {
  for (Candidate& c : candidates_) c.seen = is_seen(c, edges);
}

// Strong edges alone: weak ones come and go with the noise.
void FixedParts::compare_cells() {
  std::vector<float> strengths;
  for (size_t i = 0; i < candidates_.size(); i += 16) strengths.push_back(candidates_[i].strength);
  const float strong = median(std::move(strengths));
  std::vector<int> all(kColumns * kRows), seen(kColumns * kRows);
  for (const Candidate& c : candidates_) {
    if (c.strength < strong || (area_ && area_->at(nearest(c.x), nearest(c.y)))) continue;
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
    if (all[i] < kFewestInCell) continue;
    ++motion_.cells;
    moves_[i] = 2 * seen[i] < all[i];
    motion_.moving += moves_[i];
    still_[i] = seen[i] >= kLeastStill * all[i];
    motion_.still += still_[i];
    if (!did_stand || !stood[i]) continue;
    ++stood_cells;
    still_standing += still_[i];
  }
  motion_.stands = did_stand
                       ? 2 * still_standing >= stood_cells && motion_.still >= kLeastStanding * motion_.cells
                       : motion_.cells > 0 && 2 * motion_.still >= motion_.cells;
}

StillCells FixedParts::still_cells() const {
  return motion_.stands ? StillCells{kColumns, kRows, still_} : StillCells{};
}

// Edges along the motion stay where they are, too: the share depends on direction and place.
int FixedParts::kind(const Candidate& c) const {
  const double angle = std::atan2(c.ny, c.nx) * (kDirections / M_PI) + 2.5 * kDirections;
  const int direction = int(angle) % kDirections;
  const int column = std::min(kRegions - 1, int(c.x) * kRegions / width_);
  const int row = std::min(kRegions - 1, int(c.y) * kRegions / height_);
  return (row * kRegions + column) * kDirections + direction;
}

std::vector<double> FixedParts::scene_shares() const {
  constexpr int kPlaces = kRegions * kRegions;
  std::vector<double> all(kPlaces * kDirections), seen(kPlaces * kDirections);
  for (const Candidate& c : candidates_) {
    if (!moves_[size_t(cell(c.x, c.y))]) continue;
    ++all[size_t(c.kind)];
    seen[size_t(c.kind)] += c.seen;
  }
  // Few edges of a direction at a place borrow from other places, few of a direction from all.
  const double every = (kFewEdges + sum(seen)) / (kFewEdges + sum(all));
  std::vector<double> shares(all.size());
  for (int d = 0; d < kDirections; ++d) {
    double all_here = 0, seen_here = 0;
    for (int p = 0; p < kPlaces; ++p)
      all_here += all[size_t(p * kDirections + d)], seen_here += seen[size_t(p * kDirections + d)];
    const double along = (kFewEdges * every + seen_here) / (kFewEdges + all_here);
    for (int p = 0; p < kPlaces; ++p) {
      const size_t i = size_t(p * kDirections + d);
      const double share = (kFewEdges * along + seen[i]) / (kFewEdges + all[i]);
      shares[i] = std::clamp(share, kLeastSceneShare, kMostSceneShare);
    }
  }
  return shares;
}

void FixedParts::weigh(const std::vector<double>& shares) {
  std::vector<float> hit, miss;
  for (const double share : shares) {
    hit.push_back(float(std::log(kFoundAgain / share)));
    miss.push_back(float(std::log((1 - kFoundAgain) / (1 - share))));
  }
  for (float& left : left_) left *= kMemory;
  for (Candidate& c : candidates_)
    c.score = std::min(c.score + (c.seen ? hit : miss)[size_t(c.kind)], float(kMostScore));
  candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(),
                                   [&](const Candidate& c) {
                                     if (c.score >= 0) return false;
                                     ++left_[size_t(block(nearest(c.x), nearest(c.y)))];
                                     occupied_.at(nearest(c.x), nearest(c.y)) = 0;
                                     return true;
                                   }),
                    candidates_.end());
}

void FixedParts::add_candidates(const ImageEdges& edges) {
  for (size_t i = 0; i < edges.pixels.size(); i += kEvery) {
    const EdgePixel& e = edges.pixels[i];
    uint8_t& occupied = occupied_.at(nearest(e.x), nearest(e.y));
    if (occupied) continue;
    occupied = 1;
    Candidate c{e.x, e.y, e.nx, e.ny, e.strength};
    c.kind = kind(c);
    candidates_.push_back(c);
  }
}

// Pixels near candidates of a score. Pieces are candidates close to each other; pieces near to each other
// form a part, and only a part as a whole shows whether it is one: its instruments may be small, its rim
// straight.
Plane<uint8_t> FixedParts::grow(double least_score, const ImageEdges& edges) const {
  std::vector<const Candidate*> fixed;
  for (const Candidate& c : candidates_)
    if (c.score >= least_score) fixed.push_back(&c);
  if (int(fixed.size()) < kFewestFixed) return {};
  Plane<uint8_t> at(width_, height_), near(width_, height_), grown(width_, height_), around(width_, height_);
  as_mat(at).setTo(0);
  for (const Candidate* c : fixed) at.at(nearest(c->x), nearest(c->y)) = 255;
  cv::dilate(as_mat(at), as_mat(near), square(1));
  cv::dilate(as_mat(at), as_mat(grown), square(kReachPx));
  cv::Mat piece_at, part_at;
  std::vector<Piece> pieces(size_t(cv::connectedComponents(as_mat(grown), piece_at, 8)));
  for (const Candidate* c : fixed)
    pieces[size_t(piece_at.at<int>(nearest(c->y), nearest(c->x)))].add(c->nx, c->ny);
  for (const EdgePixel& e : edges.pixels) {
    Piece& piece = pieces[size_t(piece_at.at<int>(nearest(e.y), nearest(e.x)))];
    ++piece.edges;
    piece.edges_fixed += near.at(nearest(e.x), nearest(e.y)) != 0;
  }
  // Most images end here: pieces that hold together are rare, and the rest costs as much again.
  if (std::none_of(pieces.begin() + 1, pieces.end(), [](const Piece& p) { return p.holds_together(); }))
    return {};
  cv::dilate(as_mat(at), as_mat(around), square(width_ / kPartsApart));
  std::vector<Piece> parts(size_t(cv::connectedComponents(as_mat(around), part_at, 8)));
  for (const Candidate* c : fixed)
    pieces[size_t(piece_at.at<int>(nearest(c->y), nearest(c->x)))].part =
        part_at.at<int>(nearest(c->y), nearest(c->x));
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) ++pieces[size_t(piece_at.at<int>(y, x))].area;
  for (size_t i = 1; i < pieces.size(); ++i)
    if (pieces[i].holds_together()) parts[size_t(pieces[i].part)].add(pieces[i]);
  const int least_area = int(kLeastArea * width_ * height_);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const Piece& piece = pieces[size_t(piece_at.at<int>(y, x))];
      const bool kept =
          piece.number > 0 && piece.holds_together() && parts[size_t(piece.part)].is_part(least_area);
      if (!kept) grown.at(x, y) = 0;
    }
  cv::erode(as_mat(grown), as_mat(grown), square(kReachPx - kMarginPx));
  Plane<uint8_t> area = filled(grown, near, edges);
  if (count(area) > 0) add_calm_blocks(&area);
  return area;
}

int FixedParts::blocks_across() const { return width_ / kBlockPx + 1; }
int FixedParts::block(int x, int y) const { return y / kBlockPx * blocks_across() + x / kBlockPx; }

// Blocks that edges hardly leave, next to the area or known before: weak edges of the part, or none. The
// scene passes elsewhere.
void FixedParts::add_calm_blocks(Plane<uint8_t>* area) const {
  double active = 0, leaving = 0;
  for (const float left : left_)
    if (left > 0.5f) ++active, leaving += left;
  const double usual = leaving / std::max(active, 1.0);
  if (usual < kFewestLeaving) return;
  Plane<uint8_t> wide(width_, height_);
  cv::dilate(as_mat(*area), as_mat(wide), square(height_ / kCalmReach));
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (!area->at(x, y) && left_[size_t(block(x, y))] >= kCalm * usual) wide.at(x, y) = 0;
  cv::Mat piece_at;
  std::vector<uint8_t> touches(size_t(cv::connectedComponents(as_mat(wide), piece_at, 4)), 0);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (area->at(x, y)) touches[size_t(piece_at.at<int>(y, x))] = 255;
  touches[0] = 0;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) area->at(x, y) = touches[size_t(piece_at.at<int>(y, x))];
  // Which edges decide changes from image to image; a part does not.
  for (int y = 0; area_ && y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (area_->at(x, y) && left_[size_t(block(x, y))] < kCalm * usual) area->at(x, y) = 255;
}

// The area with its gaps closed, unless most edges in them belong to something else.
Plane<uint8_t> FixedParts::filled(const Plane<uint8_t>& area, const Plane<uint8_t>& near,
                                  const ImageEdges& edges) const {
  Plane<uint8_t> closed(width_, height_);
  cv::morphologyEx(as_mat(area), as_mat(closed), cv::MORPH_CLOSE, square(kGapPx));
  int added = 0, fixed = 0;
  for (const EdgePixel& e : edges.pixels) {
    const int x = nearest(e.x), y = nearest(e.y);
    if (!closed.at(x, y)) continue;
    ++added;
    fixed += near.at(x, y) != 0 || area.at(x, y) != 0;
  }
  if (fixed >= kLeastFixedInGaps * added) return closed;
  Plane<uint8_t> same(width_, height_);
  as_mat(area).copyTo(as_mat(same));
  return same;
}

bool FixedParts::update_area(const ImageEdges& edges, bool is_early) {
  Plane<uint8_t> grown = grow(kFixed, edges);
  const int now = count(grown), before = area_ ? count(*area_) : 0;
  const int suspects = is_early ? count(grow(kSuspect, edges)) : 0;
  is_undecided_ = suspects > std::max(kMuchMore * now, kLeastSuspects * width_ * height_);
  if (std::abs(now - before) <= kWorthChanging * before) return false;
  area_ = now > 0 ? std::make_shared<const Plane<uint8_t>>(std::move(grown)) : nullptr;
  return true;
}

bool FixedParts::add(const ImageEdges& edges) {
  index(edges);
  if (candidates_.empty()) {
    add_candidates(edges);
    return false;
  }
  look(edges);
  compare_cells();
  if (motion_.stands || motion_.moving < kLeastCellsMoving * motion_.cells || motion_.cells == 0)
    return false;
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
