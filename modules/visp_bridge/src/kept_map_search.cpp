// SPDX-License-Identifier: BSD-3-Clause
#include "kept_map_search.h"

#include <utility>
#include <vector>

namespace edgevo {
namespace {

WorkerOptions place_worker(const OdometryOptions& options) {
  WorkerOptions worker;
  worker.name = "places";
  worker.own_thread = options.realtime;
  worker.low_priority = true;
  return worker;
}

}  // namespace

KeptMapSearch::KeptMapSearch(const Camera& camera, const OdometryOptions& options,
                             std::shared_ptr<const PlaceStore> kept)
    : tracker_(kept),
      places_(rectification_of(camera, options), options.map_log, {}, std::move(kept)),
      events_(options.map_log),
      worker_(place_worker(options)) {
  places_.look_up_young(true);
}

void KeptMapSearch::follow() {
  std::vector<std::shared_ptr<const MapEvent>> events = events_.read();
  for (const auto& event : events) found_.apply(*event);
  worker_.submit([this, events = std::move(events)] {
    for (const auto& event : events) places_.apply(*event);
  });
}

}  // namespace edgevo
