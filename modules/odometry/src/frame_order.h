// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The order of the frames that a run is given: indices and times must ascend.
#include <optional>
#include <string>

#include "edgevo/core/image.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Checks each frame against those before it.
class FrameOrder {
 public:
  /// Throws InputError, which begins with `where`, unless the frame follows in index and time.
  void take(const Frame& frame, const std::string& where);
  /// The same for a frame that is skipped, whose time may be that of the frame before. Returns the time of
  /// its record, a tick later then.
  Timestamp take_skipped(const Frame& frame, const std::string& where);
  /// Whether the time of such a frame is after that of the newest record.
  bool has_own_time(const Frame& frame) const { return !newest_time_ || *newest_time_ < frame.time; }

 private:
  void require_next_index(const Frame& frame, const std::string& where) const;
  [[noreturn]] void refuse_time(const Frame& frame, const std::string& where, const char* relation) const;

  std::optional<int> newest_index_;
  std::optional<Timestamp> newest_time_;  // of the newest record
  std::optional<Timestamp> stated_time_;  // of the newest frame, as given
};

}  // namespace edgevo
