// SPDX-License-Identifier: BSD-3-Clause
#include "earlier_map.h"

#include <filesystem>
#include <utility>
#include <variant>

#include "edgevo/core/error.h"
#include "edgevo/kept_map/kept_map.h"
#include "edgevo/kept_map/map_file_writer.h"

namespace edgevo {
namespace {

std::string file_of(const std::string& path) {
  return std::filesystem::is_directory(path) ? (std::filesystem::path(path) / kMapFile).string() : path;
}

}  // namespace

EarlierMap::EarlierMap(const std::string& path, const Pinhole& pinhole, double metres_per_unit) {
  const std::string file = file_of(path);
  KeptMap map = read_map(file);
  check_camera(map, pinhole, file);
  if (!map.is_finished)
    throw InputError(file, "was left by a run that did not end, in several units of length",
                     "`edgevo finish` ends it");
  if (map.is_metric() && metres_per_unit > 0)
    throw InputError("metres_per_unit", "the map " + file + " has metres of its own", "omit metres_per_unit");
  is_metric_ = map.is_metric();
  warnings_ = std::move(map.warnings);
  auto places = std::make_shared<PlaceStore>(std::move(map.store));
  places->number_epochs({});  // at its end a run has one unit
  places_ = std::move(places);
}

bool EarlierMap::is_placed_by(const std::vector<std::shared_ptr<const MapEvent>>& events) {
  const bool was_placed = is_placed_;
  for (const auto& event : events) {
    const auto* added = std::get_if<ConstraintAdded>(event.get());
    is_found_ |= added && added->constraint.from == NodeId::world();
    is_placed_ |= is_found_ && std::holds_alternative<EpochsPlaced>(*event);
  }
  return is_placed_ && !was_placed;
}

}  // namespace edgevo
