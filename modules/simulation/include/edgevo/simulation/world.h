#pragma once
// A rendered world: textured parallelograms, a sun and a sky. Metres; x east, y north, z up.
//
// Everything is flat. Boxes are six surfaces, a trunk is a prism, a tree's crown a few crossing cards with
// leaves cut out. Flat surfaces make depth exact: 1/z is linear in the image, so that no mesh or depth buffer
// precision comes in.
#include <Eigen/Core>
#include <vector>

#include "edgevo/simulation/texture.h"

namespace edgevo {

/// The points origin + a side_u + b side_v, a and b in [0, 1].
struct Surface {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();   ///< a corner, metres
  Eigen::Vector3d side_u = Eigen::Vector3d::UnitX();  ///< the side along which u grows, metres
  Eigen::Vector3d side_v = Eigen::Vector3d::UnitY();  ///< the side along which v grows, metres
  int texture = 0;                                    ///< index in World::textures
  Eigen::Vector2d uv_origin = {0, 0};                 ///< of the texture at the origin, in repetitions
  Eigen::Vector2d uv_size = {1, 1};                   ///< repetitions of the texture across u and v
  float gain = 1;            ///< brightness: the texture's gray is multiplied by this
  bool is_tiled = false;     ///< the texture repeats; else its border is continued, so that nothing wraps in
  bool is_triangle = false;  ///< only the half with a + b <= 1
  bool is_two_sided =
      false;             ///< seen from both sides; else only from where side_u points right and side_v down
  bool is_solid = true;  ///< a camera must not pass through it
};

/// The sky is a layer of clouds infinitely far away: it turns with the camera, but does not move. Its depth
/// is 0.
struct Sky {
  int texture = -1;          ///< clouds, tiled; -1: plain
  float gray = 225;          ///< at the horizon, and what haze fades to
  float haze_per_metre = 0;  ///< a surface at z metres keeps 1 / (1 + haze z) of its own brightness
};

/// All that a camera can see.
struct World {
  std::vector<Texture> textures;  ///< shared by the surfaces
  std::vector<Surface> surfaces;  ///< in no particular order
  Sky sky;                        ///< behind all surfaces
};

}  // namespace edgevo
