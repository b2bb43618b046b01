// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/texture.h"

#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"

namespace edgevo {
namespace {

bool is_power_of_two(int n) { return n > 0 && (n & (n - 1)) == 0; }

TextureLevel half(const TextureLevel& fine) {
  TextureLevel coarse{fine.width / 2, fine.height / 2, {}, {}};
  coarse.gray.resize(size_t(coarse.width) * coarse.height);
  if (!fine.alpha.empty()) coarse.alpha.resize(coarse.gray.size());
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x) {
      const size_t at = size_t(2 * y) * fine.width + 2 * x;
      const size_t four[4] = {at, at + 1, at + fine.width, at + fine.width + 1};
      int plain = 2, weighted = 0, weight = 0;
      for (size_t i : four) {
        plain += fine.gray[i];
        if (fine.alpha.empty()) continue;
        weighted += fine.alpha[i] * fine.gray[i];
        weight += fine.alpha[i];
      }
      const size_t to = size_t(y) * coarse.width + x;
      coarse.gray[to] = uint8_t(weight > 0 ? (weighted + weight / 2) / weight : plain / 4);
      if (!fine.alpha.empty()) coarse.alpha[to] = uint8_t((weight + 2) / 4);
    }
  return coarse;
}

}  // namespace

Texture make_texture(const GrayImage& gray, const std::vector<uint8_t>& alpha) {
  if (!is_power_of_two(gray.width) || !is_power_of_two(gray.height))
    throw InputError("texture",
                     "its size " + std::to_string(gray.width) + "x" + std::to_string(gray.height) +
                         " is not a power of two",
                     "make it for example 512x512");
  check_pixels(gray, "texture");
  Texture texture;
  texture.levels.push_back({gray.width, gray.height, gray.pixels, alpha});
  while (texture.levels.back().width > 1 && texture.levels.back().height > 1)
    texture.levels.push_back(half(texture.levels.back()));
  return texture;
}

}  // namespace edgevo
