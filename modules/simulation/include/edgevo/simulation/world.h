// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A rendered world: textured parallelograms, a sun and a sky. Metres; x east, y north, z up.
//
// All surfaces are flat: a box is six surfaces, a trunk a prism, a tree's crown a few crossing cards with
// leaves cut out. Flat surfaces make depth exact: 1/z is linear in the image, so that neither a mesh nor
// depth buffer precision matters.
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "edgevo/simulation/texture.h"

namespace edgevo {

/// What a surface is part of, as a robot or its planner names it. Where several meet in an edge, the edge is
/// that of the first of them in this order.
enum class Thing : uint8_t {
  /// Paint on the ground, a cover in it.
  kMarking,
  /// The rim of a pavement.
  kKerb,
  /// Thin and upright: lamps, signs, trunks, drain pipes, pens.
  kPole,
  /// Long, thin and level: crash barriers, handrails, pipes, skirtings.
  kRail,
  /// Leaves, reeds, hedges.
  kPlant,
  /// Cars, furniture, boxes, stones, what moves by itself.
  kObject,
  /// Walls, windows, doors, roofs.
  kBuilding,
  /// What one drives, walks or swims on, with its texture.
  kGround
};
/// Number of things.
constexpr int kThings = 8;
/// Name in tables.
const std::string& to_string(Thing thing);

/// A parallelogram: the points origin + a side_u + b side_v, a and b in [0, 1].
struct Surface {
  /// A corner, metres.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  /// Side along which u grows, metres.
  Eigen::Vector3d side_u = Eigen::Vector3d::UnitX();
  /// Side along which v grows, metres.
  Eigen::Vector3d side_v = Eigen::Vector3d::UnitY();
  /// Index in World::textures.
  int texture = 0;
  /// What it is part of.
  Thing thing = Thing::kObject;
  /// Texture coordinates at the origin, in repetitions.
  Eigen::Vector2d uv_origin = {0, 0};
  /// Number of repetitions of the texture along u and v.
  Eigen::Vector2d uv_size = {1, 1};
  /// Factor on the texture's gray.
  float gain = 1;
  /// True: the texture repeats; false: its border is continued, so that nothing wraps around.
  bool is_tiled = false;
  /// True: only the half with a + b <= 1 exists.
  bool is_triangle = false;
  /// True: seen from both sides; false: only from where side_u points right and side_v down.
  bool is_two_sided = false;
  /// True: a camera must not pass through it.
  bool is_solid = true;
};

/// The sky, a layer of clouds at infinity: it rotates with the camera but does not translate. Its depth is 0.
struct Sky {
  /// Tiled cloud texture; -1: plain.
  int texture = -1;
  /// Gray at the horizon, to which haze fades.
  float gray = 225;
  /// Haze: a surface at z metres keeps 1 / (1 + haze z) of its own brightness.
  float haze_per_metre = 0;
};

/// All that a camera can see.
struct World {
  /// Textures, shared by the surfaces.
  std::vector<Texture> textures;
  /// Surfaces, in no particular order.
  std::vector<Surface> surfaces;
  /// Sky behind all surfaces.
  Sky sky;
};

}  // namespace edgevo
