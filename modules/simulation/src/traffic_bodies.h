// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What bodies of traffic look like; axes as in body.h.
#include <cstdint>
#include <memory>

#include "edgevo/simulation/world.h"

namespace edgevo {

/// A car, 4.3 m long and 1.7 m wide.
std::shared_ptr<const World> traffic_car(uint64_t seed);
/// A lorry, 9 m long, 2.5 m wide and 3 m high.
std::shared_ptr<const World> traffic_lorry(uint64_t seed);
/// A bus, 12 m long, 2.5 m wide and 3 m high.
std::shared_ptr<const World> traffic_bus(uint64_t seed);
/// Somebody on foot, 1.75 m tall.
std::shared_ptr<const World> traffic_person(uint64_t seed);

}  // namespace edgevo
