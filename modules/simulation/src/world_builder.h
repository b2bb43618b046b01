// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Assembles textured boxes, cards and prisms into a world.
#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "edgevo/core/random.h"
#include "edgevo/simulation/world.h"

namespace edgevo {

/// A local frame, seen by a viewer in front of an object. Coordinates are (right, out, up): `out` points at
/// the viewer, up is the world's z.
struct LocalFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d out = -Eigen::Vector3d::UnitY();

  Eigen::Vector3d point(double r, double o, double z) const {
    return origin + r * right + o * out + z * Eigen::Vector3d::UnitZ();
  }
  /// This frame with its origin at (r, o, z), rotated by `angle` radians about z.
  LocalFrame moved(double r, double o, double z, double angle = 0) const;
};

/// Frame at `origin` whose front looks towards `angle` radians (0: east, pi/2: north).
LocalFrame facing(const Eigen::Vector3d& origin, double angle);

/// Ranges along right, out and up.
struct Block {
  double r0, r1, o0, o1, z0, z1;
};

/// Brightness of a surface in the shade, and what a sun straight above it adds; factors on its gray.
constexpr double kInShade = 0.62, kBySun = 0.5;

class WorldBuilder {
 public:
  /// `where` opens the error messages; `sun` points towards the sun.
  WorldBuilder(uint64_t seed, std::string where, const Eigen::Vector3d& sun);

  Random& random() { return random_; }
  const Eigen::Vector3d& sun() const { return sun_; }

  /// Index of one of several variants of a kind of texture. Throws InputError for an unknown kind.
  int texture(const std::string& kind, int variant);
  int any_texture(const std::string& kind, int variants) { return texture(kind, random_.below(variants)); }

  /// A surface filled by one repeat of the texture; `corner` is the upper left one.
  Surface& fit(const Eigen::Vector3d& corner, const Eigen::Vector3d& side_u, const Eigen::Vector3d& side_v,
               int texture);
  /// A surface on which the texture repeats at its natural size.
  Surface& tile(const Eigen::Vector3d& corner, const Eigen::Vector3d& side_u, const Eigen::Vector3d& side_v,
                int texture);

  /// An upright rectangle at distance `o`, seen from the front.
  Surface& wall(const LocalFrame& place, double r0, double r1, double z0, double z1, double o, int texture,
                bool tiled);
  /// The sides and the top of a block; `front` is the texture fitted to the front side, -1: none.
  void box(const LocalFrame& place, const Block& block, int sides, int top, int front = -1, bool tiled = true,
           float gain = 1);
  /// An upright cut-out, rotated by `angle` radians against the frame, centred on its origin; seen from both
  /// sides.
  void card(const LocalFrame& place, double width, double height, double angle, int texture, float gain = 1);
  /// An upright prism with `sides` faces.
  void prism(const LocalFrame& place, double radius, double height, int sides, int texture, float gain = 1);

  /// Calls `build`, whose surfaces are part of this thing, whatever their texture.
  template <class F>
  void build_as(Thing thing, const F& build) {
    const std::optional<Thing> before = std::exchange(thing_, thing);
    build();
    thing_ = before;
  }

  /// The surfaces so far.
  std::vector<Surface>& surfaces() { return world_.surfaces; }
  void set_sky(const std::string& kind, float horizon_gray, float haze_per_metre);
  World finish() { return std::move(world_); }

 private:
  Surface& add(const Eigen::Vector3d& corner, const Eigen::Vector3d& side_u, const Eigen::Vector3d& side_v,
               int texture);

  uint64_t seed_;
  std::string where_;
  Eigen::Vector3d sun_;
  Random random_;
  World world_;
  std::map<std::pair<std::string, int>, int> known_;
  /// Natural size of each texture, metres, and what it is part of.
  std::vector<Eigen::Vector2d> natural_size_;
  std::vector<Thing> thing_of_texture_;
  /// What is being built, if not what its textures say.
  std::optional<Thing> thing_;
};

}  // namespace edgevo
