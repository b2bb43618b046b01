#include "edgevo/edges/edge_extraction.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace edgevo {
namespace {

constexpr int kBorder = 2;
// Eight neighbours by angle; even entries share a side, odd ones a corner.
constexpr std::array<std::pair<int, int>, 8> kStep{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

// Edge mask in which walked pixels are struck out.
class Walker {
 public:
  explicit Walker(const Plane<uint8_t>& mask) : open_(mask.width(), mask.height()) {
    for (int y = 0; y < mask.height(); ++y) {
      const uint8_t* from = mask.row(y);
      uint8_t* to = open_.row(y);
      const bool inside = y >= kBorder && y < mask.height() - kBorder;
      for (int x = 0; x < mask.width(); ++x) to[x] = inside && from[x];
      for (int x = 0; x < std::min(kBorder, mask.width()); ++x) to[x] = to[mask.width() - 1 - x] = 0;
      if (inside)
        for (int x = kBorder; x < mask.width() - kBorder; ++x)
          if (to[x]) pixels_.emplace_back(x, y);
    }
  }

  const std::vector<std::pair<int, int>>& pixels() const { return pixels_; }
  bool is_open(int x, int y) const { return open_.at(x, y); }

  // An end has one neighbour, or two that touch each other.
  bool is_end(int x, int y) const {
    int runs = 0, count = 0;
    bool previous = is_neighbour(x, y, 7);
    for (int d = 0; d < 8; ++d) {
      const bool now = is_neighbour(x, y, d);
      count += now;
      runs += now && !previous;
      previous = now;
    }
    return count > 0 && count < 3 && runs == 1;
  }

  // Follows the edge from (x, y), striking it out; `heading` is the direction of arrival, -1 if none.
  std::vector<std::pair<int, int>> walk(int x, int y, int heading) {
    std::vector<std::pair<int, int>> path;
    for (;;) {
      open_.at(x, y) = 0;
      path.emplace_back(x, y);
      const int d = next_direction(x, y, heading);
      if (d < 0) return path;
      strike_shoulders(x, y, d);
      x += kStep[d].first, y += kStep[d].second, heading = d;
    }
  }

 private:
  bool is_neighbour(int x, int y, int d) const { return open_.at(x + kStep[d].first, y + kStep[d].second); }

  // Side neighbours before corner ones at equal turn, smaller turns first; never more than 90 degrees.
  int next_direction(int x, int y, int heading) const {
    static constexpr std::array<int, 5> kTurns{0, 1, -1, 2, -2};
    if (heading >= 0) {
      for (int turn : kTurns)
        if (is_neighbour(x, y, (heading + turn) & 7)) return (heading + turn) & 7;
      return -1;
    }
    for (int d : {0, 2, 4, 6, 1, 3, 5, 7})
      if (is_neighbour(x, y, d)) return d;
    return -1;
  }

  // A corner step passes between two pixels that share a side with both ends: they belong to the same thick line.
  void strike_shoulders(int x, int y, int d) {
    if (d % 2 == 1) {
      const auto strike = [&](int e) { open_.at(x + kStep[e & 7].first, y + kStep[e & 7].second) = 0; };
      strike(d + 1);
      strike(d - 1);
    }
  }

  Plane<uint8_t> open_;
  std::vector<std::pair<int, int>> pixels_;
};

EdgePixel locate(int x, int y, const Gradient& g) {
  const float m0 = std::max(g.magnitude.at(x, y), 1e-3f);
  EdgePixel e;
  e.nx = float(g.dx.at(x, y)) / m0;
  e.ny = float(g.dy.at(x, y)) / m0;
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

void append_chain(const std::vector<std::pair<int, int>>& path, const Gradient& gradient, EdgeMap* map) {
  const int chain = int(map->chains.size());
  const int begin = int(map->pixels.size());
  for (const auto& [x, y] : path) {
    if (gradient.magnitude.at(x, y) < 1.0f) continue;  // a detector other than Canny may mark flat pixels
    map->pixels.push_back(locate(x, y, gradient));
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
  const auto keep = [&](const std::vector<std::pair<int, int>>& path) {
    if (int(path.size()) >= min_chain) append_chain(path, gradient, &map);
  };
  for (const auto& [x, y] : walker.pixels())
    if (walker.is_open(x, y) && walker.is_end(x, y)) keep(walker.walk(x, y, -1));
  for (const auto& [x, y] : walker.pixels()) {
    if (!walker.is_open(x, y)) continue;
    // A closed edge, or what a branch left: walk both ways from here and join the two halves.
    std::vector<std::pair<int, int>> forward = walker.walk(x, y, -1);
    std::vector<std::pair<int, int>> backward = walker.walk(x, y, -1);
    std::reverse(backward.begin(), backward.end());
    backward.pop_back();  // (x, y) itself, walked twice
    backward.insert(backward.end(), forward.begin(), forward.end());
    keep(backward);
  }
  return map;
}

}  // namespace edgevo
