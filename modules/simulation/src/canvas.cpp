// SPDX-License-Identifier: BSD-3-Clause
#include "canvas.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

int wrap(int i, int n) { return ((i % n) + n) % n; }

// Length of the overlap of [a, b) with texel i.
float overlap(double a, double b, int i) {
  return float(std::clamp(std::min(b, i + 1.0) - std::max(a, double(i)), 0.0, 1.0));
}

// Smooth lattice noise in [-1, 1]: one octave, added to the board.
void add_octave(Random& random, int cells_x, int cells_y, float amplitude, int width, int height,
                float* gray) {
  std::vector<float> lattice(size_t(cells_x) * cells_y);
  for (float& value : lattice) value = amplitude * float(random.uniform(-1, 1));
  std::vector<int> left(static_cast<size_t>(width)), right(static_cast<size_t>(width));
  std::vector<float> share(static_cast<size_t>(width));
  const auto ease = [](float t) { return t * t * (3 - 2 * t); };
  for (int x = 0; x < width; ++x) {
    const float c = (float(x) + 0.5f) * float(cells_x) / float(width);
    left[size_t(x)] = int(c), right[size_t(x)] = (int(c) + 1) % cells_x;
    share[size_t(x)] = ease(c - std::floor(c));
  }
  std::vector<float> line(static_cast<size_t>(cells_x));
  for (int y = 0; y < height; ++y) {
    const float c = (float(y) + 0.5f) * float(cells_y) / float(height);
    const float t = ease(c - std::floor(c));
    const float* upper = &lattice[size_t(int(c)) * cells_x];
    const float* lower = &lattice[size_t((int(c) + 1) % cells_y) * cells_x];
    for (int i = 0; i < cells_x; ++i) line[size_t(i)] = upper[i] + t * (lower[i] - upper[i]);
    float* row = gray + size_t(y) * width;
    for (int x = 0; x < width; ++x) {
      const float a = line[size_t(left[size_t(x)])], b = line[size_t(right[size_t(x)])];
      row[x] += a + share[size_t(x)] * (b - a);
    }
  }
}

}  // namespace

Canvas::Canvas(int width, int height, float gray)
    : width_(width), height_(height), gray_(size_t(width) * height, gray) {}

void Canvas::cut_out() { cover_.assign(gray_.size(), 0); }

void Canvas::cut_where(const std::function<bool(double, double)>& removed) {
  if (cover_.empty()) cover_.assign(gray_.size(), 1);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      int inside = 0;  // of four points, for a smooth rim
      for (int k = 0; k < 4; ++k) inside += removed(x + 0.25 + 0.5 * (k & 1), y + 0.25 + 0.5 * (k >> 1));
      cover_[size_t(y) * width_ + x] *= 1 - 0.25f * float(inside);
    }
}

void Canvas::blend(int x, int y, float gray, float opacity) {
  const size_t i = size_t(wrap(y, height_)) * width_ + wrap(x, width_);
  gray_[i] += opacity * (gray - gray_[i]);
  if (!cover_.empty()) cover_[i] = std::min(1.0f, cover_[i] + opacity);
}

void Canvas::rect(double x0, double y0, double x1, double y1, float gray, float opacity) {
  for (int y = int(std::floor(y0)); y < y1; ++y)
    for (int x = int(std::floor(x0)); x < x1; ++x)
      blend(x, y, gray, opacity * overlap(x0, x1, x) * overlap(y0, y1, y));
}

void Canvas::panel(double x0, double y0, double x1, double y1, float gray, double rim, float relief) {
  rect(x0, y0, x1, y1, gray);
  rect(x0, y0, x1, y0 + rim, gray + relief);
  rect(x0, y0, x0 + rim, y1, gray + relief);
  rect(x0, y1 - rim, x1, y1, gray - relief);
  rect(x1 - rim, y0, x1, y1, gray - relief);
}

void Canvas::ellipse(double cx, double cy, double a, double b, double angle, float gray, float opacity) {
  const double c = std::cos(angle), s = std::sin(angle), reach = std::max(a, b) + 1;
  for (int y = int(std::floor(cy - reach)); y <= cy + reach; ++y)
    for (int x = int(std::floor(cx - reach)); x <= cx + reach; ++x) {
      const double dx = x + 0.5 - cx, dy = y + 0.5 - cy;
      const double u = (c * dx + s * dy) / a, v = (-s * dx + c * dy) / b;
      // Texels within the outline.
      const double inside = (1 - std::sqrt(u * u + v * v)) * std::min(a, b) + 0.5;
      if (inside > 0) blend(x, y, gray, opacity * float(std::min(inside, 1.0)));
    }
}

void Canvas::line(double x0, double y0, double x1, double y1, double width, float gray, float opacity) {
  const double dx = x1 - x0, dy = y1 - y0, length2 = std::max(1e-9, dx * dx + dy * dy),
               reach = 0.5 * width + 1;
  for (int y = int(std::floor(std::min(y0, y1) - reach)); y <= std::max(y0, y1) + reach; ++y)
    for (int x = int(std::floor(std::min(x0, x1) - reach)); x <= std::max(x0, x1) + reach; ++x) {
      const double t = std::clamp(((x + 0.5 - x0) * dx + (y + 0.5 - y0) * dy) / length2, 0.0, 1.0);
      const double inside = 0.5 * width + 0.5 - std::hypot(x + 0.5 - x0 - t * dx, y + 0.5 - y0 - t * dy);
      if (inside > 0) blend(x, y, gray, opacity * float(std::min(inside, 1.0)));
    }
}

void Canvas::noise(Random& random, int cells, int octaves, float amplitude, float gain, int elongation) {
  float total = 0, weight = 1;
  for (int o = 0; o < octaves; ++o, weight *= gain) total += weight;
  weight = amplitude / total;
  for (int o = 0; o < octaves && (cells << o) <= width_; ++o, weight *= gain) {
    const int across = cells << o;
    const int down = std::max(1, across * height_ / width_ / elongation);
    add_octave(random, across, down, weight, width_, height_, gray_.data());
  }
}

void Canvas::grain(Random& random, float amplitude) {
  for (float& g : gray_) g += amplitude * float(random.uniform(-1, 1));
}

void Canvas::fade(float top, float bottom) {
  for (int y = 0; y < height_; ++y) {
    const float factor = top + (bottom - top) * (float(y) + 0.5f) / float(height_);
    for (int x = 0; x < width_; ++x) at(x, y) *= factor;
  }
}

Texture Canvas::texture() const {
  GrayImage image{width_, height_, std::vector<uint8_t>(gray_.size())};
  std::vector<uint8_t> alpha(cover_.size());
  for (size_t i = 0; i < gray_.size(); ++i)
    image.pixels[i] = uint8_t(std::clamp(gray_[i], 0.0f, 255.0f) + 0.5f);
  for (size_t i = 0; i < cover_.size(); ++i)
    alpha[i] = uint8_t(std::clamp(cover_[i], 0.0f, 1.0f) * 255 + 0.5f);
  return make_texture(image, alpha);
}

void write_text(Canvas* canvas, Random& random, double x0, double y0, double x1, double y1, double line,
                float ink) {
  for (double y = y0; y + line <= y1; y += line * 1.6) {
    const double end = random.uniform() < 0.2 ? x0 + (x1 - x0) * random.uniform(0.3, 0.8) : x1;
    double x = x0;
    while (x < end) {
      if (random.uniform() < 0.17) {  // space between two words
        x += 0.45 * line;
        continue;
      }
      const double w = line * random.uniform(0.3, 0.55), stem = 0.14 * line;
      if (x + w > end) break;
      const double top = random.uniform() < 0.35 ? y : y + 0.3 * line;  // with or without ascender
      canvas->line(x + stem, top, x + stem, y + line, stem, ink);
      if (random.uniform() < 0.7)
        canvas->line(x + w - stem, y + 0.3 * line, x + w - stem, y + line, stem, ink);
      const int bar = random.below(3);
      canvas->line(x + stem,
                   y + line * (bar == 0   ? 0.35
                               : bar == 1 ? 0.65
                                          : 0.95),
                   x + w - stem,
                   y + line * (bar == 0   ? 0.35
                               : bar == 1 ? 0.65
                                          : 0.95),
                   stem, ink);
      x += w + 0.12 * line;
    }
  }
}

}  // namespace edgevo
