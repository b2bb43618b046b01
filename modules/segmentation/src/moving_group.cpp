// SPDX-License-Identifier: BSD-3-Clause
#include "moving_group.h"

#include <algorithm>
#include <cmath>

#include "cell_groups.h"
#include "edgevo/alignment/edge_match.h"
#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

constexpr int kColumns = 32;  // of cells over the width of the image
// Of the points around a cell that contradict, of those outside the group that agree, of the group's edges
// that agree with a motion of its own.
constexpr double kMost = 0.6;
constexpr int kMinAround = 5;    // points around a cell
constexpr int kMinPoints = 16;   // of a group
constexpr int kMinOutside = 40;  // points that agree with the pose, outside the group
constexpr int kMinEdges = 60;    // edge pixels of a group
constexpr int kMinInCell = 6;    // edge pixels
// The rest of the view reaches over this many times the group's area.
constexpr double kRestReaches = 2.0;
constexpr double kOwnExcess = 0.35;  // agreement of a group with a motion of its own, beyond chance

constexpr double kUsualDepthError = 0.25;  // of points of the map, median inverse depths
constexpr double kSceneMovesPx = 4;        // that the map moves a group which keeps its place

enum class Fit : uint8_t { kUnseen, kAgrees, kContradicts };

std::vector<Fit> point_fits(const PyramidLevel& level, const ReferenceCloud& cloud, const SE3& T_cur_ref,
                            const AlignmentParams& params) {
  std::vector<Fit> fits(cloud.points.size(), Fit::kUnseen);
  const Eigen::Matrix3d R = T_cur_ref.R();
  for (size_t i = 0; i < fits.size(); ++i) {
    const CloudPoint& c = cloud.points[i];
    if (c.host_keyframe < 0) continue;  // its depth is a guess
    const Projection p = project(level.pinhole, R, T_cur_ref.translation(), c.ray, c.idepth);
    if (!p.valid || !level.pinhole.contains(p.px, kEdgelessBorder)) continue;
    const EdgeMatch m = match_edge(level, p.px, c.normal, params);
    fits[i] = m.found && std::abs(m.residual_px) < params.huber_px ? Fit::kAgrees : Fit::kContradicts;
  }
  return fits;
}

struct Cells {
  int cell, columns, rows;
  std::vector<int> agree, contradict;

  Cells(const Pinhole& camera)
      : cell(std::max(8, camera.width / kColumns)),
        columns((camera.width + cell - 1) / cell),
        rows((camera.height + cell - 1) / cell),
        agree(size_t(columns) * rows, 0),
        contradict(agree) {}
  int index(const Eigen::Vector2f& px) const {
    return std::clamp(int(px.y()) / cell, 0, rows - 1) * columns +
           std::clamp(int(px.x()) / cell, 0, columns - 1);
  }
  void count(const ReferenceCloud& cloud, const std::vector<Fit>& fits) {
    for (size_t i = 0; i < fits.size(); ++i)
      if (fits[i] != Fit::kUnseen)
        ++(fits[i] == Fit::kAgrees ? agree : contradict)[size_t(index(cloud.points[i].px))];
  }
  template <class F>
  void around(int c, const F& f) const {
    const int x = c % columns, y = c / columns;
    for (int v = std::max(0, y - 1); v <= std::min(rows - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(columns - 1, x + 1); ++u) f(v * columns + u);
  }
  bool contradicts(int c) const {
    if (agree[c] + contradict[c] == 0) return false;
    int a = 0, b = 0;
    around(c, [&](int n) { a += agree[n], b += contradict[n]; });
    return a + b >= kMinAround && b >= kMost * (a + b);
  }
  // Connected cells that contradict.
  std::vector<std::vector<int>> parts() const {
    return cell_groups(columns, rows, 1, [&](size_t c) { return contradicts(int(c)); });
  }
};

double spread(const std::vector<Eigen::Vector2f>& points) {
  Eigen::Vector2f sum = Eigen::Vector2f::Zero(), square = sum;
  for (const Eigen::Vector2f& p : points) sum += p, square += p.cwiseAbs2();
  const float n = float(std::max<size_t>(1, points.size()));
  const Eigen::Vector2f variance = square / n - (sum / n).cwiseAbs2();
  return std::sqrt(double(std::max(0.0f, variance.x())) * double(std::max(0.0f, variance.y())));
}

// Whether the points outside a group agree with the pose, and reach further than it.
bool rest_is_scene(const ReferenceCloud& cloud, const std::vector<Fit>& fits, const std::vector<int>& group) {
  std::vector<bool> is_in(fits.size(), false);
  std::vector<Eigen::Vector2f> own, rest;
  for (int i : group) is_in[size_t(i)] = true, own.push_back(cloud.points[size_t(i)].px);
  int agree = 0, all = 0;
  for (size_t i = 0; i < fits.size(); ++i) {
    if (is_in[i] || fits[i] == Fit::kUnseen) continue;
    ++all;
    if (fits[i] != Fit::kAgrees) continue;
    ++agree;
    rest.push_back(cloud.points[i].px);
  }
  return agree >= kMost * all && agree >= kMinOutside && spread(rest) >= kRestReaches * spread(own);
}

// Edge pixels of the reference image by cell.
std::vector<std::vector<OrientedPixel>> edges_by_cell(const ImageEdges& edges, const Cells& cells) {
  std::vector<std::vector<OrientedPixel>> by_cell(cells.agree.size());
  for (const EdgePixel& e : edges.pixels)
    by_cell[size_t(cells.index(e.position()))].push_back({e.position().cast<double>(), e.normal()});
  return by_cell;
}

std::vector<OrientedPixel> pixels_of(const std::vector<std::vector<OrientedPixel>>& by_cell,
                                     const std::vector<bool>& area) {
  std::vector<OrientedPixel> pixels;
  for (size_t c = 0; c < area.size(); ++c)
    if (area[c]) pixels.insert(pixels.end(), by_cell[c].begin(), by_cell[c].end());
  return pixels;
}

// Adds the cells next to an area whose edges have its motion: points there may still fit by chance.
void grow(const Cells& cells, const std::vector<std::vector<OrientedPixel>>& by_cell,
          const PyramidLevel& finest, const ImageSimilarity& motion, std::vector<bool>* area) {
  std::vector<int> open;
  std::vector<bool> is_visited = *area;
  for (int c = 0; c < int(area->size()); ++c)
    if ((*area)[size_t(c)]) open.push_back(c);
  while (!open.empty()) {
    const int from = open.back();
    open.pop_back();
    cells.around(from, [&](int c) {
      if (is_visited[size_t(c)]) return;
      is_visited[size_t(c)] = true;
      const std::vector<OrientedPixel>& pixels = by_cell[size_t(c)];
      if (int(pixels.size()) < kMinInCell || agreeing_share(finest, pixels, motion) < kSharesMotion) return;
      (*area)[size_t(c)] = true;
      open.push_back(c);
    });
  }
}

std::vector<ImageSimilarity> first_starts(const std::vector<OrientedPixel>& group) {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (const OrientedPixel& p : group) centre += p.px / double(group.size());
  std::vector<ImageSimilarity> starts;
  for (double scale : {1.0, 0.87, 0.75, 0.65, 1.15, 1.35})
    starts.push_back({centre, Eigen::Vector2d::Zero(), scale});
  return starts;
}

// Where the map puts the points of a group, from where its own motion does: the median distance, pixels.
double distance_from_map(const Pinhole& camera, const ReferenceCloud& cloud, const SE3& T_cur_ref,
                         const std::vector<int>& group, const ImageSimilarity& motion) {
  std::vector<double> distances;
  const Eigen::Matrix3d R = T_cur_ref.R();
  for (int i : group) {
    const CloudPoint& c = cloud.points[size_t(i)];
    const Projection p = project(camera, R, T_cur_ref.translation(), c.ray, c.idepth);
    if (p.valid) distances.push_back((p.px - motion(c.px.cast<double>())).norm());
  }
  return distances.empty() ? 0 : median(std::move(distances));
}

double median_idepth(const ReferenceCloud& cloud) {
  std::vector<double> idepths;
  for (const CloudPoint& c : cloud.points) idepths.push_back(c.idepth);
  return median(std::move(idepths));
}

// In one step a vehicle ahead moves as something could that stands still further away: then it is where the
// map puts its points that does not fit. So does a group at a depth that the map has wrong; what follows
// parts them (MovingObjects), and a small error is usual. Where the camera has hardly moved, depths make no
// difference.
bool may_move_by_itself(const Pinhole& camera, const ReferenceCloud& cloud, const SE3& T_cur_ref,
                        const std::vector<int>& group, const std::vector<OrientedPixel>& pixels,
                        const ImageSimilarity& motion, double impossible_px) {
  const StaticComparison c = compare_with_static(camera, T_cur_ref, median_idepth(cloud), pixels, motion);
  const double from_map = distance_from_map(camera, cloud, T_cur_ref, group, motion);
  if (from_map > std::max(impossible_px, kUsualDepthError * c.parallax_px) && c.parallax_px > kImpossiblePx)
    return true;
  return c.is_fixed ? from_map > kSceneMovesPx : c.distance_px > impossible_px;
}

// All that is known about the parts of the view while a group is sought.
struct View {
  const FramePyramid& current;
  const ReferenceCloud& cloud;
  const SE3& T_cur_ref;
  std::vector<Fit> fits;
  Cells cells;
  double impossible_px;  // see find_moving_group()
  // Of the reference image, by cell; empty until a part of the view is worth a look.
  std::vector<std::vector<OrientedPixel>> edges = {};

  // Indices of the points with a fit in the marked cells.
  std::vector<int> points_in(const std::vector<bool>& area) const {
    std::vector<int> points;
    for (size_t i = 0; i < fits.size(); ++i)
      if (fits[i] != Fit::kUnseen && area[size_t(cells.index(cloud.points[i].px))]) points.push_back(int(i));
    return points;
  }
};

// The group in one part of the view; no points if it has no motion of its own.
MovingGroup group_in(std::vector<bool> area, View* seen) {
  View& view = *seen;
  const std::vector<int> points = view.points_in(area);
  if (int(points.size()) < kMinPoints || !rest_is_scene(view.cloud, view.fits, points)) return {};
  if (view.edges.empty()) view.edges = edges_by_cell(view.cloud.pyramid->finest().edges, view.cells);
  const std::vector<OrientedPixel> pixels = pixels_of(view.edges, area);
  if (int(pixels.size()) < kMinEdges) return {};
  const GroupMotion own = align_group(view.current, pixels, first_starts(pixels));
  if (own.share < kMost || own.share - own.chance < kOwnExcess) return {};
  const PyramidLevel& finest = view.current.finest();
  if (!may_move_by_itself(finest.pinhole, view.cloud, view.T_cur_ref, points, pixels, own.motion,
                          view.impossible_px))
    return {};
  grow(view.cells, view.edges, finest, own.motion, &area);
  return {view.points_in(area), pixels_of(view.edges, area), own};
}

}  // namespace

MovingGroup find_moving_group(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& T_cur_ref,
                              const AlignmentParams& params, double impossible_px) {
  View view{current,
            cloud,
            T_cur_ref,
            point_fits(current.finest(), cloud, T_cur_ref, params),
            Cells(current.finest().pinhole),
            impossible_px,
            {}};
  view.cells.count(cloud, view.fits);
  MovingGroup largest;
  for (const std::vector<int>& part : view.cells.parts()) {
    std::vector<bool> area(view.cells.agree.size());
    for (const int c : part) area[size_t(c)] = true;
    MovingGroup group = group_in(std::move(area), &view);
    if (group.points.size() > largest.points.size()) largest = std::move(group);
  }
  return largest;
}

}  // namespace edgevo
