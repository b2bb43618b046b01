// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Objects: houses, trees, cars, lamps.
#include <string>

#include "season.h"
#include "world_builder.h"

namespace edgevo {

/// A house whose front runs from `place`'s origin `width` metres to the right, `depth` metres deep.
void add_house(WorldBuilder& b, const LocalFrame& place, double width, double depth, int storeys,
               const std::string& wall);

/// A broad-leaved tree with its foot at the origin of `place`.
void add_tree(WorldBuilder& b, const LocalFrame& place, double height, const Leaves& leaves = {});
/// A conifer with its foot at the origin of `place`.
void add_conifer(WorldBuilder& b, const LocalFrame& place, double height);
void add_bush(WorldBuilder& b, const LocalFrame& place, double width, const Leaves& leaves = {});

/// A car of 4.3 m whose left side is in front; the origin is below its middle.
void add_car(WorldBuilder& b, const LocalFrame& place);

/// A lamp post of 6 m whose arm reaches outwards.
void add_lamp(WorldBuilder& b, const LocalFrame& place);
/// A post with a sign that faces outwards.
void add_sign(WorldBuilder& b, const LocalFrame& place);

}  // namespace edgevo
