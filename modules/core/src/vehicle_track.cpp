// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/vehicle_track.h"

#include <algorithm>
#include <utility>

namespace edgevo {
namespace {

void sort_by_time(VehicleTrack* track) {
  auto& p = track->positions;
  std::stable_sort(p.begin(), p.end(),
                   [](const VehiclePosition& a, const VehiclePosition& b) { return a.time < b.time; });
  p.erase(std::unique(p.begin(), p.end(),
                      [](const VehiclePosition& a, const VehiclePosition& b) { return a.time == b.time; }),
          p.end());
}

}  // namespace

VehicleTrack longest_track(std::map<std::string, VehicleTrack> tracks) {
  VehicleTrack longest;
  for (auto& [label, track] : tracks)
    if (track.positions.size() > longest.positions.size()) longest = std::move(track);
  if (!longest.positions.empty()) {
    const Eigen::Vector3d first = longest.positions.front().position;
    for (VehiclePosition& p : longest.positions) p.position -= first;
  }
  sort_by_time(&longest);
  return longest;
}

}  // namespace edgevo
