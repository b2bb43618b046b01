// SPDX-License-Identifier: BSD-3-Clause
// Whether places that are none can bend a map: a share of forged ones is added to those that a run has
// stated, and all are solved for.
//   forged_places RUN SHARE SEED
// RUN: folder of a run with loops that was killed, with its recovery log. SHARE: forged places over stated
// ones, such as 0.05. Half of them say that a keyframe is at another place than it is, as a look-alike does;
// half that it is aside of the right one, as the next window of a facade does.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "edgevo/core/order_statistics.h"
#include "edgevo/core/thread_clock.h"
#include "edgevo/map/run_builder.h"
#include "edgevo/results/recovery_log.h"

namespace {

using namespace edgevo;

struct Events {
  Rectification rectification;
  std::vector<MapEvent> all;
  std::map<int, Constraint> places;  // of two keyframes; not withdrawn
  std::vector<int> keyframes;        // ids
};

Events events_of(const std::string& folder) {
  RecoveryLogReader log(folder);
  const RunInfo& info = log.header().info;
  Events events{rectification_of(info.camera, info.working_pinhole), {}, {}, {}};
  while (std::optional<MapEvent> event = log.next()) {
    if (const auto* c = std::get_if<ConstraintAdded>(&*event))
      if (c->constraint.kind == ConstraintKind::kPlace && c->constraint.from != NodeId::world())
        events.places[c->id] = c->constraint;
    if (const auto* c = std::get_if<ConstraintWithdrawn>(&*event)) events.places.erase(c->id);
    if (const auto* k = std::get_if<KeyframeMarginalised>(&*event)) events.keyframes.push_back(k->id);
    events.all.push_back(std::move(*event));
  }
  return events;
}

struct Solved {
  PlacedEpochs placed;
  std::map<int, Eigen::Vector3d> positions;
  double cpu_s = 0;  // of placing the keyframes once
};

Solved solve(const Events& events, const std::map<int, Constraint>& forged) {
  RunBuilder builder(events.rectification);
  for (const MapEvent& e : events.all) builder.apply(e);
  for (const auto& [id, c] : forged) builder.apply(ConstraintAdded{id, c});
  const double begin_ms = thread_cpu_ms();
  Solved solved{builder.place_keyframes(), {}};
  solved.cpu_s = 1e-3 * (thread_cpu_ms() - begin_ms);
  for (const int id : events.keyframes)
    if (const auto k = builder.find_keyframe(id))
      solved.positions[id] = solved.placed.T_world_map(k->segment, id) * k->T_map_cam.translation();
  return solved;
}

// Half to five units along the camera's axis x or z.
Eigen::Vector3d aside(std::mt19937* random) {
  const double way = std::uniform_real_distribution<>(0.5, 5)(*random), sign = (*random)() % 2 == 0 ? 1 : -1;
  return sign * way * ((*random)() % 2 == 0 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ());
}

bool is_elsewhere(int place, const Constraint& c) {
  constexpr int kKeyframesApart = 20;
  return std::abs(place - c.from.number()) >= kKeyframesApart &&
         std::abs(place - c.to.number()) >= kKeyframesApart;
}

std::map<int, Constraint> forge(const Events& events, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::map<int, Constraint> forged;
  const size_t wanted = size_t(std::lround(share * double(events.places.size())));
  while (forged.size() < wanted) {
    const auto right = std::next(events.places.begin(), long(random() % events.places.size()));
    const int place = events.keyframes[random() % events.keyframes.size()];
    if (!is_elsewhere(place, right->second)) continue;
    Constraint& c = forged[events.places.rbegin()->first + 1 + int(forged.size())];
    c = right->second;
    if (forged.size() % 2 == 0)
      c.from = NodeId::keyframe(place);
    else
      c.T_from_to.rigid = SE3(Eigen::Quaterniond::Identity(), aside(&random)) * c.T_from_to.rigid;
  }
  return forged;
}

template <class Map>
int held(const Map& constraints, const PlacedEpochs& placed) {
  int count = 0;
  for (const auto& [id, c] : constraints) count += !placed.is_unused(id);
  return count;
}

void print(const Events& events, double share, unsigned seed) {
  const std::map<int, Constraint> forged = forge(events, share, seed);
  const Solved before = solve(events, {}), after = solve(events, forged);
  std::vector<double> moved;
  for (const auto& [id, position] : before.positions)
    moved.push_back((after.positions.at(id) - position).norm());
  std::printf(
      "places %zu, held %d without and %d with %zu forged ones, of which %d hold; keyframes %zu, moved by "
      "%.4f in the median and %.4f at most; placed in %.3f and %.3f CPU s\n",
      events.places.size(), held(events.places, before.placed), held(events.places, after.placed),
      forged.size(), held(forged, after.placed), moved.size(), median(moved),
      *std::max_element(moved.begin(), moved.end()), before.cpu_s, after.cpu_s);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 4) return std::fprintf(stderr, "forged_places RUN SHARE SEED\n"), 2;
  const Events events = events_of(argv[1]);
  if (events.places.empty()) return std::fprintf(stderr, "%s: no place was stated\n", argv[1]), 2;
  print(events, std::atof(argv[2]), unsigned(std::atoi(argv[3])));
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 2;
}
