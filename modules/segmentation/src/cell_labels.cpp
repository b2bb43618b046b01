// SPDX-License-Identifier: BSD-3-Clause
#include "cell_labels.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "cell_groups.h"
#include "edgevo/edges/opencv_view.h"

namespace edgevo {
namespace {

constexpr int kCellPx = 8;   // of the level: a letter, a dial's rim
constexpr size_t kStep = 2;  // pixels along an edge, which say the same
constexpr int kOld = 8;      // images from each of which most of the view moved to the next
// Log-odds of a cell; none is below -kSuspect or above 2 kFixed, so that a label can change.
constexpr float kSuspect = 4, kFixed = 10;
constexpr int kReach = 2;               // cells, between those of a part: letters, instruments
constexpr double kPart = 200;           // log-odds of cells that lie together; less is harmless
constexpr double kAcross = 4 * kFixed;  // log-odds of the cells whose edges lie across those of the part
constexpr int kAroundPx = 3;            // around cells: what the gradient there is made of

}  // namespace

void CellLabels::prepare(int width, int height) {
  width_ = width, height_ = height;
  for (std::optional<KeptEdges>* kept : {&recent_, &kept_, &next_})
    kept->emplace(width, height, kCellPx, kStep);
  const size_t cells = size_t(kept_->columns()) * size_t(kept_->rows());
  takes_part_.assign(cells, 1);
  fixed_.assign(cells, 0);
  masked_.assign(cells, 0);
  log_odds_.assign(cells, 0);
}

void CellLabels::exclude(const Plane<uint8_t>& area) {
  if (!kept_) prepare(area.width(), area.height());
  std::fill(takes_part_.begin(), takes_part_.end(), uint8_t(1));
  for (int y = 0; y < area.height(); ++y)
    for (int x = 0; x < area.width(); ++x)
      if (area.at(x, y)) takes_part_[size_t(y / kCellPx * kept_->columns() + x / kCellPx)] = 0;
}

// What is known to be fixed says nothing about the motion of the view.
std::vector<uint8_t> CellLabels::voters() const {
  std::vector<uint8_t> voters(takes_part_);
  for (size_t i = 0; i < voters.size(); ++i)
    if (fixed_[i]) voters[i] = 0;
  return voters;
}

// The edges of a cell are mostly one line: together they say as much as one edge.
void CellLabels::weigh(const std::vector<double>& chances) {
  std::vector<float> hit, miss;
  for (const double measured : chances) {
    const double chance = std::min(measured, kFoundAgain);
    hit.push_back(float(std::log(kFoundAgain / chance)));
    miss.push_back(float(std::log((1 - kFoundAgain) / (1 - chance))));
  }
  std::vector<float> sum(log_odds_.size()), number(log_odds_.size());
  directions_.assign(log_odds_.size(), {});
  for (const KeptEdge& e : kept_->all()) {
    if (e.seen) directions_[size_t(e.cell)].add(e.nx, e.ny);
    sum[size_t(e.cell)] += (e.seen ? hit : miss)[size_t(e.kind)];
    ++number[size_t(e.cell)];
  }
  for (size_t i = 0; i < sum.size(); ++i)
    if (number[i] > 0) log_odds_[i] = std::clamp(log_odds_[i] + sum[i] / number[i], -kSuspect, 2 * kFixed);
}

// Of those of its cells that have `least` of them.
double CellLabels::log_odds_of(const std::vector<int>& part, float least) const {
  double sum = 0;
  for (const int i : part)
    if (log_odds_[size_t(i)] >= least) sum += log_odds_[size_t(i)];
  return sum;
}

// Edges of a single direction may slide along themselves, as those of a kerb do. What keeps its place across
// them is no less certain where there is much along them.
bool CellLabels::lies_across(const std::vector<int>& part) const {
  Directions directions;
  for (const int i : part) directions.add(directions_[size_t(i)]);
  const double angle = 0.5 * std::atan2(2 * directions.xy, directions.xx - directions.yy);
  std::vector<int> across;
  for (const int i : part)
    if (directions_[size_t(i)].are_across(angle)) across.push_back(i);
  return log_odds_of(across, kSuspect) >= kAcross;
}

// A part is made of cells that are fixed, and of suspects that lie there.
void CellLabels::label() {
  const auto is_suspect = [&](size_t i) {
    return log_odds_[i] >= kSuspect || (fixed_[i] && log_odds_[i] > -kSuspect);
  };
  is_undecided_ = false;
  std::vector<uint8_t> fixed(fixed_.size());
  for (const std::vector<int>& part : cell_groups(kept_->columns(), kept_->rows(), kReach, is_suspect)) {
    const bool is_known = std::any_of(part.begin(), part.end(), [&](int i) { return fixed_[size_t(i)]; });
    const bool may_be_fixed = log_odds_of(part, kSuspect) >= kPart && lies_across(part);
    const bool is_fixed = may_be_fixed && log_odds_of(part, kFixed) >= kPart;
    is_undecided_ |= !is_known && !is_fixed && may_be_fixed;
    for (const int i : part) fixed[size_t(i)] = is_fixed || fixed_[size_t(i)];
  }
  fixed_ = std::move(fixed);
}

// Cells of a row or column, `step` apart, that lie between fixed ones and show nothing of the scene.
void CellLabels::add_between(size_t first, size_t step, size_t number, std::vector<uint8_t>* fixed) const {
  std::optional<size_t> last;
  for (size_t n = 0; n < number; ++n) {
    const size_t i = first + n * step;
    if (fixed_[i])
      for (size_t k = last ? *last : n; k < n; ++k) (*fixed)[first + k * step] = 1;
    if (fixed_[i])
      last = n;
    else if (log_odds_[i] < 0)
      last.reset();
  }
}

// What parts enclose, alone or with the border, unless the scene shows there.
void CellLabels::add_enclosed(std::vector<uint8_t>* fixed) const {
  const size_t columns = size_t(kept_->columns()), rows = size_t(kept_->rows());
  for (size_t y = 0; y < rows; ++y) add_between(y * columns, 1, columns, fixed);
  for (size_t x = 0; x < columns; ++x) add_between(x, columns, rows, fixed);
  const std::vector<uint8_t> walls = *fixed;
  const auto is_free = [&](size_t i) { return !walls[i]; };
  for (const std::vector<int>& group : cell_groups(int(columns), int(rows), 1, is_free)) {
    double scene = 0;
    for (const int i : group) scene -= std::min(log_odds_[size_t(i)], 0.0f);
    if (scene < kPart)
      for (const int i : group) (*fixed)[size_t(i)] = 1;
  }
}

bool CellLabels::update_area() {
  std::vector<uint8_t> masked = fixed_;
  const bool is_any = std::count(fixed_.begin(), fixed_.end(), 1) > 0;
  if (is_any) add_enclosed(&masked);
  int changed = 0;
  for (size_t i = 0; i < masked.size(); ++i) changed += masked[i] != masked_[i];
  if (changed == 0) return false;
  masked_ = std::move(masked);
  area_.reset();
  if (!is_any) return true;
  Plane<uint8_t> area(width_, height_);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      area.at(x, y) = masked_[size_t(y / kCellPx * kept_->columns() + x / kCellPx)] ? 255 : 0;
  constexpr int kSide = 2 * kAroundPx + 1;
  cv::dilate(as_mat(area), as_mat(area), cv::getStructuringElement(cv::MORPH_RECT, {kSide, kSide}));
  area_ = std::make_shared<const Plane<uint8_t>>(std::move(area));
  return true;
}

bool CellLabels::add(const ImageEdges& edges, const Gradient& gradient, const Plane<uint8_t>& shown,
                     const RowShifts& rows) {
  if (!kept_) prepare(edges.width, edges.height);
  if (recent_->all().empty()) {
    for (KeptEdges* kept : {&*recent_, &*kept_, &*next_})
      kept->renew(edges, gradient, shown, rows, takes_part_);
    return false;
  }
  recent_->look(gradient, rows, motion_.stands());
  motion_.vote(*recent_, voters());
  if (!motion_.is_moving()) return false;
  kept_->look(gradient, rows);
  motion_of_kept_.vote(*kept_, voters());
  weigh(kept_->chances(motion_of_kept_.moves(), voters()));
  label();
  recent_->renew(edges, gradient, shown, rows, takes_part_);
  if (++age_ % kOld == 0) {
    std::swap(kept_, next_);
    next_->renew(edges, gradient, shown, rows, takes_part_);
  }
  return update_area();
}

}  // namespace edgevo
