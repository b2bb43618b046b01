// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/places/remembered_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "differing_bits.h"

namespace edgevo {
namespace {

// 400 corners over the view, the strongest two of each cell: crowded ones show one thing.
constexpr int kCellsAcross = 20, kCellsDown = 10, kInCell = 2;
// Found at first: dark views have weak corners, which the cells choose among.
constexpr int kFound = 1500, kFastThreshold = 5;
constexpr int kPyramidLevels = 4;
// Radius of the nearest-neighbour field, pixels of the level: what a pose by corners is off by.
constexpr int kFieldRadius = 12;
constexpr float kPerPixel = 16;
constexpr double kPerTurn = 256 / (2 * M_PI);

// Index of the cell of a grid over the image.
int cell_of(const cv::Point2f& px, const cv::Size& image, int columns, int rows) {
  const int column = std::clamp(int(px.x * float(columns) / float(image.width)), 0, columns - 1),
            row = std::clamp(int(px.y * float(rows) / float(image.height)), 0, rows - 1);
  return row * columns + column;
}

std::vector<cv::KeyPoint> strongest_of_cells(std::vector<cv::KeyPoint> found, const cv::Size& image) {
  std::stable_sort(found.begin(), found.end(),
                   [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.response > b.response; });
  std::vector<int> taken(kCellsAcross * kCellsDown, 0);
  std::vector<cv::KeyPoint> kept;
  for (const cv::KeyPoint& k : found)
    if (taken[size_t(cell_of(k.pt, image, kCellsAcross, kCellsDown))]++ < kInCell) kept.push_back(k);
  return kept;
}

ViewCorners find_corners(const FramePyramid& pyramid) {
  const Plane<uint8_t>& gray = pyramid.finest().gray;
  const cv::Mat image(gray.height(), gray.width(), CV_8U, const_cast<uint8_t*>(gray.row(0)));
  const cv::Ptr<cv::ORB> orb =
      cv::ORB::create(kFound, 1.2F, kPyramidLevels, 19, 0, 2, cv::ORB::FAST_SCORE, 31, kFastThreshold);
  std::vector<cv::KeyPoint> found;
  orb->detect(image, found);
  const auto is_ego = [&](const cv::KeyPoint& k) { return pyramid.is_ego(k.pt.x, k.pt.y); };
  found.erase(std::remove_if(found.begin(), found.end(), is_ego), found.end());
  found = strongest_of_cells(std::move(found), image.size());
  for (cv::KeyPoint& k : found) k.angle = 0;  // upright
  ViewCorners corners;
  cv::Mat descriptors;
  orb->compute(image, found, descriptors);
  corners.descriptors.resize(found.size());
  for (int i = 0; i < descriptors.rows; ++i)
    std::copy_n(descriptors.ptr(i), sizeof(CornerDescriptor), corners.descriptors[size_t(i)].data());
  for (const cv::KeyPoint& k : found) corners.px.emplace_back(k.pt.x, k.pt.y);
  return corners;
}

// Beyond 4095 pixels, of a level that is not halved, edges are as at the border.
uint16_t in_sixteenths(float x) {
  return uint16_t(std::clamp<long>(std::lround(x * kPerPixel), 0, std::numeric_limits<uint16_t>::max()));
}

PackedEdges pack(const PyramidLevel& level) {
  PackedEdges packed;
  packed.pinhole = level.pinhole;
  for (const EdgeChain& chain : level.edges.chains) packed.begins.push_back(chain.begin);
  for (const EdgePixel& p : level.edges.pixels) {
    packed.at.push_back({in_sixteenths(p.x), in_sixteenths(p.y)});
    packed.normal.push_back(uint8_t(std::lround(std::atan2(p.ny, p.nx) * kPerTurn) & 255));
  }
  return packed;
}

// Directions of the edges of each cell, as counts.
using Counts =
    std::array<float, size_t(ViewSignature::kColumns* ViewSignature::kRows* ViewSignature::kDirections)>;
Counts count_directions(const ImageEdges& edges) {
  Counts counts{};
  const cv::Size image(edges.width, edges.height);
  for (const EdgePixel& p : edges.pixels) {
    const double turn = std::atan2(p.ny, p.nx) / M_PI + 1;  // 0 to 2, unsigned: the same after half a turn
    const int direction = int(turn * ViewSignature::kDirections) % ViewSignature::kDirections;
    const int cell = cell_of({p.x, p.y}, image, ViewSignature::kColumns, ViewSignature::kRows);
    counts[size_t(cell * ViewSignature::kDirections + direction)] += 1;
  }
  return counts;
}

ViewSignature sign(const ImageEdges& edges) {
  const Counts counts = count_directions(edges);
  std::array<float, ViewSignature::kDirections> mean{};
  for (size_t i = 0; i < counts.size(); ++i)
    mean[i % mean.size()] += counts[i] / (ViewSignature::kColumns * ViewSignature::kRows);
  ViewSignature signature;
  for (size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > mean[i % mean.size()]) signature.bits[i / 64] |= uint64_t(1) << (i % 64);
  return signature;
}

ViewLight light_of(const Plane<uint8_t>& gray) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(cv::Mat(gray.height(), gray.width(), CV_8U, const_cast<uint8_t*>(gray.row(0))), mean,
                 deviation);
  return {float(mean[0]), float(deviation[0])};
}

// The level below the finest, if it has edges.
const PyramidLevel& coarse_level(const FramePyramid& pyramid) {
  const bool has_edges = pyramid.levels.size() > 1 && !pyramid.levels[1].edges.pixels.empty();
  return pyramid.levels[has_edges ? 1 : 0];
}

}  // namespace

int distance(const ViewSignature& a, const ViewSignature& b) { return differing_bits(a.bits, b.bits); }

RememberedView remember_view(const FramePyramid& pyramid) {
  const PyramidLevel& level = coarse_level(pyramid);
  return {find_corners(pyramid), pack(level), sign(level.edges), light_of(pyramid.finest().gray)};
}

FramePyramid unpack(const PackedEdges& packed) {
  FramePyramid pyramid;
  PyramidLevel& level = pyramid.levels.emplace_back();
  level.pinhole = packed.pinhole;
  level.edges.width = packed.pinhole.width, level.edges.height = packed.pinhole.height;
  for (size_t c = 0; c < packed.begins.size(); ++c) {
    const int end = c + 1 < packed.begins.size() ? packed.begins[c + 1] : int(packed.at.size());
    level.edges.chains.push_back({packed.begins[c], end});
    for (int i = packed.begins[c]; i < end; ++i) {
      const double angle = packed.normal[size_t(i)] / kPerTurn;
      level.edges.pixels.push_back({float(packed.at[size_t(i)][0]) / kPerPixel,
                                    float(packed.at[size_t(i)][1]) / kPerPixel, float(std::cos(angle)),
                                    float(std::sin(angle)), 0, int(c)});
    }
  }
  level.field = NearestField(level.edges, kFieldRadius);
  return pyramid;
}

}  // namespace edgevo
