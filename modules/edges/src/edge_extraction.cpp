#include "edgevo/edges/edge_extraction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "edgevo/core/simd.h"

namespace edgevo {
namespace {

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

  // Side neighbours before corner ones at equal turn, smaller turns first; never more than 90 degrees. -1:
  // the edge ends here.
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
  std::vector<Pixel> pixels_;
};

// Pixels that are gathered, then placed, at a time: they stay in the nearest cache.
constexpr int kRun = 256;
constexpr float kLeastCurvature = 1e-3f;  // Sobel units; a flatter parabola has no top to speak of
constexpr float kLeastMagnitude = 1e-3f;  // Sobel units; keeps the division by it finite
// Sobel units, an eighth of a gray level per pixel: no normal to speak of.
constexpr float kFlat = 1.0f;
using Floats = std::array<float, kRun>;

// Gradient at each pixel, and its magnitude there, at the next pixels along the gradient in x, in y and in
// both, and at those behind.
struct Surroundings {
  Floats dx, dy, here, ahead_x, ahead_y, ahead_xy, behind_x, behind_y, behind_xy;
};

struct Places {
  Floats nx, ny, shift;
};

// The maximum of a parabola through the magnitudes at the pixel and one pixel along the normal on both sides,
// at most half a pixel away.
EDGEVO_WIDE_CLONES void place(const Surroundings& s, int count, Places* __restrict out) {
  for (int i = 0; i < count; ++i) {
    const float m = s.here[i], scale = 1.0f / (kGradientSteps * std::max(m, kLeastMagnitude));
    const float nx = s.dx[i] * scale, ny = s.dy[i] * scale, ax = std::abs(nx), ay = std::abs(ny);
    const float ahead_row = m + ax * (s.ahead_x[i] - m),
                ahead_next = s.ahead_y[i] + ax * (s.ahead_xy[i] - s.ahead_y[i]);
    const float behind_row = m + ax * (s.behind_x[i] - m),
                behind_next = s.behind_y[i] + ax * (s.behind_xy[i] - s.behind_y[i]);
    const float ahead = ahead_row + ay * (ahead_next - ahead_row),
                behind = behind_row + ay * (behind_next - behind_row);
    const float curvature = behind - 2.0f * m + ahead;
    const float top = 0.5f * (behind - ahead) /
                      std::min(curvature, -kLeastCurvature);  // a division that never fails needs no branch
    out->nx[i] = nx, out->ny[i] = ny;
    out->shift[i] = curvature < -kLeastCurvature ? std::min(std::max(top, -0.5f), 0.5f) : 0.0f;
  }
}

// Writes edge pixels at `pixels`; their chains are not known here.
class Placement {
 public:
  explicit Placement(const Gradient& gradient) : gradient_(gradient), width_(gradient.magnitude.width()) {}

  void run(const Pixel* pixels, int count, EdgePixel* out) {
    for (int i = 0; i < count; ++i) gather(pixels[i], i);
    place(around_, count, &places_);
    for (int i = 0; i < count; ++i) {
      const float nx = places_.nx[i], ny = places_.ny[i], shift = places_.shift[i];
      out[i] = {float(pixels[i].x) + shift * nx,
                float(pixels[i].y) + shift * ny,
                nx,
                ny,
                around_.here[i] / kSobelPerGrayLevel,
                0};
    }
  }

 private:
  void gather(Pixel p, int i) {
    const int dx = gradient_.dx.at(p.x, p.y), dy = gradient_.dy.at(p.x, p.y);
    const int x = dx > 0 ? 1 : -1, y = dy > 0 ? width_ : -width_;
    const float* m = &gradient_.magnitude.at(p.x, p.y);
    around_.dx[i] = float(dx), around_.dy[i] = float(dy), around_.here[i] = *m;
    around_.ahead_x[i] = m[x], around_.ahead_y[i] = m[y], around_.ahead_xy[i] = m[x + y];
    around_.behind_x[i] = m[-x], around_.behind_y[i] = m[-y], around_.behind_xy[i] = m[-x - y];
  }

  const Gradient& gradient_;
  int width_;
  Surroundings around_;
  Places places_;
};

// Edges as whole pixels, chain by chain.
struct Chains {
  std::vector<Pixel> pixels;
  std::vector<EdgeChain> chains;

  void append(const std::vector<Pixel>& path, const Gradient& gradient) {
    const int begin = int(pixels.size());
    for (const Pixel& p : path)
      if (gradient.magnitude.at(p.x, p.y) >= kFlat)
        pixels.push_back(p);  // a detector other than Canny may mark flat pixels
    chains.push_back({begin, int(pixels.size())});
  }
};

EdgeMap place_all(Chains chains, const Gradient& gradient) {
  EdgeMap map;
  map.width = gradient.magnitude.width();
  map.height = gradient.magnitude.height();
  const int count = int(chains.pixels.size());
  map.pixels.resize(count);
  Placement placement(gradient);
  for (int i = 0; i < count; i += kRun)
    placement.run(&chains.pixels[i], std::min(kRun, count - i), &map.pixels[i]);
  map.chains = std::move(chains.chains);
  for (size_t c = 0; c < map.chains.size(); ++c)
    for (int i = map.chains[c].begin; i < map.chains[c].end; ++i) map.pixels[i].chain = int(c);
  return map;
}

}  // namespace

EdgeMap extract_edges(const Plane<uint8_t>& mask, const Gradient& gradient, int min_chain) {
  if (mask.width() <= 2 * kEdgelessBorder || mask.height() <= 2 * kEdgelessBorder) {
    EdgeMap empty;
    empty.width = mask.width();
    empty.height = mask.height();
    return empty;
  }
  Walker walker(mask);
  Chains chains;
  chains.pixels.reserve(walker.pixels().size());
  std::vector<Pixel> path;
  const auto keep = [&] {
    if (int(path.size()) >= min_chain) chains.append(path, gradient);
    path.clear();
  };
  for (const Pixel& p : walker.pixels()) {
    if (!walker.is_open(p) || !walker.is_end(p)) continue;
    walker.walk(p, &path);
    keep();
  }
  for (const Pixel& p : walker.pixels()) {
    if (!walker.is_open(p)) continue;
    // A closed edge, or what a branch left: walk both ways from here and join the two halves, without p
    // twice.
    walker.walk(p, &path);
    std::reverse(path.begin(), path.end());
    path.pop_back();
    walker.walk(p, &path);
    keep();
  }
  return place_all(std::move(chains), gradient);
}

}  // namespace edgevo
