// SPDX-License-Identifier: BSD-3-Clause
#include "cell_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "edgevo/edges/opencv_view.h"

namespace edgevo {
namespace {

constexpr int kCellPx = 8;              // of the level: small parts and outlines are seen, too
constexpr int kMinShown = 2;            // edges, of every other one
constexpr float kFaintest = 8;          // Sobel units: noise alone makes half as much
constexpr float kSameDirection = 0.9f;  // cosine
constexpr double kFixedFound = 0.7;  // share of a fixed part's edges: outlines vanish before their brightness
constexpr double kStill = 0.7;       // share of the edges of a cell that stands still
constexpr int kDirections = 12;      // of edges: those along the motion keep their place, too
constexpr double kPriorEdges = 20;   // of each direction, with the share of all
constexpr size_t kBest = 4;          // edges of a cell that show its label: the scene shows through
constexpr float kFixed = 16;         // odds of a part: 10^4 edges, each tried in each image
constexpr double kMinAcross = 0.15;  // smaller eigenvalue of the mean of n n^T, n: normals
constexpr double kMinMoving = 0.25;  // share of the cells, in a view that moves
constexpr int kMinTurns = 3;         // that what is amid the view must not follow: else it may be far away
constexpr int kEarly = 60, kSeldom = 4;  // images in which the scene moved; then every so many-th is enough
constexpr double kMinPart = 0.01;        // share of the view: less is harmless

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
// sides within a pixel. In the gradient, not among the edges: their threshold follows the image, and faint
// edges of a part fall below it whenever the scene has much contrast.
bool shows_edge(const Gradient& gradient, float x, float y, float nx, float ny) {
  constexpr float kAside = 0.25f;  // pixels: within a pixel and a half of the finest level
  const float dx = value_at(gradient.dx, x, y), dy = value_at(gradient.dy, x, y);
  const float along = std::abs(dx * nx + dy * ny);
  if (along < kFaintest * kGradientSteps ||
      along * along < kSameDirection * kSameDirection * (dx * dx + dy * dy))
    return false;
  const auto has_peak = [&](float at) {  // within half a pixel of it
    const auto magnitude = [&](float d) { return value_at(gradient.magnitude, x + d * nx, y + d * ny); };
    const float here = magnitude(at);
    return here >= magnitude(at - 1) && here > magnitude(at + 1);
  };
  return has_peak(-kAside) || has_peak(kAside);
}

int direction_of(const EdgePixel& e) {
  const double angle = std::atan2(e.ny, e.nx) * (kDirections / M_PI) + 2.5 * kDirections;
  return int(angle) % kDirections;
}

}  // namespace

bool CellLabels::Cell::speaks() const { return int(edges.size()) >= kMinShown && !is_dark(); }
bool CellLabels::Cell::is_still() const { return speaks() && found >= kStill * double(edges.size()); }

void CellLabels::prepare(int width, int height) {
  width_ = width, height_ = height, size_ = kCellPx;
  columns_ = (width + size_ - 1) / size_, rows_ = (height + size_ - 1) / size_;
  cells_.resize(size_t(columns_) * size_t(rows_));
  occupied_ = Plane<uint8_t>(width_, height_);
  as_mat(occupied_).setTo(0);
}

template <class F>
void CellLabels::around(int c, const F& f) const {
  const int x = c % columns_, y = c / columns_;
  for (int v = std::max(0, y - 1); v <= std::min(rows_ - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(columns_ - 1, x + 1); ++u) f(v * columns_ + u);
}

// The edges of before at their place, within some pixels of the finest level.
void CellLabels::find(const ImageEdges& edges, const Gradient& gradient) {
  for (Cell& c : cells_) {
    c.found = c.shown = 0;
    for (Edge& e : c.edges) {
      e.is_found = shows_edge(gradient, e.x, e.y, e.nx, e.ny);
      c.found += e.is_found;
    }
  }
  for (size_t i = 0; i < edges.pixels.size(); i += 2)
    ++cells_[size_t(cell_at(edges.pixels[i].x, edges.pixels[i].y))].shown;
}

CellLabels::Counts CellLabels::count() const {
  Counts n;
  for (const Cell& c : cells_) {
    if (!c.speaks() || c.in_part) continue;
    ++n.cells;
    n.still += c.is_still();
    n.moving += c.has_left();
  }
  return n;
}

// Whether one displacement of all that has left its place explains where it is: then it may be one body, a
// bus before a camera that stands. A camera that moves shows a scene at more than one depth.
bool CellLabels::moves_as_one(const ImageEdges& edges) const {
  constexpr int kAcross = 48, kDown = 8;  // pixels of the level, in one image
  constexpr double kShare = 0.6, kExcess = 0.35;
  Plane<uint8_t> now(width_, height_);
  as_mat(now).setTo(0);
  for (const EdgePixel& e : edges.pixels) now.at(nearest_pixel(e.x), nearest_pixel(e.y)) = 1;
  cv::dilate(as_mat(now), as_mat(now), cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}));
  std::vector<std::pair<int, int>> left;
  for (const EdgePixel& e : before_)
    if (cells_[size_t(cell_at(e.x, e.y))].has_left())
      left.emplace_back(nearest_pixel(e.x), nearest_pixel(e.y));
  int best = 0, sum = 0, tried = 0;
  for (int dy = -kDown; dy <= kDown; ++dy)
    for (int dx = -kAcross; dx <= kAcross; ++dx) {
      int hits = 0;
      for (const auto& [x, y] : left) {
        const int u = x + dx, v = y + dy;
        hits += u >= 0 && v >= 0 && u < width_ && v < height_ && now.at(u, v);
      }
      best = std::max(best, hits), sum += hits, ++tried;
    }
  const double number = double(left.size());
  return best >= kShare * number && best - double(sum) / tried >= kExcess * number;
}

// What crosses the view covers a standing one little by little, and moves as one; a camera that begins to
// move shows the whole scene moving.
bool CellLabels::stands(const ImageEdges& edges) const {
  const Counts n = count();
  if (n.cells == 0) return false;
  if (n.moving < 0.5 * kMinMoving * n.cells) return true;
  const bool may_stand = stood_ > 0 ? n.still >= 0.6 * kMinMoving * n.cells : 2 * n.still >= n.cells;
  return may_stand && is_compact() && moves_as_one(edges);
}

// Whether what has left its place is compact: little among it keeps its place.
bool CellLabels::is_compact() const {
  std::vector<int> x, y;
  for (int c = 0; c < int(cells_.size()); ++c)
    if (cells_[size_t(c)].has_left()) x.push_back(c % columns_), y.push_back(c / columns_);
  if (x.empty()) return true;
  std::sort(x.begin(), x.end()), std::sort(y.begin(), y.end());
  const size_t low = x.size() / 20, high = x.size() - 1 - low;
  int still = 0;
  for (int v = y[low]; v <= y[high]; ++v)
    for (int u = x[low]; u <= x[high]; ++u) still += cells_[size_t(v * columns_ + u)].is_still();
  return still < 0.15 * double(x.size());
}

StillCells CellLabels::still_cells() const {
  return stood_ > 0 ? StillCells{columns_, rows_, still_, stood_} : StillCells{};
}

// Adds the evidence of an image in which the scene moves.
void CellLabels::weigh() {
  std::array<double, kDirections> all{}, found{};
  double sum_all = kPriorEdges, sum_found = 0.25 * kPriorEdges;
  for (const Cell& c : cells_)
    if (c.has_left())
      for (const Edge& e : c.edges)
        ++all[size_t(e.direction)], found[size_t(e.direction)] += e.is_found, ++sum_all,
            sum_found += e.is_found;
  std::array<float, kDirections> hit, miss;
  for (size_t d = 0; d < all.size(); ++d) {
    const double share = std::clamp((kPriorEdges * sum_found / sum_all + found[d]) / (kPriorEdges + all[d]),
                                    0.05, kFixedFound);
    hit[d] = float(std::log(kFixedFound / share)), miss[d] = float(std::log((1 - kFixedFound) / (1 - share)));
  }
  std::vector<float> odds;
  for (Cell& c : cells_) {
    if (c.is_dark()) continue;
    for (Edge& e : c.edges) {
      e.fixed = std::min(e.fixed + (e.is_found ? hit : miss)[size_t(e.direction)], 1.5f * kFixed);
      if (e.fixed < 0) occupied_.at(nearest_pixel(e.x), nearest_pixel(e.y)) = 0;
    }
    c.edges.erase(std::remove_if(c.edges.begin(), c.edges.end(), [](const Edge& e) { return e.fixed < 0; }),
                  c.edges.end());
    odds.clear();
    for (const Edge& e : c.edges) odds.push_back(e.fixed);
    const size_t best = std::min(kBest, odds.size());
    std::partial_sort(odds.begin(), odds.begin() + std::ptrdiff_t(best), odds.end(), std::greater<>());
    c.fixed = best < size_t(kMinShown)
                  ? 0
                  : std::accumulate(odds.begin(), odds.begin() + std::ptrdiff_t(best), 0.0f) / float(best);
  }
}

// Cells whose edges have stayed while the view turned.
void CellLabels::add_turn(const Eigen::Vector2f& px) {
  constexpr float kTurnPx = 1.5f;  // across the edges: an edge at its place is within one
  turned_ += px;
  has_poses_ = true;
  for (Cell& c : cells_) {
    if (!c.is_still() || c.fixed < 0.5f * kFixed) {
      c.turns = 0, c.turned = turned_;
      continue;
    }
    const Eigen::Vector2f by = turned_ - c.turned;
    float across = 0;
    for (const Edge& e : c.edges) across += std::abs(e.nx * by.x() + e.ny * by.y()) / float(c.edges.size());
    if (across > kTurnPx) ++c.turns, c.turned = turned_;
  }
}

void CellLabels::interrupt_turns() {
  for (Cell& c : cells_) c.turned = turned_;
}

// The odds of each cell, half by its neighbours; of a cell that has shown little, by them.
std::vector<float> CellLabels::smooth() const {
  std::vector<float> smooth(cells_.size());
  for (int c = 0; c < int(cells_.size()); ++c) {
    float sum = 0, number = 0;
    around(c, [&](int n) {
      const Cell& cell = cells_[size_t(n)];
      if (n == c || int(cell.edges.size()) < kMinShown) return;
      sum += cell.fixed, ++number;
    });
    const float own = cells_[size_t(c)].fixed;
    smooth[size_t(c)] = number > 0 ? 0.5f * own + 0.5f * sum / number : 0.5f * own;
  }
  return smooth;
}

void CellLabels::add_edges(const ImageEdges& edges) {
  for (size_t i = 0; i < edges.pixels.size(); i += 2) {
    const EdgePixel& e = edges.pixels[i];
    uint8_t& occupied = occupied_.at(nearest_pixel(e.x), nearest_pixel(e.y));
    if (!std::exchange(occupied, uint8_t(1)))
      cells_[size_t(cell_at(e.x, e.y))].edges.push_back({e.x, e.y, e.nx, e.ny, 0, direction_of(e), true});
  }
}

// Edges of a single direction may slide along themselves, as those of a kerb do. What lies amid the view may
// be far ahead, unless it stays there when the view turns; what comes in from its border is fixed more often.
bool CellLabels::is_part(const std::vector<int>& cells, double least) const {
  const int near = columns_ / 12;  // cells: a part comes in from the border, or is held before it
  bool at_border = false;
  double number = 0, xx = 0, xy = 0, yy = 0, shown = 0, sure = 0, turns = 0;
  for (const int c : cells) {
    const Cell& cell = cells_[size_t(c)];
    shown += !cell.edges.empty(), sure += cell.fixed > (cell.in_part ? 0.6 : 1.0) * least;
    if (!cell.edges.empty()) turns += cell.in_part ? kMinTurns : cell.turns;
    const int x = c % columns_, y = c / columns_;
    at_border = at_border || std::min({x, y, columns_ - 1 - x, rows_ - 1 - y}) < near;
    for (const Edge& e : cells_[size_t(c)].edges)
      if (e.fixed > 0.5 * least) ++number, xx += e.nx * e.nx, xy += e.nx * e.ny, yy += e.ny * e.ny;
  }
  const double spread = std::hypot(0.5 * (xx - yy), xy);
  return turns >= (!at_border   ? kMinTurns
                   : has_poses_ ? 1
                                : 0) *
                      shown &&
         2 * sure >= shown && double(cells.size()) >= kMinPart * double(cells_.size()) && number >= 40 &&
         0.5 * (xx + yy) - spread >= kMinAcross * number;
}

// Cells that lie together in a part.
std::vector<uint8_t> CellLabels::parts(const std::vector<float>& fixed, double least) const {
  std::vector<uint8_t> is_fixed(cells_.size());
  for (size_t c = 0; c < cells_.size(); ++c) is_fixed[c] = fixed[c] > 0.6 * least;
  keep_dark(&is_fixed);
  enclose(&is_fixed);
  std::vector<uint8_t> kept(cells_.size()), seen(cells_.size());
  for (int first = 0; first < int(cells_.size()); ++first) {
    if (!is_fixed[size_t(first)] || seen[size_t(first)]) continue;
    std::vector<int> part = {first};
    seen[size_t(first)] = 1;
    for (size_t i = 0; i < part.size(); ++i)
      around(part[i], [&](int n) {
        if (is_fixed[size_t(n)] && !std::exchange(seen[size_t(n)], uint8_t(1))) part.push_back(n);
      });
    if (is_part(part, least))
      for (const int c : part) kept[size_t(c)] = 1;
  }
  fill_gaps(fixed, 0.3 * least, &kept);
  return kept;
}

// Adds cells in gaps of the parts and between them and the border, unless they show the scene.
void CellLabels::fill_gaps(const std::vector<float>& fixed, double least, std::vector<uint8_t>* parts) const {
  constexpr int kGap = 11;  // cells
  cv::Mat closed;
  cv::morphologyEx(cv::Mat(rows_, columns_, CV_8U, parts->data()), closed, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_RECT, {kGap, kGap}));
  for (size_t c = 0; c < cells_.size(); ++c)
    if (closed.data[c] && (int(cells_[c].edges.size()) < kMinShown || fixed[c] > least)) (*parts)[c] = 1;
}

// Adds cells of the parts that show nothing now, unless the scene shows next to them.
void CellLabels::keep_dark(std::vector<uint8_t>* parts) const {
  const std::vector<uint8_t> fixed = *parts;
  for (int c = 0; c < int(cells_.size()); ++c) {
    if (!cells_[size_t(c)].in_part || int(cells_[size_t(c)].edges.size()) >= kMinShown) continue;
    bool is_scene = false;
    around(c, [&](int n) {
      is_scene = is_scene || (!fixed[size_t(n)] && int(cells_[size_t(n)].edges.size()) >= kMinShown);
    });
    if (!is_scene) (*parts)[size_t(c)] = 1;
  }
}

// Adds cells without edges that only fixed cells and the border of the view surround.
void CellLabels::enclose(std::vector<uint8_t>* parts) const {
  const auto is_empty = [&](int c) {
    return !(*parts)[size_t(c)] && int(cells_[size_t(c)].edges.size()) < kMinShown;
  };
  std::vector<uint8_t> seen(cells_.size());
  for (int first = 0; first < int(cells_.size()); ++first) {
    if (!is_empty(first) || seen[size_t(first)]) continue;
    std::vector<int> gap = {first};
    seen[size_t(first)] = 1;
    bool is_enclosed = true;
    for (size_t i = 0; i < gap.size(); ++i)
      around(gap[i], [&](int n) {
        if ((*parts)[size_t(n)]) return;
        if (!is_empty(n))
          is_enclosed = false;
        else if (!std::exchange(seen[size_t(n)], uint8_t(1)))
          gap.push_back(n);
      });
    if (is_enclosed && gap.size() < cells_.size() / 2)
      for (const int c : gap) (*parts)[size_t(c)] = 1;
  }
}

// Whole cells inside, and around their edges next to cells of the scene.
Plane<uint8_t> CellLabels::drawn(const std::vector<uint8_t>& parts) const {
  Plane<uint8_t> area(width_, height_);
  as_mat(area).setTo(0);
  const cv::Rect image(0, 0, width_, height_);
  for (int c = 0; c < int(cells_.size()); ++c) {
    if (!parts[size_t(c)]) continue;
    bool is_inside = true;
    around(c, [&](int n) { is_inside = is_inside && parts[size_t(n)]; });
    const cv::Rect cell(c % columns_ * size_, c / columns_ * size_, size_, size_);
    if (is_inside) as_mat(area)(cell & image).setTo(255);
    if (!is_inside)
      for (const Edge& e : cells_[size_t(c)].edges)
        if (e.fixed > 0.5f * kFixed)
          as_mat(area)(cv::Rect(nearest_pixel(e.x) - 2, nearest_pixel(e.y) - 2, 5, 5) & image).setTo(255);
  }
  return area;
}

bool CellLabels::update_area() {
  const std::vector<float> fixed = smooth();
  const std::vector<uint8_t> now = parts(fixed, kFixed);
  const std::vector<uint8_t> suspects = parts(fixed, kFixed * std::min(0.5, 0.08 * compared_));
  int changed = 0, number = 0, suspected = 0;
  for (size_t c = 0; c < now.size(); ++c) {
    changed += (now[c] != 0) != cells_[c].in_part;
    number += now[c] && !cells_[c].edges.empty();
    suspected += suspects[c] && !cells_[c].edges.empty();
  }
  is_undecided_ = compared_ < kEarly && suspected > std::max(1.3 * number, 3 * kMinPart * double(now.size()));
  if (20 * changed <= number) return false;
  for (size_t c = 0; c < now.size(); ++c) cells_[c].in_part = now[c];
  area_ = number > 0 ? std::make_shared<const Plane<uint8_t>>(drawn(now)) : nullptr;
  return true;
}

bool CellLabels::add(const ImageEdges& edges, const Gradient& gradient) {
  const bool is_first = cells_.empty();
  if (is_first) prepare(edges.width, edges.height);
  find(edges, gradient);
  stood_ = !is_first && stands(edges) ? stood_ + 1 : 0;
  still_.assign(cells_.size(), 0);
  for (int c = 0; c < int(cells_.size()); ++c) {
    int still = 0;  // of it and its neighbours, over those that have left
    around(c, [&](int n) { still += int(cells_[size_t(n)].is_still()) - int(cells_[size_t(n)].has_left()); });
    still_[size_t(c)] = cells_[size_t(c)].speaks() ? cells_[size_t(c)].is_still() : still > 0;
  }
  const Counts n = count();
  const bool moves = stood_ == 0 && n.moving > 0 && n.moving >= kMinMoving * n.cells;
  bool has_changed = false;
  if (moves) {
    ++compared_;
    weigh();
    has_changed = (compared_ < kEarly || compared_ % kSeldom == 0) && update_area();
  }
  if (is_first || moves) add_edges(edges);
  before_.clear();
  for (size_t i = 0; i < edges.pixels.size(); i += edges.pixels.size() / 500 + 1)
    before_.push_back(edges.pixels[i]);
  return has_changed;
}

}  // namespace edgevo
