// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/edge_links.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace edgevo {
namespace {

// Eight neighbours by angle; even entries share a side, odd ones a corner.
constexpr std::array<MaskPixel, 8> kStep{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

// Bit of kStep[d] in a set of neighbours: they are read by rows.
constexpr std::array<int, 8> kBit{5, 8, 7, 6, 3, 0, 1, 2};

// Whether a set of open neighbours is that of an end of an edge: one neighbour, or two that touch each other.
constexpr std::array<bool, 512> make_end_table() {
  std::array<bool, 512> is_end{};
  for (int set = 0; set < 512; ++set) {
    int runs = 0, count = 0;
    for (int d = 0; d < 8; ++d) {
      const bool now = set >> kBit[d] & 1, previous = set >> kBit[(d + 7) & 7] & 1;
      count += now;
      runs += now && !previous;
    }
    is_end[set] = count > 0 && count < 3 && runs == 1;
  }
  return is_end;
}
constexpr std::array<bool, 512> kIsEnd = make_end_table();

// Edge mask, of 0 and 1, from which walked pixels are erased.
class Walker {
 public:
  explicit Walker(const Plane<uint8_t>& mask) : open_(mask.width(), mask.height()) {
    const int width = mask.width(), height = mask.height();
    std::transform(mask.row(0), mask.row(0) + size_t(width) * height, open_.row(0),
                   [](uint8_t mark) { return uint8_t(mark != 0); });
    for (int y = 0; y < height; ++y) {
      uint8_t* row = open_.row(y);
      if (y < kEdgelessBorder || y >= height - kEdgelessBorder) {
        std::fill_n(row, width, uint8_t(0));
        continue;
      }
      std::fill_n(row, kEdgelessBorder, uint8_t(0));
      std::fill_n(row + width - kEdgelessBorder, kEdgelessBorder, uint8_t(0));
      list_edges(row, y, width);
    }
    for (int d = 0; d < 8; ++d) offset_[d] = kStep[d].y * width + kStep[d].x;
  }

  const std::vector<MaskPixel>& pixels() const { return pixels_; }
  bool is_open(MaskPixel p) const { return open_.at(p.x, p.y) != 0; }

  bool is_end(MaskPixel p) const {
    const uint8_t* at = &open_.at(p.x, p.y);
    const int width = open_.width();
    return kIsEnd[size_t(three(at - width - 1) | three(at - 1) << 3 | three(at + width - 1) << 6)];
  }

  // Follows the edge from p, erases it, and appends it to `path`.
  void walk(MaskPixel p, std::vector<MaskPixel>* path) {
    uint8_t* at = &open_.at(p.x, p.y);
    for (int heading = -1;;) {
      *at = 0;
      path->push_back(p);
      heading = next_direction(at, heading);
      if (heading < 0) return;
      strike_shoulders(at, heading);
      at += offset_[heading];
      p.x += kStep[heading].x, p.y += kStep[heading].y;
    }
  }

 private:
  // Three neighbours in a row as bits.
  static int three(const uint8_t* first) { return first[0] | first[1] << 1 | first[2] << 2; }

  // Most of a row is empty, so eight pixels are tested at a time.
  void list_edges(const uint8_t* row, int y, int width) {
    int x = 0;
    for (; x + 8 <= width; x += 8) {
      uint64_t eight;
      std::memcpy(&eight, row + x, 8);
      for (; eight != 0; eight &= eight - 1) pixels_.push_back({x + __builtin_ctzll(eight) / 8, y});
    }
    for (; x < width; ++x)
      if (row[x]) pixels_.push_back({x, y});
  }

  // Next direction: smaller turns first, at equal turns side neighbours before corner ones, never more than
  // 90 degrees; -1 at the end of the edge.
  int next_direction(const uint8_t* at, int heading) const {
    static constexpr std::array<int, 5> kTurns{0, 1, -1, 2, -2};  // of 45 degrees
    if (heading >= 0) {
      for (int turn : kTurns)
        if (at[offset_[(heading + turn) & 7]]) return (heading + turn) & 7;
      return -1;
    }
    for (int d : {0, 2, 4, 6, 1, 3, 5, 7})
      if (at[offset_[d]]) return d;
    return -1;
  }

  // A corner step passes between two pixels that share a side with both ends: they belong to the same thick
  // line.
  void strike_shoulders(uint8_t* at, int d) const {
    if (d % 2 == 1) at[offset_[(d + 1) & 7]] = at[offset_[d - 1]] = 0;
  }

  Plane<uint8_t> open_;
  std::array<int, 8> offset_;  // of kStep in the mask
  std::vector<MaskPixel> pixels_;
};

}  // namespace

PixelChains link_edges(const Plane<uint8_t>& mask, int min_chain) {
  PixelChains found;
  if (mask.width() <= 2 * kEdgelessBorder || mask.height() <= 2 * kEdgelessBorder) return found;
  Walker walker(mask);
  found.pixels.reserve(walker.pixels().size());
  std::vector<MaskPixel> path;
  const auto keep = [&] {
    if (int(path.size()) >= min_chain) found.append(path);
    path.clear();
  };
  for (const MaskPixel& p : walker.pixels()) {
    if (!walker.is_open(p) || !walker.is_end(p)) continue;
    walker.walk(p, &path);
    keep();
  }
  for (const MaskPixel& p : walker.pixels()) {
    if (!walker.is_open(p)) continue;
    // A closed edge, or the remainder of a branch: walk in both directions and join the two halves, with p
    // only once.
    walker.walk(p, &path);
    std::reverse(path.begin(), path.end());
    path.pop_back();
    walker.walk(p, &path);
    keep();
  }
  return found;
}

}  // namespace edgevo
