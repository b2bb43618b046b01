// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/kept_map/map_join.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "edgevo/core/error.h"
#include "edgevo/core/formatted.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/kept_map/write_map.h"
#include "edgevo/map/run_builder.h"
#include "renumbered_map.h"

namespace edgevo {
namespace {

// What is in a map in the frame and unit of another one.
KeptMap moved(const KeptMap& map, const MapAlignment& alignment) {
  KeptMap there(map.header);
  std::map<int, Sim3> T_of;  // by id
  for (size_t i = 0; i < map.store.size(); ++i) {
    StoredKeyframe k = map.store.keyframes()[i];
    T_of[k.id] = alignment.T_a_b[i];
    auto record = std::make_shared<KeyframeRecord>(*k.record);
    move_to_world(alignment.T_a_b[i], record.get());
    k.record = std::move(record);
    if (k.next) scale_motion(alignment.T_a_b[i].scale, &*k.next);
    there.store.add(std::move(k));
  }
  for (Constraint c : map.constraints)
    if (in_unit_of(T_of, &c)) there.constraints.push_back(c);
  return there;
}

// The places that relate both, in the unit of the first.
std::vector<Constraint> relations(const KeptMap& a, const KeptMap& b, const MapAlignment& alignment) {
  std::vector<Constraint> found;
  for (const StatedPlace& p : alignment.places) {
    found.push_back(constraint_of(p, a.store, b.store));
    found.back().T_from_to.scale /= alignment.T_a_b[p.query].scale;
  }
  return found;
}

std::string statement(const MapAlignment& alignment, const KeptMap& a, const KeptMap& b) {
  std::vector<double> scales;
  for (const Sim3& T : alignment.T_a_b) scales.push_back(T.scale);
  std::set<size_t> queries;
  for (const StatedPlace& p : alignment.places) queries.insert(p.query);
  return formatted("%zu and %zu keyframes; %zu of the second map found in the first, %.4g times its unit",
                   a.store.size(), b.store.size(), queries.size(), median(std::move(scales)));
}

void check_new(const std::string& out) {
  if (std::filesystem::exists(out)) throw InputError(out, "is there already", "give a new file to -o");
}

}  // namespace

KeptMap join_maps(const KeptMap& a, const KeptMap& b, const MapAlignment& alignment) {
  KeptMap joined(a.header);
  joined.header.source += " + " + b.header.source;
  joined.is_finished = true;
  joined.scale_source = a.scale_source, joined.scale_sigma = a.scale_sigma;
  joined.correction = a.correction;
  const Numbers of_a = append(a, &joined), of_b = append(moved(b, alignment), &joined);
  for (const Constraint& c : relations(a, b, alignment))
    joined.constraints.push_back(renumbered(c, of_a, of_b));
  return joined;
}

JoinedMaps join_map_files(const std::string& path_a, const std::string& path_b, const std::string& out) {
  check_new(out);
  std::error_code ignored;
  if (std::filesystem::equivalent(map_file_of(path_a), map_file_of(path_b), ignored))
    throw InputError(path_b, "is the first map once more", "give the maps of two runs");
  const KeptMap a = read_finished_map(path_a), b = read_finished_map(path_b);
  check_camera(a, b.header.pinhole, map_file_of(path_a));
  const std::optional<MapAlignment> alignment = align_maps(a, b, find_places(a, b));
  if (!alignment)
    throw InputError(path_b, "fewer than three of its places were found in " + path_a,
                     "record one of them again so that it passes where the other one has been");
  write_map(join_maps(a, b, *alignment), out);
  JoinedMaps joined{statement(*alignment, a, b), a.warnings};
  joined.warnings.insert(joined.warnings.end(), b.warnings.begin(), b.warnings.end());
  return joined;
}

}  // namespace edgevo
