// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/relight.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"
#include "lighting_effects.h"
#include "sensor_noise.h"

namespace edgevo {
namespace {

// A stream of its own for each effect.
Random stream(uint64_t seed, uint64_t effect) { return Random::derive(seed, 0x72656c69676874 + effect); }

void to_floats(const GrayImage& image, std::vector<float>* gray) {
  gray->assign(image.pixels.begin(), image.pixels.end());
}

}  // namespace

const std::vector<std::string>& relight_kinds() {
  static const std::vector<std::string> kinds{"drift",   "jumps", "gamma", "vignette", "glare", "blooming",
                                              "shadows", "blur",  "noise", "dropped",  "mixed"};
  return kinds;
}

Relight::Relight(const std::string& kind, uint64_t seed) : kind_(kind), seed_(seed) {
  const auto& kinds = relight_kinds();
  if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) return;
  std::string list;
  for (const std::string& k : kinds) list += (list.empty() ? "" : ", ") + k;
  throw InputError("--kind " + kind, "is not a kind of lighting change",
                   "did you mean " + nearest_name(kind, kinds) + "? known are " + list);
}

bool Relight::has(const char* effect) const {
  const std::string e = effect;
  return kind_ == e || (kind_ == "mixed" && e != "blur" && e != "dropped");
}

bool Relight::drops(int index) const {
  // Never the first frame, so that the sequence begins with its ground truth.
  return has("dropped") && index > 0 && Random::derive(seed_, 0x64726f70 + uint64_t(index)).below(12) == 0;
}

GrayImage Relight::apply(const GrayImage& image, int index, double seconds) const {
  check_pixels(image, "Relight::apply()");
  const double share = kind_ == "mixed" ? 0.6 : 1;
  LitImage lit{image.width, image.height, {}};
  to_floats(image, &lit.gray);
  // In the order of the light path: scene, lens, sensor.
  if (has("shadows")) sweep_shadows(stream(seed_, 1), seconds, &lit);
  if (has("blur")) blur_along_motion(stream(seed_, 2), seconds, &lit);
  if (has("vignette")) vignette(share, &lit);
  if (has("glare")) add_glare(stream(seed_, 3), seconds, share, &lit);
  if (has("drift")) drift_gain(stream(seed_, 4), seconds, share, &lit);
  if (has("jumps")) jump_exposure(stream(seed_, 5), seconds, share, &lit);
  if (has("blooming")) bloom_highlights(&lit);
  if (has("gamma")) bend_response(stream(seed_, 6), seconds, share, &lit);
  return {image.width, image.height,
          with_sensor_noise(lit.gray, has("noise") ? 8 * share * share : 0, seed_ + 1, index)};
}

}  // namespace edgevo
