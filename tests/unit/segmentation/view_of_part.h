// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Views of a scene of random blocks, before which something may be fixed to the camera, or cross.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include "edgevo/core/random.h"
#include "support/masked_builder.h"
#include "support/test_images.h"

namespace edgevo::test {

inline constexpr int kPartWidth = 480, kPartHeight = 320;

// Blocks of random gray, 9 pixels wide.
inline double random_blocks(double x, double y, uint64_t seed) {
  const auto cell = [](double v) { return uint64_t(int64_t(std::floor(v / 9)) + 100000); };
  return 40 + 170 * Random::derive(seed, cell(x) * 1000003 + cell(y)).uniform();
}

// Those of image i before a camera that backs off and turns.
inline double receding_blocks(double x, double y, int i) {
  const double size = 1.5 / (1 + 0.01 * i);
  return random_blocks((x + 3 * i) / size, (y + 1.3 * i) / size, 1);
}

inline bool on_part(double x, double y) { return x > 170 && x < 330 && y > 210; }

inline Camera part_camera() {
  return Camera(Pinhole{400, 400, kPartWidth / 2.0, kPartHeight / 2.0, kPartWidth, kPartHeight});
}

// A scene that has moved by (x, y), with noise, behind what `body` paints; nothing: the scene.
using Body = std::function<std::optional<double>(double x, double y)>;
inline GrayImage part_view(double x, double y, const Body& body, uint64_t seed) {
  GrayImage image = make_image(kPartWidth, kPartHeight, [&](double u, double v) {
    const std::optional<double> gray = body(u, v);
    return gray ? *gray : random_blocks(u + x, v + y, 1);
  });
  Random noise(seed);
  for (uint8_t& p : image.pixels) p = uint8_t(std::clamp(p + 1.5 * noise.normal(), 0.0, 255.0));
  return image;
}

inline std::optional<double> no_body(double, double) { return std::nullopt; }
inline std::optional<double> gripper(double x, double y) {
  if (!on_part(x, y)) return std::nullopt;
  return random_blocks(x, y, 2);
}

// The pyramid of the last of the images.
inline std::shared_ptr<const FramePyramid> show(MaskedBuilder* builder, int images, double x_step,
                                                double y_step, const Body& body, int first = 0) {
  std::shared_ptr<const FramePyramid> pyramid;
  for (int i = first; i < first + images; ++i)
    pyramid = builder->build(part_view(i * x_step, i * y_step, body, uint64_t(i + 1)));
  return pyramid;
}

}  // namespace edgevo::test
