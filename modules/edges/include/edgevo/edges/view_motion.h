// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How much of the view moves in the image, from the edges alone.

namespace edgevo {

/// Cells of the view that show strong edges, compared with an image before. Parts that are fixed to the
/// camera do not count.
struct ViewMotion {
  /// Number of cells; of those whose edges keep their place; of those in which most edges leave it.
  int cells = 0, still = 0, moving = 0;
  /// Whether the camera stands: half of the view stands still. Once it stands, what crosses the view may
  /// cover more, little by little; a camera that begins to move moves everything at once.
  bool stands = false;
};

}  // namespace edgevo
