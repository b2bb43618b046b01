// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The stream of map events of one run, from the threads that change the map to those that follow it.
//
// Producers (tracking and mapping, each in its thread) append; each consumer reads through a cursor of its
// own. The events of one thread keep their order; those of two threads are ordered by the log, so that all
// consumers see the same order. An event is kept until every cursor has passed it.
#include <memory>
#include <vector>

#include "edgevo/map/map_event.h"

namespace edgevo {

class MapCursor;

/// The stream of events. Safe in any thread.
class MapLog {
 public:
  MapLog();
  ~MapLog();
  MapLog(const MapLog&) = delete;
  MapLog& operator=(const MapLog&) = delete;

  /// Appends an event. Cost: a lock and a move; without cursors the event is dropped.
  void append(MapEvent event);

  /// Announces a relation between two keyframes, of whatever segments, and returns its number in the run. So
  /// does everything that finds out about the past: ground, other sensors, places seen again, from any thread
  /// and without knowing of each other. Live poses do not jump; what is final moves (map/epochs.h) from the
  /// next frame on. State a place from the earlier keyframe to the later one: only then is it tested whether
  /// it looks alike. Between epochs Constraint::failure counts for the unit alone. From the world to a
  /// keyframe: where it lies in a map that was kept, whose frame and unit the run then has. Throws
  /// std::invalid_argument, and changes nothing, if an end is no keyframe that was announced, or as
  /// check_constraint().
  int add_constraint(const Constraint& constraint);
  /// Announces that a relation is none. Throws std::invalid_argument if there is none with this number.
  void withdraw_constraint(int id);

  /// Number of events that some cursor has not passed yet.
  size_t kept() const;

 private:
  friend class MapCursor;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The place of one consumer in the stream; for use by one thread at a time.
class MapCursor {
 public:
  /// Begins at the next event that is appended: a consumer that wants all events makes its cursor before the
  /// first frame.
  explicit MapCursor(std::shared_ptr<MapLog> log);
  ~MapCursor();
  MapCursor(MapCursor&&) noexcept;
  MapCursor& operator=(MapCursor&&) = delete;

  /// The events since the last call, oldest first.
  [[nodiscard]] std::vector<std::shared_ptr<const MapEvent>> read();

 private:
  std::shared_ptr<MapLog> log_;
  size_t id_ = 0;
};

}  // namespace edgevo
