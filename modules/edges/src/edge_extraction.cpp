#include "edgevo/edges/edge_extraction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace edgevo {
namespace {

constexpr int kBorder = 2;

struct Pixel {
  int x, y;
};
// Eight neighbours by angle; even entries share a side, odd ones a corner.
constexpr std::array<Pixel, 8> kStep{{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

// By the set of open neighbours, bit d for kStep[d]: an end of an edge has one, or two that touch each other.
std::array<bool, 256> make_end_table() {
  std::array<bool, 256> is_end{};
  for (int set = 0; set < 256; ++set) {
    int runs = 0, count = 0;
    for (int d = 0; d < 8; ++d) {
      const bool now = set >> d & 1, previous = set >> ((d + 7) & 7) & 1;
      count += now;
      runs += now && !previous;
    }
    is_end[set] = count > 0 && count < 3 && runs == 1;
  }
  return is_end;
}

// Edge mask in which walked pixels are struck out.
class Walker {
 public:
  explicit Walker(const Plane<uint8_t>& mask) : open_(mask.width(), mask.height()) {
    const int width = mask.width(), height = mask.height();
    std::copy_n(mask.row(0), size_t(width) * height, open_.row(0));
    for (int y = 0; y < height; ++y) {
      uint8_t* row = open_.row(y);
      if (y < kBorder || y >= height - kBorder) {
        std::fill_n(row, width, uint8_t(0));
        continue;
      }
      row[0] = row[1] = row[width - 2] = row[width - 1] = 0;
      list_edges(row, y, width);
    }
    for (int d = 0; d < 8; ++d) offset_[d] = kStep[d].y * width + kStep[d].x;
  }

  const std::vector<Pixel>& pixels() const { return pixels_; }
  bool is_open(Pixel p) const { return open_.at(p.x, p.y) != 0; }

  bool is_end(Pixel p) const {
    static const std::array<bool, 256> table = make_end_table();
    const uint8_t* at = &open_.at(p.x, p.y);
    int set = 0;
    for (int d = 0; d < 8; ++d) set |= int(at[offset_[d]] != 0) << d;
    return table[set];
  }

  // Follows the edge from p, striking it out, and appends it to `path`.
  void walk(Pixel p, std::vector<Pixel>* path) {
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
  // Most of a row is empty: eight pixels at a time.
  void list_edges(const uint8_t* row, int y, int width) {
    int x = 0;
    for (; x + 8 <= width; x += 8) {
      uint64_t eight;
      std::memcpy(&eight, row + x, 8);
      if (eight == 0) continue;
      for (int i = x; i < x + 8; ++i)
        if (row[i]) pixels_.push_back({i, y});
    }
    for (; x < width; ++x)
      if (row[x]) pixels_.push_back({x, y});
  }

  // Side neighbours before corner ones at equal turn, smaller turns first; never more than 90 degrees. -1: the edge ends here.
  int next_direction(const uint8_t* at, int heading) const {
    static constexpr std::array<int, 5> kTurns{0, 1, -1, 2, -2};
    if (heading >= 0) {
      for (int turn : kTurns)
        if (at[offset_[(heading + turn) & 7]]) return (heading + turn) & 7;
      return -1;
    }
    for (int d : {0, 2, 4, 6, 1, 3, 5, 7})
      if (at[offset_[d]]) return d;
    return -1;
  }

  // A corner step passes between two pixels that share a side with both ends: they belong to the same thick line.
  void strike_shoulders(uint8_t* at, int d) const {
    if (d % 2 == 1) at[offset_[(d + 1) & 7]] = at[offset_[d - 1]] = 0;
  }

  Plane<uint8_t> open_;
  std::array<int, 8> offset_;  // of kStep in the mask
  std::vector<Pixel> pixels_;
};

EdgePixel locate(int x, int y, const Gradient& g) {
  const float m0 = std::max(g.magnitude.at(x, y), 1e-3f);
  EdgePixel e;
  e.nx = float(g.dx.at(x, y)) / (kGradientSteps * m0);
  e.ny = float(g.dy.at(x, y)) / (kGradientSteps * m0);
  const ImageView<float> m = g.magnitude.view();
  const float before = bilinear(m, float(x) - e.nx, float(y) - e.ny);
  const float after = bilinear(m, float(x) + e.nx, float(y) + e.ny);
  const float curvature = before - 2.0f * m0 + after;
  const float shift = curvature < -1e-3f ? std::clamp(0.5f * (before - after) / curvature, -0.5f, 0.5f) : 0.0f;
  e.x = float(x) + shift * e.nx;
  e.y = float(y) + shift * e.ny;
  e.strength = m0 / kSobelPerGrayLevel;
  return e;
}

void append_chain(const std::vector<Pixel>& path, const Gradient& gradient, EdgeMap* map) {
  const int chain = int(map->chains.size());
  const int begin = int(map->pixels.size());
  for (const Pixel& p : path) {
    if (gradient.magnitude.at(p.x, p.y) < 1.0f) continue;  // a detector other than Canny may mark flat pixels
    map->pixels.push_back(locate(p.x, p.y, gradient));
    map->pixels.back().chain = chain;
  }
  map->chains.push_back({begin, int(map->pixels.size())});
}

}  // namespace

EdgeMap extract_edges(const Plane<uint8_t>& mask, const Gradient& gradient, int min_chain) {
  EdgeMap map;
  map.width = mask.width();
  map.height = mask.height();
  if (map.width <= 2 * kBorder || map.height <= 2 * kBorder) return map;
  Walker walker(mask);
  map.pixels.reserve(walker.pixels().size());
  std::vector<Pixel> path;
  const auto keep = [&] {
    if (int(path.size()) >= min_chain) append_chain(path, gradient, &map);
    path.clear();
  };
  for (const Pixel& p : walker.pixels()) {
    if (!walker.is_open(p) || !walker.is_end(p)) continue;
    walker.walk(p, &path);
    keep();
  }
  for (const Pixel& p : walker.pixels()) {
    if (!walker.is_open(p)) continue;
    // A closed edge, or what a branch left: walk both ways from here and join the two halves, without p twice.
    walker.walk(p, &path);
    std::reverse(path.begin(), path.end());
    path.pop_back();
    walker.walk(p, &path);
    keep();
  }
  return map;
}

}  // namespace edgevo
