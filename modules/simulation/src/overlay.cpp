// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/overlay.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"
#include "foreign_bodies.h"
#include "sensor_noise.h"

namespace edgevo {
namespace {

constexpr double kUsualWidth = 1241;        // of the images that sizes in pixels are for
constexpr double kBodyNoise = 1.5;          // gray levels
constexpr double kStandingNoise = 2.0;      // gray levels
constexpr double kAspect = 2.0;             // width over height of gripper and plain part
constexpr double kFirstVehicleShare = 0.1;  // of its width at its nearest
constexpr double kAppears = 3, kCatchUp = 4, kFollows = 2, kPullsAway = 4;  // seconds
constexpr double kFocal = 718.856;                                          // of a width of 1241
constexpr double kHorizon = 0.48;                                           // of the height of the image
// Vehicles that pass: metres to the left of the camera, below it, wide and high; when they are drawn.
constexpr double kToTheLeft = 3, kBelow = 1.65, kWide = 2.5, kNearest = 2, kFarthest = 80;
constexpr double kShade = 0.55;     // of the light is left in a shadow
constexpr double kSoft = 2;         // pixels over which it begins
constexpr double kReflected = 0.3;  // of the sky and houses by a bonnet

Random body_stream(uint64_t seed, uint64_t body) { return Random::derive(seed, 0x6f7665726c6179 + body); }

// Gray and cover (0 to 1) of a texture at (u, v), texels of level 0; `scale` is the texels per pixel.
struct BodySample {
  float gray, cover;
};

BodySample sample_body(const Texture& texture, double u, double v, double scale) {
  const int last = int(texture.levels.size()) - 1;
  const int level = std::clamp(int(std::lround(std::log2(std::max(scale, 1.0)))), 0, last);
  const TextureLevel& t = texture.levels[size_t(level)];
  const double shrink = 1.0 / (1 << level);
  const double x = std::clamp(u * shrink - 0.5, 0.0, t.width - 1.0),
               y = std::clamp(v * shrink - 0.5, 0.0, t.height - 1.0);
  const int x0 = std::min(int(x), t.width - 2), y0 = std::min(int(y), t.height - 2);
  const auto blend = [&](const std::vector<uint8_t>& plane) {
    const uint8_t* p = &plane[size_t(y0) * t.width + x0];
    const double a = x - x0, b = y - y0;
    return float((1 - b) * ((1 - a) * p[0] + a * p[1]) + b * ((1 - a) * p[t.width] + a * p[t.width + 1]));
  };
  return {blend(t.gray), t.alpha.empty() ? 1.0f : blend(t.alpha) / 255.0f};
}

// Share of the pixel around `centre` that lies in [low, high].
double covered_share(double centre, double low, double high) {
  return std::clamp(std::min(centre + 0.5, high) - std::max(centre - 0.5, low), 0.0, 1.0);
}

double usual_share(const std::string& own_part) {
  if (own_part == "dashboard") return 0.3;
  if (own_part == "bonnet") return 0.2;
  return own_part == "bow" ? 0.15 : 0.1;
}

Canvas (*own_part_look(const std::string& kind))(Random&) {
  if (kind == "plain") return plain_part;
  if (kind == "dashboard") return dashboard;
  if (kind == "bonnet") return bonnet;
  return kind == "bow" ? bow : textured_part;
}

void check_overlay(const OverlayOptions& o) {
  const auto& kinds = own_part_kinds();
  if (!o.own_part.empty() && std::find(kinds.begin(), kinds.end(), o.own_part) == kinds.end())
    throw InputError("--own-part " + o.own_part, "is not a kind of part",
                     "did you mean " + nearest_name(o.own_part, kinds) + "?");
  if (o.crossing_px > 0 && o.standing == 0)
    throw InputError("--crossing", "the bus crosses while the camera stands", "give --standing N, too");
  const auto& passing = passing_kinds();
  if (!o.passing.empty() && std::find(passing.begin(), passing.end(), o.passing) == passing.end())
    throw InputError("--traffic " + o.passing, "is not a kind of traffic",
                     "did you mean " + nearest_name(o.passing, passing) + "?");
  if (o.own_part.empty() && !(o.vehicle_px > 0) && o.standing == 0 && o.passing.empty())
    throw InputError("overlay", "nothing to paste",
                     "give --own-part, --vehicle-ahead, --traffic or --standing");
}

}  // namespace

const std::vector<std::string>& own_part_kinds() {
  static const std::vector<std::string> kinds{"gripper", "plain", "dashboard", "arm", "bonnet", "bow"};
  return kinds;
}

const std::vector<std::string>& passing_kinds() {
  static const std::vector<std::string> kinds{"oncoming", "overtaking"};
  return kinds;
}

Overlay::Overlay(const OverlayOptions& options, int width, int height)
    : options_(options), width_(width), height_(height) {
  check_overlay(options);
  if (options_.part_share == 0) options_.part_share = usual_share(options_.own_part);
  const auto drawn = [&](uint64_t body, Canvas (*draw)(Random&)) {
    Random random = body_stream(options_.seed, body);
    return draw(random).texture();
  };
  if (options_.vehicle_px > 0 || !options_.passing.empty()) lorry_ = drawn(2, lorry_rear);
  if (options_.crossing_px > 0) bus_ = drawn(3, bus_side);
  if (options_.own_part.empty()) return;
  own_ = drawn(1, own_part_look(options_.own_part));
  ego_mask_.assign(size_t(width) * height, 255);
  GrayImage ignored{width, height, std::vector<uint8_t>(ego_mask_.size())};
  paste_own(0, ignored, &ignored, &ego_mask_);
}

// Some reach over the whole width; else a rectangle leaves the lower border of the image, somewhat right of
// its middle.
Overlay::BodyBox Overlay::own_place() const {
  const double area = options_.part_share * width_ * height_;
  const bool is_wide = options_.own_part == "dashboard" || options_.own_part == "bonnet";
  if (is_wide || options_.own_part == "bow") {
    const double filled = is_wide ? 1 : 0.5;  // of its box
    const double high = std::min(options_.part_share / filled, 0.9) * height_;
    return {-0.5, height_ - 0.5 - high, width_ - 0.5, height_ - 0.5};
  }
  const double high = std::min(std::sqrt(area / kAspect), 0.9 * height_), wide = area / high;
  const double left = std::min(0.55 * width_ - 0.5 * wide, width_ - wide);
  return {left, height_ - 0.5 - high, left + wide, height_ - 0.5};
}

// At a constant speed relative to the camera, the inverse of its width changes linearly.
std::optional<Overlay::BodyBox> Overlay::vehicle_place(double seconds) const {
  const double t = seconds - kAppears;
  if (t < 0 || t > kCatchUp + kFollows + kPullsAway) return std::nullopt;
  double nearness = 1;  // 0: first seen; 1: at its nearest
  if (t < kCatchUp) nearness = t / kCatchUp;
  if (t > kCatchUp + kFollows) nearness = 1 - (t - kCatchUp - kFollows) / kPullsAway;
  const double most = options_.vehicle_px * width_ / kUsualWidth;
  const double wide = most / (nearness + (1 - nearness) / kFirstVehicleShare);
  // A camera 1.65 m above the road, a lorry 2.5 m wide and high; it weaves and sways a little.
  const double x = 0.5 * width_ + 0.06 * wide * std::sin(1.1 * t);
  const double bottom = 0.48 * height_ + wide * (0.66 + 0.004 * std::sin(5 * t));
  return BodyBox{x - 0.5 * wide, bottom - wide, x + 0.5 * wide, bottom};
}

// On the other lane, one after the other; who overtakes moves in ahead.
std::optional<Overlay::BodyBox> Overlay::passing_place(double seconds) const {
  const bool comes = options_.passing == "oncoming";
  const double every = comes ? 3.5 : 6, speed = comes ? -18 : 5;  // seconds; m/s relative to the camera
  // The next one ahead that comes; the newest one ahead that has overtaken.
  const double passed = comes ? std::ceil(seconds / every) * every : std::floor(seconds / every) * every;
  const double z = speed * (seconds - passed);
  if (passed == 0 || z < kNearest || z > kFarthest) return std::nullopt;
  const double focal = kFocal * width_ / kUsualWidth / z;
  const double moved_in = comes ? 0 : std::clamp((z - 8) / 16, 0.0, 1.0);
  const double x = 0.5 * width_ - focal * kToTheLeft * (1 - moved_in * moved_in * (3 - 2 * moved_in));
  const double half = 0.5 * focal * kWide, bottom = kHorizon * height_ + focal * kBelow;
  return BodyBox{x - half, bottom - 2 * half, x + half, bottom};
}

// It enters after a tenth of the stop and has left after nine tenths.
Overlay::BodyBox Overlay::crossing_place(int standing) const {
  const double wide = options_.crossing_px * width_ / kUsualWidth, high = wide / 4;
  const double share = (double(standing) / options_.standing - 0.1) / 0.8;
  const double left = -wide - 1 + share * (width_ + wide + 1);
  const double bottom = 0.48 * height_ + 0.55 * high + 2 * std::sin(0.7 * standing);
  return {left, bottom - high, left + wide, bottom};
}

void Overlay::paste(const Texture& texture, const BodyBox& p, int index, GrayImage* image,
                    std::vector<uint8_t>* mask) const {
  const int x0 = std::max(0, int(std::floor(p.left))), x1 = std::min(width_ - 1, int(std::ceil(p.right)));
  const int y0 = std::max(0, int(std::floor(p.top))), y1 = std::min(height_ - 1, int(std::ceil(p.bottom)));
  if (x1 < x0 || y1 < y0) return;
  const int columns = x1 - x0 + 1;
  const double texels_x = texture.width() / (p.right - p.left),
               texels_y = texture.height() / (p.bottom - p.top);
  const std::vector<uint8_t> noise = with_sensor_noise(
      std::vector<float>(size_t(columns) * (y1 - y0 + 1), 128.0f), kBodyNoise, options_.seed + 7, index);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const BodySample s =
          sample_body(texture, (x - p.left) * texels_x, (y - p.top) * texels_y, std::max(texels_x, texels_y));
      const double cover = s.cover * covered_share(x, p.left, p.right) * covered_share(y, p.top, p.bottom);
      uint8_t& pixel = image->pixels[size_t(y) * width_ + x];
      const double body = s.gray + (int(noise[size_t(y - y0) * columns + (x - x0)]) - 128);
      pixel = uint8_t(std::lround(std::clamp((1 - cover) * pixel + cover * body, 0.0, 255.0)));
      if (cover >= 0.5) (*mask)[size_t(y) * width_ + x] = 0;
    }
}

// A shadow next to an arm: the scene is seen in it, and its rim is fixed to the camera.
void Overlay::shade(const BodyBox& arm, GrayImage* image, std::vector<uint8_t>* mask) const {
  const double right = arm.right + 0.6 * (arm.right - arm.left), top = 0.6 * arm.top + 0.4 * arm.bottom;
  for (int y = std::max(0, int(top - kSoft)); y < height_; ++y)
    for (int x = std::max(0, int(arm.right)); x < std::min<double>(width_, right + kSoft); ++x) {
      const double depth = std::min(right - x, y - top);  // pixels inside its rim
      const double share = std::clamp(0.5 + depth / (2 * kSoft), 0.0, 1.0);
      uint8_t& pixel = image->pixels[size_t(y) * width_ + x];
      pixel = uint8_t(std::lround(pixel * (1 - share * (1 - kShade))));
      if (std::abs(depth) <= kSoft) (*mask)[size_t(y) * width_ + x] = 0;
    }
}

// What lies above the horizon, upside down, where the mask is black.
void Overlay::reflect(const GrayImage& scene, const std::vector<uint8_t>& mask, GrayImage* image) const {
  for (int y = 0; y < height_; ++y) {
    const int mirrored = std::clamp(int(2 * kHorizon * height_) - y, 0, height_ - 1);
    for (int x = 0; x < width_; ++x) {
      if (mask[size_t(y) * width_ + x] != 0) continue;
      uint8_t& pixel = image->pixels[size_t(y) * width_ + x];
      const double light = kReflected * scene.pixels[size_t(mirrored) * width_ + x];
      pixel = uint8_t(std::lround(std::min(pixel + light, 255.0)));
    }
  }
}

void Overlay::paste_own(int index, const GrayImage& scene, GrayImage* image,
                        std::vector<uint8_t>* mask) const {
  const BodyBox place = own_place();
  if (options_.own_part == "arm") shade(place, image, mask);
  paste(own_, place, index, image, mask);
  if (options_.own_part == "bonnet") reflect(scene, *mask, image);
}

OverlaidImage Overlay::apply(const GrayImage& image, int index, double seconds,
                             std::optional<int> standing) const {
  check_pixels(image, "Overlay::apply()");
  OverlaidImage out{{image.width, image.height, image.pixels}, {}};
  if (standing)
    out.image.pixels = with_sensor_noise({image.pixels.begin(), image.pixels.end()}, kStandingNoise,
                                         options_.seed + 3, index);
  const auto paste_moving = [&](const Texture& texture, const BodyBox& place) {
    if (out.moving.empty()) out.moving.assign(image.pixels.size(), 255);
    paste(texture, place, index, &out.image, &out.moving);
  };
  if (options_.vehicle_px > 0)
    if (const std::optional<BodyBox> place = vehicle_place(seconds)) paste_moving(lorry_, *place);
  if (!options_.passing.empty())
    if (const std::optional<BodyBox> place = passing_place(seconds)) paste_moving(lorry_, *place);
  if (options_.crossing_px > 0 && standing) paste_moving(bus_, crossing_place(*standing));
  std::vector<uint8_t> own = ego_mask_;
  if (!own.empty()) paste_own(index, image, &out.image, &own);
  return out;
}

std::string ground_truth_with_stop(const std::string& tum, Timestamp at, double step_s, int frames) {
  const int64_t step = Timestamp::from_seconds(step_s).ticks;
  std::istringstream lines(tum);
  std::string out, line, pose;
  int left = frames;
  const auto stand = [&] {
    for (; left > 0 && !pose.empty(); --left)
      out += to_string({at.ticks + step * (frames - left + 1)}) + pose + "\n";
  };
  while (std::getline(lines, line)) {
    const size_t space = line.find_first_of(" \t,");
    Timestamp time;
    if (space == std::string::npos || !parse_seconds(line.substr(0, space), &time)) {
      out += line + "\n";
      continue;
    }
    if (at < time) {
      stand();
      time.ticks += step * frames;
    }
    pose = line.substr(space);
    out += to_string(time) + pose + "\n";
  }
  stand();
  return out;
}

}  // namespace edgevo
