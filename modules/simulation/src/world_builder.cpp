// SPDX-License-Identifier: BSD-3-Clause
#include "world_builder.h"

#include <Eigen/Geometry>
#include <cmath>

#include "texture_kinds.h"

namespace edgevo {
namespace {

// FNV-1a: a stream of random numbers for each kind of texture.
uint64_t hash(const std::string& text) {
  uint64_t h = 1469598103934665603ull;
  for (char c : text) h = (h ^ uint8_t(c)) * 1099511628211ull;
  return h;
}

}  // namespace

const std::string& to_string(Thing thing) {
  static const std::string words[kThings] = {"markings", "kerbs",   "poles",     "rails",
                                             "plants",   "objects", "buildings", "ground"};
  return words[size_t(thing)];
}

LocalFrame LocalFrame::moved(double r, double o, double z, double angle) const {
  const double c = std::cos(angle), s = std::sin(angle);
  return {point(r, o, z), c * right - s * out, s * right + c * out};
}

LocalFrame facing(const Eigen::Vector3d& origin, double angle) {
  const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0);
  return {origin, Eigen::Vector3d::UnitZ().cross(out), out};
}

WorldBuilder::WorldBuilder(uint64_t seed, std::string where, const Eigen::Vector3d& sun)
    : seed_(seed),
      where_(std::move(where)),
      sun_(sun.normalized()),
      random_(Random::derive(seed, hash("world"))) {}

int WorldBuilder::texture(const std::string& kind, int variant) {
  const auto [it, is_new] = known_.try_emplace({kind, variant}, int(world_.textures.size()));
  if (!is_new) return it->second;
  const TextureKind& drawn = texture_kind(kind, where_);
  Random random = Random::derive(seed_, hash(kind) + uint64_t(variant));
  world_.textures.push_back(drawn.draw(random).texture());
  natural_size_.emplace_back(drawn.width_m, drawn.height_m);
  thing_of_texture_.push_back(drawn.thing);
  return it->second;
}

Surface& WorldBuilder::add(const Eigen::Vector3d& corner, const Eigen::Vector3d& side_u,
                           const Eigen::Vector3d& side_v, int texture) {
  Surface s;
  s.origin = corner, s.side_u = side_u, s.side_v = side_v, s.texture = texture;
  s.thing = thing_.value_or(thing_of_texture_[size_t(texture)]);
  const Eigen::Vector3d normal = side_v.cross(side_u).normalized();
  s.gain = float(kInShade + kBySun * std::max(0.0, normal.dot(sun_)));
  s.is_solid = !world_.textures[size_t(texture)].is_cut_out();
  world_.surfaces.push_back(s);
  return world_.surfaces.back();
}

Surface& WorldBuilder::fit(const Eigen::Vector3d& corner, const Eigen::Vector3d& side_u,
                           const Eigen::Vector3d& side_v, int texture) {
  return add(corner, side_u, side_v, texture);
}

Surface& WorldBuilder::tile(const Eigen::Vector3d& corner, const Eigen::Vector3d& side_u,
                            const Eigen::Vector3d& side_v, int texture) {
  Surface& s = add(corner, side_u, side_v, texture);
  s.is_tiled = true;
  s.uv_origin = {random_.uniform(), random_.uniform()};
  const Eigen::Vector2d& size = natural_size_[size_t(texture)];
  s.uv_size = {side_u.norm() / size.x(), side_v.norm() / size.y()};
  return s;
}

Surface& WorldBuilder::wall(const LocalFrame& place, double r0, double r1, double z0, double z1, double o,
                            int texture, bool tiled) {
  const Eigen::Vector3d corner = place.point(r0, o, z1), u = (r1 - r0) * place.right, v(0, 0, z0 - z1);
  return tiled ? tile(corner, u, v, texture) : fit(corner, u, v, texture);
}

void WorldBuilder::box(const LocalFrame& place, const Block& b, int sides, int top, int front, bool tiled,
                       float gain) {
  const auto side = [&](const Eigen::Vector3d& corner, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                        int tex, bool tile_it) {
    (tile_it ? tile(corner, u, v, tex) : fit(corner, u, v, tex)).gain *= gain;
  };
  const Eigen::Vector3d right = (b.r1 - b.r0) * place.right, out = (b.o1 - b.o0) * place.out,
                        down(0, 0, b.z0 - b.z1);
  side(place.point(b.r0, b.o1, b.z1), right, down, front < 0 ? sides : front, front < 0 && tiled);
  side(place.point(b.r1, b.o0, b.z1), -right, down, sides, tiled);
  side(place.point(b.r1, b.o1, b.z1), -out, down, sides, tiled);
  side(place.point(b.r0, b.o0, b.z1), out, down, sides, tiled);
  side(place.point(b.r0, b.o0, b.z1), right, out, top, tiled);
}

void WorldBuilder::card(const LocalFrame& place, double width, double height, double angle, int texture,
                        float gain) {
  const Eigen::Vector3d along = std::cos(angle) * place.right + std::sin(angle) * place.out;
  Surface& s = fit(place.point(0, 0, height) - 0.5 * width * along, width * along,
                   Eigen::Vector3d(0, 0, -height), texture);
  s.is_two_sided = true;
  s.is_solid = false;
  s.gain = 0.95f * gain;
}

void WorldBuilder::prism(const LocalFrame& place, double radius, double height, int sides, int texture,
                         float gain) {
  for (int i = 0; i < sides; ++i) {
    const double a = 2 * M_PI * i / sides, b = 2 * M_PI * (i + 1) / sides;
    const Eigen::Vector3d left = place.point(radius * std::sin(-b), radius * std::cos(b), height);
    const Eigen::Vector3d right = place.point(radius * std::sin(-a), radius * std::cos(a), height);
    Surface& s = fit(left, right - left, Eigen::Vector3d(0, 0, -height), texture);
    s.uv_origin = {double(i) / sides, 0};
    s.uv_size = {1.0 / sides, 1};
    s.gain *= gain;
    s.thing = thing_.value_or(Thing::kPole);
  }
}

void WorldBuilder::set_sky(const std::string& kind, float horizon_gray, float haze_per_metre) {
  world_.sky.texture = kind.empty() ? -1 : texture(kind, 0);
  world_.sky.gray = horizon_gray;
  world_.sky.haze_per_metre = haze_per_metre;
}

}  // namespace edgevo
