// SPDX-License-Identifier: BSD-3-Clause
#include "earlier_map.h"

#include <utility>
#include <variant>

#include "edgevo/core/error.h"
#include "edgevo/kept_map/kept_map.h"

namespace edgevo {

EarlierMap::EarlierMap(const std::string& path, const Pinhole& pinhole, double metres_per_unit) {
  KeptMap map = read_finished_map(path, pinhole);
  if (map.is_metric() && metres_per_unit > 0)
    throw InputError("metres_per_unit", "the map " + path + " has metres of its own", "omit metres_per_unit");
  is_metric_ = map.is_metric();
  warnings_ = std::move(map.warnings);
  places_ = std::make_shared<PlaceStore>(std::move(map.store));
}

bool EarlierMap::is_placed_by(const std::vector<std::shared_ptr<const MapEvent>>& events) {
  const bool was_placed = is_placed_;
  for (const auto& event : events) {
    if (const auto* added = std::get_if<ConstraintAdded>(event.get());
        added && added->constraint.from == NodeId::world())
      found_.insert(added->id);
    if (const auto* withdrawn = std::get_if<ConstraintWithdrawn>(event.get())) found_.erase(withdrawn->id);
    if (const auto* placed = std::get_if<EpochsPlaced>(event.get()))
      is_placed_ |= !found_.empty() && *found_.begin() <= placed->newest_constraint;
  }
  return is_placed_ && !was_placed;
}

}  // namespace edgevo
