#pragma once
// A window on a run (`edgevo run --view`): the newest frame, its edges coloured by depth or
// residual, the map and the path.
//
//   space  pause and go on        s  one frame, then pause       c  colour by depth or by residual
//   f      follow the camera      q  end the run (all results are written)
// Closing the window leaves the run going. The mouse turns, moves and zooms the map.
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "edgevo/drive/drive.h"

namespace edgevo {

/// The window. One thread calls.
class RunView {
 public:
  /// Opens the window. Null where there is no display; `*why` then says so.
  static std::unique_ptr<RunView> open(const std::optional<SE3>& T_vehicle_cam, std::string* why);
  ~RunView();

  /// Shows a frame and waits while the view is paused, unless `stop()`. False: the user wants the run to end.
  /// Cost: some milliseconds a frame in this thread; drawing has its own.
  [[nodiscard]] bool show(const DrivenFrame& driven, const std::function<bool()>& stop);

 private:
  struct Impl;
  explicit RunView(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
