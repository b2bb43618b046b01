// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Textures of bodies that do not belong to the scene, for overlay.h and traffic.h.
#include "canvas.h"
#include "edgevo/core/random.h"

namespace edgevo {

/// Boards, bolts and writing: edges all over.
Canvas textured_part(Random& random);
/// A uniform surface: its only edge is its outline.
Canvas plain_part(Random& random);
/// Seen from the driver's seat: a curved rim, two instruments, vents; empty above the rim.
Canvas dashboard(Random& random);
/// A bonnet with a curved rim, nozzles and two creases; empty above the rim.
Canvas bonnet(Random& random);
/// The bow of a boat, pointed, with planks; empty around it.
Canvas bow(Random& random);
/// The rear of a lorry: doors, lamps, bumper.
Canvas lorry_rear(Random& random);
/// The side of a bus: windows, wheels, an advertisement.
Canvas bus_side(Random& random);
/// Somebody who walks; empty around.
Canvas person(Random& random);

}  // namespace edgevo
