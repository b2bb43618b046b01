// SPDX-License-Identifier: BSD-3-Clause
// In edgevo-view.
#include "view_window.h"

#include "edgevo/viewer/run_view.h"

namespace edgevo::app {

void become_program_with_window(const std::vector<std::string>&) {}

ShowFrame open_view_window(const std::optional<SE3>& T_vehicle_cam, std::shared_ptr<MapLog> log,
                           std::function<bool()> stop, std::string* why) {
  const std::shared_ptr<RunView> view = RunView::open(T_vehicle_cam, std::move(log), why);
  if (!view) return {};
  return [view, stop = std::move(stop)](const ProcessedFrame& frame) { return view->show(frame, stop); };
}

}  // namespace edgevo::app
