// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_loop/past_follower.h"

#include <atomic>
#include <utility>
#include <vector>

#include "edgevo/core/rectification.h"
#include "edgevo/core/worker.h"
#include "edgevo/map/map_log.h"
#include "edgevo/scale/ground_links.h"

namespace edgevo {
namespace {

// Frames that the places may be behind, a few seconds; then keyframes are remembered, which costs a tenth,
// and not looked up: each that waits keeps its images in memory.
constexpr int kMaxWaiting = 100;

WorkerOptions worker_options(const OdometryOptions& options) {
  WorkerOptions worker;
  worker.name = "places";
  worker.own_thread = options.realtime;
  worker.low_priority = true;
  return worker;
}

}  // namespace

struct PastFollower::Impl {
  Impl(const Rectification& rectification, const std::optional<SE3>& T_vehicle_cam,
       const OdometryOptions& options, const PastParams& params)
      : ground(rectification.target(), T_vehicle_cam, params.scale, options.map_log),
        ground_events(options.map_log),
        worker(worker_options(options)) {
    if ((!params.places.loops && !params.kept) || options.forget) return;
    places.emplace(rectification, options.map_log, params.places, params.kept);
    places->look_up_young(params.looks_up_young);
    if (params.on_stored) places->on_stored(params.on_stored);
    if (params.on_young) places->on_young(params.on_young);
    if (params.on_found) places->on_found(params.on_found);
    place_events.emplace(options.map_log);
  }

  void follow_places() {
    if (!places) return;
    std::vector<std::shared_ptr<const MapEvent>> events = place_events->read();
    ++waiting;
    worker.submit([this, events = std::move(events)] {
      places->look_up_too(--waiting < kMaxWaiting);
      for (const auto& event : events) places->apply(*event);
    });
  }

  GroundLinks ground;
  MapCursor ground_events;
  std::optional<PlaceMemory> places;
  std::optional<MapCursor> place_events;
  std::atomic<int> waiting = 0;  // frames whose events are not taken yet
  Worker worker;                 // the last one: its work uses the others
};

PastFollower::PastFollower(const Camera& camera, const std::optional<SE3>& T_vehicle_cam,
                           const OdometryOptions& options, const PastParams& params)
    : impl_(std::make_unique<Impl>(rectification_of(camera, options), T_vehicle_cam, options, params)) {}
PastFollower::~PastFollower() = default;

void PastFollower::follow() {
  for (const auto& event : impl_->ground_events.read()) impl_->ground.apply(*event);
  impl_->follow_places();
}

PlaceCounts PastFollower::finish() {
  if (!impl_->places) return {};
  impl_->follow_places();
  impl_->worker.wait_idle();
  impl_->places->finish();
  return impl_->places->counts();
}

}  // namespace edgevo
