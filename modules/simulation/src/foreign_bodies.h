// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Textures of the bodies of overlay.h.
#include "edgevo/core/random.h"
#include "edgevo/simulation/texture.h"

namespace edgevo {

/// Boards, bolts and writing: edges all over.
Texture textured_part(Random random);
/// A uniform surface: its only edge is its outline.
Texture plain_part();
/// Seen from the driver's seat: a curved rim, two instruments, vents; empty above the rim.
Texture dashboard(Random random);
/// The rear of a lorry: doors, lamps, bumper.
Texture lorry_rear(Random random);
/// The side of a bus: windows, wheels, an advertisement.
Texture bus_side(Random random);

}  // namespace edgevo
