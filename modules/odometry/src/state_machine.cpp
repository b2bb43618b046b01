// SPDX-License-Identifier: BSD-3-Clause
#include "state_machine.h"

#include <algorithm>

#include "edgevo/confidence/frame_status.h"
#include "edgevo/core/angle.h"

namespace edgevo {

std::optional<Event> event_of(MapInView seen) {
  if (seen == MapInView::kUncertain) return std::nullopt;
  return seen == MapInView::kYes ? Event::kInView : Event::kOutOfView;
}

Event event_of(TrackingState status) {
  if (status == TrackingState::kLost) return Event::kUntracked;
  return status == TrackingState::kTracking ? Event::kTracked : Event::kDegraded;
}

// share/doc/architecture.md draws this table.
Transition transition(Phase phase, Event event) {
  switch (phase) {
    case Phase::kBootstrapping:
      if (event == Event::kMapMade) return {Phase::kTracking, Action::kNone};
      break;
    case Phase::kTracking:
      if (event == Event::kUntracked) return {Phase::kLost, Action::kLose};
      if (event == Event::kOutOfView) return {Phase::kSeeking, Action::kBeginBootstrap};
      break;
    case Phase::kSeeking:
      if (event == Event::kUntracked) return {Phase::kLost, Action::kLose};
      if (event == Event::kInView) return {Phase::kTracking, Action::kDropBootstrap};
      if (event == Event::kMapMade) return {Phase::kTracking, Action::kNone};
      if (event == Event::kMapRefused) return {Phase::kBootstrapping, Action::kNone};
      break;
    case Phase::kLost:
      // A DEGRADED pose is not enough for a relocalisation.
      if (event == Event::kTracked) return {Phase::kTracking, Action::kRelocalised};
      if (event == Event::kMapMade) return {Phase::kTracking, Action::kNone};
      if (event == Event::kMapRefused) return {Phase::kBootstrapping, Action::kNone};
      break;
  }
  return {phase, Action::kNone};
}

bool OdometryState::tracks(int edges, double heading_sigma) {
  // Standard deviation of the headings that a search covers: some 40 degrees to both sides.
  constexpr double kSearched = rad(20);
  if (phase_ != Phase::kLost) return has_map();
  if (!shows_edges(edges, params_) || relocalisation_tries_ >= max_relocalisation_tries_) return false;
  relocalisation_tries_ += std::min(1.0, heading_sigma / kSearched);
  return true;
}

Action OdometryState::after(Event event, int frame_index) {
  const Transition t = transition(phase_, event);
  phase_ = t.next;
  if (t.action == Action::kLose) lost_at_ = frame_index, relocalisation_tries_ = 0;
  if (event == Event::kMapMade) ++segment_, is_located_ = false;
  return t.action;
}

bool OdometryState::locate() {
  if (is_located_) return false;
  ++segment_;
  return is_located_ = true;
}

TrackingState OdometryState::without_pose(int frame_index, int edges) const {
  return ever_tracked() && (!shows_edges(edges, params_) || lost_at_ == frame_index)
             ? TrackingState::kLost
             : TrackingState::kBootstrapping;
}

TrackingState OdometryState::when_skipped() const {
  return ever_tracked() ? TrackingState::kLost : TrackingState::kBootstrapping;
}

}  // namespace edgevo
