// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A window on a run (`edgevo run --view`): the newest frame, its edges coloured by depth or
// residual, the map and the path.
//
//   space  pause or resume        s  one frame, then pause       c  colour by depth or by residual
//   f      follow the camera      q  end the run (all results are written)
// The run continues if the window is closed. The mouse rotates, moves and zooms the map.
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "edgevo/map/map_log.h"
#include "edgevo/run_loop/run_odometry.h"

namespace edgevo {

/// The window. For use by one thread.
class RunView {
 public:
  /// Opens the window on the run whose events go to `log` (OdometryOptions::map_log), before its first frame.
  /// Returns null if that fails, for example without a display; `*why` is then the reason.
  static std::unique_ptr<RunView> open(const std::optional<SE3>& T_vehicle_cam, std::shared_ptr<MapLog> log,
                                       std::string* why);
  ~RunView();

  /// Shows a frame and waits while the view is paused, until `stop()` returns true. Returns false if the user
  /// wants the run to end. Cost: some milliseconds a frame in this thread; drawing has its own thread.
  [[nodiscard]] bool show(const ProcessedFrame& processed, const std::function<bool()>& stop);

 private:
  struct Impl;
  explicit RunView(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
