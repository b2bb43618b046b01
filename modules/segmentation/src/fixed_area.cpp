// SPDX-License-Identifier: BSD-3-Clause
#include "fixed_area.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "edgevo/edges/opencv_view.h"

namespace edgevo {
namespace {

// Scene edges around and behind a part are found between its edges, too.
constexpr double kMinFixedShare = 0.5;
constexpr int kReachPx = 6;       // edges of a piece are that near to each other
constexpr int kPartsApart = 12;   // pieces of a part are this share of the width from each other
constexpr int kPartMarginPx = 2;  // around the edges: what the gradient there is made of
constexpr int kGapPx = 12;        // half width of gaps that are closed, gap in a line that goes on
constexpr double kMinFixedInGaps = 0.7;
constexpr float kSameLine = 0.97f;  // cosine between normals
// Blocks of the view in which edges that leave their place are counted, and over how many images.
constexpr int kBlockPx = 8;
constexpr float kMemory = 0.96f;
constexpr double kMinLeaving = 4, kCalm = 0.15;
constexpr int kMinInPiece = 6;         // candidates
constexpr double kMinPartArea = 0.01;  // share of the image; less is harmless
constexpr int kMinFixed = 40;          // candidates
constexpr double kMinAcross = 0.1;     // smaller eigenvalue of the mean of n n^T, n: normals

// Candidates that lie together.
struct Piece {
  int number = 0, area = 0, edges = 0, edges_fixed = 0, known = 0, at_border = 0, part = 0;
  double xx = 0, xy = 0, yy = 0;  // sums of the normals' products
  void add(double x, double y) { ++number, xx += x * x, xy += x * y, yy += y * y; }
  void add(const Piece& p) {
    number += p.number, area += p.area, at_border += p.at_border;
    xx += p.xx, xy += p.xy, yy += p.yy;
  }
  // Most edges there are fixed, or were when it was found: around an outline, the scene comes and goes.
  bool holds_together() const {
    return number >= kMinInPiece && (edges_fixed >= kMinFixedShare * edges || 2 * known >= number);
  }
  // Edges of a single direction may slide along themselves, as those of a kerb do. What is fixed to the
  // camera comes in from the border of the view; what lies amid it may be far ahead.
  bool is_part(int least_area) const {
    const double mean = 0.5 * (xx + yy), spread = std::hypot(0.5 * (xx - yy), xy);
    return number >= kMinFixed && at_border >= kMinInPiece && area >= least_area &&
           mean - spread >= kMinAcross * number;
  }
};

cv::Mat square(int radius) {
  return cv::getStructuringElement(cv::MORPH_RECT, {2 * radius + 1, 2 * radius + 1});
}

Plane<uint8_t> grown_by(const Plane<uint8_t>& plane, int radius) {
  Plane<uint8_t> grown(plane.width(), plane.height());
  cv::dilate(as_mat(plane), as_mat(grown), square(radius));
  return grown;
}

// Adds the projections of the points to the sides of the image that are near: a part comes in from the
// border.
void extend_to_border(int width, int height, std::vector<cv::Point>* points) {
  const cv::Rect box = cv::boundingRect(*points);
  const int near = width / kPartsApart, right = width - 1, bottom = height - 1;
  for (size_t i = 0, size = points->size(); i < size; ++i) {
    const cv::Point p = (*points)[i];
    if (box.x < near) points->push_back({0, p.y});
    if (box.y < near) points->push_back({p.x, 0});
    if (right - box.br().x < near) points->push_back({right, p.y});
    if (bottom - box.br().y < near) points->push_back({p.x, bottom});
  }
}

}  // namespace

LeavingEdges::LeavingEdges(int width, int height)
    : width_(width), height_(height), across_(width / kBlockPx + 1) {
  left_.assign(size_t(across_ * (height / kBlockPx + 1)), 0);
}

int LeavingEdges::block(int x, int y) const { return y / kBlockPx * across_ + x / kBlockPx; }

void LeavingEdges::fade() {
  for (float& left : left_) left *= kMemory;
}

Plane<uint8_t> LeavingEdges::calm() const {
  double active = 0, leaving = 0;
  for (const float left : left_)
    if (left > 0.5f) ++active, leaving += left;
  const double usual = leaving / std::max(active, 1.0);
  if (usual < kMinLeaving) return {};
  Plane<uint8_t> calm(width_, height_);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) calm.at(x, y) = left_[size_t(block(x, y))] < kCalm * usual ? 255 : 0;
  return calm;
}

FixedArea::FixedArea(const std::vector<FixedCandidate>& candidates, const ImageEdges& edges,
                     const LeavingEdges& leaving, const Plane<uint8_t>* known)
    : candidates_(candidates),
      edges_(edges),
      leaving_(leaving),
      known_(known),
      width_(edges.width),
      height_(edges.height) {}

// Pieces are candidates close to each other; pieces near to each other form a part, and only a part as a
// whole shows whether it is one: its instruments may be small, its rim straight.
Plane<uint8_t> FixedArea::grow(double least_score) const {
  Candidates fixed;
  for (const FixedCandidate& c : candidates_)
    if (c.score >= least_score) fixed.push_back(&c);
  if (int(fixed.size()) < kMinFixed) return {};
  Plane<uint8_t> at(width_, height_);
  as_mat(at).setTo(0);
  for (const FixedCandidate* c : fixed) at.at(nearest_pixel(c->x), nearest_pixel(c->y)) = 255;
  const Plane<uint8_t> near = grown_by(at, 1);
  Plane<uint8_t> parts = grown_by(at, kReachPx);
  cv::Mat piece_at, part_at;
  std::vector<Piece> pieces(size_t(cv::connectedComponents(as_mat(parts), piece_at, 8)));
  const auto piece_of = [&](const auto& p) -> Piece& {
    return pieces[size_t(piece_at.at<int>(nearest_pixel(p.y), nearest_pixel(p.x)))];
  };
  const float wide = float(width_) / kPartsApart;
  const auto is_near_border = [&](const FixedCandidate& c) {
    return std::min(c.x, c.y) < wide || c.x > float(width_) - wide || c.y > float(height_) - wide;
  };
  for (const FixedCandidate* c : fixed) {
    piece_of(*c).add(c->nx, c->ny);
    piece_of(*c).at_border += is_near_border(*c);
    piece_of(*c).known += known_ && known_->at(nearest_pixel(c->x), nearest_pixel(c->y));
  }
  for (const EdgePixel& e : edges_.pixels) {
    ++piece_of(e).edges;
    piece_of(e).edges_fixed += near.at(nearest_pixel(e.x), nearest_pixel(e.y)) != 0;
  }
  // Most images end here: pieces that hold together are rare, and the rest costs as much again.
  if (std::none_of(pieces.begin() + 1, pieces.end(), [](const Piece& p) { return p.holds_together(); }))
    return {};
  const Plane<uint8_t> around = grown_by(at, width_ / kPartsApart);
  std::vector<Piece> sums(size_t(cv::connectedComponents(as_mat(around), part_at, 8)));
  for (const FixedCandidate* c : fixed)
    piece_of(*c).part = part_at.at<int>(nearest_pixel(c->y), nearest_pixel(c->x));
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) ++pieces[size_t(piece_at.at<int>(y, x))].area;
  for (size_t i = 1; i < pieces.size(); ++i)
    if (pieces[i].holds_together()) sums[size_t(pieces[i].part)].add(pieces[i]);
  const int least_area = int(kMinPartArea * width_ * height_);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const Piece& piece = pieces[size_t(piece_at.at<int>(y, x))];
      const bool kept =
          piece.number > 0 && piece.holds_together() && sums[size_t(piece.part)].is_part(least_area);
      if (!kept) parts.at(x, y) = 0;
    }
  cv::erode(as_mat(parts), as_mat(parts), square(kReachPx - kPartMarginPx));
  parts = with_continuations(std::move(fixed), parts);
  Plane<uint8_t> area = filled(parts, near);
  if (cv::countNonZero(as_mat(area)) > 0) add_calm(hulls(parts, part_at), &area);
  return area;
}

// The parts with suspects on the lines of their edges: an outline is faint where the background has its
// brightness, but goes on. Such suspects make no part: in a corridor there are many.
Plane<uint8_t> FixedArea::with_continuations(Candidates fixed, const Plane<uint8_t>& parts) const {
  const auto is_outside = [&](const FixedCandidate* c) {
    return !parts.at(nearest_pixel(c->x), nearest_pixel(c->y));
  };
  fixed.erase(std::remove_if(fixed.begin(), fixed.end(), is_outside), fixed.end());
  Plane<const FixedCandidate*> suspects(width_, height_);
  Plane<uint8_t> added(width_, height_);
  std::fill_n(suspects.row(0), size_t(width_) * size_t(height_), nullptr);
  as_mat(added).setTo(0);
  for (const FixedCandidate& c : candidates_)
    if (c.score >= kSuspectScore) suspects.at(nearest_pixel(c.x), nearest_pixel(c.y)) = &c;
  const auto follow = [&](const FixedCandidate& from, int along, int across) {
    const int x = int(std::lround(from.x - from.ny * float(along) + from.nx * float(across))),
              y = int(std::lround(from.y + from.nx * float(along) + from.ny * float(across)));
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    const FixedCandidate*& other = suspects.at(x, y);
    if (!other || std::abs(other->nx * from.nx + other->ny * from.ny) < kSameLine) return;
    fixed.push_back(std::exchange(other, nullptr));
    added.at(x, y) = 255;
  };
  for (size_t next = 0; next < fixed.size(); ++next) {
    const FixedCandidate from = *fixed[next];
    for (int along = -kGapPx; along <= kGapPx; ++along)
      for (int across = -1; across <= 1; ++across) follow(from, along, across);
  }
  Plane<uint8_t> all = grown_by(added, kPartMarginPx);
  cv::bitwise_or(as_mat(all), as_mat(parts), as_mat(all));
  return all;
}

// The area with its gaps closed, unless most edges in them belong to something else.
Plane<uint8_t> FixedArea::filled(const Plane<uint8_t>& area, const Plane<uint8_t>& near) const {
  Plane<uint8_t> closed(width_, height_);
  cv::morphologyEx(as_mat(area), as_mat(closed), cv::MORPH_CLOSE, square(kGapPx));
  int added = 0, fixed = 0;
  for (const EdgePixel& e : edges_.pixels) {
    const int x = nearest_pixel(e.x), y = nearest_pixel(e.y);
    if (!closed.at(x, y)) continue;
    ++added;
    fixed += near.at(x, y) != 0 || area.at(x, y) != 0;
  }
  if (fixed >= kMinFixedInGaps * added) return closed;
  Plane<uint8_t> same(width_, height_);
  as_mat(area).copyTo(as_mat(same));
  return same;
}

// What each part encloses: its convex hull, up to the border that is near.
Plane<uint8_t> FixedArea::hulls(const Plane<uint8_t>& area, const cv::Mat& part_at) const {
  double parts = 0;
  cv::minMaxLoc(part_at, nullptr, &parts);
  std::vector<std::vector<cv::Point>> points(size_t(parts) + 1);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (area.at(x, y)) points[size_t(part_at.at<int>(y, x))].push_back({x, y});
  Plane<uint8_t> inside(width_, height_);
  cv::Mat to = as_mat(inside);
  to.setTo(0);
  for (size_t part = 1; part < points.size(); ++part) {  // 0: what went on far from it
    if (points[part].empty()) continue;
    std::vector<cv::Point> hull, wide;
    cv::convexHull(points[part], hull);
    extend_to_border(width_, height_, &hull);
    cv::convexHull(hull, wide);
    cv::fillConvexPoly(to, wide, cv::Scalar(255));
  }
  return inside;
}

// Adds what edges hardly leave, enclosed by a part or known before: weak edges of the part, or none. The
// scene passes elsewhere. Which edges decide changes from image to image; a part does not.
void FixedArea::add_calm(const Plane<uint8_t>& within, Plane<uint8_t>* area) const {
  const Plane<uint8_t> calm = leaving_.calm();
  for (int y = 0; !calm.empty() && y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (calm.at(x, y) && (within.at(x, y) || (known_ && known_->at(x, y)))) area->at(x, y) = 255;
}

}  // namespace edgevo
