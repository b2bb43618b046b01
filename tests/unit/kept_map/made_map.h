// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A made-up map: keyframes along a corridor (support/synthetic_run.h) with views of random corners and edges.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "edgevo/core/random.h"
#include "edgevo/core/record_units.h"
#include "edgevo/kept_map/map_file_writer.h"
#include "support/synthetic_run.h"
#include "support/temp_folder.h"

namespace edgevo::test {

/// A view with `corners` corners and `edges` edges of 30 pixels.
inline RememberedView made_view(const Pinhole& pinhole, int corners, int edges, Random* random) {
  RememberedView view;
  view.corners.descriptors.resize(size_t(corners));
  for (int i = 0; i < corners; ++i) {
    view.corners.px.emplace_back(float(random->uniform(0, pinhole.width - 1)),
                                 float(random->uniform(0, pinhole.height - 1)));
    for (uint8_t& byte : view.corners.descriptors[size_t(i)]) byte = uint8_t(random->below(256));
  }
  view.edges.pinhole = pinhole.at_level(1);
  for (int e = 0; e < edges; ++e) {
    view.edges.begins.push_back(int32_t(view.edges.at.size()));
    double x = random->uniform(40, view.edges.pinhole.width - 40),
           y = random->uniform(40, view.edges.pinhole.height - 40), angle = random->uniform(0, 2 * M_PI);
    for (int i = 0; i < 30; ++i) {
      view.edges.at.push_back({uint16_t(std::lround(16 * x)), uint16_t(std::lround(16 * y))});
      view.edges.normal.push_back(uint8_t(std::lround((angle + M_PI / 2) * 256 / (2 * M_PI)) & 255));
      angle += random->uniform(-0.1, 0.1);
      x += std::cos(angle) + random->uniform(-0.1, 0.1), y += std::sin(angle) + random->uniform(-0.1, 0.1);
    }
  }
  for (uint64_t& bits : view.signature.bits)
    bits = uint64_t(random->below(1 << 30)) << 33 | uint64_t(random->below(1 << 30));
  view.light = {float(random->uniform(20, 200)), float(random->uniform(5, 60))};
  return view;
}

/// A run, its keyframes as they left the window (in another unit), and the file that they are written to.
struct MadeMap {
  /// Half the unit of the run.
  static constexpr double kGrowth = 2;

  explicit MadeMap(int frames = 90, int points = 100, int corners = 40, int edges = 20)
      : run(synthetic_run(frames, points).run) {
    Random random(5);
    header = {run.pinhole, "a camera", "a source"};
    for (size_t i = 0; i < run.keyframes.size(); ++i) {
      auto record = std::make_shared<KeyframeRecord>(run.keyframes[i]);
      record->T_world_cam = SE3(record->T_world_cam.rotation(), record->T_world_cam.translation() / kGrowth);
      multiply_depths(1 / kGrowth, record.get());
      StoredKeyframe k{id_of(i), record->segment + 1, record,
                       std::make_shared<RememberedView>(made_view(run.pinhole, corners, edges, &random)),
                       std::nullopt};
      keyframes.push_back(k);
    }
    for (size_t i = 0; i + 1 < keyframes.size(); ++i)
      keyframes[i].next = NeighbourPose{
          id_of(i + 1), keyframes[i].record->T_world_cam.inverse() * keyframes[i + 1].record->T_world_cam,
          Matrix6d::Identity() * 1e-4};
  }
  static int id_of(size_t i) { return 2 * int(i); }

  /// A place seen again.
  ConstraintAdded place(int number, size_t from, size_t to) const {
    Constraint c;
    c.from = NodeId::keyframe(id_of(from)), c.to = NodeId::keyframe(id_of(to));
    c.T_from_to = {1, keyframes[from].record->T_world_cam.inverse() * keyframes[to].record->T_world_cam};
    c.kind = ConstraintKind::kPlace;
    return {number, c};
  }
  void write(MapFileWriter* writer) const {
    for (const StoredKeyframe& k : keyframes) writer->add(k);
  }
  /// Writes a finished map.
  void write(const std::string& path) const {
    MapFileWriter writer(path, header);
    write(&writer);
    writer.add(place(0, 1, 5));
    writer.finish(run);
  }

  Run run;
  MapHeader header;
  std::vector<StoredKeyframe> keyframes;
};

}  // namespace edgevo::test
