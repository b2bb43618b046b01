// SPDX-License-Identifier: BSD-3-Clause
#include "final_map.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "edgevo/core/formatted.h"
#include "edgevo/core/order_statistics.h"
#include "keyframe_bytes.h"

namespace edgevo {
namespace {

// Where a keyframe has come to lie, and how much longer lengths are there than when it left the window.
struct FinalPlace {
  int frame_index = 0;
  SE3 T_world_cam;
  double growth = 1;
};
using FinalPlaces = std::map<int, FinalPlace>;  // by id

std::map<int, const KeyframeRecord*> by_frame(const Run& run) {
  std::map<int, const KeyframeRecord*> keyframes;
  for (const KeyframeRecord& k : run.keyframes)
    if (!k.is_doubtful) keyframes[k.frame_index] = &k;
  return keyframes;
}

bool has_depth(const EdgePoint& p) { return p.idepth > 0; }

// The median over the points; nothing without points.
std::optional<double> growth_of(const KeyframeRecord& before, const KeyframeRecord& now) {
  std::vector<double> ratios;
  size_t i = 0;
  for (const EdgePoint& p : now.points) {
    if (!has_depth(p)) continue;
    if (i < before.points.size()) ratios.push_back(double(before.points[i].idepth) / p.idepth);
    ++i;
  }
  if (ratios.empty()) return std::nullopt;
  return median(std::move(ratios));
}

// Writes the keyframes that the run has, and returns where they are. `is_final`: the unit is that of the run
// already.
FinalPlaces write_keyframes(Database* grown, bool is_final, const Run& run, Database* target) {
  const std::map<int, const KeyframeRecord*> known = by_frame(run);
  FinalPlaces places;
  double growth = 1;
  KeyframeRows out(target);
  Statement rows = grown->statement("SELECT id, place, view FROM keyframes ORDER BY id");
  while (rows.step()) {
    std::optional<KeyframePlace> place = read_place(rows.bytes(1));
    if (!place) continue;
    const auto found = known.find(place->record.frame_index);
    if (found == known.end()) continue;
    if (!is_final) growth = growth_of(place->record, *found->second).value_or(growth);
    place->record = *found->second;
    places[place->id] = {place->record.frame_index, place->record.T_world_cam, growth};
    out.put(int(rows.integer(0)), bytes_of(*place), rows.bytes(2));
  }
  return places;
}

// The constraint in the unit of the run.
Constraint in_final_unit(const Constraint& grown, const FinalPlace& from, const FinalPlace& to) {
  Constraint c = in_new_units(grown, from.growth, to.growth);
  if (c.kind == ConstraintKind::kNeighbour) c.T_from_to = {1, from.T_world_cam.inverse() * to.T_world_cam};
  return c;
}

using Contradicted = std::set<std::tuple<std::string, int, int>>;  // kind, frames of both keyframes

Contradicted contradicted_by(const Run& run) {
  Contradicted found;
  for (const ConstraintRecord& c : run.constraints)
    if (!c.holds) found.insert({c.kind, c.from_frame, c.to_frame});
  return found;
}

void write_constraints(Database* grown, const Run& run, const FinalPlaces& places, Database* target) {
  const Contradicted contradicted = contradicted_by(run);
  ConstraintRows out(target);
  Statement rows = grown->statement("SELECT number, data FROM constraints ORDER BY number");
  while (rows.step()) {
    const std::optional<Constraint> c = read_constraint(rows.bytes(1));
    if (!c) continue;
    const auto from = places.find(c->from.number()), to = places.find(c->to.number());
    if (from == places.end() || to == places.end()) continue;
    if (contradicted.count({to_string(c->kind), from->second.frame_index, to->second.frame_index})) continue;
    out.put(rows.integer(0), in_final_unit(*c, from->second, to->second));
  }
}

}  // namespace

MapTexts texts_of(const MapHeader& header) {
  return {{"pinhole", to_text(header.pinhole)},
          {"camera", header.camera},
          {"source", header.source},
          {"finished", "0"}};
}

MapTexts finished_texts(MapTexts texts, const MapEnd& end) {
  texts["finished"] = "1";
  texts["scale_source"] = end.scale_source;
  texts["scale_sigma"] = formatted("%.6g", end.scale_sigma);
  const ImageCorrection& lens = end.correction;
  texts["correction"] = formatted("%.17g %.17g %.17g", lens.k1, lens.readout_s, lens.focal);
  return texts;
}

Constraint motion_of(const StoredKeyframe& keyframe) {
  Constraint motion;
  motion.from = NodeId::keyframe(keyframe.id);
  motion.to = NodeId::keyframe(keyframe.next->id);
  motion.T_from_to = {1, keyframe.next->T_leaving_neighbour};
  motion.covariance.setZero();
  motion.covariance.topLeftCorner<6, 6>() = keyframe.next->covariance;
  motion.kind = ConstraintKind::kNeighbour;
  return motion;
}

NeighbourPose neighbour_of(const Constraint& motion) {
  return {motion.to.number(), motion.T_from_to.rigid, motion.covariance.topLeftCorner<6, 6>()};
}

void write_final_map(Database* grown, const Run& run, const std::string& path) {
  const std::optional<MapTexts> texts = read_texts(grown);
  if (!texts) throw DatabaseError("its description is damaged");
  const bool is_final = texts->count("finished") > 0 && texts->at("finished") == "1";
  write_whole_map(path, [&](Database* target) {
    write_texts(target, finished_texts(*texts, {run.scale_source, run.scale.sigma, run.camera.applied}));
    const FinalPlaces places = write_keyframes(grown, is_final, run, target);
    write_constraints(grown, run, places, target);
  });
}

}  // namespace edgevo
