// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_loop/kept_places.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <variant>

#include "edgevo/core/error.h"
#include "edgevo/core/record_units.h"
#include "edgevo/kept_map/kept_map.h"
#include "edgevo/kept_map/map_extension.h"
#include "edgevo/kept_map/write_map.h"
#include "edgevo/scale/given_scale.h"
#include "edgevo/scale/scale_source.h"

namespace edgevo {
namespace {

// Frames of the keyframes that hold the run in the map.
std::set<int> frames_found(const Run& run) {
  std::set<int> found;
  for (const ConstraintRecord& c : run.constraints)
    if (c.from_frame < 0 && c.holds) found.insert(c.to_frame);
  return found;
}

// A keyframe may have several, of which one is mistaken: they differ in scale.
std::vector<Constraint> those_that_hold(const Run& run, const KeptMap& of_run,
                                        const std::vector<Constraint>& found) {
  std::set<std::pair<int, double>> holding;  // frame, scale
  for (const ConstraintRecord& c : run.constraints)
    if (c.from_frame < 0 && c.holds) holding.insert({c.to_frame, c.scale});
  std::map<int, int> frame_of;  // by keyframe
  for (const StoredKeyframe& k : of_run.store.keyframes()) frame_of[k.id] = k.record->frame_index;
  std::vector<Constraint> that_hold;
  for (const Constraint& c : found)
    if (const auto k = frame_of.find(c.to.number()); k != frame_of.end())
      if (holding.count({k->second, c.T_from_to.scale}) > 0) that_hold.push_back(c);
  return that_hold;
}

// Of the run's unit in that of the map: what is known best of a keyframe; exact if there is none.
double unit_sigma(const Run& run) {
  double best = 0;
  for (const EpochRecord& e : run.epochs) best = std::max(best, e.scale_sigma);
  for (const ConstraintRecord& c : run.constraints)
    if (c.from_frame < 0 && c.holds && std::isfinite(c.scale_sigma)) best = std::min(best, c.scale_sigma);
  return best;
}

}  // namespace

KeptPlaces::KeptPlaces(const std::string& path, const Pinhole& pinhole, const std::string& scale)
    : path_(path) {
  KeptMap map = read_finished_map(path, pinhole);
  if (map.is_metric() && !scale.empty())
    throw InputError(scale, "the map " + path_ + " has metres of its own", "omit it");
  is_metric_ = map.is_metric(), scale_sigma_ = map.scale_sigma;
  warnings_ = std::move(map.warnings);
  places_ = std::make_shared<PlaceStore>(std::move(map.store));
}

void KeptPlaces::follow(const std::vector<std::shared_ptr<const MapEvent>>& events) {
  for (const auto& event : events) follow(*event);
}

void KeptPlaces::follow(const MapEvent& event) {
  if (const auto* keyframe = std::get_if<KeyframeAdded>(&event); keyframe && keyframe->segment != segment_)
    begin_epoch(keyframe->segment, keyframe->id);
  if (const auto* epoch = std::get_if<EpochBegan>(&event); epoch && epoch->segment == segment_)
    begin_epoch(epoch->segment, epoch->first);
  if (const auto* added = std::get_if<ConstraintAdded>(&event);
      added && added->constraint.from == NodeId::world())
    found_[added->id] = added->constraint.to.number();
  if (const auto* withdrawn = std::get_if<ConstraintWithdrawn>(&event)) found_.erase(withdrawn->id);
  if (const auto* placed = std::get_if<EpochsPlaced>(&event); placed && placed->segment == segment_)
    is_placed_ = is_found_since_then(placed->newest_constraint);
}

void KeptPlaces::begin_epoch(int segment, int first_keyframe) {
  segment_ = segment, first_keyframe_ = first_keyframe;
  is_placed_ = false;
}

// By a constraint that was known when the epochs were placed.
bool KeptPlaces::is_found_since_then(int newest_constraint) const {
  return std::any_of(found_.begin(), found_.end(), [&](const auto& found) {
    return found.first <= newest_constraint && found.second >= first_keyframe_;
  });
}

bool KeptPlaces::is_found(const Run& run) const { return is_in_kept_map(run); }

void KeptPlaces::give_unit(Run* run) const {
  if (!is_metric_ || !is_found(*run)) return;
  scale_run(1, kKeptMapScale, run);
  run->scale.sigma = std::hypot(scale_sigma_, unit_sigma(*run));
}

std::string KeptPlaces::statement(const Run& run) const {
  const std::set<int> found = frames_found(run);
  if (found.empty())
    return "nothing of " + path_ + " was recognised: the run has a frame and a unit of its own";
  return std::to_string(found.size()) + " frames found in " + path_ + ", whose frame and unit the run has" +
         (is_metric_ ? " (metres)" : "");
}

std::string KeptPlaces::extend(const Run& run, const std::string& run_map,
                               const std::vector<Constraint>& found) const {
  const std::string file = map_file_of(path_);
  KeptMap map = read_finished_map(file);
  if (!map.warnings.empty())
    throw InputError(file, "is not extended, since that would lose what is damaged: " + map.warnings.front(),
                     "join what can be read with another map: edgevo join A B -o C");
  const KeptMap of_run = read_finished_map(run_map);
  const std::vector<Constraint> that_hold = those_that_hold(run, of_run, found);
  const size_t before = map.store.size(), added = extend_map(of_run, that_hold, &map);
  if (added == 0) return "nothing new for " + path_;
  write_map(map, file);
  return std::to_string(added) + " keyframes added to the " + std::to_string(before) + " of " + path_;
}

}  // namespace edgevo
