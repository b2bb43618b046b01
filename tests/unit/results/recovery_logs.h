// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Recovery logs of a run, written and read back.
#include <filesystem>
#include <string>
#include <vector>

#include "edgevo/core/output_file.h"
#include "edgevo/results/recovery_log.h"
#include "recovered_run.h"
#include "recovery_values.h"
#include "support/made_events.h"
#include "written_run.h"

namespace edgevo {

class RecoveryLogs : public WrittenRun {
 protected:
  RecoveryLogs() { std::filesystem::create_directories(folder_); }

  RecoveryHeader header() const {
    RecoveryHeader h;
    h.info.command_line = {"edgevo", "run", "a \"quoted\" folder"};
    h.info.source_kind = "synthetic";
    h.info.camera = made_.camera;
    h.info.notes = {{"seed", "3"}};
    h.scale = "odometry";
    h.tracks[VehicleSensor::kGps].positions = {{Timestamp{5}, {1, 2, 3}}, {Timestamp{7}, {4, 5, 6}}};
    h.T_vehicle_cam = SE3(Eigen::Quaterniond::Identity(), {0, 0, 1.5});
    return h;
  }
  // Writes the events of the first frames as a run does.
  void write_frames(size_t frames) const {
    RecoveryLog log(folder_.string(), header());
    for (size_t i = 0; i < frames; ++i) log.add(events_.frames()[i]);
  }
  size_t all_frames() const { return events_.frames().size(); }
  std::string bytes() const { return test::content(folder_ / kRecoveryLog); }
  void put(const std::string& bytes) const { write_file((folder_ / kRecoveryLog).string(), bytes); }
  std::vector<MapEvent> read() const {
    RecoveryLogReader reader(folder_.string());
    std::vector<MapEvent> events;
    while (auto event = reader.next()) events.push_back(std::move(*event));
    return events;
  }
  edgevo::Run recovered() const { return test::run_from(made_.run.pinhole, read()); }
  // The run that the events of the first frames make without a detour over the disk.
  edgevo::Run direct(size_t frames) const {
    std::vector<MapEvent> events;
    for (size_t i = 0; i < frames; ++i)
      for (const auto& event : events_.frames()[i]) events.push_back(*event);
    return test::run_from(made_.run.pinhole, events);
  }
  // What comes back of one event.
  template <class Event>
  Event there_and_back(Event event) const {
    test::FrameEvents events;
    test::append(std::move(event), &events);
    RecoveryLog(folder_.string(), header()).add(events);
    return std::get<Event>(read().at(0));
  }

  const test::MadeEvents events_{made_};
};

inline void expect_same(const SE3& a, const SE3& b) {
  EXPECT_EQ(a.translation(), b.translation());
  EXPECT_EQ(a.rotation().coeffs(), b.rotation().coeffs());
}

}  // namespace edgevo
