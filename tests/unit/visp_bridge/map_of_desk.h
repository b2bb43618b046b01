// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The rendered desk, and the map that a run over it keeps.
#include <memory>

#include "edgevo/map/map_log.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/places/place_memory.h"
#include "edgevo/simulation/scene_renderer.h"
#include "edgevo/visp_bridge/servo_params.h"

namespace edgevo::test {

inline const SceneRenderer& desk() {
  static const SceneRenderer renderer(load_scene("desk"));
  return renderer;
}

constexpr int kDeskFrames = 60;

inline Frame desk_frame(int i) { return {i, Timestamp::from_seconds(i / 30.0), desk().render_image(i)}; }

// The keyframes of a run over the desk, and its poses.
inline std::shared_ptr<const PlaceStore> map_of_desk(edgevo::Run* run) {
  OdometryOptions options;
  options.map_log = std::make_shared<MapLog>();
  const Rectification rectification = rectification_of(desk().camera(), options);
  auto kept = std::make_shared<PlaceStore>(rectification.target());
  MapCursor events(options.map_log);
  PlaceMemory memory(rectification, options.map_log);
  memory.on_stored([&](const StoredKeyframe& k) { kept->add(k); });
  Odometry odometry(desk().camera(), servo_odometry_params(), options);
  for (int i = 0; i < kDeskFrames; ++i) odometry.process(desk_frame(i));
  odometry.close();
  for (const auto& event : events.read()) memory.apply(*event);
  *run = odometry.finish();
  return kept;
}

}  // namespace edgevo::test
